// Rank, pivots and solutions of random matrices that are made to have them, with numbers of many
// words.
#include "symbolic/algebra/rational_matrix.hpp"

#include <cln/integer.h>
#include <gtest/gtest.h>

#include <random>

namespace casimir::test {
namespace {

class RationalMatrices : public ::testing::Test {
 protected:
  /// Up to 200 bits above and below, of either sign, and often zero.
  cln::cl_RA number() {
    const auto word = [this] { return cln::cl_I(static_cast<unsigned long>(random_())); };
    if (random_() % 4 == 0) return 0;
    cln::cl_I top = word(), bottom = word() + 1;
    for (auto more = random_() % 3; more > 0; --more) top = cln::ash(top, 64) + word();
    for (auto more = random_() % 3; more > 0; --more) bottom = cln::ash(bottom, 64) + word();
    return (random_() % 2 == 0 ? top : -top) / bottom;
  }

  RationalMatrix matrix(std::size_t rows, std::size_t columns) {
    RationalMatrix result(rows, std::vector<cln::cl_RA>(columns));
    for (auto& row : result)
      for (cln::cl_RA& entry : row) entry = number();
    return result;
  }

  static RationalMatrix product(const RationalMatrix& a, const RationalMatrix& b) {
    RationalMatrix result(a.size(), std::vector<cln::cl_RA>(b[0].size(), 0));
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t k = 0; k < b.size(); ++k)
        for (std::size_t j = 0; j < b[0].size(); ++j)
          result[i][j] = result[i][j] + a[i][k] * b[k][j];
    return result;
  }

  std::mt19937_64 random_{5};
};

TEST_F(RationalMatrices, HaveTheRankThatTheirFactorsAllow) {
  for (std::size_t inner = 1; inner <= 4; ++inner) {
    for (int trial = 0; trial < 10; ++trial) {
      const RationalMatrix left = matrix(5, inner), right = matrix(inner, 6);
      const std::size_t expected = std::min(rank(left), rank(right));
      // Sylvester's inequality, and equality where the inner dimension is full.
      const std::size_t found = rank(product(left, right));
      EXPECT_LE(found, expected);
      EXPECT_GE(found + inner, rank(left) + rank(right));
    }
  }
}

TEST_F(RationalMatrices, GiveTheSolutionThatTheEquationsWereMadeFor) {
  for (int trial = 0; trial < 20; ++trial) {
    const RationalMatrix a = matrix(6, 4), x = matrix(4, 1), b = product(a, x);
    RationalMatrix equations = a;
    for (std::size_t i = 0; i < a.size(); ++i) equations[i].push_back(b[i][0]);
    const auto solution = solve_unique(equations);
    if (rank(a) < 4) {
      EXPECT_FALSE(solution);
      continue;
    }
    ASSERT_TRUE(solution);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ((*solution)[i], x[i][0]);
    equations[5][4] = equations[5][4] + 1;
    if (rank(equations) == 5) {
      EXPECT_FALSE(solve_unique(equations));
    }
  }
}

TEST_F(RationalMatrices, PivotsAreTheFirstColumnsThatAreIndependent) {
  const RationalMatrix rows{{0, 2, 4, 1}, {0, 1, 2, 3}, {0, 3, 6, 4}};
  EXPECT_EQ(independent_columns(rows), (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(rank(rows), 2U);
  EXPECT_EQ(rank({}), 0U);
  EXPECT_TRUE(independent_columns({}).empty());
  EXPECT_FALSE(solve_unique({}));
}

}  // namespace
}  // namespace casimir::test
