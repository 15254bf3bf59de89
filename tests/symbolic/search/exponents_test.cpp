// Balances and Kovalevskaya exponents.
#include "symbolic/search/exponents.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bundled_cases.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/search/search_cases.hpp"

namespace casimir::test {
namespace {

TEST(Exponents, OfKovalevskayasTopAreIntegersAndOfOthersNot) {
  const auto report =
      search::kovalevskaya_exponents(model_of(euler_poisson("(M1^2 + M2^2 + 2*M3^2)/2 - g1")), {});
  EXPECT_TRUE(report.complete);
  EXPECT_GE(report.balances.size(), 2U);
  for (const auto& balance : report.balances)
    for (const auto& e : balance.exponents) EXPECT_EQ(e.kind, search::Exponent::Kind::integer);
  const auto other = search::kovalevskaya_exponents(
      model_of(euler_poisson("(M1^2 + 2*M2^2 + 3*M3^2)/2 - g1")), {});
  bool irrational = false;
  for (const auto& balance : other.balances)
    for (const auto& e : balance.exponents)
      irrational = irrational || e.kind == search::Exponent::Kind::algebraic;
  EXPECT_TRUE(irrational);
}

TEST(Exponents, WithAParameterAreConditions) {
  // A balance has 2, 3, 4, -1 and (2 - a3)/a3, 2*(a3 - 1)/a3: integers for a3 = 1 and 2 alone.
  const auto report = search::kovalevskaya_exponents(
      model_of(euler_poisson("(M1^2 + M2^2 + a3*M3^2)/2 - g1", "a3 = {}\n")), {});
  std::vector<std::string> values;
  for (const auto& balance : report.balances)
    for (const auto& e : balance.exponents)
      if (e.kind == search::Exponent::Kind::parametric) values.push_back(e.text);
  EXPECT_NE(std::find(values.begin(), values.end(), "(-a3 + 2)/(a3)"), values.end());
  EXPECT_NE(std::find(values.begin(), values.end(), "(2*a3 - 2)/(a3)"), values.end());
}

// M' = M x AM solved by algebraic numbers, and a vector that is carried along: its equations are
// linear with coefficients that have unknowns.
TEST(Exponents, OfEulersTopWithAVectorAreThoseOfTwiceItself) {
  const auto report = search::kovalevskaya_exponents(
      model_of(euler_poisson("(a1*M1^2 + a2*M2^2 + a3*M3^2)/2", "a1 = {}\na2 = {}\na3 = {}\n")),
      {});
  EXPECT_TRUE(report.complete);
  EXPECT_EQ(report.generic, (std::vector<std::string>{"a1", "a2", "a3"}));
  ASSERT_FALSE(report.balances.empty());
  for (const auto& balance : report.balances) {
    std::vector<std::string> values;
    for (const auto& e : balance.exponents)
      values.push_back(e.text + " x " + std::to_string(e.multiplicity));
    EXPECT_EQ(values, (std::vector<std::string>{"0 x 1", "1 x 1", "2 x 3", "-1 x 1"}));
  }
}

// An earlier Groebner basis lost the equation y1 = 0 here.
/// For generic a there is the balance x = -1/(a^2 - 4), z = 0 ; where a = 2 there is none.
TEST(Exponents, OfABalanceWithAZeroAreFound) {
  const auto report = search::kovalevskaya_exponents(
      model_of("title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[equations]\n"
               "x = \"x^3\"\ny = \"(y - z)^3 + (z - 2*(y - z))^3/2 + 2*(y - z)^3\"\n"
               "z = \"(z - 2*(y - z))^3/2 + 2*(y - z)^3\"\n"),
      {});
  EXPECT_TRUE(report.complete);
  EXPECT_EQ(report.balances.size(), 7U);
}

TEST(Exponents, OfParametersThatObeyAnEquationAreRefused) {
  const auto equations = [](const std::string& assumed) {
    return "[phase_space]\nvariables = [\"x\", \"z\"]\n[parameters]\na = { assume = \"" + assumed +
           "\" }\n[equations]\nx = \"(a^2 - 4)*x^2\"\nz = \"(a^2 - 4)*x*z\"\n";
  };
  EXPECT_THROW(search::kovalevskaya_exponents(model_of(equations("a^2 = 4")), {}), ModelError);
  EXPECT_FALSE(search::kovalevskaya_exponents(model_of(equations("a > 2")), {}).balances.empty());
}

TEST(Exponents, OfABalanceStandBesideItsValuesOnly) {
  // y1' = 3*y1^3, y2' = -2*y2^3 for y1 = 2*x1 + x2, y2 = x1 + x2: the equations are solved
  // for x1 over 6*x2^2 - 1 first, and for x2 then. "x1 = -5/2/(6*x2^2 - 1), x2 = 1" was printed.
  const auto report = search::kovalevskaya_exponents(
      model_of("title = \"t\"\n[phase_space]\nvariables = [\"x1\", \"x2\"]\n[equations]\n"
               "x1 = \"3*(2*x1 + x2)^3 + 2*(x1 + x2)^3\"\n"
               "x2 = \"-4*(x1 + x2)^3 - 3*(2*x1 + x2)^3\"\n"),
      {});
  std::size_t plain = 0;
  for (const auto& balance : report.balances) {
    const auto& values = balance.coefficients;
    if (values.at(1).second == "x2") continue;
    ++plain;
    EXPECT_EQ(values.at(0).second.find("x2"), std::string::npos) << values.at(0).second;
  }
  EXPECT_GE(plain, 1U);
}

TEST(Exponents, WithoutABalanceSayNothing) {
  const auto report = search::kovalevskaya_exponents(
      build_model(read_case(CASIMIR_SOURCE_DIR "/cases/" + std::string("neumann") + ".toml")), {});
  EXPECT_TRUE(report.complete);
  EXPECT_TRUE(report.balances.empty());
}

/// A motion of x, y (and more) by quadratic rates.
search::ExponentReport exponents_of(const std::string& variables, const std::string& equations,
                                    const std::string& parameters = {}) {
  return search::kovalevskaya_exponents(
      model_of("[phase_space]\nvariables = [" + variables + "]\n[parameters]\n" + parameters +
               "[equations]\n" + equations),
      {});
}

const std::string kPlane = "\"x\", \"y\"";

// "x = 1/(sqrt(2)^2 - 2)" was a balance, and 1/(sin(a)^2 + cos(a)^2 - 1), 1/(I^2 + 1).
TEST(Exponents, OfNumbersThatObeyAnEquationDivideByNothingThatIsZero) {
  for (const auto& [equations, parameters] : std::vector<std::pair<std::string, std::string>>{
           {"x = \"2*x^2 - y^2\"\ny = \"sqrt(2)*(2*x^2 - y^2)\"\n", ""},
           {"x = \"a*x^2 - y^2\"\ny = \"sqrt(a)*(a*x^2 - y^2)\"\n", "a = {}\n"},
           {"x = \"cos(a)^2*x^2 - y^2\"\ny = \"cos(a)*((1 - sin(a)^2)*x^2 - y^2)\"\n", "a = {}\n"},
           {"x = \"x^2 + y^2\"\ny = \"I*(x^2 + y^2)\"\n", ""}}) {
    const auto report = exponents_of(kPlane, equations, parameters);
    EXPECT_TRUE(report.complete) << equations << report.reason;
    EXPECT_TRUE(report.balances.empty()) << equations;
  }
}

TEST(Exponents, OfABalanceThatOnlyAnEquationOfNumbersLeavesAreFound) {
  // 2*x + 2*sqrt(2)*y = -1 and sqrt(2)*x + 2*y = -1/sqrt(2) are one equation.
  const auto report = exponents_of(kPlane,
                                   "x = \"x*(2*x + 2*sqrt(2)*y)\"\n"
                                   "y = \"sqrt(2)*y*(sqrt(2)*x + 2*y)\"\n");
  EXPECT_TRUE(report.complete) << report.reason;
  EXPECT_TRUE(report.generic.empty());
  EXPECT_TRUE(std::ranges::any_of(report.balances, [](const search::Balance& balance) {
    return balance.free.size() == 1 && balance.relations.empty();
  }));
}

TEST(Exponents, MadeOfARootOfANumberAreNotRationalAndDependOnNoParameter) {
  const auto report =
      exponents_of(kPlane, "x = \"x*(sqrt(2)*x + 2*y)\"\ny = \"y*(x + sqrt(2)*y)\"\n");
  EXPECT_TRUE(report.complete);
  EXPECT_EQ(report.balances.size(), 2U);  // one more has its coefficients over sqrt(2)^2 - 2
  std::vector<std::string> irrational;
  for (const auto& balance : report.balances)
    for (const auto& e : balance.exponents)
      if (e.is_irrational) irrational.push_back(e.text);
  EXPECT_EQ(irrational, (std::vector<std::string>{"-sqrt(2) + 1", "-1/2*sqrt(2) + 1"}));
  EXPECT_TRUE(report.leading.has_value());
  ASSERT_EQ(report.conclusions.size(), 1U);
  EXPECT_EQ(report.conclusions[0].find("parameters"), std::string::npos);
}

// Of y^2 = 2 only -sqrt(2) gives a balance: (y - sqrt(2))*w = -y has no solution w for sqrt(2).
// With sqrt(2) as a number of its own, w was (y*sqrt(2) + 2)/(sqrt(2)^2 - 2) for both.
TEST(Exponents, OfARootAtWhichSomethingIsDividedByZeroAreLeftOut) {
  const auto report = exponents_of("\"w\", \"y\", \"z\"",
                                   "z = \"-z^2\"\ny = \"-y*z + y^2 - 2*z^2\"\n"
                                   "w = \"-w*z + (y - sqrt(2)*z)*w + y*z\"\n");
  ASSERT_EQ(report.balances.size(), 2U);
  const auto& last = report.balances[1];
  EXPECT_TRUE(last.relations.empty());
  EXPECT_EQ(last.coefficients[0].second, "-1/2");
  EXPECT_EQ(last.coefficients[1].second, "-2/(sqrt(2))");
}

TEST(Exponents, OfFunctionsThatMayObeyMoreAreNotSaid) {
  const auto report = exponents_of(kPlane, "x = \"(abs(a) - a)*x^2\"\ny = \"x*y\"\n", "a = {}\n");
  EXPECT_FALSE(report.complete);
  EXPECT_TRUE(report.balances.empty());
  EXPECT_FALSE(report.reason.empty());
}

TEST(Exponents, OfParametersThatAssumptionsLeaveOneValueAreNotSaid) {
  const auto report =
      exponents_of(kPlane, "x = \"a*x^2\"\ny = \"x*y\"\n", "a = { assume = \"a^2 <= 0\" }\n");
  EXPECT_FALSE(report.complete);
  EXPECT_TRUE(report.balances.empty());
}

}  // namespace
}  // namespace casimir::test
