// Runs of a hundred thousand steps: the error of what the motion keeps grows by chance, not in one
// direction (Brouwer's law), and far below the rounding of single steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/taylor/quadratic_targets.hpp"

namespace casimir::test {
namespace {

using State = std::vector<double>;

/// A free rigid body with these reciprocal moments of inertia: M' = M x (a M).
QuadraticForm free_body(double a1, double a2, double a3) {
  QuadraticForm form;
  form.states = 3;
  form.constant = State(3);
  form.linear.assign(3, State(3));
  form.products = {{0, 1, {0, 0, a2 - a1}}, {0, 2, {0, a1 - a3, 0}}, {1, 2, {a3 - a2, 0, 0}}};
  return form;
}

/// The largest change of energy so far, at times a factor of two apart.
struct Drift {
  long double start = 0;
  double first = 0, next = 0, largest = 0;
  std::vector<double> times, sizes;

  static long double energy(const double* m) {
    const long double a = m[0], b = m[1], c = m[2];
    return a * a / 2 + b * b / 4 + c * c / 8;
  }

  void see(double t, const double* m) {
    largest = std::max(largest, std::abs(static_cast<double>((energy(m) - start) / start)));
    if (t < next) return;
    times.push_back(t);
    sizes.push_back(largest);
    next = 2 * t;
  }

  /// The slope of the line through log(size) over log(time).
  double exponent() const {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double x = std::log(times[i]), y = std::log(sizes[i]);
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
  }
};

const State kStarts[] = {
    {0.75, 0.5, 1}, {0.3, 0.9, -0.7}, {1, 0.1, 0.2}, {-0.6, 0.4, 0.9}, {0.5, -1.1, 0.3}};
constexpr double kDuration = 1e5;  // some 5000 periods

/// \param pieces  runs that follow each other: each begins without the carry of the one before.
Drift drift_of(const std::string& target, const State& start, int pieces) {
  const QuadraticKernel kernel(free_body(1, 0.5, 0.25), target);
  Drift drift;
  State x = start;
  drift.start = Drift::energy(x.data());
  drift.next = kDuration / 200;
  for (int k = 0; k < pieces; ++k) {
    casimir_run run = {};
    run.t_begin = k * (kDuration / pieces);
    run.t_end = (k + 1) * (kDuration / pieces);
    run.rtol = run.atol = 1e-15;
    run.observer = &drift;
    run.observe = [](void* self, const casimir_step* step) {
      static_cast<Drift*>(self)->see(step->t1, step->x1);
      return 0;
    };
    casimir_outcome out = {};
    kernel.integrate(&run, x.data(), &out);
    EXPECT_EQ(out.status, CASIMIR_OK);
  }
  return drift;
}

class LongRun : public testing::TestWithParam<std::string> {};

TEST_P(LongRun, TheEnergyErrorGrowsNoFasterThanTheRootOfTime) {
  double exponents = 0, largest = 0;
  for (const State& start : kStarts) {
    const Drift drift = drift_of(GetParam(), start, 1);
    exponents += drift.exponent();
    largest = std::max(largest, drift.largest);
  }
  EXPECT_LT(exponents / std::size(kStarts), 0.65);
  EXPECT_LT(largest, 5e-15);
  EXPECT_GT(largest, 1e-17);  // doubles are not that good: something was measured
}

TEST_P(LongRun, WithoutTheCarryTheEnergyErrorIsManyTimesAsLarge) {
  double largest = 0;
  for (const State& start : kStarts)
    largest = std::max(largest, drift_of(GetParam(), start, 50'000).largest);
  EXPECT_GT(largest, 8e-15);
}

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, LongRun, testing::ValuesIn(quadratic_targets()),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace casimir::test
