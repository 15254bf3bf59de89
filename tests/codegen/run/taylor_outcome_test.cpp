// How runs of the method of Taylor series end where they cannot go on, and that they go on where
// they can.
#include "tests/codegen/run/taylor_forms.hpp"

namespace casimir {
namespace {

using testing::compiled;
using testing::equations;
using testing::forms;
using testing::run_taylor;
using testing::settings_for;
using testing::specialised;

TEST(TaylorOutcome, PolesAndBranchPointsAreSingularities) {
  for (const auto& [rate, from, at] :
       {std::tuple{"x^2", 1., 1.}, std::tuple{"x^2", 1e8, 1e-8}, std::tuple{"-1/(2*x)", 1., 1.},
        std::tuple{"x^2", 1e-8, 1e8}}) {
    const Specialisation s = specialised(equations({{"x", rate}}));
    for (const auto& [name, module] : forms(s)) {
      Settings settings = settings_for(2 * at, 1e-10);
      settings.atol = 1e-10 * from;
      const Trajectory orbit = run_taylor(module, settings, {from});
      EXPECT_EQ(orbit.status, Status::singularity) << name << rate << orbit.reason;
      EXPECT_NEAR(orbit.time / at, 1, 1e-8) << name << rate;
      EXPECT_TRUE(std::isfinite(orbit.state[0]));
      EXPECT_LT(orbit.steps + orbit.rejected, 1000u);
    }
  }
}

TEST(TaylorOutcome, EndOfTheDomainIsNotPassed) {
  const Specialisation s = specialised(equations({{"x", "sqrt(x) - 1"}}));
  for (const auto& [name, module] : forms(s)) {
    const Trajectory orbit = run_taylor(module, settings_for(2, 1e-10), {0.25});
    EXPECT_NE(orbit.status, Status::ok) << name;
    EXPECT_NEAR(orbit.time, 2 * (std::log(2.) - 0.5), 1e-6) << name;
    EXPECT_LT(orbit.steps + orbit.rejected, 5000u);
  }
}

TEST(TaylorOutcome, StartsWithoutANumberAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Specialisation pole = specialised(equations({{"x", "1/x"}}));
  const Specialisation square = specialised(equations({{"x", "x^2"}}));
  for (const auto& [name, module] : forms(pole)) {
    EXPECT_EQ(run_taylor(module, settings_for(1), {0}).status, Status::non_finite) << name;
    EXPECT_EQ(run_taylor(module, settings_for(1), {nan}).status, Status::non_finite) << name;
  }
  for (const auto& [name, module] : forms(square)) {
    for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
      const Trajectory orbit = run_taylor(module, settings_for(1), {bad});
      EXPECT_EQ(orbit.status, Status::non_finite) << name << bad;
      EXPECT_EQ(orbit.time, 0);
    }
    // A rate that is no number, or with states in units of their own the pole that is so near.
    const Trajectory orbit = run_taylor(module, settings_for(1), {1e200});
    EXPECT_EQ(orbit.status, name == "tables" ? Status::singularity : Status::non_finite) << name;
    EXPECT_LE(orbit.time, 1.0001e-200);
  }
}

TEST(TaylorOutcome, KinksAreFoundThoughTheSeriesDoNotShowThem) {
  // x' = |x - 1| + 1/4 from 0: the series at the start knows nothing of x = 1.
  const Specialisation s = specialised(equations({{"x", "sqrt((x - 1)^2) + 1/4"}}));
  const double crossing = std::log(5.);
  for (const auto& [name, module] : forms(s)) {
    const Trajectory orbit = run_taylor(module, settings_for(3, 1e-10), {0});
    ASSERT_EQ(orbit.status, Status::ok) << name << orbit.reason;
    EXPECT_NEAR(orbit.state[0], 1 + (std::exp(3 - crossing) - 1) / 4, 1e-6) << name;
    EXPECT_LT(orbit.steps + orbit.rejected, 500u);
  }
}

TEST(TaylorOutcome, JumpsEndInBoundedWork) {
  // The angle jumps from Pi to -Pi at y = 0 and turns the motion back: there is no solution on.
  const Specialisation s = specialised(equations({{"x", "0"}, {"y", "-atan2(y, x)"}}));
  for (const auto& [name, module] : forms(s)) {
    Settings settings = settings_for(10, 1e-8);
    settings.max_steps = 20000;
    const Trajectory orbit = run_taylor(module, settings, {-1, 1});
    EXPECT_NE(orbit.status, Status::ok) << name;
    EXPECT_NEAR(orbit.state[1], 0, 1e-5) << name;
    EXPECT_LE(orbit.steps + orbit.rejected, 20000u) << name;
  }
}

TEST(TaylorOutcome, WithoutALimitTheEndOutOfReachIsNoticed) {
  const Specialisation s = specialised(equations({{"x", "0"}, {"y", "-atan2(y, x)"}}));
  const std::vector<double> from = {-1, 1};
  const Trajectory jump = run_taylor(compiled(s), settings_for(10, 1e-12), from);
  EXPECT_EQ(jump.status, Status::step_underflow);
  EXPECT_NEAR(jump.state[1], 0, 1e-9);
  const Trajectory other =
      integrate(compiled(s, "dop853"), *find_method("dop853"), settings_for(10, 1e-12), from);
  EXPECT_EQ(other.status, Status::step_underflow);
}

TEST(TaylorOutcome, StiffnessStopsAtTheLimitOfSteps) {
  const Specialisation s =
      specialised(equations({{"x", "1000000*(y - x)"}, {"y", "z"}, {"z", "-y"}}));
  for (const auto& [name, module] : forms(s)) {
    Settings settings = settings_for(1000, 1e-6);
    settings.max_steps = 2000;
    const Trajectory orbit = run_taylor(module, settings, {1, 1, 0});
    EXPECT_EQ(orbit.status, Status::max_steps) << name;
    EXPECT_EQ(orbit.steps + orbit.rejected, 2000u) << name;
    EXPECT_NEAR(orbit.state[0], std::cos(orbit.time), 1e-4) << name;
  }
}

TEST(TaylorOutcome, ScaleOfTheStateDoesNotMatter) {
  const Specialisation s = specialised(equations({{"x", "y*z"}, {"y", "-2*z*x"}, {"z", "x*y"}}));
  for (const auto& [name, module] : forms(s)) {
    const Trajectory plain = run_taylor(module, settings_for(10, 1e-12), {0.75, 0.5, 1});
    for (const double scale : {1e150, 1e-150}) {
      Settings settings = settings_for(10 / scale, 1e-12);
      settings.atol = 1e-12 * scale;
      const Trajectory orbit = run_taylor(module, settings, {0.75 * scale, 0.5 * scale, scale});
      ASSERT_EQ(orbit.status, Status::ok) << name << scale << orbit.reason;
      EXPECT_EQ(orbit.time, 10 / scale);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(orbit.state[i] / scale, plain.state[i], 1e-10) << name << scale;
      EXPECT_LT(orbit.steps, 2 * plain.steps + 20);
    }
  }
}

/// Where the square of a state is no number any more, and the equations make up for it.
TEST(TaylorOutcome, ProductsBeyondTheRangeOfNumbers) {
  const auto system = [](const std::string& f) {
    return specialised(
        equations({{"x", f + "*y*z"}, {"y", "-2*" + f + "*z*x"}, {"z", f + "*x*y"}}));
  };
  const Trajectory plain =
      run_taylor(compiled(system("1")), settings_for(10, 1e-12), {0.75, 0.5, 1});
  for (const auto& [factor, scale] : {std::pair{"10^(-200)", 1e200}, std::pair{"10^200", 1e-200}}) {
    for (const auto& [name, module] : forms(system(factor))) {
      Settings settings = settings_for(10, 1e-12);
      settings.atol = 1e-12 * scale;
      settings.sample_every = 5;
      const Trajectory orbit = run_taylor(module, settings, {0.75 * scale, 0.5 * scale, scale});
      ASSERT_EQ(orbit.status, Status::ok) << name << scale << orbit.reason;
      EXPECT_EQ(orbit.samples.size(), 3U);
      EXPECT_EQ(orbit.samples.back(), orbit.state);
      EXPECT_NEAR(orbit.samples.front()[2] / scale, 1, 1e-15);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(orbit.state[i] / scale, plain.state[i], 1e-10) << name << scale;
    }
  }
}

TEST(TaylorOutcome, ComponentsOfDifferentSizesKeepTheirOwnAccuracy) {
  const Specialisation s =
      specialised(equations({{"x", "y"}, {"y", "-x"}, {"u", "v"}, {"v", "-4*u"}}));
  for (const auto& [name, module] : forms(s)) {
    Settings settings = settings_for(5, 1e-13);
    settings.atol = 0;
    const Trajectory orbit = run_taylor(module, settings, {1e150, 0, 1e-150, 0});
    ASSERT_EQ(orbit.status, Status::ok) << name << orbit.reason;
    EXPECT_NEAR(orbit.state[0] / 1e150, std::cos(5.), 1e-12) << name;
    EXPECT_NEAR(orbit.state[2] / 1e-150, std::cos(10.), 1e-12) << name;
    EXPECT_LT(orbit.steps, 100u) << name;
  }
}

}  // namespace
}  // namespace casimir
