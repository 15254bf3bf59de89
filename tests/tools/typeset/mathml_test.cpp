#include "tools/typeset/mathml.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "symbolic/case_file.hpp"
#include "symbolic/model.hpp"
#include "tests/tools/pages/page_checks.hpp"
#include "tools/show/system_view.hpp"
#include "tools/typeset/latex.hpp"

namespace casimir::test {
namespace {

using tools::typeset::Kind;
using tools::typeset::Math;
namespace typeset = tools::typeset;

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

Math sum(std::vector<Math> terms) {
  Math result{Kind::sum};
  for (Math& term : terms) typeset::add_term(result, std::move(term));
  return result;
}

Math squared(Math base) { return typeset::with_power(std::move(base), typeset::number("2")); }

Math half() { return typeset::fraction(typeset::number("1"), typeset::number("2")); }

/// a_i b_i c_i d_i
Math four(const char* index) {
  std::vector<Math> factors;
  for (const char* name : {"a", "b", "c", "d"})
    factors.push_back(typeset::name(std::string(name) + index));
  return typeset::product(factors);
}

TEST(MathMl, HasTheTreeOfTheFormula) {
  const Math square = squared(typeset::name("M1"));
  EXPECT_EQ(typeset::mathml(square),
            "<math><msubsup><mrow><mi>M</mi></mrow><mrow><mn>1</mn></mrow><mrow><mn>2</mn></mrow>"
            "</msubsup></math>");
  const Math energy =
      sum({typeset::product({half(), square}),
           typeset::negated(typeset::product({typeset::letter("r"), typeset::name("gamma1")}))});
  EXPECT_EQ(letters(typeset::mathml(energy)), "12M12 −rγ1");
  EXPECT_EQ(
      count(typeset::mathml({Kind::root, {}, {sum({typeset::letter("x"), half()})}}), "<msqrt>"),
      1U);
  EXPECT_EQ(
      count(typeset::mathml(typeset::rate({Kind::bold, {}, {typeset::letter("M")}})), "mover"), 2U);
}

TEST(MathMl, LinesBreakBetweenTermsAndInLongBracketsOnly) {
  const Math a = typeset::letter("a"), b = typeset::letter("b"), c = typeset::letter("c");
  EXPECT_EQ(count(typeset::mathml(sum({a, b, typeset::negated(c)})), "<math>"), 3U);
  EXPECT_EQ(count(typeset::mathml(typeset::fraction(sum({a, b}), sum({c, a}))), "<math>"), 1U);
  const auto doubled = [](const Math& inside) {
    return typeset::product({typeset::number("2"), squared(typeset::in_brackets(inside))});
  };
  EXPECT_EQ(count(typeset::mathml(doubled(sum({a, b}))), "<math>"), 1U);
  const std::string broken = typeset::mathml(doubled(sum({four("1"), four("2"), four("3")})));
  EXPECT_EQ(count(broken, "<math>"), 3U);
  // The power stands at the bracket that ends, and everything is still there in its order.
  EXPECT_NE(broken.find(")</mo></mrow><mrow><mn>2</mn></mrow></msup></math>"), std::string::npos)
      << broken;
  EXPECT_EQ(letters(broken), "2(a1b1c1d1 +a2b2c2d2 +a3b3c3d3)2");
}

TEST(MathMl, WordsAreNoMarkup) {
  const std::string words = typeset::mathml(typeset::prose("<b>&\\unknown"));
  EXPECT_EQ(nesting_problem(words), "");
  EXPECT_NE(words.find("&lt;b&gt;&amp;\\unknown"), std::string::npos);
}

/// Every formula of a view.
void each(const tools::SystemView& view, const std::function<void(const Math&)>& look) {
  const auto formulas = [&](const std::vector<tools::Formula>& list) {
    for (const tools::Formula& f : list) {
      look(f.left.math);
      look(f.right.math);
      for (const tools::Written& level : f.on) look(level.math);
    }
  };
  if (view.hamiltonian) look(view.hamiltonian->math);
  for (const auto* list : {&view.vector_brackets, &view.zero_brackets, &view.brackets,
                           &view.vector_equations, &view.gradients, &view.equations})
    formulas(*list);
  for (const tools::FormulaGroup& group : view.claims) formulas(group.formulas);
  for (const tools::LaxView& pair : view.lax_pairs)
    for (const auto* matrix : {&pair.l, &pair.a})
      for (const auto& row : *matrix)
        for (const tools::Written& entry : row) look(entry.math);
}

TEST(MathMl, EveryBundledCaseIsWritten) {
  std::size_t formulas = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CASIMIR_SOURCE_DIR "/cases")) {
    if (entry.path().extension() != ".toml") continue;
    const Model model = build_model(read_case(entry.path()));
    tools::Notation notation(model);
    each(view_of(model, notation), [&](const Math& formula) {
      ++formulas;
      const std::string markup = typeset::mathml(formula);
      ASSERT_EQ(nesting_problem(markup), "") << entry.path();
      ASSERT_EQ(letters(markup).find('\\'), std::string::npos) << entry.path() << markup;
      const std::string latex = typeset::latex(formula);
      ASSERT_EQ(std::ranges::count(latex, '{'), std::ranges::count(latex, '}')) << latex;
    });
  }
  constexpr std::size_t kMany = 5000;
  EXPECT_GT(formulas, kMany);
}

}  // namespace
}  // namespace casimir::test
