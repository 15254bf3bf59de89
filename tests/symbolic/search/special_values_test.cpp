// Values of parameters at which there is an additional integral: none is lost by the way in which
// the equations are written, and none is claimed where the equations have no value.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "symbolic/error.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/search/conditions/darboux_conditions.hpp"
#include "symbolic/search/conditions/special_model.hpp"
#include "symbolic/search/search.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/search/search_cases.hpp"

namespace casimir::test {
namespace {

using Lines = std::vector<std::string>;

/// Two equations with the parameters a and b, and further lines of the file.
std::string two_rates(const std::string& x, const std::string& y, const std::string& more = {}) {
  return "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\na = {}\nb = {}\n[equations]\nx "
         "= "
         "\"" +
         x + "\"\ny = \"" + y + "\"\n" + more;
}

search::ConditionReport values_at(const std::string& toml, int degree, const Lines& free,
                                  const Lines& on = {}) {
  search::Request request = up_to(degree);
  for (const std::string& own : on) request.on.push_back(text(own));
  std::vector<Text> names;
  for (const std::string& name : free) names.push_back(text(name));
  return search::find_conditions(model_of(toml), request, names);
}

/// "NAME = VALUE, ..: FOUND; FOUND" of each, in order.
template <class Report>
Lines told(const Report& report) {
  Lines result;
  for (const auto& condition : report.conditions) {
    std::string line;
    for (const auto& [name, value] : condition.parameters)
      line += (line.empty() ? "" : ", ") + name + " = " + value;
    line += ":";
    for (const auto& found : condition.found) line += " " + found.text;
    result.push_back(line);
  }
  std::ranges::sort(result);
  return result;
}

// GiNaC simplifies each of these away while it reads them, and only the domain of the case knows.
TEST(SpecialValues, WhatIsSimplifiedAwayHidesNone) {
  for (const char* one : {"1", "a/a", "a^2/a/a", "3*(a + 1)/(3*a + 3)", "(-a - 1)/(-a - 1)",
                          "sqrt(a)^2/a", "exp(log(a))/a"}) {
    const auto report = values_at(two_rates("x*" + std::string(one), "-x + (a - 2)*y^2"), 1, {"a"});
    EXPECT_EQ(told(report), (Lines{"a = 2: x + y"})) << one;
    EXPECT_TRUE(report.complete) << one << report.reason;
  }
  // The twin has a value nowhere where the other has its integral.
  const auto none = values_at(two_rates("x*(a - 2)/(a - 2)", "-x + (a - 2)*y^2"), 1, {"a"});
  EXPECT_EQ(told(none), Lines{});
  EXPECT_TRUE(none.complete) << none.reason;
}

TEST(SpecialValues, ANumberBesideAParameterInADenominatorHidesNone) {
  const std::string oscillators =
      "hamiltonian = \"px^2/(2*m) + py^2/2 + (x^2 + y^2)/2\"\n[phase_space]\n"
      "variables = [\"x\", \"y\", \"px\", \"py\"]\ncanonical = true\n[parameters]\n"
      "m = { assume = \"m > 0\" }\n";
  const auto mass = values_at(oscillators, 2, {"m"});
  ASSERT_EQ(mass.conditions.size(), 1U);
  EXPECT_EQ(mass.conditions[0].parameters[0].second, "1");
  EXPECT_EQ(mass.conditions[0].found.size(), 2U);
  EXPECT_EQ(mass.conditions[0].verdict, Verdict::proved);
  EXPECT_TRUE(mass.complete) << mass.reason;
  // In a bracket, with a value over another parameter.
  const auto bracket = values_at(
      "hamiltonian = \"x^2/2 + y^2/2 + a*z^2\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n"
      "[phase_space.brackets]\n\"x,y\" = \"z/(2*b)\"\n\"y,z\" = \"x\"\n\"z,x\" = \"y\"\n"
      "[parameters]\na = {}\nb = {}\n",
      1, {"b"});
  ASSERT_EQ(bracket.conditions.size(), 1U);
  EXPECT_EQ(bracket.conditions[0].parameters[0].second, "1/(4*a)");
  EXPECT_TRUE(bracket.complete) << bracket.reason;
}

TEST(SpecialValues, EitherParameterTellsOfTheSameCurve) {
  const std::string toml = two_rates("x/(2*a)", "-x/(2*a) + (a - 2*b)*y^2");
  for (const char* name : {"a", "b"}) {
    const auto report = values_at(toml, 1, {name});
    ASSERT_EQ(report.conditions.size(), 1U) << name;
    EXPECT_EQ(report.conditions[0].found.size(), 1U) << name;
  }
}

// Jacobi's geodesics: the denominator of the Hamiltonian has a number.
TEST(SpecialValues, OfTheEllipsoidAreThoseOfRevolution) {
  const auto report = search::find_conditions(bundled("jacobi-ellipsoid"), up_to(2), {text("a1")});
  std::vector<std::string> values;
  for (const auto& condition : report.conditions) values.push_back(condition.parameters[0].second);
  std::ranges::sort(values);
  EXPECT_EQ(values, (Lines{"a2", "a3"}));
}

TEST(SpecialValues, PointsOfTwoParametersAreLookedAtInTheSpecialCase) {
  const std::string toml = two_rates("x/(2*a) + (b - 1)*x^2", "-x/(2*a) + (a - 2)*y^2");
  const auto report = values_at(toml, 1, {"a", "b"});
  EXPECT_EQ(told(report), (Lines{"a = 2, b = 1: x + y"}));
}

TEST(SpecialValues, OfDarbouxPolynomialsNoneIsHiddenEither) {
  const auto report = search::find_darboux_conditions(
      model_of(two_rates("x/(2*a)", "(a - 2)/(2*a)*x + y^2")), 1, {text("a")});
  EXPECT_EQ(told(report), (Lines{"a = 2: y"}));
  EXPECT_TRUE(report.complete) << report.reason;
}

// At a = 2 it has no value, and the equations do not use it.
TEST(SpecialValues, WhatTheEquationsDoNotUseHidesNone) {
  for (const char* table : {"definitions", "integrals"}) {
    const auto report = values_at(
        two_rates("x", "-x + (a - 2)*y^2", "[" + std::string(table) + "]\nD = \"y/(a - 2)\"\n"), 1,
        {"a"});
    EXPECT_EQ(told(report), (Lines{"a = 2: x + y"})) << table;
    EXPECT_TRUE(report.complete) << report.reason;
  }
}

TEST(SpecialValues, AConstraintOrALevelWithoutAValueLeavesItOpen) {
  const std::string constraint =
      "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\nconstraints = [\"z/(a - 2)\"]\n"
      "[parameters]\na = {}\n[equations]\nx = \"x\"\ny = \"-x + (a - 2)*y^2\"\nz = \"z*y\"\n";
  const auto report = values_at(constraint, 1, {"a"});
  EXPECT_EQ(told(report), Lines{});
  EXPECT_FALSE(report.complete);
  const auto level = values_at(
      two_rates("x", "-x + (a - 2)*y^2", "[definitions]\nD = \"x/(a - 2)\"\n"), 1, {"a"}, {"D"});
  EXPECT_FALSE(level.complete);
}

// sqrt(a)^2 is a, and real where a is positive only.
TEST(SpecialValues, WhereARootIsNotRealThereIsNone) {
  const auto report = values_at(two_rates("x*sqrt(a)^2/a", "-x + (a + 2)*y^2"), 1, {"a"});
  EXPECT_EQ(told(report), Lines{});
  EXPECT_TRUE(report.complete) << report.reason;
}

TEST(SpecialValues, AModelTakesItsValueEverywhere) {
  const Model model =
      model_of(two_rates("x*a/a", "-x + y^2", "[definitions]\nD = \"y/(a - 2)\"\n"));
  const auto at = [&](int value) { return search::with_value(model, model.parameters[0], value); };
  EXPECT_FALSE(at(0));
  ASSERT_TRUE(at(2));
  EXPECT_TRUE(at(2)->definitions.empty());
  const auto three = at(3);
  ASSERT_TRUE(three);
  EXPECT_EQ(three->definitions.size(), 1U);
  EXPECT_FALSE(three->domain.empty());
  EXPECT_FALSE(search::is_meaningless(*three));
  for (const GiNaC::ex& part : three->domain) EXPECT_FALSE(part.has(model.parameters[0]));
}

// (sqrt(5) - 1)/2 is a root of a^2 + a - 1, which only algebra sees.
TEST(SpecialValues, AnExpressionHasNoValueWhereItDividesByAHiddenZeroAndOnlyThere) {
  const Model model = model_of(two_rates("x/(a^2 + a - 1)", "y"));
  const auto golden =
      search::with_value(model, model.parameters[0], (GiNaC::sqrt(GiNaC::ex(5)) - 1) / 2);
  ASSERT_TRUE(golden);
  EXPECT_TRUE(search::is_meaningless(*golden));
  // A derivative of asin has no value at 1, while asin has one.
  const GiNaC::symbol x("x");
  const GiNaC::ex one = GiNaC::pow(GiNaC::sin(x), 2) + GiNaC::pow(GiNaC::cos(x), 2);
  const auto convert = [&](const GiNaC::ex& e) { FunctionRing({x}, {}, {e}, Limits{}); };
  EXPECT_THROW(convert(1 / (one - 1)), NoValue);
  EXPECT_THROW(convert(GiNaC::log(one - 1)), NoValue);
  try {
    convert(GiNaC::asin(one));
  } catch (const NoValue&) {
    ADD_FAILURE() << "asin(1) has a value";
  } catch (const ModelError&) {
  }
}

// On a = 1 the rank falls by one, and by one more where b = 2 too: y is one that x does not give.
TEST(SpecialValues, PartsOfACurveWithMoreAreFoundOrLeftOpen) {
  const auto found = values_at(two_rates("(a - 1)*x", "(b - 2)*x + (a - 1)*y^2"), 1, {"a", "b"});
  EXPECT_EQ(told(found), (Lines{"a = 1, b = 2: y", "a = 1: x"}));
  EXPECT_TRUE(found.complete) << found.reason;
  const auto open =
      values_at(two_rates("(a - 1)*x", "(b^5 - 7*b - 2)*x + (a - 1)*y^2"), 1, {"a", "b"});
  EXPECT_EQ(told(open), (Lines{"a = 1: x"}));
  EXPECT_FALSE(open.complete);
  EXPECT_TRUE(open.sets_open);
  // The twin loses no more anywhere on its curve.
  const auto even = values_at(two_rates("(a - 1)*x", "(b^2 + 1)*x + (a - 1)*y^2"), 1, {"a", "b"});
  EXPECT_EQ(told(even), (Lines{"a = 1: x"}));
  EXPECT_TRUE(even.complete) << even.reason;
}

}  // namespace
}  // namespace casimir::test
