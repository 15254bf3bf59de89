// Parts and dimensions of the common zeros of polynomials.
#include "symbolic/algebra/zero_sets.hpp"

#include <gtest/gtest.h>

namespace casimir::test {
namespace {

class ZeroSets : public ::testing::Test {
 protected:
  PolynomialRing ring{4};
  Polynomial x = ring.variable(0), y = ring.variable(1), z = ring.variable(2), w = ring.variable(3);
  Polynomial one = ring.constant(1), two = ring.constant(2);
};

TEST_F(ZeroSets, OneEquationHasAsManyPartsAsFactors) {
  EXPECT_TRUE(has_irreducible_zeros({x * x + y * y - one}, false));
  EXPECT_TRUE(has_irreducible_zeros({x * x - two * y * y}, false));
  EXPECT_FALSE(has_irreducible_zeros({x * y}, false));
}

// Over the numbers with sqrt(2) each of x^2 = 2 and y^2 = 2 has two parts; x = y and x = -y are
// parts of the product over the rational numbers.
TEST_F(ZeroSets, ProductsOfIrreducibleSetsMayHaveParts) {
  EXPECT_FALSE(has_irreducible_zeros({x * x - two, y * y - two}, false));
  EXPECT_TRUE(has_irreducible_zeros({x * x + y * y - one, z * z + w * w - one}, true));
}

// Where the factor in front of the variable is zero there may be another part.
TEST_F(ZeroSets, GraphsOverIrreducibleSetsAreIrreducible) {
  EXPECT_TRUE(has_irreducible_zeros({x, x * y + z}, false));
  EXPECT_TRUE(has_irreducible_zeros({x * x + y * y - one, x * z + y * w}, false));
  EXPECT_FALSE(has_irreducible_zeros({x * z, x * y + z * w}, false));
  EXPECT_FALSE(has_irreducible_zeros({x * x - y, (x * x - one) * z + (x - one) * w}, false));
}

TEST_F(ZeroSets, CodimensionsAreBounded) {
  EXPECT_TRUE(has_codimension_above(1, {x * y, x * z - one}));
  EXPECT_FALSE(has_codimension_above(1, {x * y, x * z}));
  EXPECT_TRUE(has_codimension_above(3, {x * x - y, x * y - one, y * y - z, w - z}));
  EXPECT_FALSE(has_codimension_above(4, {x, y, z, w}));
  EXPECT_TRUE(has_codimension_above(4, {x, x - one}));
}

}  // namespace
}  // namespace casimir::test
