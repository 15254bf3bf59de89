// Deviations across jumps of the equations, against derivatives of solutions in closed form.
#include "tools/analysis/estimate/saltation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "codegen/optimise/differentiate.hpp"
#include "runtime/uncompiled.hpp"
#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/estimate/growth_of_changes.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/analysis/section/section.hpp"
#include "tools/analysis/sweep/lyapunov.hpp"

namespace casimir::test {
namespace {

/// The state and a deviation after a time, by the variational equations of the scene.
Trajectory deviated(const Model& model, std::vector<double> deviation, double duration,
                    const char* method = "taylor") {
  const PreparedScene run = prepare(model, model.scene("default"));
  const Program& rhs = run.specialisation.rhs;
  Saltation saltation(rhs);
  std::vector<double> state = run.initial;
  state.insert(state.end(), deviation.begin(), deviation.end());
  const Module module =
      uncompiled_module(codegen::variational(rhs, run.initial.size()), {}, std::nullopt, {});
  Settings settings;
  settings.duration = duration;
  settings.rtol = settings.atol = 1e-13;
  settings.after_step = saltation.hook(run.parameters, state.size());
  return integrate(module, *find_method(method), settings, state);
}

Model equations(const std::string& variables, const std::string& rates, const std::string& initial,
                const std::string& more = {}) {
  return model_of("title = \"t\"\n[phase_space]\nvariables = [" + variables + "]\n" + more +
                  "[equations]\n" + rates + "\n[[scene]]\nname = \"default\"\ninitial = {" +
                  initial + "}\nduration = \"9\"\n");
}

/// A ball on both sides of a floor: q = 1/2 at rest, through the floor at t = 1.
const char* const kBall = "q = \"p\"\np = \"-sign(q)\"";

// dq/dq0 = 1 - 2 s and dp/dq0 = -2 at the time 1 + s, up to the next passage at s = 2.
TEST(Saltation, OfABallIsThatOfItsParabolas) {
  const Model ball = equations("\"q\", \"p\"", kBall, "q = \"1/2\", p = \"0\"");
  for (const double s : {0.25, 1.5}) {
    const Trajectory run = deviated(ball, {1, 0}, 1 + s);
    ASSERT_EQ(run.status, Status::ok) << run.reason;
    EXPECT_NEAR(run.state[2], 1 - 2 * s, 1e-7);
    EXPECT_NEAR(run.state[3], -2, 1e-7);
  }
}

// The same ball, where a root has the sign.
TEST(Saltation, SeesJumpsOfRoots) {
  for (const char* const sign : {"q/sqrt(q^2)", "sqrt(q^2)/q", "q*sqrt(1 + q^2)/sqrt(q^2 + q^4)"}) {
    const Model ball = equations("\"q\", \"p\"", "q = \"p\"\np = \"-" + std::string(sign) + "\"",
                                 "q = \"1/2\", p = \"0\"");
    const Trajectory run = deviated(ball, {1, 0}, 1.25);
    ASSERT_EQ(run.status, Status::ok) << sign << ": " << run.reason;
    EXPECT_NEAR(run.state[2], 0.5, 1e-7) << sign;
    EXPECT_NEAR(run.state[3], -2, 1e-7) << sign;
  }
}

// T(a) = 4 sqrt(2 a): after n periods the deviation (1, 0) is (1, 4 n / sqrt(2 a)).
TEST(Saltation, AddsUpOverPeriods) {
  const Model ball = equations("\"q\", \"p\"", kBall, "q = \"1/2\", p = \"0\"");
  const Trajectory run = deviated(ball, {1, 0}, 40);
  ASSERT_EQ(run.status, Status::ok) << run.reason;
  EXPECT_NEAR(run.state[2], 1, 1e-5);
  EXPECT_NEAR(run.state[3], 40, 1e-5);
}

// From x = -1 + e it meets x = t at t = 1 - e, and x(2) = 5 + 3 e.
TEST(Saltation, OfAPlaceThatMovesHasItsSpeed) {
  const Model model = equations("\"x\"", "x = \"3 + sign(x - t)\"", "x = \"-1\"", "time = \"t\"\n");
  const Trajectory run = deviated(model, {1}, 2);
  ASSERT_EQ(run.status, Status::ok) << run.reason;
  EXPECT_NEAR(run.state[0], 5, 1e-9);
  EXPECT_NEAR(run.state[1], 3, 1e-7);
}

// Two functions that jump at one place are one jump: the rate grows from 1 to 5.
TEST(Saltation, OfOnePlaceIsTakenOnce) {
  const Model model = equations("\"x\"", "x = \"3 + sign(x) + sign(2*x + x^3)\"", "x = \"-1\"");
  const Trajectory run = deviated(model, {1}, 2);
  ASSERT_EQ(run.status, Status::ok) << run.reason;
  EXPECT_NEAR(run.state[1], 5, 1e-7);
}

// The angle of (x, y) jumps from Pi to -Pi: y' from -1 - Pi to -1 + Pi changes the sign, so z is
// asked.
TEST(Saltation, OfAnAngleIsThatOfItsJump) {
  const Model model =
      equations("\"y\", \"z\"", "y = \"-1\"\nz = \"atan2(y, -1)\"", "y = \"1\", z = \"0\"");
  const Trajectory run = deviated(model, {1, 0}, 2);
  ASSERT_EQ(run.status, Status::ok) << run.reason;
  // z(2) = integral of atan2(1 + e - t, -1) over 0 < t < 2, by e: atan2(1, -1) - atan2(-1, -1).
  EXPECT_NEAR(run.state[3], 1.5 * std::acos(-1.), 1e-7);
}

/// The exponent of the equations from one value of the first variable.
PointResult exponent_of(const Model& model, double first, const GiNaC::ex& duration,
                        const char* method = "taylor") {
  Scene scene = model.scene("default");
  scene.duration = duration;
  const PreparedScene run = prepare(model, scene);
  const Grid grid{{{model.variables[0].get_name(), Axis::Kind::state, {first}}}};
  const GridPoints places(model, scene, run, grid, {{model.variables[0]}});
  const Settings settings = settings_for({}, run);
  const LyapunovExponents task(model, scene, run, places, *find_method(method), settings);
  return task.run({0}, 1, {}).front();
}

// The ball comes to the floor at whole times, where parts of the run end.
TEST(Saltation, AtTheEndOfAPartOfARunIsNotMissed) {
  const Model ball = equations("\"q\", \"p\"", kBall, "q = \"1/2\", p = \"0\"");
  for (const int duration : {256, -256}) {
    const PointResult whole = exponent_of(ball, 0.5, duration),
                      beside = exponent_of(ball, 0.5000001, duration);
    EXPECT_EQ(whole.status, Status::ok);
    EXPECT_NEAR(whole.values[1], beside.values[1], 1e-6);
  }
}

// x(2) = 5 + 2 e, by methods whose steps end where they do.
TEST(Saltation, IsThatOfEveryMethodOfOurOwn) {
  const Model model =
      equations("\"x\", \"y\"", "x = \"3 + sign(x)\"\ny = \"-y\"", "x = \"-1\", y = \"1\"");
  for (const char* method : {"dop853", "gauss8"}) {
    const PointResult one = exponent_of(model, -0.9, 1, method),
                      other = exponent_of(model, -0.9, 1);
    EXPECT_EQ(one.status, Status::ok) << method;
    EXPECT_NEAR(one.values[1], other.values[1], 1e-6) << method;
  }
}

// Continuous rates have no jump, whatever signs and angles stand in them.
TEST(Saltation, IsNotNeededWhereRatesAreContinuous) {
  for (const char* rates : {"x = \"2 + sign(x)*sin(x)\"\ny = \"2 + sign(y)*sin(y)\"",
                            "x = \"y + sin(3*atan2(y, x))\"\ny = \"-x + cos(2*atan2(y, x))\""}) {
    const Model model = equations("\"x\", \"y\"", rates, "x = \"-1\", y = \"-1\"");
    EXPECT_FALSE(Saltation(prepare(model, model.scene("default")).specialisation.rhs).needed())
        << rates;
  }
}

// At x = 1/10 the body comes to rest: the rate behind the place is zero, to rounding.
TEST(Saltation, OfABodyThatFrictionHoldsIsNotKnown) {
  const Model model =
      equations("\"x\", \"y\"", "x = \"y\"\ny = \"-x - sign(y)/10\"", "x = \"1/2\", y = \"0\"");
  EXPECT_NE(deviated(model, {1, 0}, 50).status, Status::ok);
}

// Which of the two places the motion beside meets first decides.
TEST(Saltation, OfTwoPlacesAtOnceIsNotKnown) {
  const Model model = equations("\"x\", \"y\"", "x = \"3 + sign(x)\"\ny = \"3 + sign(y)\"",
                                "x = \"-1\", y = \"-1\"");
  EXPECT_EQ(deviated(model, {1, 0}, 2).status, Status::no_convergence);
}

// The rates are continuous where |x| has its corner, and so are deviations.
TEST(Saltation, IsNotNeededWhereOnlySlopesJump) {
  const Model model = equations("\"x\"", "x = \"2 + abs(x)\"", "x = \"-1\"");
  const PreparedScene run = prepare(model, model.scene("default"));
  EXPECT_FALSE(Saltation(run.specialisation.rhs).needed());
  const Trajectory there = deviated(model, {1}, 1);
  EXPECT_NEAR(there.state[1], (2 + std::abs(there.state[0])) / 3, 1e-9);
}

TEST(Saltation, IsRefusedToMethodsThatDoNotStopThere) {
  const Model ball = equations("\"q\", \"p\"", kBall, "q = \"1/2\", p = \"0\"");
  const PreparedScene run = prepare(ball, ball.scene("default"));
  EXPECT_THROW(deviated(ball, {1, 0}, 2, "cvode-adams"), std::invalid_argument);
}

// Conditioning: from rest at 1/2 small changes grow by the time, and with saltation alone.
TEST(Saltation, IsPartOfHowSmallChangesGrow) {
  const Model ball = equations("\"q\", \"p\"", kBall, "q = \"1/2\", p = \"0\"");
  const PreparedScene run = prepare(ball, ball.scene("default"));
  Settings settings = settings_for({}, run);
  settings.duration = 40;
  const auto growth = conditioning(run, settings, 40, {0.5, 1});
  ASSERT_TRUE(growth);
  // A change of q by its size 1/2 becomes one of p by 20, whose size is 1.
  EXPECT_NEAR(growth->columns[0], 20, 0.01);
}

/// Two balls on a rod that bends: chaotic, with an exponent near 0.59 by exact parabolas.
const char* const kTwoBalls = R"toml(
title = "two balls"
hamiltonian = "(p1^2 + p2^2)/2 + q2 + 10*abs(q2 - q1)/3 + 5*abs(q2 + q1/2)"
[phase_space]
variables = ["q1", "q2", "p1", "p2"]
canonical = true
[section]
function = "q1"
plot = ["q2", "p2"]
[[scene]]
name = "default"
initial = { q1 = "1/2", q2 = "1/10", p1 = "1/5", p2 = "1/3" }
duration = "400"
)toml";

TEST(Saltation, ShowsTheChaosOfBalls) {
  const Model model = model_of(kTwoBalls);
  const Scene& scene = model.scene("default");
  const PreparedScene run = prepare(model, scene);
  const Grid grid{{{"q1", Axis::Kind::state, {0.5}}}};
  const GridPoints places(model, scene, run, grid, {{model.variables[0]}});
  const Settings settings = settings_for({}, run);
  const LyapunovExponents exponents(model, scene, run, places, *find_method("taylor"), settings);
  const PointResult result = exponents.run({0}, 1, {}).front();
  EXPECT_EQ(result.status, Status::ok);
  EXPECT_NEAR(result.values[1], 0.59, 0.08);
}

// Orbits in lanes do not carry deviations over jumps: nothing is said of them.
TEST(Saltation, IsMissingInSectionsWhichSaySo) {
  const Model model = model_of(kTwoBalls);
  PoincareOptions options;
  options.orbits = 2;
  options.points = 12;
  const PoincareSection cut = section(model, model.scene("default"), options);
  ASSERT_EQ(cut.orbits.size(), 2U);
  for (const OrbitReport& orbit : cut.orbits) EXPECT_FALSE(orbit.judged);
  options.longest_cycle = 1;
  EXPECT_THROW(section(model, model.scene("default"), options), RequestError);
}

}  // namespace
}  // namespace casimir::test
