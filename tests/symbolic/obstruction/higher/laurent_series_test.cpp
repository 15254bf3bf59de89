// Laurent series that know how far they are known.
#include "symbolic/obstruction/higher/laurent_series.hpp"

#include <gtest/gtest.h>

#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

TEST(LaurentSeries, KnowsOfAProductWhatBothFactorsGive) {
  // (t^-2 + 3 + O(t)) (t + O(t^4)) = t^-1 + 3 t + O(t^2).
  const LaurentSeries a(-2, Univariate({1, 0, 3}), 1), b(1, Univariate(1), 4);
  const LaurentSeries product = a * b;
  EXPECT_EQ(product.end(), 2);
  EXPECT_EQ(product.coefficient(-1), 1);
  EXPECT_EQ(product.coefficient(1), 3);
  EXPECT_THROW(product.coefficient(2), NotDecided);
}

TEST(LaurentSeries, InverseOfOneLessT) {
  const LaurentSeries inverse = LaurentSeries(0, Univariate({1, -1}), 7).inverse();
  for (long i = 0; i < 7; ++i) EXPECT_EQ(inverse.coefficient(i), 1);
  EXPECT_THROW(inverse.coefficient(7), NotDecided);
  EXPECT_THROW(LaurentSeries(0, Univariate(), 7).inverse(), NotDecided);
}

TEST(LaurentSeries, AnIntegralNeedsAResidueThatIsKnownToBeZero) {
  EXPECT_EQ(LaurentSeries(-3, Univariate({4, 0, 0, 1}), 5).integral().coefficient(-2), -2);
  EXPECT_THROW(LaurentSeries(-3, Univariate({4, 0, 1}), 5).integral(), NotDecided);
  EXPECT_THROW(LaurentSeries(-3, Univariate(4), -1).integral(), NotDecided);
}

TEST(LaurentSeries, InverseMatrix) {
  const LaurentSeries one(cln::cl_RA(1)), t(1, Univariate(1), 20);
  const SeriesMatrix m{{t, one}, {one, t * t}};
  const SeriesMatrix unit = inverse(m) * m;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      EXPECT_TRUE((unit[i][j] - LaurentSeries(cln::cl_RA(i == j ? 1 : 0))).vanishes());
}

}  // namespace
}  // namespace casimir::obstruction
