// What Darboux polynomials give together: integrals, densities and what is constant in time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/search/darboux.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

using search::DarbouxCombination;
using search::DarbouxReport;
using Kind = DarbouxCombination::Kind;

/// Of one kind, all proved.
std::vector<std::string> texts(const DarbouxReport& report, Kind kind) {
  std::vector<std::string> result;
  for (const DarbouxCombination& own : report.combinations) {
    EXPECT_EQ(own.verdict, Verdict::proved) << own.text;
    if (own.kind == kind) result.push_back(own.text);
  }
  return result;
}

DarbouxReport of_equations(const std::string& variables, const std::string& equations, int degree,
                           const std::string& parameters = {}) {
  return search::find_darboux(
      model_of("[phase_space]\nvariables = " + variables + "\n[parameters]\n" + parameters +
               "[equations]\n" + equations),
      degree);
}

using Texts = std::vector<std::string>;

TEST(DarbouxIntegrals, OfLotkaAndVolterraHaveExponentsThatAreParameters) {
  const DarbouxReport report =
      of_equations(R"(["x", "y"])", "x = \"x*(a - b*y)\"\ny = \"y*(c*x - d)\"\n", 1,
                   "a = {}\nb = {}\nc = {}\nd = {}\n");
  EXPECT_EQ(texts(report, Kind::integral), Texts{"x^d*y^a*exp(-y*b - x*c)"});
  EXPECT_EQ(texts(report, Kind::multiplier), Texts{"1/(x*y)"});
  EXPECT_TRUE(texts(report, Kind::time_dependent).empty());
}

/// A parameter is no factor: a*F is F, and its degree does not count.
TEST(DarbouxIntegrals, ParametersAreNoFactors) {
  const std::string xyz = R"(["x", "y", "z"])";
  const DarbouxReport leading =
      of_equations(xyz, "x = \"0\"\ny = \"a*z + x + y\"\nz = \"0\"\n", 1, "a = {}\n");
  ASSERT_EQ(leading.found.size(), 1U);
  EXPECT_EQ(leading.found[0].degree, 1);
  EXPECT_TRUE(leading.complete) << leading.reason;
  const DarbouxReport quotient =
      of_equations(xyz, "x = \"x\"\ny = \"2*a*z + x + 2*y\"\nz = \"0\"\n", 1, "a = {}\n");
  EXPECT_EQ(quotient.found.size(), 2U);
  EXPECT_EQ(texts(quotient, Kind::integral).size(), 1U);
  // With a denominator and products of parameters, after the change of y by (a + b)*y - z/a.
  for (const char* top : {"a*x", "x/(a + b)", "a*b*x^2"}) {
    const std::string f = std::string(top) + " + y + a*z";
    const DarbouxReport found =
        of_equations(xyz,
                     fmt::format("x = \"x\"\ny = \"(z + 1)*({}) - ({}) - a*z\"\nz = \"z\"\n", f,
                                 std::string(top).back() == '2' ? "2*a*b*x^2" : top),
                     2, "a = {}\nb = {}\n");
    const bool is_found = std::ranges::any_of(found.found, [](const auto& own) {
      return own.text.find('y') != std::string::npos && own.verdict == Verdict::proved;
    });
    EXPECT_TRUE(is_found || !found.complete) << top;
    EXPECT_TRUE(is_found) << top << ": " << found.reason;
  }
}

TEST(DarbouxIntegrals, OfTwoCofactorsInAWholeRatioAreRational) {
  const DarbouxReport report = of_equations(R"(["x", "y"])", "x = \"2*x\"\ny = \"3*y\"\n", 1);
  EXPECT_EQ(texts(report, Kind::integral), Texts{"x^3/y^2"});
  EXPECT_EQ(texts(report, Kind::time_dependent).size(), 1U);
}

/// The search multiplies the equations by a, and by x: the cofactors are those of the equations.
TEST(DarbouxIntegrals, OfEquationsWithDenominatorsAreOfTheEquationsAsTheyAre) {
  const DarbouxReport logistic =
      of_equations(R"(["x", "y"])", "x = \"x*(1 - x/a)\"\ny = \"y*(x - 1)\"\n", 1,
                   "a = { assume = \"a > 0\" }\n");
  ASSERT_FALSE(logistic.found.empty());
  EXPECT_EQ(logistic.found[0].text, "x");
  EXPECT_EQ(logistic.found[0].cofactor, "(-x + a)/(a)");
  EXPECT_EQ(texts(logistic, Kind::time_dependent), Texts{"x*exp(-1*t)/(x - a)"});
  // d(log|y|)/dt = 1/x: exp(x)/y is no integral.
  const DarbouxReport line = of_equations(R"(["x", "y"])", "x = \"1\"\ny = \"y/x\"\n", 1);
  EXPECT_TRUE(texts(line, Kind::integral).empty());
  for (const search::DarbouxPolynomial& own : line.found) EXPECT_EQ(own.cofactor, "1/(x)");
}

/// dF/dt = K F is an identity, also of F = x^2 + 1, which is zero at no real point.
TEST(DarbouxIntegrals, OfFactorsWithoutRealZeros) {
  const DarbouxReport report =
      of_equations(R"(["x", "y"])", "x = \"-(x^2 + 1)\"\ny = \"-2*x*y\"\n", 2);
  ASSERT_EQ(report.found.size(), 2U);
  for (const search::DarbouxPolynomial& own : report.found)
    EXPECT_EQ(own.verdict, Verdict::proved) << own.text;
  EXPECT_EQ(texts(report, Kind::integral), Texts{"y/(x^2 + 1)"});
}

/// (a + |a|) log(density) has no rate, and for a < 0 that says nothing: the density 1 is none.
TEST(DarbouxIntegrals, NothingIsDividedByADivisorOfZero) {
  for (const std::string size : {"abs(a)", "sqrt(a^2)", "sign(a)*a"}) {
    const DarbouxReport report = of_equations(
        R"(["x", "y"])", fmt::format("x = \"-{}*x\"\ny = \"a*y\"\n", size), 1, "a = {}\n");
    for (const DarbouxCombination& own : report.combinations) {
      const bool is_one = own.kind == Kind::multiplier && own.text == "1";
      EXPECT_FALSE(is_one && own.verdict == Verdict::proved) << size;
    }
  }
}

/// A constant cofactor alone is no integral; the time is needed.
TEST(DarbouxIntegrals, OfLorenzWithATwiceSNeedTheTime) {
  const DarbouxReport report = of_equations(
      R"(["x", "y", "z"])", "x = \"s*(y - x)\"\ny = \"r*x - y - x*z\"\nz = \"x*y - 2*s*z\"\n", 2,
      "s = {}\nr = {}\n");
  EXPECT_TRUE(texts(report, Kind::integral).empty());
  EXPECT_EQ(texts(report, Kind::time_dependent), Texts{"(x^2 - 2*z*s)*exp((2*s)*t)"});
  EXPECT_EQ(texts(report, Kind::multiplier), Texts{"(x^2 - 2*z*s)^((-3*s - 1)/(2*s))"});
}

}  // namespace
}  // namespace casimir::test
