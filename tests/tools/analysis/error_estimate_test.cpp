// How far an end state can be believed.
#include "tools/analysis/estimate/error_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/methods.hpp"
#include "tests/tools/analysis/assessed.hpp"
#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/estimate/growth_of_changes.hpp"
#include "tools/analysis/run/assessed_run.hpp"
#include "tools/analysis/run/ensemble_check.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/analysis/solve.hpp"

namespace casimir::test {
namespace {

TEST(ErrorEstimate, TheEstimateIsAboveTheErrorAndNotFarAbove) {
  const Oscillator oscillator;
  for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
    SolveOptions options;
    options.method = "dop853";
    options.run.tolerance = tolerance;
    const Solution motion = solve(oscillator.model, oscillator.scene(100), options);
    ASSERT_TRUE(motion.ok());
    const ErrorEstimate& trust = motion.trust();
    ASSERT_TRUE(trust.known);
    const double error = std::hypot(motion.trajectory().state[0] - std::cos(100.),
                                    motion.trajectory().state[1] + std::sin(100.));
    EXPECT_GE(trust.error_estimate, error / 2) << tolerance;
    EXPECT_LE(trust.error_estimate, 100 * error + 1e-14) << tolerance;
    EXPECT_FALSE(trust.beyond_double);
    EXPECT_FALSE(trust.unconfirmed);
  }
}

TEST(ErrorEstimate, GrowthOfChangesIsThatOfTheFlow) {
  // In units of the state when the change is made: what grows no faster than x = e^t itself is
  // lost in no digit, to the end of all doubles.
  for (const char* duration : {"10", "300", "700"}) {
    const Model growing = one_equation("x", duration);
    const Solution growth = solve(growing, growing.scene("default"));
    EXPECT_LT(growth.trust().conditioning, 10) << duration;
    EXPECT_FALSE(growth.trust().beyond_double) << duration;
    const double end = std::exp(std::stod(duration));
    EXPECT_NEAR(growth.trajectory().state[0] / end, 1, 1e-12) << duration;
    const double error = std::abs(growth.trajectory().state[0] / end - 1);
    EXPECT_GT(growth.trust().error_estimate, error / 3) << duration;
    EXPECT_LT(growth.trust().error_estimate, 1e-12) << duration;
  }
  // Away from x = 1, which the motion does not leave: a change grows e^10 times.
  const Model unstable = one_equation("x - 1", "10");
  const Solution motion = solve(unstable, unstable.scene("default"));
  ASSERT_TRUE(motion.trust().known);
  EXPECT_NEAR(motion.trust().conditioning / std::exp(10), 1, 0.01);
  EXPECT_FALSE(motion.trust().beyond_double);
  const Model lost = one_equation("x - 1", "40");
  const ErrorEstimate none = solve(lost, lost.scene("default")).trust();
  EXPECT_TRUE(none.beyond_double);
  EXPECT_NEAR(none.conditioning / std::exp(40), 1, 0.01);  // no step is long because nothing moves
  ASSERT_TRUE(none.six_digits_until);
  const Model overflowing = one_equation("x - 1", "800");
  const ErrorEstimate most = solve(overflowing, overflowing.scene("default")).trust();
  EXPECT_TRUE(most.known);
  EXPECT_TRUE(most.beyond_double);
  // Rounding grows to 1e-6 at the time log(1e-6 / 2^-53): the end of a step before it.
  EXPECT_LE(*none.six_digits_until, std::log(1e-6 * 0x1p53));
}

TEST(ErrorEstimate, RoundingOfTheDataIsCounted) {
  const Oscillator oscillator;
  const auto input = [&](const GiNaC::ex& q) {
    return solve(oscillator.model, scene_from(oscillator.model, {q, 0}, 10)).trust().input_rounding;
  };
  EXPECT_EQ(input(GiNaC::numeric(1, 2)), 0);
  EXPECT_GT(input(GiNaC::numeric(1, 3)), 1e-18);
  EXPECT_LT(input(GiNaC::numeric(1, 3)), 1e-15);
}

TEST(ErrorEstimate, OfSamplesIsThatOfTheWay) {
  const Oscillator oscillator;
  const Scene scene = scene_from(oscillator.model, {1, 0}, 10);
  for (const char* method : {"dop853", "gauss8", "taylor"}) {
    SolveOptions options;
    options.method = method;
    options.run.rtol = options.run.atol = 1e-6;
    EXPECT_FALSE(solve(oscillator.model, scene, options).trust().samples_error);
    options.sample_every = 0.37;
    const Solution motion = solve(oscillator.model, scene, options);
    double off = 0;
    for (std::size_t k = 0; k < motion.trajectory().samples.size(); ++k)
      off = std::max(off, std::abs(motion.trajectory().samples[k][0] -
                                   std::cos(motion.trajectory().sample_times[k])));
    ASSERT_TRUE(motion.trust().samples_error) << method;
    EXPECT_GT(*motion.trust().samples_error, off / 3) << method;
    EXPECT_LT(*motion.trust().samples_error, 3 * off + 1e-12) << method;
  }
}

/// sin(w/10) with the double next to 1/10, by the closed form, which takes no other roundings.
TEST(ErrorEstimate, TheRoundingOfTheDurationIsCounted) {
  for (const int digits : {7, 10}) {
    const Model model = model_of(
        "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"10^" +
        std::to_string(digits) + "*y\"\ny = \"-10^" + std::to_string(digits) +
        "*x\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"1\", y = \"0\" }\n"
        "duration = \"1/10\"\n");
    SolveOptions options;
    options.method = "exact";
    const Solution motion = solve(model, model.scene("default"), options);
    const double off = std::abs(motion.trajectory().state[1] + std::sin(std::pow(10., digits - 1)));
    EXPECT_GT(motion.trust().error_estimate, off / 2) << digits;
    EXPECT_LT(motion.trust().error_estimate, 1e-16 * std::pow(10., digits)) << digits;
  }
}

// Beside f = t, which takes a step or two, the steps have to be those of the changes of a.
TEST(ErrorEstimate, FollowsTheChangesOfAStateThatRestsBesideOneThatMoves) {
  for (const double sign : {-1., 1.}) {
    const Model model = model_of(
        std::string("[phase_space]\nvariables = [\"f\", \"a\"]\n[equations]\nf = \"1\"\n") +
        (sign < 0 ? "a = \"-a\"\n" : "a = \"a\"\n") +
        "[[scene]]\nname = \"default\"\ninitial = { f = \"0\", a = \"0\" }\nduration = \"80\"\n");
    const double growth = solve(model, model.scene("default")).trust().conditioning;
    const double expected = sign < 0 ? 1 : std::exp(80.);
    EXPECT_GT(growth, expected / 4) << sign;
    EXPECT_LT(growth, expected * 4) << sign;
  }
}

// A pendulum and a body in a small part of their periods, from where the momentum is zero: what the
// closed form is off by is a part of the momentum that they have later.
TEST(ErrorEstimate, OfAClosedFormCountsBesideAWholePeriod) {
  struct Short {
    const char *variables, *equations, *initial, *duration;
    std::size_t place;
    double value;
  };
  const Short cases[] = {
      {R"("q", "p")", "q = \"p/10^8\"\np = \"-10^8*sin(q)\"\n", "q = \"1\", p = \"0\"", "1/10^8", 1,
       -std::sin(1.)},
      {R"("x", "y", "z")", "x = \"y*z/10^18\"\ny = \"-10^6*x*z\"\nz = \"-x*y/10^19\"\n",
       "x = \"1\", y = \"0\", z = \"1\"", "1/10^6", 1, -1}};
  for (const Short& at : cases) {
    const Model model =
        model_of(std::string("[phase_space]\nvariables = [") + at.variables + "]\n[equations]\n" +
                 at.equations + "[[scene]]\nname = \"default\"\ninitial = { " + at.initial +
                 " }\nduration = \"" + at.duration + "\"\n");
    SolveOptions options;
    options.method = "exact";
    const Solution motion = solve(model, model.scene("default"), options);
    const double off = std::abs(motion.trajectory().state[at.place] - at.value);
    EXPECT_GT(off, 1e-13) << "the test is about such an error";
    EXPECT_GT(motion.trust().error_estimate, off / 2);
  }
}

// From x = 1 + 1/K the motion has its pole at t = 1; from x = 1, which is what is left of that, it
// rests.
TEST(ErrorEstimate, AStartThatRoundsToARestIsInDoubt) {
  const auto scene_of = [](const char* start) {
    return model_of(
        "[phase_space]\nvariables = [\"x\"]\n[equations]\nx = \"10^24*(x-1)^2\"\n"
        "[[scene]]\nname = \"default\"\ninitial = { x = \"" +
        std::string(start) + "\" }\nduration = \"2\"\n");
  };
  const Model rounded = scene_of("1 + 10^(-24)");
  for (const char* method : {"taylor", "dop853"}) {
    SolveOptions options;
    options.method = method;
    const Solution motion = solve(rounded, rounded.scene("default"), options);
    EXPECT_TRUE(!motion.ok() || motion.trust().input_rounding >= 1) << method;
  }
  // The twin is a rest.
  const Model rest = scene_of("1");
  EXPECT_LT(solve(rest, rest.scene("default")).trust().error_estimate, 1e-14);
}

/// x' = 2 (1 - cos(t/10^8)) 10^16 is t^2, and 0 or 2.2 in double precision, whatever the method.
TEST(ErrorEstimate, DigitsThatTheEquationsLoseAreCounted) {
  for (const char* method : {"dop853", "gauss8", "radau5"}) {
    const Model cancels = driven_equation("2*(1 - cos(t/10^8))*10^16");
    SolveOptions options;
    options.method = method;
    options.run.tolerance = 1e-8;
    const Solution motion = solve(cancels, cancels.scene("default"), options);
    ASSERT_TRUE(motion.ok()) << method;
    const double error = std::abs(motion.trajectory().state[0] / (64. / 3) - 1);
    EXPECT_GT(error, 1e-6) << method;
    EXPECT_GT(motion.trust().error_estimate, error / 3) << method;
  }
  // The twin keeps all of them.
  const Model keeps = driven_equation("4*10^16*sin(t/(2*10^8))^2");
  const Solution motion = solve(keeps, keeps.scene("default"));
  EXPECT_NEAR(motion.trajectory().state[0] / (64. / 3), 1, 1e-14);
  EXPECT_LT(motion.trust().error_estimate, 1e-13);
}

// An argument that rests is rounded in the same way by every step and every method.
TEST(ErrorEstimate, DigitsOfArgumentsThatRestAreCounted) {
  const Model model = model_of(R"toml(
[phase_space]
variables = ["x", "z"]
[equations]
x = "cos(sqrt(2)*(z - 10^6))"
z = "0"
[[scene]]
name = "default"
initial = { x = "0", z = "1/2" }
duration = "1"
)toml");
  const Solution motion = solve(model, model.scene("default"));
  ASSERT_TRUE(motion.ok());
  const long double end = std::cos(std::sqrt(2.L) * (0.5L - 1e6L));
  const auto error = static_cast<double>(std::abs(motion.trajectory().state[0] / end - 1));
  EXPECT_GT(error, 1e-11);
  EXPECT_GT(motion.trust().error_estimate, error / 3);
  EXPECT_LT(motion.trust().error_estimate, 30 * error);
}

/// x' = y, y' = -2x^3 from x = 0, y = 1: the sine of the lemniscate. An eighth of its period, which
/// is twice 2.622057.., after the start, and so many periods later, x^2 is sqrt(2) - 1.
struct Lemniscate {
  GiNaC::symbol x{"x"}, y{"y"};
  Model model = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"y\"\ny = \"-2*x^3\"\n");
  Scene scene() const { return scene_from(model, {0, 1}, 1); }
  static double duration(int periods) { return 2 * 2.62205755429211981 * (periods + 0.125); }
  static double error(const Trajectory& run) {
    const double x = std::sqrt(std::sqrt(2.) - 1);
    return std::hypot(run.state[0] - x, run.state[1] - std::sqrt(1 - std::pow(x, 4)));
  }
};

// Errors of single steps grow until the end, also where there is no time for a second run.
TEST(ErrorEstimate, OfLongRunsHasTheGrowthOfTheirErrors) {
  const Lemniscate lemniscate;
  constexpr int kPeriods = 10000;
  for (const auto& [method, tolerance] : {std::pair("taylor", 1e-10), std::pair("dop853", 1e-11)}) {
    Settings settings;
    settings.duration = Lemniscate::duration(kPeriods);
    settings.rtol = settings.atol = tolerance;
    for (const double budget : {1., 0.}) {
      Trajectory run;
      const ErrorEstimate trust =
          estimate_of(lemniscate.model, lemniscate.scene(), method, settings, &run, budget);
      ASSERT_EQ(run.status, Status::ok) << method;
      const double error = Lemniscate::error(run);
      EXPECT_GT(error, 1e-6) << method;
      EXPECT_GT(trust.error_estimate, error / 3) << method << ' ' << budget;
      EXPECT_LT(trust.error_estimate, (budget > 0 ? 10 : 1e4) * error) << method << ' ' << budget;
    }
  }
}

// A kink ends the steps of series at every tolerance, and from 1e-8 down they have the same order.
TEST(ErrorEstimate, IsNoDifferenceOfRunsWithTheSameSteps) {
  const Model kinks = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"y\"\n"
      "y = \"-x - 5/16*abs(x + 1/2)\"\n[[scene]]\nname = \"default\"\n"
      "initial = { x = \"1\", y = \"0\" }\nduration = \"11\"\n");
  Settings settings;
  settings.duration = 11;
  settings.rtol = settings.atol = 1e-14;
  Trajectory truth, run;
  estimate_of(kinks, kinks.scene("default"), "dop853", settings, &truth, 1);
  for (const double tolerance : {1e-8, 1e-9}) {
    settings.rtol = settings.atol = tolerance;
    const ErrorEstimate trust =
        estimate_of(kinks, kinks.scene("default"), "taylor", settings, &run, 1);
    const double error = std::hypot(run.state[0] - truth.state[0], run.state[1] - truth.state[1]);
    EXPECT_GT(trust.error_estimate, error / 3) << tolerance;
  }
}

// x = 1e-25/(1 - t) is below all absolute tolerances until it is at its pole.
TEST(ErrorEstimate, APoleBelowTheToleranceIsNotPassedInSilence) {
  const Model weak = model_of(
      "[phase_space]\nvariables = [\"x\", \"u\", \"v\"]\n[equations]\nx = \"10^25*x^2\"\n"
      "u = \"v\"\nv = \"-u\"\n[[scene]]\nname = \"default\"\n"
      "initial = { x = \"10^(-25)\", u = \"1\", v = \"0\" }\nduration = \"2\"\n");
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
    SolveOptions options;
    options.method = "taylor";
    options.run.tolerance = tolerance;
    const Solution motion = solve(weak, weak.scene("default"), options);
    const ErrorEstimate& trust = motion.trust();
    EXPECT_TRUE(!motion.ok() || trust.unconfirmed || !trust.known || trust.error_estimate > 0.1)
        << tolerance << ' ' << trust.error_estimate;
  }
}

// x = 1 + 1/(K(1 - t)): written out as x^2 - 2x + 1 its rate is rounding.
TEST(ErrorEstimate, ADoubleRestOfTheEquationsIsNotWrittenOut) {
  const auto scene_of = [](const std::string& rate, const std::string& start,
                           const char* duration) {
    return model_of("[phase_space]\nvariables = [\"x\", \"u\", \"v\"]\n[equations]\nx = \"" + rate +
                    "\"\nu = \"v\"\nv = \"-u\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"" +
                    start + "\", u = \"1\", v = \"0\" }\nduration = \"" + duration + "\"\n");
  };
  SolveOptions options;
  options.method = "taylor";
  const Model pole = scene_of("2*10^8*(x-1)^2", "1+1/(2*10^8)", "1.05");
  EXPECT_FALSE(solve(pole, pole.scene("default"), options).ok());
  const Model towards = scene_of("-10^8*(x-1)^2", "2", "100");
  const Solution motion = solve(towards, towards.scene("default"), options);
  ASSERT_TRUE(motion.ok());
  EXPECT_NEAR(motion.trajectory().state[0], 1, 1e-9);
}

// x = sqrt(1 - 2t) ends at t = 1/2; errors of the tolerance take each step to the other side of x =
// 0, and the run once went on like that for minutes.
TEST(ErrorEstimate, ARunThatGoesToAndFroOverAPoleEnds) {
  const Model ends = one_equation("-1/x", "1");
  for (const char* method : {"taylor", "dopri5"}) {
    SolveOptions options;
    options.method = method;
    options.run.tolerance = 1e-6;
    const Solution motion = solve(ends, ends.scene("default"), options);
    EXPECT_EQ(motion.trajectory().status, Status::singularity) << method;
    EXPECT_NEAR(motion.trajectory().time, 0.5, 0.01) << method;
    EXPECT_LT(motion.trajectory().steps, 10000000U) << method;
  }
}

// Jacobi's functions of the size 1e-9 beside an oscillator: small changes grow some hundred times.
TEST(ErrorEstimate, GrowthOfSmallStatesIsTheirOwn) {
  const Model small = model_of(
      "[phase_space]\nvariables = [\"a\", \"b\", \"c\", \"u\", \"v\"]\n[equations]\na = "
      "\"10^9*b*c\"\n"
      "b = \"-10^9*a*c\"\nc = \"-1/2*10^9*a*b\"\nu = \"v\"\nv = \"-u\"\n[[scene]]\nname = "
      "\"default\"\n"
      "initial = { a = \"0\", b = \"10^(-9)\", c = \"10^(-9)\", u = \"1\", v = \"0\" }\nduration = "
      "\"20\"\n");
  SolveOptions options;
  options.method = "dop853";
  options.run.tolerance = 1e-6;
  EXPECT_LT(solve(small, small.scene("default"), options).trust().conditioning, 1e4);
  options.run.tolerance = 1e-12;
  const ErrorEstimate trust = solve(small, small.scene("default"), options).trust();
  EXPECT_LT(trust.error_estimate, 1e-4);
}

// A few steps are the same ones at many tolerances.
/// x is 10^-200*exp(-t) up to the last digit, and far below what the steps are chosen by.
TEST(ErrorEstimate, SaysOfWhichStatesItSaysNothing) {
  const auto unestimated_from = [](const std::string& size) {
    const Model model = model_of(
        "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[equations]\n"
        "x = \"-y*z\"\ny = \"x*z\"\nz = \"-x*y\"\n[[scene]]\nname = \"default\"\n"
        "initial = { x = \"" +
        size + "\", y = \"1\", z = \"" + size + "\" }\nduration = \"10\"\n");
    const Scene& scene = model.scene("default");
    return integrate_assessed(model, scene, prepare(model, scene), {}).unestimated.value_or("");
  };
  EXPECT_NE(unestimated_from("10^(-200)").find("nothing of x, z"), std::string::npos);
  EXPECT_EQ(unestimated_from("1/1000"), "");
  EXPECT_EQ(unestimated_from("0"), "");
}

TEST(ErrorEstimate, OfAFewStepsIsNotAboveWhatIsKnown) {
  const Oscillator oscillator;
  for (const double tolerance : {1e-3, 1e-5}) {
    Settings settings;
    settings.duration = 0.5;
    settings.rtol = settings.atol = tolerance;
    for (const char* method : {"dop853", "taylor"}) {
      Trajectory run;
      const ErrorEstimate trust = estimate_of(
          oscillator.model, oscillator.scene(GiNaC::numeric(1, 2)), method, settings, &run, 1);
      const double error = std::hypot(run.state[0] - std::cos(0.5), run.state[1] + std::sin(0.5));
      EXPECT_GT(trust.error_estimate, error / 3) << method << tolerance;
    }
  }
}

TEST(ErrorEstimate, ChangesThatDiedOutAreToldFromThoseThatAreThere) {
  ErrorEstimate trust;
  trust.conditioning = 1;
  EXPECT_FALSE(trust.died_out());
  trust.beyond_double = true;
  EXPECT_TRUE(trust.died_out());
  trust.conditioning = 1e14;
  EXPECT_FALSE(trust.died_out());
}

TEST(ErrorEstimate, NothingIsSaidOfARunThatStopped) {
  const Model model = one_equation("x^2", "2");
  EXPECT_FALSE(solve(model, model.scene("default")).trust().known);
}

TEST(Conditioning, TheTimeOfAGrowthIsTheLastBeforeIt) {
  Conditioning flow;
  flow.growth = {{0, 1}, {1, 4}, {2, 64}};
  EXPECT_EQ(flow.time_of(1), 0);
  EXPECT_EQ(flow.time_of(3), 0);
  EXPECT_EQ(flow.time_of(5), 1);
  EXPECT_FALSE(flow.time_of(65));
  EXPECT_EQ(flow.on_the_way(), 64);
}

/// cos(a) turns eight times over between this a and one that differs by the root of the last digit.
TEST(ErrorEstimate, TheRoundingOfAParameterIsMeasuredByTheNextDoubles) {
  const Model model = model_of(
      "title = \"t\"\n[phase_space]\nvariables = [\"x\"]\n[parameters]\na = {}\n[equations]\n"
      "x = \"cos(a)\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"1\" }\n"
      "parameters = { a = \"10^15/3\" }\nduration = \"1\"\n");
  SceneOptions kept;
  kept.keep_parameters = {"a"};
  const PreparedScene run = prepare(model, model.scene("default"), kept);
  const AssessedRun assessed = integrate_assessed(model, model.scene("default"), run, {});
  constexpr double kTruth = 0.058574965848110344;  // mpmath, 60 digits
  EXPECT_GT(assessed.trust.error_estimate, std::abs(assessed.trajectory.state[0] - kTruth) / 3);
}

TEST(ErrorEstimate, TheMemberWithMostStepsIsChecked) {
  const auto checked = [](unsigned long long steps_of_third) {
    std::vector<MemberEnd> ends(8, {.arrived = true, .steps = 10, .size = 1});
    ends[2].steps = steps_of_third;
    return members_to_check(ends);
  };
  EXPECT_EQ(checked(10), (std::vector<std::size_t>{0, 4, 7}));
  EXPECT_EQ(checked(100), (std::vector<std::size_t>{0, 2, 4, 7}));
}

TEST(ErrorEstimate, MembersThatEndFarBeyondTheOthersAreChecked) {
  std::vector<MemberEnd> ends(100, {.arrived = true, .steps = 10, .size = 2});
  ends[20].size = ends[30].size = 1e9;
  ends[40] = {.arrived = false, .steps = 10, .size = 1e9};
  EXPECT_EQ(members_to_check(ends), (std::vector<std::size_t>{0, 20, 30, 62, 99}));
}

/// What takes longest is what most needs a check: that there was no time for one is said.
TEST(ErrorEstimate, MembersWithoutTimeForACheckAreUnconfirmed) {
  const Oscillator oscillator;
  const PreparedScene run = prepare(oscillator.model, oscillator.scene(100));
  Ensemble ensemble{.states = 2, .initial = {1, 0, 2, 0}, .values = {}};
  EnsembleResult result;
  for (const double size : {1., 2.})
    result.members.push_back({.status = Status::ok,
                              .time = 100,
                              .state = {size * std::cos(100.), -size * std::sin(100.)},
                              .invariants = {}});
  Settings settings;
  settings.duration = 100;
  const auto checked = [&](double budget) {
    return check_members(run, *find_method("taylor"), settings, ensemble, result, {0, 1}, budget);
  };
  ASSERT_EQ(checked(10).size(), 2U);
  EXPECT_FALSE(checked(10)[0].trust.unconfirmed);
  ASSERT_EQ(checked(1e-9).size(), 2U);
  for (const CheckedMember& member : checked(1e-9)) EXPECT_TRUE(member.trust.unconfirmed);
}

}  // namespace
}  // namespace casimir::test
