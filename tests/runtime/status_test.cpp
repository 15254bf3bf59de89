#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "tests/runtime/systems.hpp"

namespace casimir::test {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

Settings settings_for(double duration, double tolerance = 1e-10) {
  Settings settings;
  settings.duration = duration;
  settings.rtol = settings.atol = tolerance;
  return settings;
}

class Outcome : public testing::TestWithParam<std::string> {
 protected:
  bool own() const { return find_method(GetParam())->outside.empty(); }
};

TEST_P(Outcome, NoTimeIsDoneAtOnce) {
  const Trajectory orbit = run<Square>(GetParam(), settings_for(0), {3});
  EXPECT_EQ(orbit.status, Status::ok);
  EXPECT_EQ(orbit.state[0], 3);
  EXPECT_EQ(orbit.steps, 0u);
}

TEST_P(Outcome, PoleIsASingularityNearItsTime) {
  for (const double start : {1., 1e8, 1e-8}) {
    Settings settings = settings_for(2 / start);
    settings.atol = 1e-10 * start;
    const Trajectory orbit = run<Square>(GetParam(), settings, {start});
    EXPECT_EQ(orbit.status, Status::singularity) << orbit.reason;
    EXPECT_FALSE(orbit.reason.empty());
    EXPECT_NEAR(orbit.time * start, 1, own() ? 1e-8 : 1e-5);
    EXPECT_TRUE(std::isfinite(orbit.state[0]));
    EXPECT_GT(orbit.state[0], 1e4 * start);
  }
  // The twin: short of the pole all is well, and right.
  const Trajectory before = run<Square>(GetParam(), settings_for(0.9), {1});
  EXPECT_EQ(before.status, Status::ok);
  EXPECT_NEAR(before.state[0], 10, 1e-4);
  const Trajectory away = run<Square>(GetParam(), settings_for(-2), {1});
  EXPECT_EQ(away.status, Status::ok);
  EXPECT_NEAR(away.state[0], 1. / 3, 1e-6);
}

TEST_P(Outcome, BranchPointWithFiniteStateIsASingularity) {
  const Trajectory orbit = run<Root>(GetParam(), settings_for(2), {1});
  EXPECT_EQ(orbit.status, Status::singularity) << orbit.reason;
  EXPECT_NEAR(orbit.time, 1, 1e-5);
  EXPECT_LT(std::abs(orbit.state[0]), 1e-2);
}

TEST_P(Outcome, RestAtZeroWhereNothingMovesIsLeft) {
  for (const double power : {0., 1., 2., 3., 4., 5., 8., 13., 2.5}) {
    const Trajectory orbit = run<Pushed>(GetParam(), settings_for(2, 1e-8), {0, 0}, {power});
    ASSERT_EQ(orbit.status, Status::ok) << power << ' ' << orbit.reason;
    const double speed = std::pow(2, power + 1) / (power + 1), way = speed * 2 / (power + 2);
    const double allowed = GetParam() == "midpoint" ? 1e-4 : 1e-5;
    EXPECT_NEAR(orbit.state[0] / way, 1, allowed) << power;
    EXPECT_NEAR(orbit.state[1] / speed, 1, allowed) << power;
    EXPECT_LT(orbit.steps, 100000U) << power;
  }
}

TEST_P(Outcome, EndOfTheDomainIsNotPassed) {
  const Trajectory orbit = run<Edge>(GetParam(), settings_for(2), {0.25});
  EXPECT_NE(orbit.status, Status::ok);
  // t = 2 (ln 2 - 1/2): with y = sqrt x the time is the integral of 2 y / (1 - y) from 0 to 1/2.
  EXPECT_NEAR(orbit.time, 2 * (std::log(2.) - 0.5), 1e-6);
  EXPECT_GE(orbit.state[0], -1e-8);
}

TEST_P(Outcome, StartWithoutANumberIsRefused) {
  for (const double bad : {kNoNumber, kInfinite}) {
    const Trajectory orbit = run<Oscillator>(GetParam(), settings_for(1), {1, bad});
    EXPECT_EQ(orbit.status, Status::non_finite);
    EXPECT_EQ(orbit.time, 0);
  }
  const Trajectory pole = run<Root>(GetParam(), settings_for(1), {0});
  EXPECT_EQ(pole.status, Status::non_finite);
  EXPECT_EQ(pole.state[0], 0);
}

TEST_P(Outcome, LimitOfStepsStopsShort) {
  Settings settings = settings_for(1000);
  settings.max_steps = 10;
  const Trajectory orbit = run<Oscillator>(GetParam(), settings, {1, 0});
  EXPECT_EQ(orbit.status, Status::max_steps);
  EXPECT_LE(orbit.steps + (own() ? orbit.rejected : 0), 10u);
  EXPECT_GT(orbit.time, 0);
  EXPECT_LT(orbit.time, 1000);
  EXPECT_NEAR(orbit.state[0], std::cos(orbit.time), 1e-6);
}

TEST_P(Outcome, StopsWhenAsked) {
  int asked = 0;
  Settings settings = settings_for(1000);
  settings.give_up = [&] { return ++asked == 3; };
  const Trajectory orbit = run<Oscillator>(GetParam(), settings, {1, 0});
  EXPECT_EQ(orbit.status, Status::stopped);
  EXPECT_EQ(orbit.steps, 3u);
  EXPECT_NEAR(orbit.state[0], std::cos(orbit.time), 1e-6);
}

TEST_P(Outcome, ScaleOfTheStateDoesNotMatter) {
  const Trajectory plain = run<Euler>(GetParam(), settings_for(10, 1e-9), {0.75, 0.5, 1});
  for (const double scale : {1e150, 1e-150}) {
    Settings settings = settings_for(10 / scale, 1e-9);
    settings.atol = 1e-9 * scale;
    const Trajectory orbit =
        run<Euler>(GetParam(), settings, {0.75 * scale, 0.5 * scale, 1 * scale});
    ASSERT_EQ(orbit.status, Status::ok) << scale << ' ' << orbit.reason;
    EXPECT_EQ(orbit.time, 10 / scale);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(orbit.state[i] / scale, plain.state[i], 1e-6) << scale;
    EXPECT_LT(orbit.steps, 3 * plain.steps + 100);
  }
}

TEST_P(Outcome, TinyAndHugeTimes) {
  const Trajectory tiny = run<Oscillator>(GetParam(), settings_for(1e-300), {1, 0});
  if (!own()) {
    // CVODE takes so short an interval for rounding, and says so: no number is made up.
    EXPECT_EQ(tiny.status, Status::step_underflow);
    EXPECT_EQ(tiny.state, (std::vector<double>{1, 0}));
    return;
  }
  EXPECT_EQ(tiny.status, Status::ok);
  EXPECT_EQ(tiny.state[0], 1);
  EXPECT_NEAR(tiny.state[1] / -1e-300, 1, 1e-9);
}

TEST_P(Outcome, SamplesAreExactMultiplesAndTheEnd) {
  Settings settings = settings_for(1);
  settings.sample_every = 0.3;
  const Trajectory orbit = run<Oscillator>(GetParam(), settings, {1, 0});
  ASSERT_EQ(orbit.sample_times.size(), 5u);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(orbit.sample_times[k], static_cast<double>(k) * 0.3);
  EXPECT_EQ(orbit.sample_times[4], 1);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(orbit.samples[k][0], std::cos(orbit.sample_times[k]), 1e-7);
}

TEST_P(Outcome, SettingsWithoutMeaningAreRefused) {
  const auto refused = [&](auto change) {
    Settings settings = settings_for(1);
    change(settings);
    EXPECT_THROW(run<Oscillator>(GetParam(), settings, {1, 0}), std::invalid_argument);
  };
  refused([](Settings& s) { s.rtol = s.atol = 0; });
  refused([](Settings& s) { s.rtol = -1e-6; });
  refused([](Settings& s) { s.rtol = kNoNumber; });
  refused([](Settings& s) { s.atol = kInfinite; });
  refused([](Settings& s) { s.duration = kInfinite; });
  refused([](Settings& s) { s.duration = kNoNumber; });
  refused([](Settings& s) { s.fixed_step = -1; });
  refused([](Settings& s) { s.sample_every = kNoNumber; });
  refused([](Settings& s) { s.sample_every = 1e-12; });
  EXPECT_THROW(run<Oscillator>(GetParam(), settings_for(1), {1}), std::invalid_argument);
  EXPECT_THROW(run<Oscillator>(GetParam(), settings_for(1), {1, 0, 0}), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Runtime, Outcome, testing::ValuesIn(own_and_linked_methods()),
                         [](const auto& one) { return test_name(one.param); });

class FixedStep : public testing::TestWithParam<std::string> {};

TEST_P(FixedStep, DividesTheInterval) {
  Settings settings = settings_for(1);
  settings.fixed_step = 0.3;
  const Trajectory orbit = run<Oscillator>(GetParam(), settings, {1, 0});
  EXPECT_EQ(orbit.steps, 4u);  // of 1/4
  settings.fixed_step = 0.1;
  EXPECT_EQ(run<Oscillator>(GetParam(), settings, {1, 0}).steps, 10u);
  EXPECT_EQ(run<Oscillator>(GetParam(), settings, {1, 0}).time, 1);
}

TEST_P(FixedStep, NeverPassesAPole) {
  for (const double h : {0.3, 0.1, 0.01, 1e-3}) {
    Settings settings = settings_for(3);
    settings.fixed_step = h;
    const Trajectory orbit = run<Square>(GetParam(), settings, {1});
    EXPECT_NE(orbit.status, Status::ok) << h;
    EXPECT_LT(orbit.time, 1 + h);
  }
}

TEST_P(FixedStep, FarTooLargeIsRefused) {
  Settings settings = settings_for(100);
  settings.fixed_step = 50;
  const Trajectory orbit = run<Euler>(GetParam(), settings, {0.75, 0.5, 1});
  EXPECT_NE(orbit.status, Status::ok);
  EXPECT_EQ(orbit.time, 0);
}
INSTANTIATE_TEST_SUITE_P(Runtime, FixedStep, testing::ValuesIn(own_methods()),
                         [](const auto& one) { return test_name(one.param); });

// A stiff decay to cos t: the implicit methods take steps beyond the stability of explicit ones.
TEST(StiffSystem, NewtonTakesOver) {
  Settings settings = settings_for(10, 1e-6);
  const std::vector<double> parameter = {1e6};
  const double truth = std::cos(10.) + std::sin(10.) / 1e6;
  for (const char* name : {"gauss4", "gauss6", "gauss8", "radau5", "radau9", "cvode-bdf"}) {
    const Trajectory orbit = run<Stiff>(name, settings, {1}, parameter);
    EXPECT_EQ(orbit.status, Status::ok) << name << ' ' << orbit.reason;
    EXPECT_NEAR(orbit.state[0], truth, 1e-4) << name;
    EXPECT_GT(orbit.jacobians, 0u) << name;
    EXPECT_LT(orbit.steps, 100000u) << name;
  }
  settings.max_steps = 100000;
  EXPECT_EQ(run<Stiff>("dop853", settings, {1}, parameter).status, Status::max_steps);
}

TEST(Modules, WhatIsMissingIsNamed) {
  ModuleFunctions functions;
  EXPECT_THROW(Module::from_functions(functions), std::invalid_argument);
  functions.dimension = 2;
  functions.rhs = Oscillator::rhs;
  const Module module = Module::from_functions(functions);
  Settings settings = settings_for(1);
  EXPECT_THROW(integrate(module, *find_method("dop853"), settings, {1, 0}), std::invalid_argument);
  EXPECT_EQ(integrate(module, *find_method("cvode-adams"), settings, {1, 0}).status, Status::ok);
  try {
    Module::load("/no/such/module.so");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such/module.so"), std::string::npos);
  }
}

}  // namespace
}  // namespace casimir::test
