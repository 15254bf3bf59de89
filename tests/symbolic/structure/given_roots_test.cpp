// Roots of a polynomial that is given: proved to separate, refuted, or left open.
#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/error.hpp"
#include "tests/symbolic/structure/separations.hpp"

namespace casimir::test {
namespace {

TEST(RootsThatAreGiven, HavePlacesWhereThereAreNone) {
  structure::SeparationRequest request;
  request.roots = text_of("(a*u - x)*(u - y)");
  const SeparationReport report = structure::find_separation(
      canonical(kPlane, "(px^2 + py^2)/2 + x^4 + y^4",
                "[parameters]\na = {}\n[integrals]\nK = \"px^2/2 + x^4\"\n"),
      request);
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].separated, Verdict::proved);
  const std::vector<std::string>& nonzero = report.found[0].nonzero;
  EXPECT_NE(std::ranges::find(nonzero, "a"), nonzero.end());
}

TEST(RootsThatAreGiven, AreProvedToSeparate) {
  const Model model = bundled("goryachev-chaplygin");
  const SeparationReport report = examined(model, "u^2 - 2*M3*u - (M1^2 + M2^2)");
  expect_separated(model, report, kOnLevel);
  EXPECT_TRUE(report.found[0].bivector.empty());
}

/// 3 in place of 2: the roots commute and are coordinates, but Levi-Civita's condition fails.
TEST(RootsThatAreGiven, AreRefutedWhereNothingSeparates) {
  const SeparationReport report =
      examined(bundled("goryachev-chaplygin"), "u^2 - 3*M3*u - (M1^2 + M2^2)");
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].commuting, Verdict::proved);
  EXPECT_EQ(report.found[0].separated, Verdict::refuted);
}

/// Polar coordinates: H = pr^2/2 + L^2/(2 r^2) + U(r) is not linear in L, so that Staeckel's form
/// is not there, and Levi-Civita's condition decides.
TEST(RootsThatAreGiven, MaySeparateWithoutStaeckelsForm) {
  const SeparationReport report = examined(central(), "(u - x^2 - y^2)*(u - y/x)");
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].separated, Verdict::proved);
  EXPECT_EQ(report.found[0].staeckel, Verdict::undecided);
  const SeparationReport cartesian = examined(central(), "(u - x)*(u - y)");
  EXPECT_EQ(cartesian.found.at(0).separated, Verdict::refuted);
}

TEST(RootsThatAreGiven, AreRefutedWhereTheyDoNotCommute) {
  const SeparationReport report = examined(central(), "(u - x^2 - y^2)*(u - x*px)");
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].commuting, Verdict::refuted);
  EXPECT_EQ(report.found[0].separated, Verdict::refuted);
}

/// The discriminant of six roots has 56183 terms, too many to be factored: their differences are
/// said.
TEST(RootsThatAreGiven, MayBeSixPolynomials) {
  std::string variables, momenta, hamiltonian, integrals, roots;
  for (int i = 1; i <= 6; ++i) {
    const std::string n = std::to_string(i), comma = i < 6 ? ", " : "";
    const std::string own = "p" + n + "^2/2 + " + n + "*q" + n + (i % 2 == 0 ? "^4" : "^2");
    variables += "\"q" + n + "\", ";
    momenta += "\"p" + n + "\"" + comma;
    hamiltonian += (i > 1 ? " + " : "") + own;
    if (i < 6) integrals += "E" + n + " = \"" + own + "\"\n";
    roots += (i > 1 ? "*(u - q" : "(u - q") + n + ")";
  }
  const SeparationReport report =
      examined(canonical(variables + momenta, hamiltonian, "[integrals]\n" + integrals), roots);
  ASSERT_EQ(report.found.size(), 1U) << report.reason;
  EXPECT_EQ(report.found[0].separated, Verdict::proved) << report.found[0].reason;
  EXPECT_EQ(report.found[0].nonzero.size(), 21U);  // 15 differences, 6 momenta
}

/// Where: the roots are given on a command line.
TEST(RootsThatAreGiven, AreRefusedWithThePlaceOfTheError) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"(sin(x)^2 + cos(x)^2 - 1)*u^3 + u^2 - x*y",
       "1: the leading coefficient of '(sin(x)^2 + cos(x)^2 - 1)*u^3 + u^2 - x*y' is identically "
       "zero"},
      {"u^2 - x/(sin(x)^2 + cos(x)^2 - 1)",
       "1: division by an expression that is identically zero"},
      {"u^2 + x*I", "9: the polynomial has to be real, without I"},
      {"u^2 + sqrt(-1)", "7: this has no real value"},
      {"u^2 + sqrt(-2)", "7: this has no real value"}};
  for (const auto& [roots, error] : wrong) {
    try {
      examined(central(), roots);
      ADD_FAILURE() << roots;
    } catch (const CaseError& problem) {
      EXPECT_EQ(std::to_string(problem.where().column) + ": " + problem.text(), error);
    }
  }
}

/// Equal roots, roots that depend on each other, a root that is an integral: nothing is said.
TEST(RootsThatAreGiven, AreUndecidedWhereTheyAreNoCoordinates) {
  for (const char* roots :
       {"(u - x)^2", "(u - x)*(u - x^2)", "(u - x^2 - y^2)*(u - x*py + y*px)"}) {
    const SeparationReport report = examined(central(), roots);
    ASSERT_EQ(report.found.size(), 1U);
    EXPECT_EQ(report.found[0].separated, Verdict::undecided) << roots;
    EXPECT_FALSE(report.found[0].reason.empty());
  }
}

TEST(RootsThatAreGiven, AreOfAPolynomialOfTheRightDegree) {
  for (const char* roots : {"u - x", "(u - x)*(u - y)*(u - 1)", "sqrt(u)", "x + y", "u^2 +"})
    EXPECT_THROW(examined(central(), roots), CaseError) << roots;
}

/// The name u is taken: v is the next.
TEST(RootsThatAreGiven, HaveAnotherNameWhereTheCaseHasAnU) {
  const Model model = canonical(R"("u", "y", "pu", "py")", "(pu^2 + py^2)/2 + u^4 + y^4",
                                "[integrals]\nK = \"pu^2/2 + u^4\"\n");
  const SeparationReport report = examined(model, "(v - u)*(v - y)");
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].names.root, "v");
  EXPECT_EQ(report.found[0].separated, Verdict::proved);
}

}  // namespace
}  // namespace casimir::test
