// Casimir functions found by linear algebra, against the degrees that Lie theory gives.
#include "symbolic/model/invariant_forms.hpp"

#include <gtest/gtest.h>

namespace casimir::test {
namespace {

std::size_t count(const char* algebra, std::size_t degree) {
  return invariant_forms(*find_lie_algebra(algebra), degree).size();
}

TEST(InvariantForms, HaveTheDegreesOfTheInvariantRing) {
  // so(2m+1): 2, 4, .., 2m; so(2m): 2, 4, .., 2m-2 and the Pfaffian of degree m. Products of lower
  // ones are invariant too.
  EXPECT_EQ(count("so(5)", 1), 0U);
  EXPECT_EQ(count("so(5)", 2), 1U);
  EXPECT_EQ(count("so(5)", 3), 0U);
  EXPECT_EQ(count("so(5)", 4), 2U);
  EXPECT_EQ(count("so(6)", 2), 1U);
  EXPECT_EQ(count("so(6)", 3), 1U);
  EXPECT_EQ(count("so(4)", 2), 2U);
  EXPECT_EQ(count("so(4)", 4), 3U);
  // e(4): the square of p and that of the Pauli-Lubanski vector, of degree 4.
  EXPECT_EQ(count("e(4)", 2), 1U);
  EXPECT_EQ(count("e(4)", 4), 2U);
  EXPECT_EQ(count("so(12)", 2), 1U);
  // k vectors: their k(k+1)/2 scalar products.
  EXPECT_EQ(count("so(3)+3*R3", 2), 6U);
  EXPECT_EQ(count("so(3)+3*R3", 3), 1U);
}

TEST(InvariantForms, AreWhatTheBookHas) {
  using Terms = IntegerForm;
  const auto forms = [](const char* name) {
    return invariant_forms_to_degree_two(*find_lie_algebra(name));
  };
  EXPECT_EQ(forms("e(3)"),
            (std::vector<IntegerForm>{Terms{{{3, 3}, 1}, {{4, 4}, 1}, {{5, 5}, 1}},
                                      Terms{{{0, 3}, 1}, {{1, 4}, 1}, {{2, 5}, 1}}}));
  EXPECT_EQ(
      forms("so(3,1)").at(0),
      (Terms{{{0, 0}, 1}, {{1, 1}, 1}, {{2, 2}, 1}, {{3, 3}, -1}, {{4, 4}, -1}, {{5, 5}, -1}}));
  EXPECT_EQ(forms("l(7)"),
            (std::vector<IntegerForm>{Terms{{{3, 3}, 1}, {{4, 4}, 1}, {{5, 5}, 1}, {{6, 6}, 1}}}));
  EXPECT_EQ(forms("sl(2)"), (std::vector<IntegerForm>{Terms{{{0, 0}, 1}, {{1, 2}, 4}}}));
}

TEST(InvariantForms, ProductsOfLinearOnesAreLeftOut) {
  EXPECT_EQ(count("h(3)", 2), 1U);  // z^2
  EXPECT_EQ(invariant_forms_to_degree_two(*find_lie_algebra("h(3)")),
            (std::vector<IntegerForm>{{{{2}, 1}}}));
  // Without brackets everything is invariant: x, y, and nothing new of degree two.
  const LieAlgebra abelian{"R2", "x y", 2, {}};
  EXPECT_EQ(invariant_forms(abelian, 2).size(), 3U);
  EXPECT_EQ(invariant_forms_to_degree_two(abelian).size(), 2U);
}

}  // namespace
}  // namespace casimir::test
