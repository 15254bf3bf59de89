// Equilibria whose existence and stability are proved.
#include "tools/analysis/equilibria/validated_equilibria.hpp"

#include <cln/real.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/tools/analysis/systems.hpp"

namespace casimir::test {
namespace {

struct Both {
  EquilibriumReport report;
  std::vector<ProvedEquilibrium> proofs;
};

Both both(const Model& model, const Scene& scene) {
  Both result{find_equilibria(model, scene, [](double) {}), {}};
  result.proofs = enclose_equilibria(model, scene, result.report);
  return result;
}

bool contains(const RationalInterval& interval, const cln::cl_RA& value) {
  return interval.low <= value && value <= interval.high;
}

TEST(ValidatedEquilibria, OfADoubleWellAreInTheirBoxesWithTheirStability) {
  const GiNaC::symbol q("q"), p("p");
  const Model model =
      hamiltonian_system("well", {q}, {p}, p * p / 2 + GiNaC::pow(q, 4) / 4 - q * q / 2);
  const auto [report, proofs] = both(model, scene_from(model, {1, 1}, 1));
  ASSERT_EQ(proofs.size(), 3U);
  for (std::size_t k = 0; k < proofs.size(); ++k) {
    ASSERT_TRUE(proofs[k].proved) << proofs[k].reason;
    const double at = std::round(report.equilibria[k].state[0]);
    EXPECT_TRUE(contains(proofs[k].state[0], static_cast<long>(at)));
    EXPECT_TRUE(contains(proofs[k].state[1], 0));
    EXPECT_LT(cln::double_approx(proofs[k].radius), 1e-30);
    EXPECT_EQ(proofs[k].stability, at == 0 ? ProvedStability::unstable : ProvedStability::stable);
  }
}

/// On a sphere: the axes of an ellipsoid of inertia, of which the middle one is unstable (Euler).
TEST(ValidatedEquilibria, OfAFreeTopAreTheAxesOnTheExactLevel) {
  const Model model = model_of(
      "title = \"t\"\nhamiltonian = \"M1^2/2 + M2^2 + 3*M3^2/2\"\n[phase_space]\nvariables = "
      "[\"M1\", "
      "\"M2\", \"M3\"]\nalgebra = \"so(3)\"\n[casimirs]\nF = \"M1^2 + M2^2 + "
      "M3^2\"\n[[scene]]\nname = "
      "\"default\"\ninitial = { M1 = \"1\", M2 = \"1\", M3 = \"0\" }\nduration = \"1\"\n");
  const auto [report, proofs] = both(model, model.scene("default"));
  ASSERT_EQ(proofs.size(), 6U);
  for (const ProvedEquilibrium& proof : proofs) {
    ASSERT_TRUE(proof.proved) << proof.reason;
    int axis = 0;
    for (int i = 0; i < 3; ++i) {
      const cln::cl_RA low = cln::square(proof.state[i].low),
                       high = cln::square(proof.state[i].high);
      if (cln::double_approx(low) < 0.5) continue;
      axis = i + 1;
      EXPECT_TRUE(std::min(low, high) <= 2 && 2 <= std::max(low, high));
    }
    EXPECT_EQ(proof.stability, axis == 2 ? ProvedStability::unstable : ProvedStability::stable);
  }
}

/// x^2 + y^2 has a family on the valley and no isolated point: Newton's matrix is singular.
TEST(ValidatedEquilibria, AFamilyIsNotProved) {
  const GiNaC::symbol x("x"), y("y"), u("u"), v("v");
  const Model model =
      hamiltonian_system("valley", {x, y}, {u, v}, (u * u + v * v + (x - y) * (x - y)) / 2);
  for (const ProvedEquilibrium& proof : both(model, scene_from(model, {1, 0, 0, 1}, 1)).proofs)
    EXPECT_FALSE(proof.proved);
}

/// The hypothesis of Krawczyk's theorem that is easiest to forget: |x| has a derivative on both
/// sides of 0 and none there, so its zero is no theorem here, and neither is that of a double root.
TEST(ValidatedEquilibria, CornersAndDoubleRootsAreNotProved) {
  for (const char* rate : {"sqrt(x^2) - x/2", "x^2", "x^3"}) {
    const Model model = one_equation(rate, "1");
    for (const ProvedEquilibrium& proof : both(model, model.scene("default")).proofs)
      EXPECT_FALSE(proof.proved) << rate;
  }
}

/// H has its minimum at 0, but the function that is called a Casimir function is none.
/// sqrt(q)^4: a motion near it leaves for where there are no equations.
TEST(ValidatedEquilibria, AtTheEndOfWhereTheEquationsHaveValuesAreNotProved) {
  const Model model = model_of(R"toml(
title = "half a well"
hamiltonian = "p^2/2 + sqrt(q)^4"
[phase_space]
variables = ["q", "p"]
canonical = true
[[scene]]
name = "default"
initial = { q = "1", p = "0" }
duration = "1"
)toml");
  const std::vector<ProvedEquilibrium> proofs = both(model, model.scene("default")).proofs;
  ASSERT_EQ(proofs.size(), 1U);
  EXPECT_FALSE(proofs[0].proved);
}

TEST(ValidatedEquilibria, NothingIsProvedWithAFalseCasimirFunction) {
  const Model model = model_of(
      "title = \"t\"\nhamiltonian = \"M1^2/2 + M2^2 + 3*M3^2/2\"\n[phase_space]\nvariables = "
      "[\"M1\", "
      "\"M2\", \"M3\"]\nalgebra = \"so(3)\"\n[casimirs]\nF = \"M1^2 + M2^2 + "
      "2*M3^2\"\n[[scene]]\nname = "
      "\"default\"\ninitial = { M1 = \"1\", M2 = \"1\", M3 = \"0\" }\nduration = \"1\"\n");
  for (const ProvedEquilibrium& proof : both(model, model.scene("default")).proofs)
    EXPECT_FALSE(proof.proved);
}

TEST(ValidatedEquilibria, WithoutABracketSinksAreStable) {
  const Model model = one_equation("1 - x^2", "1");
  const auto [report, proofs] = both(model, model.scene("default"));
  ASSERT_EQ(proofs.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    ASSERT_TRUE(proofs[k].proved);
    EXPECT_EQ(proofs[k].stability, report.equilibria[k].state[0] > 0 ? ProvedStability::stable
                                                                     : ProvedStability::unstable);
  }
}

TEST(ValidatedEquilibria, TakeThePlaceOfNumbersThatTheyExclude) {
  const Model model = one_equation("x - x^3", "1");
  auto [report, proofs] = both(model, model.scene("default"));
  ASSERT_EQ(proofs.size(), 3U);
  std::vector<double> found;
  for (Equilibrium& rest : report.equilibria) {
    found.push_back(rest.state[0]);
    rest.state[0] += 1e-9;
    rest.stability = SpectralStability::undecided;
  }
  take_proved(proofs, report);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double exact = std::round(found[k]);
    EXPECT_NEAR(report.equilibria[k].state[0], exact, 1e-30);
    EXPECT_EQ(report.equilibria[k].stability,
              exact == 0 ? SpectralStability::unstable : SpectralStability::stable);
  }
}

/// dx/dt = r - x^2: a sink and a source for every r of a range above the fold at r = 0.
TEST(ValidatedEquilibria, OfARangeOfParametersAreBranchesUnlessTheyFold) {
  const auto proofs_of = [](const std::string& middle, const cln::cl_RA& radius) {
    const Model model = model_of(
        "title = \"t\"\n[phase_space]\nvariables = [\"x\"]\n[equations]\nx = \"r - x^2\"\n"
        "[parameters]\nr = {}\n[[scene]]\nname = \"default\"\nparameters = { r = \"" +
        middle + "\" }\ninitial = { x = \"1\" }\nduration = \"1\"\n");
    const Scene& scene = model.scene("default");
    return enclose_equilibria(model, scene, find_equilibria(model, scene, [](double) {}),
                              {{"r", radius}});
  };
  const cln::cl_RA thousandth = cln::cl_RA(1) / 1000;
  const auto branches = proofs_of("1/4", 10 * thousandth);
  ASSERT_EQ(branches.size(), 2U);
  for (const ProvedEquilibrium& branch : branches) {
    ASSERT_TRUE(branch.proved) << branch.reason;
    const bool sink = cln::plusp(branch.state[0].low);
    for (const double r : {0.24, 0.25, 0.26}) {
      const double x = sink ? std::sqrt(r) : -std::sqrt(r);
      EXPECT_LE(cln::double_approx(branch.state[0].low), x);
      EXPECT_GE(cln::double_approx(branch.state[0].high), x);
    }
    EXPECT_LT(cln::double_approx(branch.radius), 0.03);
    EXPECT_EQ(branch.stability, sink ? ProvedStability::stable : ProvedStability::unstable);
  }
  // Through the fold, and where x is not there for some of the values.
  for (const cln::cl_RA& radius : {250 * thousandth, 300 * thousandth})
    for (const ProvedEquilibrium& branch : proofs_of("1/4", radius)) {
      EXPECT_FALSE(branch.proved);
      EXPECT_NE(branch.reason.find("range"), std::string::npos);
    }
}

/// The second variation is indefinite and no eigenvalue is off the axis: neither is claimed.
TEST(ValidatedEquilibria, OppositeOscillatorsAreNotDecided) {
  const GiNaC::symbol x("x"), y("y"), u("u"), v("v");
  const Model model = hamiltonian_system("opposite", {x, y}, {u, v},
                                         (u * u + x * x) / 2 - (v * v + 2 * y * y) / 2 + x * x * y);
  for (const ProvedEquilibrium& proof : both(model, scene_from(model, {1, 0, 0, 1}, 1)).proofs) {
    if (!proof.proved || !contains(proof.state[0], 0) || !contains(proof.state[1], 0)) continue;
    EXPECT_EQ(proof.stability, ProvedStability::undecided);
  }
}

}  // namespace
}  // namespace casimir::test
