// What runs beside one that is assessed find out, against closed forms.
#include "tools/analysis/estimate/neighbour_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <utility>

#include "tests/tools/analysis/assessed.hpp"
#include "tests/tools/analysis/systems.hpp"

namespace casimir::test {
namespace {

/// q and p of q'' = -sign(q) from rest at a height a, in parabolas of sqrt(2 a) a quarter.
std::pair<double, double> ball_at(double a, double t) {
  const double quarter = std::sqrt(2 * a);
  const double turns = std::floor(t / quarter);
  const double s = t - turns * quarter;  // since the last top or passage
  switch (static_cast<int>(std::fmod(turns, 4))) {
    case 0:
      return {a - s * s / 2, -s};
    case 1:
      return {-quarter * s + s * s / 2, s - quarter};
    case 2:
      return {-a + s * s / 2, s};
    default:
      return {quarter * s - s * s / 2, quarter - s};
  }
}

// Steps end a little behind jumps: two runs that do it alike err alike, and always to one side.
TEST(NeighbourRuns, CountsTheWayOnTheWrongSideOfAJump) {
  const Model ball = model_of(
      "[phase_space]\nvariables = [\"q\", \"p\"]\n[equations]\nq = \"p\"\np = \"-sign(q)\"\n"
      "[[scene]]\nname = \"default\"\ninitial = { q = \"1\", p = \"0\" }\nduration = \"50\"\n");
  for (const auto& [method, tolerance] :
       {std::pair{"taylor", 1e-15}, {"taylor", 1e-12}, {"gauss8", 1e-12}, {"dop853", 1e-13}}) {
    for (const int height : {1, 7, 10}) {
      Scene scene = ball.scene("default");
      scene.initial[0] = GiNaC::numeric(1, height);
      const double a = 1. / height;
      Settings settings;
      settings.duration = 20;
      settings.rtol = settings.atol = tolerance;
      Trajectory run;
      const ErrorEstimate trust = estimate_of(ball, scene, method, settings, &run, 3);
      ASSERT_EQ(run.status, Status::ok) << method;
      const auto [q, p] = ball_at(a, 20);
      const double error =
          std::max(std::abs(run.state[0] - q) / a, std::abs(run.state[1] - p) / std::sqrt(2 * a));
      EXPECT_GT(trust.error_estimate, error / 3) << method << ' ' << height;
      EXPECT_LT(trust.error_estimate, 1e-7) << method << ' ' << height;
    }
  }
}

/// u = 0 is left by what the steps err by, long before it should be, and z shows only that it was.
Model latched() {
  return model_of(R"toml([phase_space]
variables = ["c", "s", "u", "z"]
[equations]
c = "-s"
s = "c"
u = "60*(c - 2/5)*u - u^3"
z = "u^2*(1 - z)"
[[scene]]
name = "default"
initial = { c = "-1", s = "0", u = "1/1000", z = "0" }
duration = "2*Pi"
)toml");
}

// With E = exp(60 (-sin t - 2 t/5)), the integral of u^2 is log(1 + 2e-6 int E^2)/2.
TEST(NeighbourRuns, OfRunsThatPartOnTheWayAndMeetAgain) {
  const Model model = latched();
  constexpr double kTruth = 5.9525315735605e-9;
  for (const auto& [method, tolerance] : {std::pair{"taylor", 1e-8},
                                          {"taylor", 1e-12},
                                          {"dop853", 1e-8},
                                          {"gauss8", 1e-6},
                                          {"cvode-adams", 1e-10},
                                          {"odeint-fehlberg78", 1e-8}}) {
    Settings settings;
    settings.duration = 2 * std::acos(-1.);
    settings.rtol = settings.atol = tolerance;
    Trajectory run;
    const ErrorEstimate trust =
        estimate_of(model, model.scene("default"), method, settings, &run, 3);
    ASSERT_EQ(run.status, Status::ok) << method;
    EXPECT_GT(trust.error_estimate, std::abs(run.state[3] - kTruth) / 3) << method << tolerance;
  }
}

// The same in a run of which it is a small part, by stiff methods, and behind a large part of z.
TEST(NeighbourRuns, ThatPartAreSeenWhereverTheyHide) {
  const Model hidden = model_of(R"toml([phase_space]
variables = ["c", "s", "x", "z"]
[equations]
c = "-s"
s = "c"
x = "10000*(c^2 - s^2) + 200*(c - 2/5)*(x - 10000*c*s) - (x - 10000*c*s)^3"
z = "-10000*s + 10*(x - 10000*c*s)^2*(1 - z + 10000*c)"
[[scene]]
name = "default"
initial = { c = "-1", s = "0", x = "1/1000", z = "-10000" }
duration = "2*Pi"
)toml");
  const Model brief = model_of(R"toml([phase_space]
variables = ["u", "z"]
time = "t"
[equations]
u = "60*(-cos(t) - 2/5)*exp(-(t/5)^8)*u - u - u^3"
z = "u^2*(1 - z)"
[[scene]]
name = "default"
initial = { u = "1/1000", z = "0" }
duration = "20"
)toml");
  struct Case {
    const Model& model;
    const char* method;
    double tolerance, duration, error;
  };
  const double turn = 2 * std::acos(-1.);
  const Model latch = latched();
  for (const auto& [model, method, tolerance, duration, error] :
       {Case{hidden, "taylor", 1e-12, turn, 1e-4},
        {hidden, "dop853", 1e-8, turn, 1e-4},
        {brief, "dop853", 1e-8, 10000, 1},
        {brief, "taylor", 1e-10, 10000, 1},
        {latch, "radau9", 1e-8, turn, 1},
        {latch, "cvode-bdf", 1e-10, turn, 1}}) {
    Settings settings;
    settings.duration = duration;
    settings.rtol = settings.atol = tolerance;
    Trajectory run;
    const ErrorEstimate trust =
        estimate_of(model, model.scene("default"), method, settings, &run, 3);
    ASSERT_EQ(run.status, Status::ok) << method;
    EXPECT_GT(trust.error_estimate, error / 3) << method << ' ' << tolerance;
  }
}

// A front that comes a little earlier or later.
TEST(NeighbourRuns, ThatAreShiftedInTimeHaveNotParted) {
  const Model front = one_equation("1000*(x/1000)^2*(1 - x/1000)", "2000");
  for (const auto& [method, tolerance] : {std::pair{"cvode-adams", 1e-4},
                                          {"cvode-adams", 1e-5},
                                          {"dop853", 1e-3},
                                          {"taylor", 1e-3}}) {
    Settings settings;
    settings.duration = 2000;
    settings.rtol = tolerance;
    settings.atol = 1000 * tolerance;
    Trajectory run;
    const ErrorEstimate trust =
        estimate_of(front, front.scene("default"), method, settings, &run, 3);
    ASSERT_EQ(run.status, Status::ok) << method;
    EXPECT_FALSE(trust.parted) << method << ' ' << tolerance << ' ' << *trust.parted;
  }
}

// Low orders come nearer with a hundredth of the tolerance, and not near enough.
TEST(NeighbourRuns, ThatAreShiftedByMoreThanAJumpTakesHaveNotParted) {
  const auto van_der_pol = [](const std::string& mu, const std::string& duration) {
    return model_of("[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"y\"\ny = \"" +
                    mu +
                    "*(1 - x^2)*y - x\"\n[[scene]]\nname = \"default\"\n"
                    "initial = { x = \"2\", y = \"0\" }\nduration = \"" +
                    duration + "\"\n");
  };
  const Model stiff = van_der_pol("1000", "3000"), mild = van_der_pol("40", "150");
  for (const auto& [model, method, tolerance, x] : {std::tuple{stiff, "radau5", 1e-4, -1.51060694},
                                                    {stiff, "cvode-bdf", 1e-6, -1.51060694},
                                                    {mild, "midpoint", 1e-3, 1.67056}}) {
    Settings settings;
    settings.duration = x < 0 ? 3000 : 150;
    settings.rtol = settings.atol = tolerance;
    Trajectory run;
    const ErrorEstimate trust =
        estimate_of(model, model.scene("default"), method, settings, &run, 3);
    ASSERT_EQ(run.status, Status::ok) << method;
    EXPECT_FALSE(trust.parted) << method << ' ' << *trust.parted;
    EXPECT_GT(trust.error_estimate, std::abs(run.state[0] - x) / 6) << method;
    EXPECT_LT(trust.error_estimate, 0.05) << method;
  }
}

// Runs turn a little earlier or later, and nothing else: no rounding and no tolerance decides it.
TEST(NeighbourRuns, OfARelaxationOscillationIsNotInDoubt) {
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"40*(y + x - x^3/3)\"\n"
      "y = \"-x/40\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"2\", y = \"0\" }\n"
      "duration = \"150\"\n");
  for (const double tolerance : {1e-5, 1e-7, 1e-10}) {
    Settings settings;
    settings.duration = 150;
    settings.rtol = settings.atol = tolerance;
    Trajectory run;
    const ErrorEstimate trust =
        estimate_of(model, model.scene("default"), "dop853", settings, &run, 3);
    ASSERT_EQ(run.status, Status::ok);
    EXPECT_FALSE(trust.parted) << tolerance << ' ' << *trust.parted;
  }
}

// CVODE's methods do not know of jumps, and may fail of a tolerance beside one.
TEST(NeighbourRuns, AFailureOfARunBesideIsNoRounding) {
  const Model ball = model_of(
      "[phase_space]\nvariables = [\"q\", \"p\"]\n[equations]\nq = \"p\"\np = \"-sign(q)\"\n"
      "[[scene]]\nname = \"default\"\ninitial = { q = \"1/10\", p = \"0\" }\nduration = \"7\"\n");
  for (const double duration : {7., 20.}) {
    Settings settings;
    settings.duration = duration;
    settings.rtol = settings.atol = 1e-12;
    Trajectory run;
    const ErrorEstimate trust =
        estimate_of(ball, ball.scene("default"), "cvode-adams", settings, &run, 3);
    ASSERT_EQ(run.status, Status::ok);
    EXPECT_LT(trust.input_rounding, 1e-6) << duration;
    EXPECT_GT(trust.error_estimate, std::abs(run.state[0] - ball_at(0.1, duration).first))
        << duration;
  }
}

}  // namespace
}  // namespace casimir::test
