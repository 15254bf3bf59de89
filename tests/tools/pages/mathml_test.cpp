// LaTeX of show as MathML.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tools/pages/page_checks.hpp"
#include "tests/tools/program.hpp"
#include "tools/report/mathml.hpp"

namespace casimir::test {
namespace {

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

/// What a reader sees, without the tree.
std::string letters(const std::string& markup) {
  static const std::regex kTag("<[^>]*>");
  return std::regex_replace(markup, kTag, "");
}

TEST(MathMl, HasTheTreeOfTheFormula) {
  EXPECT_EQ(tools::mathml("M_{1}^{2}"),
            "<math><msubsup><mrow><mi>M</mi></mrow><mrow><mn>1</mn></mrow><mrow><mn>2</mn></mrow>"
            "</msubsup></math>");
  EXPECT_EQ(letters(tools::mathml("\\frac{1}{2} M_{1}^{2} - r \\gamma_{1}")), "12M12 −rγ1");
  EXPECT_EQ(count(tools::mathml("\\sqrt{x + \\frac{a}{b}}"), "<msqrt>"), 1U);
  EXPECT_NE(tools::mathml("\\dot{\\boldsymbol M} = 0").find("mover"), std::string::npos);
}

TEST(MathMl, LinesBreakBetweenTermsAndInLongBracketsOnly) {
  EXPECT_EQ(count(tools::mathml("a + b - c"), "<math>"), 3U);
  EXPECT_EQ(count(tools::mathml("\\frac{a + b}{c + d}"), "<math>"), 1U);
  EXPECT_EQ(count(tools::mathml("2 \\left(a + b\\right)^{2}"), "<math>"), 1U);
  const std::string lengthy =
      "2 \\left(a_{1} b_{1} c_{1} d_{1} + a_{2} b_{2} c_{2} d_{2} + a_{3} b_{3} c_{3}\\right)^{2}";
  const std::string broken = tools::mathml(lengthy);
  EXPECT_EQ(count(broken, "<math>"), 3U);
  // The power stands at the bracket that ends, and everything is still there in its order.
  EXPECT_NE(broken.find(")</mo></mrow><mrow><mn>2</mn></mrow></msup></math>"), std::string::npos)
      << broken;
  EXPECT_EQ(letters(broken), "2(a1b1c1d1 +a2b2c2d2 +a3b3c3)2");
}

TEST(MathMl, TextIsNoMarkupAndNothingIsLost) {
  EXPECT_EQ(nesting_problem(tools::mathml("\\text{<b>&} + \\unknown{x} }")), "");
  EXPECT_NE(tools::mathml("\\text{<b>}").find("&lt;b&gt;"), std::string::npos);
  EXPECT_NE(tools::mathml("\\unknown{x}").find("\\unknown"), std::string::npos);
}

TEST(MathMl, UnderstandsWhatEveryBundledCaseShows) {
  std::size_t lines = 0;
  const auto list = run({"list", "--json"}).json();
  for (const auto& entry : list.at("cases")) {
    const std::string name = entry.at("name");
    const Outcome shown = run({"show", name, "--format", "latex"});
    EXPECT_EQ(shown.status, 0) << name << ": " << shown.err;
    std::istringstream latex(shown.out);
    for (std::string line; std::getline(latex, line);) {
      if (line.starts_with("\\begin") || line.starts_with("\\end")) continue;
      for (const char* mark : {"\\\\", "\\qquad", "\\operatorname{rank}", "\\begin{pmatrix}"})
        for (std::size_t at = line.find(mark); at != std::string::npos; at = line.find(mark))
          line.erase(at, std::string(mark).size());
      ++lines;
      const std::string markup = tools::mathml(line);
      EXPECT_EQ(nesting_problem(markup), "") << name << ": " << line;
      EXPECT_EQ(letters(markup).find('\\'), std::string::npos) << name << ": " << line;
    }
  }
  constexpr std::size_t kMany = 1000;
  EXPECT_GT(lines, kMany);
}

}  // namespace
}  // namespace casimir::test
