// Expressions as people write them, in LaTeX.
#include "tools/typeset/dag_math.hpp"

#include <gtest/gtest.h>

#include "tools/typeset/latex.hpp"

namespace casimir::tools::typeset {
namespace {

using GiNaC::ex;

struct Paper {
  GiNaC::symbol x{"x"}, y{"y"}, a{"a"}, m{"M1"}, om{"omega_max"};
  codegen::Dag dag{{x, y, m, a, om}, 3};
  std::string operator()(const ex& e) { return latex(math(dag, dag.convert(e))); }
};

TEST(DagMath, PutsParametersFirst) {
  Paper paper;
  EXPECT_EQ(paper(2 * paper.x * paper.a), "2 a x");
  EXPECT_EQ(paper(paper.x * pow(paper.a - 1, 2)), "\\left(a - 1\\right)^{2} x");
  EXPECT_EQ(paper(paper.x * pow(paper.a - paper.y, 2)), "x \\left(y - a\\right)^{2}");
}

TEST(DagMath, WritesQuotientsRootsAndPowersAsPeopleDo) {
  Paper paper;
  const ex& x = paper.x;
  EXPECT_EQ(paper(-x * x / 2), "-\\frac{1}{2} x^{2}");
  EXPECT_EQ(paper(3 * x / (2 * paper.a)), "\\frac{3 x}{2 a}");
  EXPECT_EQ(paper(1 / sqrt(x + 1)), "\\frac{1}{\\sqrt{x + 1}}");
  EXPECT_EQ(paper((x + paper.y) / 2 - 1), "\\frac{1}{2} \\left(x + y - 2\\right)");
  EXPECT_EQ(paper(pow(sin(x), 2) * GiNaC::Pi), "\\pi \\sin^{2}\\left(x\\right)");
  EXPECT_EQ(paper(GiNaC::atan2(x, paper.y)), "\\operatorname{atan2}\\left(x, y\\right)");
  EXPECT_EQ(paper(GiNaC::log(x)), "\\ln\\left(x\\right)");
}

/// 2 beside 3^{1/3} would be a power of 23.
TEST(DagMath, DigitsDoNotRunTogether) {
  Paper paper;
  const auto root = [](int base, int of) { return pow(ex(base), GiNaC::numeric(1, of)); };
  EXPECT_EQ(paper(2 * root(3, 3) * paper.x), "2 \\cdot 3^{1/3} x");
  EXPECT_EQ(paper(paper.x / (5 * root(10, 5))), "\\frac{1}{50} \\cdot 10^{4/5} x");
  EXPECT_EQ(paper(root(2, 3) * paper.x), "2^{1/3} x");
}

TEST(DagMath, NamesHaveIndicesAndGreekLetters) {
  Paper paper;
  EXPECT_EQ(paper(paper.m * paper.m), "M_{1}^{2}");
  EXPECT_EQ(paper(paper.om), "\\omega_{\\mathrm{max}}");
  EXPECT_EQ(latex(name("p_theta12")), "p_{\\theta 12}");
  EXPECT_EQ(latex(name("pi")), "\\mathrm{pi}");
}

TEST(DagMath, NamesCanBeGiven) {
  Paper paper;
  const auto bold = [](const std::string& name) { return Math{Kind::bold, {}, {letter(name)}}; };
  EXPECT_EQ(latex(math(paper.dag, paper.dag.convert(pow(paper.x, 2) * paper.y), bold)),
            "\\boldsymbol x^{2} \\boldsymbol y");
}

TEST(Latex, WordsOfACaseGiveNoCommand) {
  EXPECT_EQ(latex(prose("a\\input{b}_c & 50%")), "\\text{ainputb\\_c \\& 50\\%}");
}

TEST(Latex, TheDotOfARateStandsOnTheLetter) {
  EXPECT_EQ(latex(rate(name("M1"))), "\\dot{M}_{1}");
  EXPECT_EQ(latex(rate({Kind::bold, {}, {name("gamma")}})), "\\dot{\\boldsymbol\\gamma}");
  EXPECT_EQ(latex(rate({Kind::bold, {}, {name("L1")}})), "\\dot{\\boldsymbol{L_{1}}}");
}

TEST(Math, SumsTakeTheSignsOfWhatIsAdded) {
  Math sum;
  add_term(sum, negated(letter("a")));
  add_term(sum, letter("b"));
  add_term(sum, negated(letter("c")));
  EXPECT_EQ(latex(sum), "-a + b - c");
}

TEST(Math, LongSumsGoOnInTheNextLine) {
  Math sum;
  for (const char* name : {"a1", "b1", "c1", "d1", "e1"}) add_term(sum, letter(name));
  add_term(sum, negated(letter("f1")));
  const std::vector<Math> lines = lines_of(sum, 13);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(latex(lines[0]), "a1 + b1 + c1");
  EXPECT_EQ(latex(lines[1]), "d1 + e1 - f1");
  EXPECT_EQ(lines_of(sum, 100).size(), 1U);
  EXPECT_EQ(lines_of(letter("a_very_long_name"), 3).size(), 1U);
}

}  // namespace
}  // namespace casimir::tools::typeset
