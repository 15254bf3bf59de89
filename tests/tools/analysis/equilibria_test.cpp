// Equilibria and their eigenvalues.
#include "tools/analysis/equilibria/equilibria.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/equilibria/validated_equilibria.hpp"

namespace casimir::test {
namespace {

EquilibriumReport found(const Model& model, const Scene& scene) {
  double last = -1;
  EquilibriumReport report = find_equilibria(model, scene, [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  });
  EXPECT_GE(last, 0);
  return report;
}

TEST(Equilibria, OfADoubleWellAreTwoCentresAndASaddle) {
  const GiNaC::symbol q("q"), p("p");
  const Model model =
      hamiltonian_system("well", {q}, {p}, p * p / 2 + GiNaC::pow(q, 4) / 4 - q * q / 2);
  const EquilibriumReport report = found(model, scene_from(model, {1, 1}, 1));
  ASSERT_EQ(report.equilibria.size(), 3U);
  int saddles = 0;
  for (const Equilibrium& equilibrium : report.equilibria) {
    const double at = equilibrium.state[0];
    EXPECT_LT(equilibrium.residual, 1e-10);
    EXPECT_EQ(equilibrium.family, 0U);
    EXPECT_FALSE(equilibrium.degenerate);
    EXPECT_NEAR(equilibrium.state[1], 0, 1e-10);
    ASSERT_EQ(equilibrium.eigenvalues.size(), 2U);
    if (std::abs(at) < 0.5) {
      ++saddles;
      EXPECT_NEAR(equilibrium.growth(), 1, 1e-9);
    } else {
      EXPECT_NEAR(std::abs(at), 1, 1e-10);
      EXPECT_EQ(equilibrium.growth(), 0);
      EXPECT_NEAR(std::abs(equilibrium.eigenvalues[0].imag()), std::sqrt(2.), 1e-9);
    }
  }
  EXPECT_EQ(saddles, 1);
}

TEST(Equilibria, AFlatValleyIsOneFamily) {
  const GiNaC::symbol x("x"), y("y"), u("u"), v("v");
  const Model model =
      hamiltonian_system("valley", {x, y}, {u, v}, (u * u + v * v + (x - y) * (x - y)) / 2);
  const EquilibriumReport report = found(model, scene_from(model, {1, 0, 0, 1}, 1));
  ASSERT_FALSE(report.equilibria.empty());
  const Equilibrium& rest = report.equilibria.front();
  EXPECT_NEAR(rest.state[0], rest.state[1], 1e-9);
  EXPECT_TRUE(rest.degenerate);
}

/// Of the only rest of linear equations with these right-hand sides.
Equilibrium rest_of(const std::vector<std::string>& rates) {
  std::string variables, equations, initial;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const std::string name = "x" + std::to_string(i + 1), comma = i > 0 ? ", " : "";
    variables += comma + '"' + name + '"';
    equations += name + " = \"" + rates[i] + "\"\n";
    initial += comma + name + " = \"1\"";
  }
  const Model model = model_of(
      "title = \"t\"\n[phase_space]\nvariables = [" + variables + "]\n[equations]\n" + equations +
      "[[scene]]\nname = \"default\"\ninitial = { " + initial + " }\nduration = \"1\"\n");
  const EquilibriumReport report = found(model, model.scene("default"));
  EXPECT_EQ(report.equilibria.size(), 1U);
  return report.equilibria.at(0);
}

TEST(Equilibria, ASlowRateBesideFastOnesIsNoRounding) {
  const Equilibrium saddle = rest_of({"x1", "-10^6*x2"});
  EXPECT_EQ(saddle.stability, SpectralStability::unstable);
  EXPECT_NEAR(saddle.growth(), 1, 1e-12);
  const Equilibrium slow = rest_of({"-x2", "x1", "x3/10^8"});
  EXPECT_EQ(slow.stability, SpectralStability::unstable);
  EXPECT_NEAR(slow.growth(), 1e-8, 1e-20);
}

TEST(Equilibria, ASlowSaddleBesideAnOscillatorIsUnstable) {
  const GiNaC::symbol x("x"), y("y"), u("u"), v("v");
  const Model model = hamiltonian_system(
      "saddle", {x, y}, {u, v}, (u * u - x * x) / 2 + GiNaC::ex(1000000) * (v * v + y * y) / 2);
  const EquilibriumReport report = found(model, scene_from(model, {1, 1, 0, 0}, 1));
  ASSERT_EQ(report.equilibria.size(), 1U);
  EXPECT_EQ(report.equilibria[0].stability, SpectralStability::unstable);
  EXPECT_NEAR(report.equilibria[0].growth(), 1, 1e-9);
}

/// Oscillators of opposite sign with the same frequency leave the axis when they are coupled
/// (Krein), those of the same sign do not.
TEST(Equilibria, OnlyOscillatorsOfOppositeSignLeaveTheAxis) {
  const GiNaC::symbol x("x"), y("y"), u("u"), v("v");
  const GiNaC::ex coupling = x * y / 1000000;
  for (const int sign : {-1, 1}) {
    const Model model = hamiltonian_system(
        "two", {x, y}, {u, v}, (u * u + x * x) / 2 + sign * (v * v + y * y) / 2 + coupling);
    const EquilibriumReport report = found(model, scene_from(model, {1, 1, 0, 0}, 1));
    ASSERT_EQ(report.equilibria.size(), 1U);
    EXPECT_EQ(report.equilibria[0].stability,
              sign < 0 ? SpectralStability::unstable : SpectralStability::stable);
    if (sign < 0) {
      EXPECT_NEAR(report.equilibria[0].growth(), 5e-7, 1e-8);
    }
  }
}

/// The same frequencies exactly: of one sign they are on the axis whatever rounding does; of
/// opposite signs rounding decides. A coordinate that acts on itself leaves the bracket alone to
/// tell of it.
TEST(Equilibria, ADoubleFrequencyIsDecidedByItsSigns) {
  const GiNaC::symbol x("x"), y("y"), u("u"), v("v");
  const auto stability = [&](const GiNaC::ex& hamiltonian) {
    const Model model = hamiltonian_system("two", {x, y}, {u, v}, hamiltonian);
    const EquilibriumReport report = found(model, scene_from(model, {1, 1, 0, 0}, 1));
    EXPECT_EQ(report.equilibria.size(), 1U);
    return report.equilibria.at(0).stability;
  };
  const GiNaC::ex one = (u * u + x * x) / 2 + x * u / 5, other = (v * v + y * y) / 2 + y * v / 5;
  EXPECT_EQ(stability(one + 2 * other), SpectralStability::stable);
  EXPECT_EQ(stability(one - 2 * other), SpectralStability::stable);
  EXPECT_EQ(stability(one + other), SpectralStability::stable);
  EXPECT_EQ(stability(one - other), SpectralStability::undecided);
  EXPECT_EQ(stability(x * v - y * u + (x * x + y * y) / 2), SpectralStability::undecided);
}

/// Of a rotation in other coordinates nothing but its integral tells that it is one.
TEST(Equilibria, ADefiniteIntegralKeepsEigenvaluesOnTheAxis) {
  const std::string text =
                        "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx "
                        "= \"x - 2*y\"\ny = "
                        "\"x - y\"\n",
                    scene =
                        "[[scene]]\nname = \"default\"\ninitial = { x = \"1\", y = \"1\" "
                        "}\nduration = \"1\"\n",
                    integral = "[integrals]\nF = \"x^2 - 2*x*y + 2*y^2\"\n";
  const Model with = model_of(text + integral + scene), without = model_of(text + scene);
  EXPECT_EQ(found(with, with.scene("default")).equilibria.at(0).stability,
            SpectralStability::stable);
  EXPECT_EQ(found(without, without.scene("default")).equilibria.at(0).stability,
            SpectralStability::undecided);
}

TEST(Equilibria, OfEquationsWithoutStructureAnEigenvalueOnTheAxisIsNotDecided) {
  EXPECT_EQ(rest_of({"x1 - 2*x2", "x1 - x2 - x3", "-x3"}).stability, SpectralStability::undecided);
  EXPECT_EQ(rest_of({"-x2", "x1"}).stability, SpectralStability::stable);  // reversible
  EXPECT_EQ(rest_of({"x2 - x1/10^7", "-x1"}).stability, SpectralStability::stable);
  EXPECT_EQ(rest_of({"x2 + x1/10^7", "-x1"}).stability, SpectralStability::unstable);
}

TEST(Equilibria, ABadlyConditionedRestIsNoFamily) {
  const Equilibrium rest =
      rest_of({"x1/10^8 - 9999999999/10^8*x2 - 1000000001/10^8*x4", "100*x2", "-100*x3", "-10*x4"});
  EXPECT_EQ(rest.family, 0U);
  EXPECT_FALSE(rest.degenerate);
  for (const double x : rest.state) EXPECT_NEAR(x, 0, 1e-12);
}

EquilibriumReport of_pair(const std::string& x, const std::string& y) {
  const Model model = model_of(
      "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"" + x +
      "\"\ny = \"" + y +
      "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"1\", y = \"1\" }\nduration = \"1\"\n");
  return found(model, model.scene("default"));
}

/// What is small beside the rates elsewhere may be all that there is.
TEST(Equilibria, RootsThatAreNearEachOtherAreNoMultipleOne) {
  const EquilibriumReport slow = of_pair("10^(-8)*x + x^2", "-y");
  ASSERT_FALSE(slow.equilibria.empty());
  for (const Equilibrium& rest : slow.equilibria) {
    EXPECT_FALSE(rest.degenerate);
    const bool unstable = std::abs(rest.state[0]) < 1e-9;
    EXPECT_EQ(rest.stability, unstable ? SpectralStability::unstable : SpectralStability::stable);
  }
  const EquilibriumReport wells = of_pair("y", "10^(-9)*x - x^3");
  ASSERT_EQ(wells.equilibria.size(), 2U);  // and the saddle between, which no start leads to
  for (const Equilibrium& rest : wells.equilibria) {
    EXPECT_NEAR(std::abs(rest.state[0]), std::sqrt(1e-9), 1e-12);
    EXPECT_EQ(rest.stability, SpectralStability::stable);
  }
}

TEST(Equilibria, WhereMoreIsLeftThanRoundingNoneIsFound) {
  EXPECT_TRUE(of_pair("x^2 + 10^(-12)", "y - x").equilibria.empty());
  EXPECT_TRUE(of_pair("x^2 + 10^(-20)", "y - x").equilibria.empty());
  EXPECT_FALSE(of_pair("x^2 - 10^(-20)", "y - x").equilibria.empty());
}

/// Of a multiple root doubles tell that the derivative vanishes where nothing else is left of it.
TEST(Equilibria, AMultipleRootIsFoundWhereItIs) {
  const EquilibriumReport cubic = of_pair("y", "-x^3");
  ASSERT_EQ(cubic.equilibria.size(), 1U);
  EXPECT_TRUE(cubic.equilibria[0].degenerate);
  EXPECT_NEAR(cubic.equilibria[0].state[0], 0, 1e-9);
  const EquilibriumReport shifted = of_pair("x^2 - 2/3*x + 1/9", "-y");
  ASSERT_EQ(shifted.equilibria.size(), 1U);
  EXPECT_NE(shifted.equilibria[0].stability, SpectralStability::stable);
}

EquilibriumReport in_text(const std::string& text) {
  const Model model = model_of(text);
  return found(model, model.scene("default"));
}

std::string along_line(const std::string& rate, const std::string& start,
                       const std::string& domain = {}) {
  return "title = \"t\"\n[phase_space]\nvariables = [\"x\"]\n" + domain + "[equations]\nx = \"" +
         rate + "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"" + start +
         "\" }\nduration = \"1\"\n";
}

/// In the units of what two bodies have when they are close there is next to nothing of their
/// equations where they rest, and it is all that they have there.
TEST(Equilibria, OfWhatRepelsWhenItIsCloseAreNotDegenerate) {
  const EquilibriumReport report = in_text(
      "title = \"t\"\nhamiltonian = \"p^2/2 + 1/q^12 - 1/q^6\"\n[phase_space]\nvariables = "
      "[\"q\", \"p\"]\ncanonical = true\n[[scene]]\nname = \"default\"\ninitial = { q = \"1/2\", p "
      "= \"1/3\" }\nduration = \"1\"\n");
  ASSERT_FALSE(report.equilibria.empty());
  for (const Equilibrium& rest : report.equilibria) {
    EXPECT_FALSE(rest.degenerate);
    EXPECT_NEAR(std::abs(rest.state[0]), std::pow(2., 1. / 6), 1e-12);
  }
}

/// exp(-x^2) is as good as 0 for x = 27, and 0 in doubles for x = 28, and vanishes nowhere.
TEST(Equilibria, WhatIsTooSmallForADoubleIsNoZero) {
  const EquilibriumReport report = in_text(along_line("x*exp(-x^2)", "1/2"));
  ASSERT_EQ(report.equilibria.size(), 1U);
  EXPECT_NEAR(report.equilibria[0].state[0], 0, 1e-12);
}

TEST(Equilibria, FartherOutThanTheStartAreFound) {
  EXPECT_EQ(in_text(along_line("(x - 1)*(x - 2)*(x - 3)", "1/2")).equilibria.size(), 3U);
  EXPECT_EQ(in_text(along_line("(x - 1)*(x - 50)", "1/2")).equilibria.size(), 2U);
}

TEST(Equilibria, OutsideOfTheDomainAreLeftOut) {
  const EquilibriumReport report =
      in_text(along_line("(x - 1)*(x + 1)", "1/2", "domain = [\"x > 0\"]\n"));
  ASSERT_EQ(report.equilibria.size(), 1U);
  EXPECT_NEAR(report.equilibria[0].state[0], 1, 1e-12);
  EXPECT_EQ(report.outside, 1U);
}

TEST(Equilibria, AtAKinkNothingIsToldFromOneSide) {
  for (const char* rate : {"-x1 + 2*abs(x1)", "-(x1 - 1/3) + 2*abs(x1 - 1/3)"}) {
    const Equilibrium rest = rest_of({rate, "-x2"});
    EXPECT_EQ(rest.stability, SpectralStability::no_derivative) << rate;
    EXPECT_TRUE(rest.eigenvalues.empty());
  }
  EXPECT_EQ(rest_of({"-x1 - 2*x1*abs(x1)", "-x2"}).stability, SpectralStability::stable);
}

/// About the axes of a free top the eigenvalue 0 of the Casimir function is known.
TEST(Equilibria, CasimirFunctionsGiveExactZeros) {
  const Model model = model_of(
      "title = \"t\"\nhamiltonian = \"M1^2/2 + M2^2 + 3*M3^2/2\"\n[phase_space]\nvariables = "
      "[\"M1\", \"M2\", \"M3\"]\nalgebra = \"so(3)\"\n[casimirs]\nF = \"M1^2 + M2^2 + "
      "M3^2\"\n[[scene]]\nname = \"default\"\ninitial = { M1 = \"1\", M2 = \"1/2\", M3 = "
      "\"1/3\" }\nduration = \"1\"\n");
  const EquilibriumReport report = found(model, model.scene("default"));
  ASSERT_EQ(report.equilibria.size(), 6U);
  for (const Equilibrium& rest : report.equilibria) {
    EXPECT_NE(rest.stability, SpectralStability::undecided);
    EXPECT_EQ(std::ranges::count(rest.eigenvalues, 0.), 1);
  }
}

TEST(Equilibria, OfConstraintsLieOnThemAndAreSeenAlongThem) {
  // A pendulum in Cartesian coordinates: equations that say nothing off the circle.
  const Model pendulum = model_of(
      "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\", \"u\", \"v\"]\n"
      "constraints = [\"x^2 + y^2 - 1\", \"x*u + y*v\"]\n[definitions]\n"
      "k = \"y - u^2 - v^2\"\n[equations]\nx = \"u\"\ny = \"v\"\nu = \"k*x\"\n"
      "v = \"k*y - 1\"\n[[scene]]\nname = \"default\"\n"
      "initial = { x = \"1\", y = \"0\", u = \"0\", v = \"0\" }\nduration = \"1\"\n");
  const Scene& scene = pendulum.scene("default");
  const EquilibriumReport report = found(pendulum, scene);
  EXPECT_EQ(report.level.size(), 2U);
  ASSERT_EQ(report.equilibria.size(), 2U);
  for (const Equilibrium& rest : report.equilibria) {
    const bool below = rest.state[1] < 0;
    ASSERT_EQ(rest.eigenvalues.size(), 2U);  // those across the circle are no motions
    EXPECT_NEAR(rest.growth(), below ? 0 : 1, 1e-9);
    EXPECT_NEAR(std::abs(rest.eigenvalues[0].imag()), below ? 1 : 0, 1e-9);
    EXPECT_EQ(rest.stability == SpectralStability::unstable, !below);
  }
  for (const ProvedEquilibrium& proof : enclose_equilibria(pendulum, scene, report))
    EXPECT_FALSE(proof.proved);

  // The centre of a circle is not on it.
  const Model circle = model_of(
      "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n"
      "constraints = [\"x^2 + y^2 - 1\"]\n[equations]\nx = \"-y\"\ny = \"x\"\n"
      "[[scene]]\nname = \"default\"\ninitial = { x = \"1\", y = \"0\" }\n"
      "duration = \"1\"\n");
  EXPECT_TRUE(found(circle, circle.scene("default")).equilibria.empty());
}

TEST(Equilibria, EquationsThatDependOnTheTimeHaveNone) {
  const Model model = driven_equation("t - x");
  EXPECT_THROW(find_equilibria(model, model.scene("default"), [](double) {}), ModelError);
}

}  // namespace
}  // namespace casimir::test
