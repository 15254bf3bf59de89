#include "runtime/taylor/scaled_run.hpp"

#include <algorithm>
#include <cmath>

namespace casimir {

ScaledRun::ScaledRun(const casimir_run& run, double scale, std::size_t states)
    : run_(run), scaled_(run), scale_(scale), x0_(states), x1_(states) {
  scaled_.atol = run.atol / scale;
  scaled_.leading = nullptr;  // of the unscaled equations
  scaled_.observe = &observe;
  scaled_.observer = this;
}

double ScaledRun::scale_for(const double* x, std::size_t states) {
  // Squares are still numbers; of small ones so are those that are 1e-60 of them. No nearer: small
  // states beside large ones are the worse for it.
  constexpr int kHuge = 500, kTiny = -400;
  double size = 0;
  for (std::size_t i = 0; i < states; ++i) size = std::max(size, std::abs(x[i]));
  if (size == 0 || !std::isfinite(size)) return 1;
  const int exponent = std::ilogb(size);
  return exponent > kHuge || exponent < kTiny ? std::ldexp(1.0, exponent) : 1;
}

void ScaledRun::finish(double* x, casimir_outcome* out) const {
  if (left_range_) {
    std::ranges::copy(x0_, x);
    out->t = t0_;
    out->status = CASIMIR_NON_FINITE;
    return;
  }
  for (std::size_t i = 0; i < x0_.size(); ++i) x[i] *= scale_;
}

int ScaledRun::observe(void* self, const casimir_step* seen) {
  auto& run = *static_cast<ScaledRun*>(self);
  for (std::size_t i = 0; i < run.x0_.size(); ++i) {
    run.x0_[i] = seen->x0[i] * run.scale_;
    run.x1_[i] = seen->x1[i] * run.scale_;
    run.left_range_ = run.left_range_ || !std::isfinite(run.x1_[i]);
  }
  if (run.left_range_) run.t0_ = seen->t0;
  if (run.left_range_ || !run.run_.observe) return run.left_range_;
  run.seen_ = seen;
  const casimir_step shown = {seen->t0, seen->t1, run.x0_.data(), run.x1_.data(),
                              &dense,   &run,     nullptr,        nullptr};
  return run.run_.observe(run.run_.observer, &shown);
}

void ScaledRun::dense(const casimir_step* step, double t, double* x) {
  const auto& run = *static_cast<const ScaledRun*>(step->data);
  run.seen_->dense(run.seen_, t, x);
  for (std::size_t i = 0; i < run.x0_.size(); ++i) x[i] *= run.scale_;
}

}  // namespace casimir
