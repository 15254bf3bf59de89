// Names in figures, and texts of figures for LaTeX.
#include "tools/typeset/printed_names.hpp"

#include <gtest/gtest.h>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using tools::latex_text;
using tools::printed_names;

TEST(PrintedNames, AreAsPeopleWriteThem) {
  EXPECT_EQ(printed_names("M1"), "M₁");
  EXPECT_EQ(printed_names("gamma12"), "γ₁₂");
  EXPECT_EQ(printed_names("theta"), "θ");
  EXPECT_EQ(printed_names("2*M1*g2 + r"), "2·M₁·g₂ + r");
  EXPECT_EQ(printed_names("atan2(M1, beta)"), "atan2(M₁, β)");
  EXPECT_EQ(printed_names("x_1 + p1x + 1e5"), "x_1 + p1x + 1e5");
}

TEST(PrintedNames, ForLatexSymbolsStandInMathematics) {
  EXPECT_EQ(latex_text("M₁·γ₁₂"), "$M_{1}$$\\cdot $$\\gamma_{12}$");
  EXPECT_EQ(latex_text("l/π"), "l/$\\pi$");
  EXPECT_EQ(latex_text("time"), "time");
}

TEST(PrintedNames, NothingInATextIsACommandOfLatex) {
  EXPECT_EQ(latex_text("\\input{x}$a_b^c$ 100% #1 & ~"),
            "\\textbackslash{}input\\{x\\}\\$a\\_b\\textasciicircum{}c\\$ 100\\% \\#1 \\& "
            "\\textasciitilde{}");
}

constexpr const char* kHostile = R"toml(title = 'A \input{secret} $x$ 100% #1 \write18{ls} } end'
[phase_space]
variables = ["x1", "omega"]
[equations]
x1 = "omega"
omega = "-x1"
[[scene]]
name = "default"
initial = { x1 = "1", omega = "0" }
duration = "5"
)toml";

TEST(Print, ALatexFigureIncludesItsLinesAndSaysNothingThatIsACommand) {
  const Folder folder;
  folder.write("hostile.toml", kHostile);
  const Outcome drawn = run_in(
      folder, {"integrate", "hostile.toml", "--plot", "fig.tex", "--width", "86mm", "--quiet"});
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_EQ(folder.files(), 3U);
  const std::string text = file_text(folder.path() / "fig.tex");
  EXPECT_TRUE(file_text(folder.path() / "fig.pdf").starts_with("%PDF"));
  EXPECT_NE(text.find("{fig}}"), std::string::npos);
  EXPECT_EQ(text.find(folder.path().string()), std::string::npos);
  EXPECT_NE(text.find("$x_{1}$"), std::string::npos);
  EXPECT_NE(text.find("$\\omega$"), std::string::npos);
  EXPECT_EQ(text.find("\\input"), std::string::npos);
  EXPECT_EQ(text.find("\\write"), std::string::npos);
  EXPECT_NE(text.find("\\$x\\$ 100\\% \\#1"), std::string::npos);
}

TEST(Print, ALatexFigureHasANameThatLatexTakes) {
  const Folder folder;
  const Outcome drawn = run_in(folder, {"integrate", "euler", "--plot", "a b.tex", "--quiet"});
  EXPECT_EQ(drawn.status, 2);
  EXPECT_NE(drawn.err.find("letters, digits and hyphens"), std::string::npos) << drawn.err;
  EXPECT_EQ(folder.files(), 0U);
}

}  // namespace
}  // namespace casimir::test
