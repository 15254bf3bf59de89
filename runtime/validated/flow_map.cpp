#include "runtime/validated/flow_map.hpp"

#include <cmath>

namespace casimir::validated {
namespace {

/// A time of the run is a whole multiple of 2^-kStepBits of the whole time: a double, exactly.
constexpr int kStepBits = 46;
constexpr int kTries = 60;

double down_to(double grid, double h) { return std::floor(h / grid) * grid; }

}  // namespace

bool FlowMap::fail(std::string reason) {
  reason_ = std::move(reason);
  return false;
}

bool FlowMap::find(const std::vector<ArbBall>& start, const std::vector<MidRad>& wide,
                   const MidRad& time, bool derivatives) {
  reason_.clear();
  if (!is_usable(time) || contains_zero(time) || time.mid < 0)
    return fail("the time is not certain to be positive");
  StepSettings steps;
  steps.order = settings_.order;
  steps.log2_error = settings_.log2_error;
  steps.derivatives = derivatives;
  try {
    Lohner<MidRad> lohner(flow_, integrals_, steps);
    lohner.begin(start, wide);
    return go(lohner, time);
  } catch (const std::domain_error& problem) {
    return fail(std::string("the equations are not certain to have a value: ") + problem.what());
  }
}

/// The length of a step that is enclosed, or 0. The last one takes all times of the interval, which
/// no other comes near to.
double FlowMap::enclosed_step(Lohner<MidRad>& lohner, double proposed, double last) const {
  double h = std::min(proposed, last);
  bool full = true;
  for (int k = 0; k < kTries; ++k) {
    if (h < last) h = down_to(grid_, std::min(h, last / 2));
    if (!(h > 0)) return 0;
    const double by = lohner.shortened_by(MidRad(h), full && h < last);
    if (by == 0) return h;
    full = false;
    h *= std::exp2(-by);
  }
  return 0;
}

bool FlowMap::go(Lohner<MidRad>& lohner, const MidRad& time) {
  int exponent = 0;
  std::frexp(time.mid, &exponent);
  grid_ = std::ldexp(1., exponent - kStepBits);
  // A multiple of the grid that is not below any of the times.
  const double end = (std::floor(upwards(time.mid + time.rad) / grid_) + 1) * grid_;
  double elapsed = 0;
  for (int k = 0; k < settings_.max_steps; ++k) {
    if (settings_.give_up && settings_.give_up()) return fail("no time was left");
    const double log2_h = lohner.prepare(MidRad(elapsed));
    if (std::isnan(log2_h)) return fail("the numbers have become too large");
    const double last = end - elapsed;
    const double h = enclosed_step(lohner, log2_h > 1000 ? last : std::exp2(log2_h), last);
    if (!(h > 0)) return fail("no step of any length can be enclosed");
    if (h == last) {
      const MidRad after = time - MidRad(elapsed);
      const bool within =
          after.mid - upwards(after.rad) >= 0 && upwards(after.mid + after.rad) <= h;
      if (!within) return fail("the interval of times is longer than a step");
      result_.states = lohner.box_at(after);
      if (lohner.follows_derivatives()) result_.derivatives = lohner.derivatives_at(after);
      result_.rates = rates_(result_.states, MidRad());
      lohner.pass(MidRad(h));
      result_.not_kept = lohner.not_kept();
      return true;
    }
    if (lohner.advance(MidRad(h)) != StepOutcome::taken) return fail("the set has become too wide");
    elapsed += h;
  }
  return fail("it is not enclosed to the end within the steps that are allowed");
}

}  // namespace casimir::validated
