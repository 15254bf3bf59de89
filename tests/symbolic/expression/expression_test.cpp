#include "symbolic/expression/expression.hpp"

#include <gtest/gtest.h>

#include <random>

#include "symbolic/expression/expression_size.hpp"
#include "tests/symbolic/expression/reads_expressions.hpp"

namespace casimir {
namespace {

class Expression : public test::ReadsExpressions {
 protected:
  Expression() : ReadsExpressions({"x", "y"}) {}

  const GiNaC::symbol x_ = symbol("x"), y_ = symbol("y");
};

TEST_F(Expression, ReadsNumbersExactly) {
  EXPECT_EQ(parse("0.5"), GiNaC::numeric(1, 2));
  EXPECT_EQ(parse("1.25e-3"), GiNaC::numeric(1, 800));
  EXPECT_EQ(parse(".1 + 1/3"), GiNaC::numeric(13, 30));
  EXPECT_EQ(parse("75*10^(-2)"), GiNaC::numeric(3, 4));
  EXPECT_TRUE(GiNaC::ex_to<GiNaC::numeric>(parse("0.1")).is_rational());
}

TEST_F(Expression, BindsLikeMathematics) {
  EXPECT_EQ(parse("-x^2"), -(x_ * x_));
  EXPECT_EQ(parse("2^3^2"), 512);
  EXPECT_EQ(parse("2^-1"), GiNaC::numeric(1, 2));
  EXPECT_EQ(parse("x - y - 1"), x_ - y_ - 1);
  EXPECT_EQ(parse("8/2/2"), 2);
  EXPECT_EQ(parse("x*-y"), -x_ * y_);
}

TEST_F(Expression, ReadsFunctionsAndConstants) {
  EXPECT_EQ(parse("sqrt(4)"), 2);
  EXPECT_EQ(parse("sin(Pi/2)"), 1);
  EXPECT_EQ(parse("atan2(x, y)"), GiNaC::atan2(x_, y_));
  EXPECT_EQ(parse("I^2"), -1);
  EXPECT_FALSE((parse("sqrt(x^2)") - x_).is_zero());
  EXPECT_EQ(parse("sinh(x)"), GiNaC::sinh(x_));
  EXPECT_EQ(parse("cosh(0) + tanh(0)"), 1);
  EXPECT_EQ(parse("cot(x)"), GiNaC::cos(x_) / GiNaC::sin(x_));
  EXPECT_EQ(parse("cot(Pi/2)"), 0);
  EXPECT_EQ(parse("abs(x)"), parse("sqrt(x^2)"));
  EXPECT_EQ(parse("abs(-3/2) + sign(-7)"), GiNaC::numeric(1, 2));
  EXPECT_EQ(parse("sign(x)"), x_ / GiNaC::sqrt(GiNaC::pow(x_, 2)));
  EXPECT_EQ(parse("abs(exp(x))"), GiNaC::exp(x_));
  EXPECT_EQ(parse("sign(exp(x))"), 1);
}

TEST_F(Expression, HasNoValueAtThePolesOfItsFunctions) {
  EXPECT_EQ(error_of("cot(0)"), "1: this has no value: division by zero or a pole of the function");
  EXPECT_EQ(error_of("sign(x - x)"),
            "1: this has no value: division by zero or a pole of the function");
}

/// GiNaC makes log(3) + I*Pi of log(-3): with it an integral would be "proved" that has no value.
TEST_F(Expression, HasNoValueWhereItWouldBeComplexAmongRealNumbers) {
  EXPECT_EQ(error_of("x + log(-3)"), "5: this has no real value");
  EXPECT_EQ(error_of("2*sqrt(-4)"), "3: this has no real value");
  EXPECT_EQ(error_of("2*sqrt(-2)"), "3: this has no real value");
  EXPECT_EQ(error_of("x + (-3)^(-3/4)"), "9: this has no real value");
  EXPECT_EQ(error_of("x*(-1)^(1/2)"), "7: this has no real value");
  EXPECT_EQ(error_of("y*sqrt(7 - 4*sqrt(4))"), "3: this has no real value");
  EXPECT_EQ(parse("I*sqrt(-4)"), -2);
  EXPECT_EQ(parse("sqrt(-4*x)^2 + sqrt(9 - 5)"), 2 - 4 * x_);
}

/// What GiNaC cancels is kept as a place without a value: cot(x)*sin(x) has none at 0.
TEST_F(Expression, RemembersWhereItsFunctionsHaveNoValue) {
  for (const char* text : {"cot(x)*sin(x)", "sign(x)*abs(x)"}) {
    Text place{text, {}, {}};
    EXPECT_FALSE(lost_parts(parse_expression(place, names_)).empty()) << text;
  }
  Text place{"cosh(x) - cosh(x) + x", {}, {}};
  EXPECT_TRUE(lost_parts(parse_expression(place, names_)).empty());
}

TEST_F(Expression, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(error_of("x + z"), "5: 'z' is not declared");
  EXPECT_EQ(error_of("sin(x, y)"), "1: 'sin' takes 1 argument, 2 given");
  EXPECT_EQ(error_of("atan2(x)"), "1: 'atan2' takes 2 arguments, 1 given");
  EXPECT_EQ(error_of("1/0"), "2: division by zero");
  EXPECT_EQ(error_of("1/(x-x)"), "2: division by zero");
  EXPECT_EQ(error_of("x +"),
            "4: unexpected end of the expression, expected a number, a name or '('");
  EXPECT_EQ(error_of("(x"), "3: unexpected end of the expression, expected ')'");
  EXPECT_EQ(error_of("2x"), "2: unexpected 'x' after a number");
  EXPECT_EQ(error_of("\xCE\xB8"), "1: unexpected '\xCE\xB8', expected a number, a name or '('");
  EXPECT_EQ(error_of("log(0)"), "1: this has no value: division by zero or a pole of the function");
  EXPECT_EQ(error_of("x + atan2(x - x, 0)"), "5: this has no value: atan2(0, 0)");
}

TEST_F(Expression, RefusesGiantsByAStatedLimit) {
  EXPECT_NE(error_of(std::string(100000, '(') + "x" + std::string(100000, ')'))
                .find("nested more than 200 deep"),
            std::string::npos);
  EXPECT_NE(error_of(std::string(100000, '-') + "x").find("nested more than 200 deep"),
            std::string::npos);
  std::string sum = "x";
  while (sum.size() <= 16777216) sum += "+x";
  EXPECT_NE(error_of(sum).find("the limit is 16777216"), std::string::npos);
  EXPECT_NE(error_of("(x+y)^(10^9)").find("degree"), std::string::npos);
  EXPECT_NE(error_of("10^(10^9)").find("bits"), std::string::npos);
  EXPECT_NE(error_of("((2*x)^10000)^10000").find("degree"), std::string::npos);
  EXPECT_NE(error_of("1e999999999").find("bits"), std::string::npos);
}

TEST_F(Expression, LongFlatSumIsReadInLinearTime) {
  std::string sum = "0";
  while (sum.size() < 200000) sum += "+x*y";
  EXPECT_NE(parse(sum), 0);
}

// Property: text made from a random tree means what the tree means.
TEST_F(Expression, RandomTreesKeepTheirValue) {
  std::mt19937 random(7);
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const std::function<std::pair<std::string, GiNaC::numeric>(int)> tree =
      [&](int depth) -> std::pair<std::string, GiNaC::numeric> {
    if (depth == 0) {
      const int k = pick(4);
      if (k == 0) return {"x", GiNaC::numeric(3, 7)};
      if (k == 1) return {"y", GiNaC::numeric(-2)};
      const int n = pick(9) + 1;
      return {std::to_string(n), GiNaC::numeric(n)};
    }
    const auto [a, u] = tree(depth - 1);
    const auto [b, v] = tree(depth - 1);
    switch (pick(4)) {
      case 0:
        return {"(" + a + " + " + b + ")", u + v};
      case 1:
        return {a + "*(" + b + ")", u * v};
      case 2:
        return v.is_zero() ? std::pair(a, u) : std::pair("(" + a + ")/(" + b + ")", u / v);
      default:
        return {"(" + a + "-(" + b + "))^2", (u - v) * (u - v)};
    }
  };
  for (int k = 0; k < 300; ++k) {
    const auto [text, value] = tree(3);
    // A product written "a*(b)" binds as such only when a is not a sum: trees above bracket sums.
    GiNaC::ex parsed;
    try {
      parsed = parse(text);
    } catch (const CaseError&) {
      continue;  // an exact zero in a denominator
    }
    EXPECT_EQ(parsed.subs(GiNaC::lst{x_ == GiNaC::numeric(3, 7), y_ == -2}), value) << text;
  }
}

TEST(Names, KeywordsFunctionsAndOddCharactersAreRefused) {
  for (const char* bad :
       {"int", "double", "sin", "Pi", "I", "1x", "a b", "", "x;", "t\xC3\xA9ta", "co_await"}) {
    EXPECT_THROW(check_name({bad, {"test", 1, 1}, bad}, "a variable"), CaseError) << bad;
  }
  EXPECT_THROW(check_name({std::string(10000, 'a'), {"test", 1, 1}, ""}, "a variable"), CaseError);
  EXPECT_NO_THROW(check_name({"M_1", {"test", 1, 1}, "M_1"}, "a variable"));
}

TEST(Printable, EscapesWhatCouldDriveATerminal) {
  EXPECT_EQ(printable("a\x1b[31mb"), "a\\x1b[31mb");
  EXPECT_EQ(printable("a\nb"), "a\\x0ab");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\xc2\\x9b31m");
  EXPECT_EQ(printable("\xCE\xB8"), "\xCE\xB8");
  EXPECT_EQ(printable("\xFF"), "\\xff");
  EXPECT_EQ(printable("abcdef", 3), "abc...");
}

// GiNaC counts the degree of x^(1/q) in 32 bits, and throws beyond that or keeps the low ones.
TEST_F(Expression, WithLongFractionsAsExponentsIsNotForGinacsNormalForm) {
  EXPECT_TRUE(is_fit_for_normal(parse("x^100 + sqrt(x + y)*y^(5/3) + x^0.333333")));
  EXPECT_FALSE(is_fit_for_normal(parse("x^(1/2000000000)")));
  EXPECT_FALSE(is_fit_for_normal(parse("1 + sin(x^(2 + 1/18446744073709551618))")));
  EXPECT_FALSE(is_fit_for_normal(parse("x^(1/20011) + y^(1/30011)")));
  EXPECT_THROW(normal_form(parse("x^-.2222222222222222223 + 1/x")), TooLarge);
}

TEST_F(Expression, HasNoMoreTermsWhenExpandedThanTheBoundSays) {
  for (const auto& [text, bound] :
       std::vector<std::pair<const char*, double>>{{"x", 1},
                                                   {"3*x*y", 1},
                                                   {"x + y + 1", 3},
                                                   {"(x + y + 1)^4", 15},
                                                   {"(x + y)*(x + 2)*y", 4},
                                                   {"((x + y)^2 + 1)^3", 20},
                                                   {"1/((x + y)^3 + 1)", 5},
                                                   {"sin(x + y)^2", 1}}) {
    const GiNaC::ex e = parse(text), expanded = e.expand();
    EXPECT_EQ(most_terms(e), bound) << text;
    EXPECT_LE(GiNaC::is_a<GiNaC::add>(expanded) ? expanded.nops() : 1, bound) << text;
  }
  EXPECT_GT(most_terms(parse("((x + y)^50 + 1)^200")), 1e50);
  const GiNaC::ex large = parse("(x + y)^5000");
  EXPECT_TRUE(expanded_within(large, 5000).is_equal(large));
  EXPECT_EQ(expanded_within(parse("(x + y)^2"), 3).nops(), 3U);
}

}  // namespace
}  // namespace casimir
