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

}  // namespace
}  // namespace casimir::test
