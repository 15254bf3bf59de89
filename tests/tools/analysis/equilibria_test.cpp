// Equilibria and their eigenvalues.
#include "tools/analysis/equilibria/equilibria.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/analysis/systems.hpp"

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

TEST(Equilibria, EquationsThatDependOnTheTimeHaveNone) {
  const Model model = driven_equation("t - x");
  EXPECT_THROW(find_equilibria(model, model.scene("default"), [](double) {}), ModelError);
}

}  // namespace
}  // namespace casimir::test
