// What of a logarithm the semisimple part of a group leaves alone.
#include "symbolic/obstruction/higher/binary_form.hpp"

#include <gtest/gtest.h>

namespace casimir::obstruction {
namespace {

constexpr int kNone = 0;

TEST(BinaryForm, OnTheLinesOfTheBasisTheMiddleTermIsInvariant) {
  const ProductOfSolutions lines{kNone, 1, kNone};  // y1 y2 = u1 u2
  EXPECT_TRUE(has_invariant_part({1, 0, 7, 0, 2}, lines));
  EXPECT_FALSE(has_invariant_part({1, 5, 0, 3, 2}, lines));
  EXPECT_FALSE(has_invariant_part({1, 5, 3, 2}, lines));
  EXPECT_TRUE(has_other_part({1, 0, 7, 0, 2}, lines));
  EXPECT_FALSE(has_other_part({0, 0, 7, 0, 0}, lines));
  EXPECT_TRUE(has_other_part({0, 1, 0, 0}, lines));
}

TEST(BinaryForm, OnOtherLinesItIsThePowerOfTheirConstants) {
  // y1 y2 = u1^2 - u2^2: y1 = u1 + u2, y2 = u1 - u2, and c1 c2 is a multiple of a^2 - b^2.
  const ProductOfSolutions lines{1, 0, -1};
  const BinaryForm square{1, 0, -2, 0, 1};  // (b^2 - a^2)^2 by powers of a
  EXPECT_TRUE(has_invariant_part(square, lines));
  EXPECT_FALSE(has_other_part(square, lines));
  // (c1^4 + c2^4): no middle term.
  const BinaryForm ends{1, 0, 6, 0, 1};
  EXPECT_FALSE(has_invariant_part(ends, lines));
  EXPECT_TRUE(has_other_part(ends, lines));
}

TEST(BinaryForm, OnOneLineEvenFormsAreLeftAlone) {
  const ProductOfSolutions line{1, 0, 0};
  EXPECT_TRUE(has_invariant_part({0, 3, 0, 0, 0}, line));
  EXPECT_FALSE(has_invariant_part({0, 3, 0, 0}, line));
  EXPECT_FALSE(has_invariant_part({0, 0, 0}, line));
  EXPECT_FALSE(has_other_part({0, 3, 0, 0, 0}, line));
}

TEST(BinaryForm, FieldsGiveFormsAndDeterminants) {
  // c3 -> c3^3, c4 -> -3 c3^2 c4: c3 (-3 c3^2 c4) - c4 c3^3 = -4 c3^3 c4.
  std::vector<ConstantPolynomial> field(4);
  field[2][{0, 0, 3, 0}] = 1;
  field[3][{0, 0, 2, 1}] = -3;
  const std::vector<BinaryForm> forms = forms_of(field);
  ASSERT_EQ(forms.size(), 1u);
  EXPECT_EQ(forms.front(), (BinaryForm{0, 0, 0, -4, 0}));
  // Along the plane the coefficients themselves.
  field.assign(4, {});
  field[0][{1, 0, 1, 1}] = 2;
  EXPECT_EQ(forms_of(field), (std::vector<BinaryForm>{{0, 2, 0}}));
}

}  // namespace
}  // namespace casimir::obstruction
