#include "symbolic/algebra/ball_evaluator.hpp"

#include <gtest/gtest.h>

#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

using GiNaC::ex;
using Numbers = BallEvaluator::Numbers;

class Balls : public testing::Test {
 protected:
  ex parse(const std::string& text) const { return model_.parse({text, {"test", 1, 1}, text}); }

  BallEvaluator at(const std::string& x, const std::string& y, Numbers numbers = Numbers::real) {
    BallEvaluator result(numbers, 128);
    result.set(model_.variables[0], parse(x));
    result.set(model_.variables[1], parse(y));
    return result;
  }

  std::optional<bool> is_zero(const std::string& f, const std::string& x, const std::string& y) {
    BallEvaluator evaluator = at(x, y);
    return evaluator(parse(f)).is_zero();
  }

  Model model_ =
      model_of("[phase_space]\nvariables = [\"x\",\"y\"]\n[equations]\nx = \"I*y\"\ny = \"0\"\n");
};

/// The digits of GiNaC and CLN, which share no code with Arb.
TEST_F(Balls, AgreeWithGiNaC) {
  GiNaC::Digits = 30;
  for (const char* text :
       {"x + y/3",       "x^7*y^-3",  "sqrt(x)",    "(x*y)^(2/3)",
        "sin(x)*cos(y)", "tan(x)",    "cot(x)",     "sinh(x - y)",
        "cosh(x)",       "tanh(y/x)", "exp(x - y)", "log(x/y)",
        "atan(x)",       "asin(x/9)", "acos(-x/9)", "atan2(y, x)",
        "atan2(-y, -x)", "Pi*x",      "x^y",        "sqrt(2 + sqrt(x + sqrt(y)))"}) {
    BallEvaluator evaluator = at("7/3", "5/4");
    const Ball& ball = evaluator(parse(text));
    const ex exact = parse(text)
                         .subs({{model_.variables[0], GiNaC::numeric(7, 3)},
                                {model_.variables[1], GiNaC::numeric(5, 4)}})
                         .evalf();
    const std::string digits = ball.text();
    const double own = std::stod(digits);
    EXPECT_NEAR(own, GiNaC::ex_to<GiNaC::numeric>(exact).to_double(), 1e-13) << text;
    EXPECT_TRUE(ball.is_real()) << text;
  }
  GiNaC::Digits = 17;
}

TEST_F(Balls, RationalNumbersStayExact) {
  EXPECT_EQ(is_zero("x^2 - 1/9", "1/3", "0"), true);
  EXPECT_EQ(is_zero("sqrt(x) - 3/2", "9/4", "0"), true);
  EXPECT_EQ(is_zero("(x)^(1/3) - 2", "8", "0"), true);
  EXPECT_EQ(is_zero("y*log(x)", "2", "0"), true);
  EXPECT_EQ(is_zero("sin(y) + log(x)", "1", "0"), true);
}

TEST_F(Balls, ZeroOfIrrationalNumbersStaysOpen) {
  EXPECT_EQ(is_zero("sqrt(3 + 2*sqrt(2)) - 1 - sqrt(2)", "1", "1"), std::nullopt);
  EXPECT_EQ(is_zero("asin(x/3) + acos(x/3) - Pi/2", "1", "1"), std::nullopt);
  EXPECT_EQ(is_zero("sqrt(3 + 2*sqrt(2)) - 1 - sqrt(2) + x/10^30", "1", "1"), false);
}

TEST_F(Balls, WhatHasNoRealValueIsNotCertified) {
  for (const char* text :
       {"sqrt(x)", "log(x)", "x^(1/3)", "x^y", "asin(x)", "acos(x)", "log(y)", "1/y", "atan2(y, y)",
        "tan(Pi/2 + y)", "sqrt(1 + x + y) - sqrt(x)", "y*log(x)"}) {
    BallEvaluator evaluator = at("-2", "0");
    EXPECT_THROW(evaluator(parse(text)), NotCertified) << text;
  }
}

TEST_F(Balls, PlacesWhereFunctionsAreNotDifferentiableAreSeen) {
  for (const char* text : {"sqrt(y)", "asin(1 + y)", "acos(y - 1)", "atan2(y, x)"}) {
    BallEvaluator evaluator = at("-2", "0");
    evaluator(parse(text));
    EXPECT_FALSE(evaluator.smooth()) << text;
  }
  BallEvaluator evaluator = at("2", "1/2");
  evaluator(parse("sqrt(y) + asin(y) + atan2(y, x)"));
  EXPECT_TRUE(evaluator.smooth());
}

TEST_F(Balls, ComplexNumbersHavePrincipalValues) {
  BallEvaluator evaluator = at("-4", "1", Numbers::complex);
  EXPECT_EQ(evaluator(parse("sqrt(x) - 2*I")).is_zero(), true);
  EXPECT_EQ(evaluator(parse("sqrt(x) + 2*I")).is_zero(), false);
  EXPECT_EQ(evaluator(parse("log(x) - log(4) + I*Pi")).is_zero(), false);
}

/// With I in the case, the root of 1/x keeps its branch: I*sqrt(1/x) is -1 at x = -1, and I/sqrt(x)
/// is 1.
TEST_F(Balls, TheRootOfAReciprocalKeepsItsBranch) {
  BallEvaluator evaluator = at("-1", "1", Numbers::complex);
  EXPECT_EQ(evaluator(parse("I*sqrt(1/x) + 1")).is_zero(), true);
  EXPECT_EQ(evaluator(parse("I*sqrt(1/x) - 1")).is_zero(), false);
  EXPECT_EQ(evaluator(parse("I/sqrt(x) - 1")).is_zero(), true);
}

}  // namespace
}  // namespace casimir::test
