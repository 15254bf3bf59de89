// Frequencies, rotation numbers, chaos indicators and cycles with a symmetry of whole systems,
// against closed forms and published figures.
#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <cmath>
#include <numbers>

#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/frequency/motion_frequencies.hpp"
#include "tools/analysis/run/assessed_run.hpp"
#include "tools/analysis/section/orbit_rotation.hpp"
#include "tools/analysis/section/section.hpp"
#include "tools/analysis/section/symmetric_cycle.hpp"
#include "tools/analysis/sweep/indicators.hpp"

namespace casimir::test {
namespace {

constexpr double kWhole = 2 * std::numbers::pi;

/// Euler's top with 2H = a1 M1^2 + a2 M2^2 + a3 M3^2 that turns about its first axis: the frequency
/// of M, and the mean rate at which the third axis precesses about M, by elliptic integrals.
struct EulerTop {
  double a1, a2, a3, twice_energy, square;  ///< 2H and |M|^2

  double gap1() const { return a1 * square - twice_energy; }
  double gap3() const { return twice_energy - a3 * square; }
  double modulus() const { return std::sqrt((a2 - a3) * gap1() / ((a1 - a2) * gap3())); }
  double rotation() const {
    return kWhole * std::sqrt((a1 - a2) * gap3()) / (4 * boost::math::ellint_1(modulus()));
  }
  double precession() const {
    const double largest = gap1() / (a1 - a3);  // of M3^2 = largest * cn^2
    const double n = -largest / (square - largest);
    const double mean = boost::math::ellint_3(modulus(), n) / boost::math::ellint_1(modulus());
    return std::sqrt(square) * (a3 + gap3() / (square - largest) * mean);
  }
};

const char* const kEuler = R"toml(title = "Euler"
hamiltonian = "(M1^2 + M2^2/2 + M3^2/3)/2"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
[casimirs]
F1 = "g1^2 + g2^2 + g3^2"
F2 = "M1*g1 + M2*g2 + M3*g3"
[section]
function = "M3*(M1*g1 + M2*g2 + M3*g3) - (M1^2 + M2^2 + M3^2)*g3"
direction = "down"
plot = ["atan2(M1, M2)", "M3/sqrt(M1^2 + M2^2 + M3^2)"]
[[scene]]
name = "default"
initial = { M1 = "1", M2 = "1/2", M3 = "1/3", g1 = "3/5", g2 = "0", g3 = "4/5" }
duration = "600"
)toml";

EulerTop top_at(const LevelSet::Vector& x) {
  return {1, 0.5, 1. / 3, x[0] * x[0] + x[1] * x[1] / 2 + x[2] * x[2] / 3,
          x[0] * x[0] + x[1] * x[1] + x[2] * x[2]};
}

TEST(Frequencies, OfEulersTopAreThoseOfTheEllipticIntegrals) {
  const Model model = model_of(kEuler);
  const Scene& scene = model.scene("default");
  const PreparedScene run = prepare(model, scene, {.observe = std::vector<std::string>{}});
  AssessmentOptions how;
  how.sample_every = 600. / 8192;
  const AssessedRun judged = integrate_assessed(model, scene, run, how);
  SampledMotion motion{run.specialisation.states, std::vector<bool>(6), judged.trajectory.samples,
                       how.sample_every};
  motion.states.resize(8192);
  const MotionFrequencies found = frequencies_of(motion, 5);
  EXPECT_TRUE(found.settled);
  EXPECT_TRUE(found.warnings.empty());
  EXPECT_EQ(found.base.size(), 2U);
  LevelSet::Vector start(6);
  start << 1, 0.5, 1. / 3, 0.6, 0, 0.8;
  const EulerTop top = top_at(start);
  const double rotation = top.rotation(), precession = top.precession();
  for (const VariableSpectrum& variable : found.variables)
    for (const MotionLine& line : variable.lines) {
      if (line.amplitude < 1e-3) continue;
      double nearest = 1;
      for (int k = -9; k <= 9; ++k)
        for (const int p : {-1, 0, 1})
          nearest =
              std::min(nearest, std::abs(std::abs(k * rotation + p * precession) - line.frequency));
      EXPECT_LT(nearest, 1e-12) << variable.name << " " << line.frequency;
      EXPECT_LT(nearest, 10 * line.error + 1e-13) << variable.name;
    }
}

TEST(Rotation, OfEulersTopIsThatOfTheEllipticIntegrals) {
  const Model model = model_of(kEuler);
  const PoincareSection cut =
      section(model, model.scene("default"), {.orbits = 6, .points = 400, .jobs = 1});
  int compared = 0;
  for (const OrbitReport& orbit : cut.orbits) {
    const EulerTop top = top_at(orbit.seed);
    if (!(top.modulus() < 1)) continue;  // it turns about the third axis
    const Rotation rotation = rotation_of_orbit(*cut.problem, orbit);
    ASSERT_EQ(rotation.kind, Rotation::Kind::curve) << rotation.reason;
    const double expected = top.rotation() / top.precession();
    const double part = expected - std::floor(expected);
    const double off =
        std::min(std::abs(part - rotation.number), std::abs(1 - part - rotation.number));
    EXPECT_LT(off, 10 * rotation.error + 1e-12);
    if (rotation.error < 1e-12) {
      EXPECT_LT(off, 1e-11);
      ++compared;
    }
  }
  EXPECT_GE(compared, 1);
}

TEST(Frequencies, OfChaosAreWarnedOf) {
  SampledMotion motion{{"x"}, {false}, {}, 1};
  double x = 0.3;
  for (int j = 0; j < 2048; ++j) motion.states.push_back({x = 3.99 * x * (1 - x)});
  const MotionFrequencies found = frequencies_of(motion, 3);
  EXPECT_FALSE(found.settled);
  EXPECT_TRUE(found.base.empty());
  EXPECT_FALSE(found.warnings.empty());
}

const char* const kHenonHeiles = R"toml(title = "Henon-Heiles"
hamiltonian = "(px^2 + py^2 + x^2 + y^2)/2 + x^2*y - y^3/3"
[phase_space]
variables = ["x", "y", "px", "py"]
canonical = true
[[scene]]
name = "default"
initial = { x = "0", y = "0", px = "0.3", py = "0" }
duration = "2000"
)toml";

std::vector<double> indicators_of(const Model& model, const std::vector<double>& start,
                                  double duration, std::vector<std::string>* names = nullptr) {
  const Scene& scene = model.scene("default");
  PreparedScene run = prepare(model, scene, {.observe = std::vector<std::string>{}});
  run.initial = start;
  const Grid grid{{{run.specialisation.states[0], Axis::Kind::state, {start[0]}}}};
  const GridPoints places(model, scene, run, grid, {{model.variables[0]}});
  RunRequest request;
  request.duration = duration;
  const Settings settings = settings_for(request, run);
  const Indicators task(model, scene, run, places, *find_method("taylor"), settings);
  if (names) *names = task.columns();
  const PointResult result = task.run({0}, 1, {})[0];
  EXPECT_EQ(result.status, Status::ok);
  return result.values;
}

TEST(Indicators, TellTheOrbitsOfHenonAndHeilesApart) {
  const Model model = model_of(kHenonHeiles);
  std::vector<std::string> names;
  const auto periodic = indicators_of(model, {0, 0.295456, 0.407308431, 0}, 2000, &names);
  const auto regular = indicators_of(model, {0, 0.483, 0.27898039, 0}, 2000);
  const auto chaotic = indicators_of(model, {0, -0.25, 0.42081, 0}, 2000);
  ASSERT_EQ(names, (std::vector<std::string>{"t", "megno", "megno_half", "level", "dimension",
                                             "gali_2", "gali_3", "steps"}));
  EXPECT_LT(periodic[1], 2.1);
  EXPECT_NEAR(regular[1], 2, 0.3);
  EXPECT_GT(chaotic[1], 20);
  // On a torus of two dimensions in a level of three: constant, and like t^-2.
  EXPECT_EQ(regular[3], 3);
  EXPECT_EQ(regular[4], 2);
  EXPECT_GT(regular[5], 0.05);
  EXPECT_LT(regular[6], 1e-3);
  EXPECT_TRUE(std::isnan(chaotic[4]));
  EXPECT_LT(chaotic[5], 1e-12);
}

TEST(Indicators, GaliFallsLikeTheSquareOfTheTimeBeyondTheTorus) {
  const Model model = model_of(kHenonHeiles);
  const auto early = indicators_of(model, {0, 0.483, 0.27898039, 0}, 500);
  const auto late = indicators_of(model, {0, 0.483, 0.27898039, 0}, 5000);
  EXPECT_NEAR(std::log10(early[6] / late[6]), 2, 0.6);
  EXPECT_NEAR(std::log10(early[5] / late[5]), 0, 0.4);
}

TEST(Indicators, MegnoOfUncoupledOscillatorsIsThatOfNoGrowth) {
  const Model model = model_of(R"toml(title = "two"
hamiltonian = "(p1^2 + p2^2 + q1^2 + 2*q2^2)/2"
[phase_space]
variables = ["q1", "q2", "p1", "p2"]
canonical = true
[integrals]
F = "p1^2 + q1^2"
[[scene]]
name = "default"
initial = { q1 = "1", q2 = "1/2", p1 = "0", p2 = "0" }
duration = "100"
)toml");
  const auto values = indicators_of(model, {1, 0.5, 0, 0}, 500);
  EXPECT_LT(std::abs(values[1]), 0.5);
  EXPECT_EQ(values[3], 2);  // the level of both integrals is the torus
  EXPECT_EQ(values[4], 2);
}

/// With an integral that is none, deviations keep to the level of the energy alone.
TEST(Indicators, WhatIsNotProvedIsLeftOut) {
  const Model model = model_of(std::string(kHenonHeiles) + "[integrals]\nF = \"px\"\n");
  const Scene& scene = model.scene("default");
  const PreparedScene run = prepare(model, scene, {.observe = std::vector<std::string>{}});
  const Grid grid{{{"x", Axis::Kind::state, {0}}}};
  const GridPoints places(model, scene, run, grid, {{model.variables[0]}});
  const Settings settings = settings_for({}, run);
  const Indicators task(model, scene, run, places, *find_method("taylor"), settings);
  EXPECT_EQ(task.proved(), std::vector<std::string>{"H"});
  EXPECT_EQ(task.left_out(), std::vector<std::string>{"F"});
}

const char* const kThreeBodies = R"toml(title = "Three bodies"
hamiltonian = "(u1^2 + v1^2 + u2^2 + v2^2 + u3^2 + v3^2)/2 - 1/r12 - 1/r23 - 1/r31"
[phase_space]
variables = ["x1", "y1", "x2", "y2", "x3", "y3", "u1", "v1", "u2", "v2", "u3", "v3"]
canonical = true
[definitions]
r12 = "sqrt((x1-x2)^2 + (y1-y2)^2)"
r23 = "sqrt((x2-x3)^2 + (y2-y3)^2)"
r31 = "sqrt((x3-x1)^2 + (y3-y1)^2)"
[[scene]]
name = "default"
initial = { x1 = "0.97000436", y1 = "-0.24308753", x2 = "-0.97000436", y2 = "0.24308753", x3 = "0", y3 = "0", u1 = "0.466203685", v1 = "0.43236573", u2 = "0.466203685", v2 = "0.43236573", u3 = "-0.93240737", v3 = "-0.86473146" }
duration = "6.32591398"
)toml";

SymmetricCycle cycle_of(const Model& model,
                        const std::vector<std::pair<std::string, std::string>>& s, double period,
                        bool keep) {
  std::vector<std::pair<std::string, GiNaC::ex>> images;
  for (const auto& [name, image] : s)
    images.emplace_back(name, model.parse(Text{image, {"test", 1, 1}, image}));
  const Scene& scene = model.scene("default");
  const PreparedScene run = prepare(model, scene, {.observe = std::vector<std::string>{}});
  const PhaseSymmetry symmetry = phase_symmetry(model, scene, images);
  return symmetric_cycle(model, scene, run, symmetry, {.guess = period, .keep_period = keep});
}

const std::vector<std::pair<std::string, std::string>> kExchange = {
    {"x1", "x3"}, {"y1", "y3"}, {"x2", "x1"}, {"y2", "y1"}, {"x3", "x2"}, {"y3", "y2"},
    {"u1", "u3"}, {"v1", "v3"}, {"u2", "u1"}, {"v2", "v1"}, {"u3", "u2"}, {"v3", "v2"}};

/// Chenciner and Montgomery (2000), with the figures of Simo.
TEST(SymmetricCycle, OfThreeBodiesIsTheFigureEight) {
  const SymmetricCycle cycle = cycle_of(model_of(kThreeBodies), kExchange, 6.32591398, true);
  ASSERT_TRUE(cycle.found) << cycle.reason;
  EXPECT_NEAR(cycle.period, 6.32591398, 1e-12);
  const std::vector<double> published{0.97000436,  -0.24308753, -0.97000436, 0.24308753,
                                      0,           0,           0.466203685, 0.43236573,
                                      0.466203685, 0.43236573,  -0.93240737, -0.86473146};
  for (std::size_t i = 0; i < published.size(); ++i)
    EXPECT_NEAR(cycle.state[i], published[i], 2e-8) << i;
  EXPECT_LT(cycle.residual, 1e-12);
  EXPECT_LT(cycle.closure, 1e-10);
  for (const auto& m : cycle.multipliers) EXPECT_NEAR(std::abs(m), 1, 1e-4);
}

TEST(SymmetricCycle, WhatIsNoSymmetryIsRefused) {
  const Model model = model_of(kThreeBodies);
  const Scene& scene = model.scene("default");
  const GiNaC::ex x2 = model.variables[2], x1 = model.variables[0];
  EXPECT_THROW(phase_symmetry(model, scene, {{"x1", x2}, {"x2", x1}}), RequestError);
  EXPECT_THROW(phase_symmetry(model, scene, {{"x1", 2 * x1}}), RequestError);
}

/// The flow of the pendulum after half of its period is a turn by half.
TEST(SymmetricCycle, OfAPendulumHasThePeriodOfTheEllipticIntegral) {
  const Model model = model_of(R"toml(title = "pendulum"
hamiltonian = "p^2/2 - cos(q)"
[phase_space]
variables = ["q", "p"]
canonical = true
[[scene]]
name = "default"
initial = { q = "1", p = "0" }
duration = "6.7"
)toml");
  const SymmetricCycle cycle = cycle_of(model, {{"q", "-q"}, {"p", "-p"}}, 6.7, false);
  ASSERT_TRUE(cycle.found) << cycle.reason;
  const double energy = cycle.state[1] * cycle.state[1] / 2 - std::cos(cycle.state[0]);
  const double modulus = std::sqrt((energy + 1) / 2);
  EXPECT_NEAR(cycle.period, 4 * boost::math::ellint_1(modulus), 1e-11);
}

}  // namespace
}  // namespace casimir::test
