// Periodic orbits whose existence is proved.
#include "tools/analysis/section/validated_cycles.hpp"

#include <cln/float.h>
#include <cln/real.h>
#include <gtest/gtest.h>

#include <cmath>

#include "symbolic/case_file.hpp"
#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/proof/ball_matrix.hpp"

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

/// z grows by 10^-13 a second. z - 10^-13 arg(x + i y) has no derivative along the motion, and is
/// again what it was after a turn: it jumps at its cut.
TEST(ValidatedCycles, WhatReturnsToAJumpingFunctionOnlyIsNotProved) {
  const Model model = build_model(parse_case(R"toml(title = "spiral"
hamiltonian = "(x^2+y^2)/2 + (p^2+3*q^2)/2"
[phase_space]
variables = ["x", "y", "z", "q", "p"]
[phase_space.brackets]
"x,y" = "-1"
"y,z" = "-10^(-13)*y/(x^2+y^2)"
"x,z" = "-10^(-13)*x/(x^2+y^2)"
"q,p" = "1"
[casimirs]
C = "z - 10^(-13)*atan2(y, x)"
[section]
function = "y"
plot = ["q", "p"]
[[scene]]
name = "default"
initial = { x = "1", y = "0", z = "1", q = "0", p = "0" }
duration = "1"
)toml",
                                             "spiral"));
  const Scene& scene = model.scenes.front();
  Cycle cycle;
  LevelSet::Vector point(5);
  point << 1, 0, 1, 0, 0;
  cycle.points = {{point, {0, 0}}};
  cycle.period = 2 * std::acos(-1.);
  const ProvedCycle proof =
      enclose_cycles(model, scene, section_problem(model, scene), {cycle}).front();
  EXPECT_FALSE(proof.proved);
  EXPECT_NE(proof.reason.find("jump"), std::string::npos) << proof.reason;
}

TEST(ValidatedCycles, WhatDoesNotCloseIsNotProved) {
  const Oscillators two(2);
  EXPECT_FALSE(enclose_cycles(two.model, two.scene, two.problem, {two.guess(0, 5)}).front().proved);
}

/// The second oscillator is as stiff as k: the first one's cycle is alone unless k passes 4.
TEST(ValidatedCycles, OfARangeOfParametersAreABranchUnlessItIsDegenerateSomewhere) {
  const double pi = std::acos(-1.);
  const auto proof_of = [&](const std::string& middle, const cln::cl_RA& radius,
                            const std::string& of_k = "") {
    const Model model = build_model(parse_case(
        "title = \"two\"\nhamiltonian = \"(u^2 + x^2 + v^2 + k*y^2)/2\"\n[phase_space]\n"
        "variables = [\"x\", \"y\", \"u\", \"v\"]\ncanonical = true\n[parameters]\nk = {" +
            of_k +
            "}\n"
            "[section]\nfunction = \"x\"\nplot = [\"y\", \"v\"]\n[[scene]]\nname = \"default\"\n"
            "parameters = { k = \"" +
            middle +
            "\" }\ninitial = { x = \"0\", y = \"0\", u = \"1\", v = \"0\" }\nduration = \"1\"\n",
        "two"));
    const Scene& scene = model.scenes.front();
    const SectionProblem problem = section_problem(model, scene);
    return enclose_cycles(model, scene, problem, {Oscillators(2).guess(0, 2 * pi)}, {{"k", radius}})
        .front();
  };
  const ProvedCycle branch = proof_of("2", cln::cl_RA(1) / 1000);
  ASSERT_TRUE(branch.proved) << branch.reason;
  for (const double k : {1.999, 2., 2.001})
    EXPECT_TRUE(contains(branch.trace, 2 * std::cos(2 * pi * std::sqrt(k)), 1e-15));
  EXPECT_TRUE(contains(branch.period, 2 * pi, 1e-15));
  EXPECT_FALSE(proof_of("4-1/2000", cln::cl_RA(1) / 1000).proved);
  const std::string below = "assume = \"k < 2 + 1/2000\"";
  EXPECT_TRUE(proof_of("2", cln::cl_RA(1) / 4000, below).proved);
  const ProvedCycle beyond = proof_of("2", cln::cl_RA(1) / 1000, below);
  EXPECT_FALSE(beyond.proved);
  EXPECT_NE(beyond.reason.find("assumption"), std::string::npos) << beyond.reason;
}

TEST(ValidatedCycles, TheLevelIsToldWithTheDigitsThatItHas) {
  Oscillators two(2);
  EXPECT_EQ(two.problem.proved_level_text(), "H = 0.5");
  two.problem.levels = {0.1249961291166};
  EXPECT_EQ(two.problem.proved_level_text(), "H = 0.1249961291166");
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

/// x^2 = 2 in a box of radius 1e-6: Newton's test holds around the root, and not around a point
/// that is moved by 1e-4, nor with a derivative that leaves something out.
TEST(Krawczyk, FromAMovedPointOrWithAFalseDerivativeNothingIsProved) {
  const auto proves = [](double at, bool whole) {
    BallMatrix z(1, 1), box(1, 1), y(1, 1), derivative(1, 1), value(1, 1);
    arb_set_d(z.at(0), at);
    set_interval(box.at(0), {cln::rational(cln::cl_DF(at)) - cln::cl_RA(1) / 1000000,
                             cln::rational(cln::cl_DF(at)) + cln::cl_RA(1) / 1000000});
    arb_mul_2exp_si(derivative.at(0), box.at(0), 1);
    if (!whole) arb_zero(derivative.at(0));
    arb_set_d(y.at(0), 0.5 / std::sqrt(2.));
    arb_mul(value.at(0), z.at(0), z.at(0), kBallBits);
    arb_sub_ui(value.at(0), value.at(0), 2, kBallBits);
    return inside(krawczyk(z, y, value, derivative, box), box);
  };
  EXPECT_TRUE(proves(std::sqrt(2.), true));
  EXPECT_FALSE(proves(std::sqrt(2.) + 1e-4, true));
  EXPECT_FALSE(proves(std::sqrt(2.) - 1e-4, true));
  EXPECT_FALSE(proves(std::sqrt(2.), false));
}

/// From a cycle that is not known well the proof is of the true one, or there is none.
TEST(ValidatedCycles, FromAGuessThatIsOffTheTrueCycleIsFoundOrNone) {
  const double pi = std::acos(-1.);
  const Oscillators two(2);
  for (const double off : {1e-6, 1e-4, 1e-2}) {
    const ProvedCycle proof =
        enclose_cycles(two.model, two.scene, two.problem, {two.guess(off, 2 * pi + off)}).front();
    if (!proof.proved) continue;
    EXPECT_TRUE(contains(proof.period, 2 * pi, 1e-15)) << off;
    EXPECT_TRUE(contains(proof.trace, 2 * std::cos(2 * pi * std::sqrt(2.)), 1e-15)) << off;
  }
}

}  // namespace
}  // namespace casimir::test
