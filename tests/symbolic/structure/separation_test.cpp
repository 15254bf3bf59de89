// Variables that separate: what is found is checked in numbers, what may not count does not.
#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/structure/separate/leaves.hpp"
#include "tests/symbolic/structure/separations.hpp"

namespace casimir::test {
namespace {

using GiNaC::numeric;

TEST(Separation, OfGoryachevAndChaplyginIsFoundAgain) {
  const Model model = bundled("goryachev-chaplygin");
  const SeparationReport report = searched(model, 2);
  expect_separated(model, report, kOnLevel);
  const Separation& own = report.found[0];
  EXPECT_EQ(report.on, (std::vector<std::string>{"M1*g1 + M2*g2 + M3*g3"}));
  EXPECT_EQ(own.coefficients, (std::vector<std::string>{"2*M3", "-M1^2 - M2^2"}));
  EXPECT_EQ(own.relations[0].multipliers, (std::vector<std::string>{"u", "-1"}));
  EXPECT_EQ(own.relations[0].equation,
            "-4*G^2 + 4*u^3*G - u^6 + (4*g1^2*r^2 + 4*g2^2*r^2 + 4*g3^2*r^2)*u^2");
  for (const Verdict verdict : {own.tangent, own.compatible, own.jacobi, own.involution})
    EXPECT_EQ(verdict, Verdict::proved);
  EXPECT_TRUE(own.real);
}

/// Neither bracket nor Hamiltonian nor integral is given, only the level.
TEST(Separation, OfGoryachevAndChaplyginIsFoundFromBareEquations) {
  const Model bare = model_of(R"(
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
[parameters]
r = {}
[equations]
M1 = "3*M2*M3"
M2 = "-3*M1*M3 - r*g3"
M3 = "r*g2"
g1 = "4*M3*g2 - M2*g3"
g2 = "M1*g3 - 4*M3*g1"
g3 = "M2*g1 - M1*g2"
)");
  const SeparationReport report = searched(bare, 2, {"M1*g1 + M2*g2 + M3*g3"});
  EXPECT_TRUE(report.bracket_of_motion);
  expect_separated(bundled("goryachev-chaplygin"), report, kOnLevel);
}

/// Elliptic coordinates on the sphere.
TEST(Separation, OfNeumannsProblemIsElliptic) {
  const Model model = bundled("neumann-sphere");
  const SeparationReport report =
      searched(model, 3, {"M1*g1 + M2*g2 + M3*g3", "g1^2 + g2^2 + g3^2 - 1"});
  expect_separated(model, report, {3, 0, -1, numeric(2, 7), numeric(3, 7), numeric(6, 7), 1, 3, 7});
}

TEST(Separation, OfHenonAndHeilesIsParabolic) {
  const Model model = bundled("henon-heiles");
  expect_separated(model, searched(model, 1), {1, 2, 3, numeric(1, 2), 2, numeric(1, 3)});
}

/// At x + y = 0 the integral jumps, and near x = 0 the Hamiltonian has a kink.
TEST(Separation, ListsWhereItsFunctionsAreNotAnalytic) {
  const Model model = canonical(kPlane, "(px^2 + py^2)/2 + abs(x) + abs(x + y)",
                                "[integrals]\nK = \"py^2/2 + y*sign(x + y)\"\n");
  const SeparationReport report = searched(model, 1);
  ASSERT_FALSE(report.found.empty());
  for (const Separation& own : report.found)
    for (const char* place : {"x", "x + y"})
      EXPECT_EQ(std::ranges::count(own.nonzero, std::string(place)), 1) << place;
}

/// Three degrees of freedom: elliptic coordinates in space.
TEST(Separation, OfGarniersSystemIsElliptic) {
  const Model model =
      canonical(R"("x", "y", "z", "px", "py", "pz")",
                "(px^2 + py^2 + pz^2)/2 + (x^2 + y^2 + z^2)^2 + a*x^2 + b*y^2 + c*z^2",
                "[parameters]\na = {}\nb = {}\nc = {}\n");
  expect_separated(model, searched(model, 2), {1, 2, numeric(1, 2), 3, 1, numeric(2, 3), 1, 3, 7});
}

/// With roots in the Hamiltonian: parabolic coordinates of a charge in a field.
TEST(Separation, OfTheStarkEffectIsParabolic) {
  const Model model = canonical(kPlane, "(px^2 + py^2)/2 - k/sqrt(x^2 + y^2) - f*x",
                                "[parameters]\nk = {}\nf = {}\n[integrals]\nR = \"py*(x*py - y*px) "
                                "- k*x/sqrt(x^2 + y^2) + f*y^2/2\"\n");
  expect_separated(model, searched(model, 1), {3, 4, 1, 2, 2, numeric(1, 3)});
}

/// The roots are polynomials, and each has multipliers of its own.
TEST(Separation, MayHaveAnotherSumForEachRoot) {
  const Model model = canonical(kPlane, "(px^2 + py^2)/2 + x^2*y + y^3/3");
  const SeparationReport report = searched(model, 1);
  expect_separated(model, report, {1, 3, 2, numeric(1, 2)});
  EXPECT_EQ(report.found[0].relations.size(), 2U);
  EXPECT_FALSE(report.found[0].relations[0].root.empty());
}

/// In Flaschka's variables the whole momentum is a Casimir function, and stands in the sum.
TEST(Separation, TakesCasimirFunctionsForConstants) {
  const Model model = model_of(R"(
hamiltonian = "(b1^2 + b2^2 + b3^2)/2 + a1 + a2"
[phase_space]
variables = ["a1", "a2", "b1", "b2", "b3"]
[phase_space.brackets]
"a1,b1" = "-a1"
"a1,b2" = "a1"
"a2,b2" = "-a2"
"a2,b3" = "a2"
)");
  const SeparationReport report = searched(model, 2);
  expect_separated(model, report, {1, 2, 3, numeric(1, 2), -1});
  EXPECT_EQ(report.found[0].relations[0].multipliers[0], "u + (b1 + b2 + b3)");
  EXPECT_FALSE(report.found[0].relations[0].may_vanish);
}

TEST(Separation, NeedsAsManyIntegralsAsDegreesOfFreedom) {
  const Model model =
      canonical(kPlane, "(px^2 + py^2)/2 + x^2*y + a*y^3", "[parameters]\na = {}\n");
  const SeparationReport report = searched(model, 1);
  EXPECT_TRUE(report.found.empty());
  EXPECT_FALSE(report.none);
  EXPECT_TRUE(report.reason.starts_with("2 integrals in involution")) << report.reason;
}

/// K commutes with H at no point of an open set: what the case claims is not believed.
TEST(Separation, LeavesOutIntegralsThatAreNone) {
  const Model model = canonical(kPlane, "(px^2 + py^2)/2 + x^2*y + a*y^3",
                                "[parameters]\na = {}\n[integrals]\nK = \"px\"\n");
  const SeparationReport report = searched(model, 1);
  EXPECT_TRUE(report.found.empty());
  EXPECT_EQ(report.integrals.size(), 1U);
}

/// Each of the integrals A, B that are claimed has no bivector of degree 1 beside the Hamiltonian,
/// and A - B has one: no word about all of them.
TEST(Separation, OfOtherCombinationsOfIntegralsIsNotExcluded) {
  const std::string p1 = "(px + x^2)", p2 = "(py + y^2)";
  const std::string l = "3*(x*" + p2 + " - y*" + p1 + ")*" + p1 + " + 5*" + p2 + "^2";
  const SeparationReport report =
      searched(canonical(kPlane, p1 + "^2 + " + p2 + "^2",
                         "[integrals]\nA = \"" + l + " - 7*" + p1 + "\"\nB = \"" + l + "\"\n"),
               1);
  EXPECT_TRUE(report.found.empty());
  EXPECT_FALSE(report.none);
}

TEST(Separation, ThatDoesNotExistIsSaidOfTheIntegralsAndOfTheSpaceThatWereLookedAt) {
  const SeparationReport report = searched(bundled("kovalevskaya"), 1);
  EXPECT_TRUE(report.none) << report.reason;
  EXPECT_EQ(report.involved.size(), 2U);
  EXPECT_EQ(report.not_used.size(), 1U);
}

TEST(Separation, UsesNoNameOfTheCase) {
  const SeparationReport report =
      searched(canonical(R"("G", "u", "F1", "w")", "(F1^2 + w^2)/2 + G^4 + u^4 + K*u",
                         "[parameters]\nK = {}\n[integrals]\nI1 = \"F1^2/2 + G^4\"\n"),
               1);
  ASSERT_EQ(report.found.size(), 1U);
  const structure::SeparationNames& names = report.found[0].names;
  for (const std::string& own : {names.root, names.sum, names.rate})
    EXPECT_TRUE(own != "G" && own != "u" && own != "w" && own != "K") << own;
  EXPECT_NE(names.integral, "F");
  EXPECT_EQ(report.found[0].map, Verdict::proved);
}

TEST(Separation, HasNothingToDoInOneDegreeOfFreedom) {
  const SeparationReport report = searched(canonical(R"("q", "p")", "p^2 + q^4"), 2);
  EXPECT_EQ(report.freedom, 1U);
  EXPECT_TRUE(report.found.empty());
}

TEST(Separation, IsSaidNotToExistWhereTheLinearConditionsHaveNoSolution) {
  const SeparationReport report = searched(bundled("clebsch"), 2);
  EXPECT_TRUE(report.found.empty());
  EXPECT_TRUE(report.none) << report.reason;
}

/// All of degree 0 have constant roots: compatible, Poisson, in involution, and no variables.
TEST(Separation, DoesNotCountConstantRoots) {
  const Model model =
      canonical(kPlane, "(px^2 + py^2)/2 + a*x^2 + b*y^2", "[parameters]\na = {}\nb = {}\n");
  const SeparationReport report = searched(model, 0);
  EXPECT_TRUE(report.found.empty());
  EXPECT_FALSE(report.none);
  EXPECT_GT(report.examined, 0U);
}

TEST(Separation, NeedsThePoissonBracketItself) {
  const Model model = model_of(R"(
hamiltonian = "x^2 + y^2"
[phase_space]
variables = ["x", "y", "z", "w"]
[phase_space.brackets]
"x,y" = "z"
"z,w" = "x"
)");
  const SeparationReport report = searched(model, 1);
  EXPECT_TRUE(report.found.empty());
  EXPECT_EQ(report.reason, "the bracket is not shown to obey the Jacobi identity");
}

TEST(Separation, IsAskedForOnLevelsOfCasimirFunctionsOnly) {
  EXPECT_THROW(searched(bundled("goryachev-chaplygin"), 1, {"M1"}), structure::NotLeaves);
}

/// Its degree is not the one that was asked for.
TEST(Separation, SaysWhichSearchWasTooLarge) {
  search::Watch watch;
  watch.memory_limit = 1;
  try {
    structure::find_separation(central(), {1, {}, {}}, watch);
    ADD_FAILURE();
  } catch (const search::TooMuchMemory& problem) {
    EXPECT_EQ(std::string(problem.what())
                  .find("the search for Casimir functions up to degree 2, which this needs, is too "
                        "large: degree 2 has "),
              0U)
        << problem.what();
  }
}

}  // namespace
}  // namespace casimir::test
