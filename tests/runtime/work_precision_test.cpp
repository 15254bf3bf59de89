#include "runtime/work_precision.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/runtime/systems.hpp"

namespace casimir::test {
namespace {

Sample oscillator_sample(double duration, double tolerance, const Truth& truth,
                         unsigned long long max_steps = 0) {
  Settings settings;
  settings.duration = duration;
  settings.rtol = settings.atol = tolerance;
  settings.max_steps = max_steps;
  const Module module = module_of<Oscillator>(dop853<Oscillator>, 0, 1);
  return measure(module, *find_method("dop853"), settings, {1, 0}, {}, truth, 0.001, 20);
}

TEST(WorkPrecision, TimeComesWithItsError) {
  const Truth truth = {{std::cos(50.), -std::sin(50.)}, {0, 0}, {1, 1}};
  const Sample coarse = oscillator_sample(50, 1e-6, truth);
  const Sample fine = oscillator_sample(50, 1e-10, truth);
  EXPECT_EQ(coarse.status, Status::ok);
  EXPECT_EQ(coarse.method, "dop853");
  EXPECT_EQ(coarse.tolerance, 1e-6);
  EXPECT_LT(fine.error, 1e-2 * coarse.error);
  EXPECT_GT(fine.error, 0);
  EXPECT_LT(fine.drift, 1e-2 * coarse.drift);
  EXPECT_GT(fine.steps, coarse.steps);
  EXPECT_GT(fine.seconds, 0);
  EXPECT_GE(fine.spread, 0);
}

TEST(WorkPrecision, RunThatFailedHasNoError) {
  const Truth truth = {{std::cos(50.), -std::sin(50.)}, {0, 0}, {1, 1}};
  const Sample sample = oscillator_sample(50, 1e-10, truth, 5);
  EXPECT_EQ(sample.status, Status::max_steps);
  EXPECT_TRUE(std::isnan(sample.error));
}

TEST(WorkPrecision, ErrorIsTheLargestOverItsScale) {
  EXPECT_EQ(error_of({1, 2}, {{1, 1}, {0, 0}, {1, 4}}), 0.25);
  EXPECT_EQ(error_of({1, 2}, {{1, 2}, {0, -0.5}, {1, 1}}), 0.5);  // what rounding left out counts
  EXPECT_EQ(error_of({1, NAN}, {{1, 1}, {0, 0}, {1, 1}}), INFINITY);
}

}  // namespace
}  // namespace casimir::test
