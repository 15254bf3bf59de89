// What people write who come from LaTeX, Python or a book: it means what it means there, or
// nothing.
#include "symbolic/expression/notation.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/symbolic/expression/reads_expressions.hpp"

namespace casimir::test {
namespace {

class Notation : public ReadsExpressions {
 protected:
  Notation() : ReadsExpressions({"x", "y", "M1", "gamma_1", "w12"}) {}
};

TEST_F(Notation, MeansWhatTheOwnOneMeans) {
  const std::pair<const char*, const char*> same[] = {
      {"ln(x) + pi", "log(x) + Pi"},
      {"arcsin(x) + arccos(y) + arctan(x*y)", "asin(x) + acos(y) + atan(x*y)"},
      {"x**2 + 2**3**2 - y**-1", "x^2 + 512 - 1/y"},
      {"-x**2", "-(x^2)"},
      {"\\frac{x + 1}{y}", "(x + 1)/y"},
      {"\\dfrac{1}{2}*\\frac{\\frac{x}{y}}{3}", "x/y/6"},
      {"\\sqrt{x^{2} + 1}", "sqrt(x^2 + 1)"},
      {"x^{-1} + x^{y + 1}", "1/x + x^(y + 1)"},
      {"2 \\cdot x \\times y / 4", "x*y/2"},
      {"\\sin\\left(x\\right) + \\cos{y} + \\ln(x)", "sin(x) + cos(y) + log(x)"},
      {"\\exp(x \\, + \\; y)", "exp(x + y)"},
      {"M_1 + M_{1} + \\gamma_1 + \\gamma_{1} + w_{12}", "2*M1 + 2*gamma_1 + w12"},
      {"\\pi", "Pi"},
  };
  for (const auto& [theirs, ours] : same)
    EXPECT_TRUE((parse(theirs) - parse(ours)).is_zero()) << theirs << " is " << parse(theirs);
}

TEST_F(Notation, YieldsToTheNamesOfTheCase) {
  declare("pi");
  declare("ln");
  declare("M_1");
  EXPECT_TRUE(parse("pi*ln").is_equal(symbol("pi") * symbol("ln")));
  EXPECT_TRUE(parse("M_1").is_equal(symbol("M_1")));
  EXPECT_TRUE(parse("M_{1}").is_equal(symbol("M_1")));
  EXPECT_TRUE(parse("M1").is_equal(symbol("M1")));
  EXPECT_EQ(error_of("x_1"), "1: 'x_1' is not declared");
}

TEST_F(Notation, IsRefusedWhereItCouldMeanSomethingElse) {
  EXPECT_EQ(error_of("2x"), "2: unexpected 'x' after a number");
  EXPECT_EQ(error_of("x y"), "3: unexpected 'y', expected an operator or the end");
  EXPECT_EQ(error_of("\\frac12"), "6: unexpected '1', expected '{'");
  EXPECT_EQ(error_of("\\frac{1}{2}x"), "12: unexpected 'x', expected an operator or the end");
  EXPECT_EQ(error_of("\\frac{1}{0}"), "1: division by zero");
  EXPECT_EQ(error_of("\\sin x"), "2: 'sin' is a function and needs '('");
  EXPECT_EQ(error_of("\\sin^2(x)"), "2: 'sin' is a function and needs '('");
  EXPECT_EQ(error_of("\\sqrt[3]{x}"), "2: 'sqrt' is a function and needs '('");
  EXPECT_EQ(error_of("x^{x, y}"), "5: unexpected ',', expected '}'");
  EXPECT_EQ(error_of("x^{2"), "5: unexpected end of the expression, expected '}'");
  EXPECT_EQ(error_of("e^x"), "1: 'e' is not declared");
  EXPECT_EQ(error_of("\\left"),
            "6: unexpected end of the expression, expected a number, a name or '('");
  EXPECT_EQ(error_of("\\"), "1: unexpected '\\', expected a number, a name or '('");
  EXPECT_EQ(error_of("M_{1"), "1: 'M_' is not declared");
}

/// The same tree in two notations.
std::pair<std::string, std::string> random_tree(std::mt19937& random, int depth) {
  const auto inner = [&] { return random_tree(random, depth - 1); };
  switch (depth == 0 ? random() % 2 : random() % 7) {
    case 0:
      return {"M_{1}", "M1"};
    case 1: {
      const std::string number = std::to_string(1 + random() % 9);
      return {number, number};
    }
    case 2: {
      const auto a = inner(), b = inner();
      return {"\\left(" + a.first + " + " + b.first + "\\right)",
              "(" + a.second + " + " + b.second + ")"};
    }
    case 3: {
      const auto a = inner(), b = inner();
      return {a.first + " \\cdot " + b.first, a.second + "*" + b.second};
    }
    case 4: {
      const auto a = inner(), b = inner();
      return {"\\frac{" + a.first + "}{" + b.first + " + 1}",
              "(" + a.second + ")/(" + b.second + " + 1)"};
    }
    case 5: {
      const auto a = inner();
      return {"\\sqrt{" + a.first + "}", "sqrt(" + a.second + ")"};
    }
    default: {
      const auto a = inner();
      return {"\\left(" + a.first + "\\right)^{2}", "(" + a.second + ")^2"};
    }
  }
}

TEST_F(Notation, OfRandomTreesIsReadAsTheOwnOne) {
  std::mt19937 random(7);  // NOLINT: the same trees in every run
  for (int k = 0; k < 300; ++k) {
    const auto [theirs, ours] = random_tree(random, 5);
    EXPECT_TRUE(parse(theirs).is_equal(parse(ours))) << theirs;
  }
}

}  // namespace
}  // namespace casimir::test
