// Sections: what is on the level, which orbits are chaotic, and what has no section.
#include "tools/analysis/section/section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/section/cycles.hpp"

namespace casimir::test {
namespace {

/// Two oscillators whose squares of frequencies are 1 and 2, and a coupling.
struct Pair {
  GiNaC::symbol x{"x"}, y{"y"}, u{"u"}, v{"v"};
  Model model;
  Scene scene;
  explicit Pair(const GiNaC::ex& coupling)
      : model(hamiltonian_system(
            "pair", {x, y}, {u, v},
            (u * u + v * v + x * x) / 2 + y * y + coupling * (x * x * y - y * y * y / 3))),
        scene(scene_from(model, {0, GiNaC::numeric(1, 10), GiNaC::numeric(1, 2), 0}, 1)) {}

  PoincareOptions options(std::size_t orbits, std::size_t points, double energy) const {
    PoincareOptions result;
    result.request.plane = FunctionText{x, "x"};
    result.request.pair = {{y, "y"}, {v, "v"}};
    result.request.energy = energy;
    result.orbits = orbits;
    result.points = points;
    return result;
  }
};

TEST(Section, OrbitsOfUncoupledOscillatorsLieOnEllipses) {
  const Pair pair(0);
  const PoincareSection map = section(pair.model, pair.scene, pair.options(5, 60, 0.25));
  ASSERT_EQ(map.orbits.size(), 5U);
  EXPECT_EQ(map.crossings(), 300U);
  for (const OrbitReport& orbit : map.orbits) {
    EXPECT_TRUE(orbit.judged);
    EXPECT_FALSE(orbit.chaotic);
    EXPECT_FALSE(orbit.leaves_level);
    EXPECT_LT(orbit.off_level, kOnLevel);
    const auto energy = [](const std::array<double, 2>& at) {
      return at[1] * at[1] / 2 + at[0] * at[0];
    };
    for (const auto& place : orbit.places)
      EXPECT_NEAR(energy(place), energy(orbit.places[0]), 1e-11);
  }
}

/// An oscillator beside a saddle: what grows there is every orbit, and no chaos is in it.
TEST(Section, OrbitsThatRunAwayAreNotJudged) {
  const GiNaC::symbol x("x"), y("y"), u("u"), v("v");
  const Model model =
      hamiltonian_system("saddle", {x, y}, {u, v}, (u * u + x * x + v * v) / 2 - y * y / 2000);
  const Scene scene = scene_from(model, {0, GiNaC::numeric(1, 10), GiNaC::numeric(1, 2), 0}, 1);
  PoincareOptions options;
  options.request.plane = FunctionText{x, "x"};
  options.request.pair = {{y, "y"}, {v, "v"}};
  options.request.energy = 0.25;
  options.orbits = 6;
  options.points = 100;
  const PoincareSection map = section(model, scene, options);
  ASSERT_FALSE(map.orbits.empty());
  for (const OrbitReport& orbit : map.orbits) {
    EXPECT_FALSE(orbit.judged);
    EXPECT_FALSE(orbit.chaotic);
  }
}

/// Rounding moves an n-fold zero of a series by an n-th root of it.
TEST(Section, MultipleZerosOfAPlaneAreWhereTheFunctionHasThem) {
  const Pair pair(0);
  const GiNaC::ex shifted = pair.x + GiNaC::numeric(1, 10);
  const auto times = [&](const GiNaC::ex& plane) {
    PoincareOptions options = pair.options(1, 5, 0.25);
    options.seeds = {{0.1, 0.1, 0.5, 0.3}};
    options.request.plane = FunctionText{plane, "plane"};
    options.request.energy = 0.5 * (0.25 + 0.09 + 0.01) + 0.01;
    return section(pair.model, pair.scene, options).orbits.at(0).orbit.times;
  };
  const std::vector<double> simple = times(pair.x), aside = times(shifted);
  ASSERT_EQ(simple.size(), 5U);
  const std::vector<std::pair<GiNaC::ex, std::vector<double>>> planes{
      {GiNaC::pow(pair.x, 9), simple},
      {pair.x - GiNaC::sin(pair.x), simple},
      {GiNaC::pow(shifted, 3), aside},
      {GiNaC::pow(shifted, 3).expand(), aside},
      {(GiNaC::pow(shifted, 3) * GiNaC::pow(pair.v - 7, 2)).expand(), aside}};
  for (const auto& [plane, expected] : planes) {
    const std::vector<double> found = times(plane);
    ASSERT_EQ(found.size(), expected.size()) << plane;
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], expected[i], 1e-7) << plane;
  }
}

TEST(Section, TheLevelIsTheSceneSUnlessAnotherIsAskedFor) {
  const Pair pair(0);
  PoincareOptions options = pair.options(2, 10, 0.25);
  EXPECT_FALSE(section(pair.model, pair.scene, options).problem->on_scene);
  options.request.energy.reset();
  const PoincareSection map = section(pair.model, pair.scene, options);
  EXPECT_TRUE(map.problem->on_scene);
  EXPECT_NEAR(map.problem->levels.at(0), 0.125 + 0.01, 1e-15);
}

TEST(Section, WhereNothingMovesThereIsNoOrbit) {
  const Pair pair(0);
  EXPECT_TRUE(section(pair.model, pair.scene, pair.options(3, 10, -1)).orbits.empty());
}

TEST(Section, TheOppositeDirectionIsTheMirrorImage) {
  const Pair pair(0);
  PoincareOptions options = pair.options(2, 20, 0.25);
  const std::size_t n = pair.model.variables.size();
  for (const bool upwards : {true, false}) {
    options.request.upwards = upwards;
    for (const OrbitReport& orbit : section(pair.model, pair.scene, options).orbits)
      for (std::size_t k = 0; k < orbit.orbit.size(); ++k)
        EXPECT_EQ(orbit.orbit.states[k * n + 2] > 0, upwards);
  }
}

TEST(Section, SystemsWithoutOneAreRefused) {
  const Oscillator oscillator;
  PoincareOptions options;
  options.request.plane = FunctionText{oscillator.q, "q"};
  options.request.pair = {{oscillator.q, "q"}, {oscillator.p, "p"}};
  EXPECT_THROW(section(oscillator.model, oscillator.scene(1), options), RequestError);
  const Model equations = one_equation("x", "1");
  EXPECT_THROW(section(equations, equations.scene("default")), RequestError);
  EXPECT_THROW(require_energy_level(equations), RequestError);
  const Pair pair(1);
  EXPECT_NO_THROW(require_energy_level(pair.model));
  EXPECT_THROW(section(pair.model, pair.scene), RequestError) << "no plane";
  PoincareOptions constant = pair.options(2, 10, 0.1);
  constant.request.plane = FunctionText{1, "1"};
  EXPECT_THROW(section(pair.model, pair.scene, constant), RequestError);
  PoincareOptions one = pair.options(2, 10, 0.1);
  one.request.pair.pop_back();
  EXPECT_THROW(section(pair.model, pair.scene, one), RequestError);
  PoincareOptions unknown = pair.options(2, 10, 0.1);
  unknown.request.casimirs = {{"F", 1}};
  EXPECT_THROW(section(pair.model, pair.scene, unknown), RequestError);
}

TEST(Cycle, ItsKindFollowsFromTheTrace) {
  Cycle cycle;
  cycle.trace = 1;
  EXPECT_EQ(cycle.stability(), SpectralStability::stable);
  EXPECT_EQ(cycle.kind(), "elliptic");
  EXPECT_NEAR(std::abs(cycle.multipliers()[0]), 1, 1e-15);
  cycle.trace = 2.5;
  EXPECT_EQ(cycle.kind(), "hyperbolic");
  EXPECT_NEAR(std::abs(cycle.multipliers()[0] * cycle.multipliers()[1] - 1.), 0, 1e-15);
  cycle.trace = -2.5;
  EXPECT_EQ(cycle.stability(), SpectralStability::unstable);
  EXPECT_EQ(cycle.kind(), "inverse hyperbolic");
}

TEST(Cycle, ATraceThatIsMinusTwoToRoundingTellsNothing) {
  for (const double aside : {-1e-9, 0., 1e-9}) {
    Cycle cycle;
    cycle.trace = -2 + aside;
    EXPECT_EQ(cycle.stability(), SpectralStability::undecided);
    EXPECT_EQ(cycle.kind(), "parabolic or nearly so");
  }
  Cycle distorted;
  distorted.trace = 2.001;
  distorted.determinant = 1.001;
  EXPECT_EQ(distorted.stability(), SpectralStability::undecided);
}

TEST(Cycle, TheNormalModeOfTwoOscillatorsIsAFixedPoint) {
  // On x alone the motion has period 2 Pi, in which y turns by the angle 2 Pi sqrt(2).
  const Pair pair(0);
  const SectionProblem problem =
      section_problem(pair.model, pair.scene, pair.options(2, 10, 0.25).request);
  const LevelSet level(problem);
  const OrbitCutter cutter(problem, {}, 1);
  LevelSet::Vector start(4);
  start << 0, 0.01, 0.7, 0.01;
  ASSERT_TRUE(level.project(start));
  const CycleSearch found =
      find_cycles(level, cutter, {{start, level.plotted(start.data())}}, 1, true, [](double) {});
  ASSERT_EQ(found.cycles.size(), 1U);
  const Cycle& cycle = found.cycles[0];
  EXPECT_EQ(cycle.length(), 1U);
  EXPECT_NEAR(cycle.period, 2 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(cycle.trace, 2 * std::cos(2 * std::numbers::pi * std::sqrt(2.)), 1e-7);
  EXPECT_NEAR(cycle.points[0].place[0], 0, 1e-9);
}

}  // namespace
}  // namespace casimir::test
