// Fundamental matrices of Laurent series, and equations that have none.
#include "symbolic/obstruction/higher/local_solutions.hpp"

#include <gtest/gtest.h>

namespace casimir::obstruction {
namespace {

/// y'' = f y.
std::optional<SeriesMatrix> solutions(const LaurentSeries& f) {
  return laurent_solutions({{LaurentSeries(), LaurentSeries(cln::cl_RA(1))}, {f, LaurentSeries()}},
                           12, 30);
}

TEST(LaurentSolutions, BeginWithTheExponents) {
  const auto phi = solutions(LaurentSeries(-2, Univariate(6), 100));
  ASSERT_TRUE(phi);
  EXPECT_EQ((*phi)[0][0].valuation(), -2);
  EXPECT_EQ((*phi)[0][1].valuation(), 3);
}

TEST(LaurentSolutions, OfAnEquationWithoutPolesAreTaylorSeries) {
  const auto phi = solutions(LaurentSeries(cln::cl_RA(1)));
  ASSERT_TRUE(phi);
  // cosh and sinh, of which every second coefficient vanishes.
  for (std::size_t j = 0; j < 2; ++j) {
    const LaurentSeries& y = (*phi)[0][j];
    for (long i = y.valuation(); i < 10; ++i)
      EXPECT_EQ(y.coefficient(i + 2) * cln::cl_RA((i + 1) * (i + 2)), y.coefficient(i));
  }
}

TEST(LaurentSolutions, ThereAreNoneWithALogarithm) {
  // Exponents -1 and 2; 2/t^2 + 1/t forces a logarithm: y = 1/t - 1/2 + t/4 + .. + c t^2 log t.
  EXPECT_FALSE(solutions(LaurentSeries(-2, Univariate({2, 1}), 100)));
  // None is forced where f has even powers only, as Weierstrass's function.
  EXPECT_TRUE(solutions(LaurentSeries(-2, Univariate({2, 0, 0, 0, 5}), 100)));
}

TEST(LaurentSolutions, ThereAreNoneWithExponentsThatAreNoIntegers) {
  EXPECT_FALSE(solutions(LaurentSeries(-2, Univariate(1), 100)));
  EXPECT_FALSE(solutions(LaurentSeries(-2, Univariate(cln::cl_RA(3) / 4), 100)));
}

TEST(LaurentSolutions, AnIrregularPointHasNone) {
  EXPECT_FALSE(solutions(LaurentSeries(-4, Univariate(1), 100)));
}

}  // namespace
}  // namespace casimir::obstruction
