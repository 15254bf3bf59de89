#include "runtime/outside/sundials.hpp"

#include <sundials/sundials_version.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>

#include "runtime/outside/sundials_version.hpp"

namespace casimir {

std::string sundials_version() {
  char text[64] = "";
  SUNDIALSGetVersion(text, static_cast<int>(sizeof text));
  return text;
}

}  // namespace casimir

namespace casimir::sundials {
namespace {

bool all_finite(const double* x, std::size_t n) {
  return std::all_of(x, x + n, [](double v) { return std::isfinite(v); });
}

/// Like the kernels: a run that can go no further at a place where the solution changes by its own
/// size in a vanishing part of the time passed has met a singularity.
bool singular(const Problem& problem, const Trajectory& trajectory) {
  std::vector<double> slope(trajectory.state.size());
  problem.functions->rhs(trajectory.time, trajectory.state.data(), problem.parameters,
                         slope.data());
  double size = 0, speed = 0;
  for (std::size_t i = 0; i < slope.size(); ++i) {
    size = std::max(size, std::abs(trajectory.state[i]));
    speed = std::max(speed, std::abs(slope[i]));
  }
  constexpr double kVanishing = 1e-6;
  return size < kVanishing * speed * std::abs(trajectory.time);
}

}  // namespace

Owned<SUNContext> new_context() {
  SUNContext raw = nullptr;
  if (SUNContext_Create(nullptr, &raw) != 0) throw std::bad_alloc();
  return Owned<SUNContext>(raw);
}

Owned<N_Vector> new_vector(const std::vector<double>& values, SUNContext context) {
  Owned<N_Vector> vector(N_VNew_Serial(static_cast<sunindextype>(values.size()), context));
  if (!vector) throw std::bad_alloc();
  std::copy(values.begin(), values.end(), N_VGetArrayPointer(vector.get()));
  return vector;
}

int rhs(realtype t, N_Vector y, N_Vector dy, void* data) {
  const auto* problem = static_cast<const Problem*>(data);
  problem->functions->rhs(t, N_VGetArrayPointer(y), problem->parameters, N_VGetArrayPointer(dy));
  for (sunindextype i = 0; i < N_VGetLength(dy); ++i) {
    if (!std::isfinite(NV_Ith_S(dy, i))) return 1;
  }
  return 0;
}

void keep_quiet(int, const char*, const char*, char*, void*) {}

bool starts_well(const Problem& problem, const Settings& settings, Trajectory& trajectory) {
  const std::size_t n = trajectory.state.size();
  std::vector<double> slope(n);
  problem.functions->rhs(0, trajectory.state.data(), problem.parameters, slope.data());
  if (all_finite(trajectory.state.data(), n) &&
      (settings.duration == 0 || all_finite(slope.data(), n)))
    return true;
  trajectory.status = Status::non_finite;
  return false;
}

void integrate(const Problem& problem, const Settings& settings, Observer& observer,
               Trajectory& trajectory, const double* x, const Stepper& stepper) {
  const std::size_t n = trajectory.state.size();
  const auto start = std::chrono::steady_clock::now();
  realtype t = 0;
  while (t != settings.duration) {
    if (settings.max_steps > 0 && trajectory.steps == settings.max_steps) {
      trajectory.status = Status::max_steps;
      break;
    }
    const int flag = stepper.step(&t);
    // A step that does not move the time is lost in rounding.
    if (flag < 0 || t == trajectory.time || !all_finite(x, n)) {
      trajectory.status =
          singular(problem, trajectory) ? Status::singularity : stepper.meaning(flag);
      break;
    }
    std::copy_n(x, n, trajectory.state.begin());
    trajectory.time = t;
    ++trajectory.steps;
    if (observer.needed() && !observer.step(t, x, stepper.state_at) && t != settings.duration) {
      trajectory.status = Status::stopped;
      break;
    }
  }
  trajectory.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace casimir::sundials
