// Curves of the plane from what they are on lines.
#include "symbolic/discrete/plane_factors.hpp"

#include <gtest/gtest.h>

namespace casimir::test {
namespace {

using discrete::Element;
using discrete::OnLine;
using discrete::PlaneFactors;
using discrete::Univariate;

/// (1 + a + b)^2 (3 - b^2) on b = s a, times a number that differs from line to line.
std::vector<OnLine> lines(std::size_t count) {
  const discrete::PrimeField field;
  std::vector<OnLine> result;
  for (Element s = 1; s <= count; ++s) {
    OnLine& line = result.emplace_back(OnLine{s, Univariate()});
    Univariate other;
    nmod_poly_set_coeff_ui(line.polynomial.raw(), 0, 1);
    nmod_poly_set_coeff_ui(line.polynomial.raw(), 1, 1 + s);
    nmod_poly_pow(line.polynomial.raw(), line.polynomial.raw(), 2);
    nmod_poly_set_coeff_ui(other.raw(), 0, 3);
    nmod_poly_set_coeff_ui(other.raw(), 2, field.subtract(0, s * s));
    nmod_poly_mul(line.polynomial.raw(), line.polynomial.raw(), other.raw());
    nmod_poly_scalar_mul_nmod(line.polynomial.raw(), line.polynomial.raw(), 5 + s);
  }
  return result;
}

/// 3 is no square modulo 2^61 - 1, so that 3 - b^2 is one factor.
TEST(PlaneFactors, AreThoseOfTheCurve) {
  const auto factors = PlaneFactors::from_lines(lines(9), discrete::kPrime);
  ASSERT_TRUE(factors);
  ASSERT_EQ(factors->size(), 2U);
  const std::size_t line = factors->degree(0) == 1 ? 0 : 1;
  EXPECT_EQ(factors->degree(line), 1);
  EXPECT_EQ(factors->exponent(line), 2U);
  EXPECT_EQ(factors->degree(1 - line), 2);
  EXPECT_EQ(factors->exponent(1 - line), 1U);
  EXPECT_TRUE(factors->vanishes(line, 4, discrete::kPrime - 5));
  EXPECT_FALSE(factors->vanishes(line, 4, 5));
  EXPECT_FALSE(factors->vanishes(1 - line, 4, discrete::kPrime - 5));
}

TEST(PlaneFactors, WantMoreLinesThanTheDegreeAndOneCurve) {
  EXPECT_FALSE(PlaneFactors::from_lines(lines(4), discrete::kPrime));
  std::vector<OnLine> wrong = lines(9);
  nmod_poly_set_coeff_ui(wrong[3].polynomial.raw(), 1, 77);
  EXPECT_FALSE(PlaneFactors::from_lines(wrong, discrete::kPrime));
}

}  // namespace
}  // namespace casimir::test
