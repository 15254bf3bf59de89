// Periodic orbits whose existence is proved.
#include "tools/analysis/section/validated_cycles.hpp"

#include <cln/float.h>
#include <cln/real.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/analysis/systems.hpp"

namespace casimir::test {
namespace {

bool contains(const RationalInterval& x, double value, double error) {
  return cln::double_approx(x.low) - error <= value && value <= cln::double_approx(x.high) + error;
}

/// Two oscillators that do not know of each other, cut where x = 0.
struct Oscillators {
  GiNaC::symbol x{"x"}, y{"y"}, u{"u"}, v{"v"};
  Model model;
  Scene scene;
  SectionProblem problem;

  explicit Oscillators(const GiNaC::ex& stiffness)
      : model(hamiltonian_system("two", {x, y}, {u, v},
                                 (u * u + x * x + v * v + stiffness * y * y) / 2)),
        scene(scene_from(model, {0, 0, 1, 0}, 1)),
        problem(
            section_problem(model, scene, {{{x, "x"}}, true, {{y, "y"}, {v, "v"}}, {}, 0.5, {}})) {}

  /// A guess: a point of the plane, and the time after which it is there again.
  Cycle guess(double y_value, double period) const {
    Cycle cycle;
    LevelSet::Vector point(4);
    point << 0, y_value, 1, 0;
    cycle.points = {{point, {y_value, 0}}};
    cycle.period = period;
    return cycle;
  }
};

TEST(ValidatedCycles, AnOscillationHasItsPeriodAndItsTrace) {
  const double pi = std::acos(-1.);
  const Oscillators two(2);
  const ProvedCycle proof =
      enclose_cycles(two.model, two.scene, two.problem, {two.guess(1e-9, 2 * pi + 1e-9)}).front();
  ASSERT_TRUE(proof.proved) << proof.reason;
  EXPECT_TRUE(contains(proof.period, 2 * pi, 1e-15));
  EXPECT_TRUE(contains(proof.trace, 2 * std::cos(2 * pi * std::sqrt(2.)), 1e-15));
  EXPECT_TRUE(contains(proof.state[1], 0, 0));
  EXPECT_LT(cln::double_approx(proof.radius), 1e-10);
  EXPECT_EQ(proof.kind(), "elliptic");
}

/// With stiffness 4 every orbit of the level closes after 2 pi: a family, so that none is alone.
TEST(ValidatedCycles, AMemberOfAFamilyIsNotProved) {
  const Oscillators two(4);
  const ProvedCycle proof =
      enclose_cycles(two.model, two.scene, two.problem, {two.guess(0, 2 * std::acos(-1.))}).front();
  EXPECT_FALSE(proof.proved);
  EXPECT_FALSE(proof.reason.empty());
}

TEST(ValidatedCycles, WhatDoesNotCloseIsNotProved) {
  const Oscillators two(2);
  EXPECT_FALSE(enclose_cycles(two.model, two.scene, two.problem, {two.guess(0, 5)}).front().proved);
}

/// What is called a Casimir function is none: the level is not kept, and the proof rests on that.
TEST(ValidatedCycles, NothingIsProvedOnAFalseLevel) {
  Oscillators two(2);
  two.model.casimirs.push_back({"F", two.x + two.y, {}});
  two.problem.level_names.push_back("F");
  two.problem.levels.push_back(0);
  EXPECT_FALSE(enclose_cycles(two.model, two.scene, two.problem, {two.guess(0, 2 * std::acos(-1.))})
                   .front()
                   .proved);
}

}  // namespace
}  // namespace casimir::test
