// The table of homogeneous potentials against Kimura's theorem, and Kimura's against what is known.
#include "symbolic/obstruction/homogeneous_table.hpp"

#include <cln/integer_io.h>
#include <cln/rational_io.h>
#include <gtest/gtest.h>

#include <set>

#include "symbolic/obstruction/equation/kimura.hpp"
#include "tests/symbolic/obstruction/equation/riemann_equations.hpp"

namespace casimir::obstruction {
namespace {

using cln::cl_RA;

TEST(HomogeneousTable, AgreesWithKimura) {
  std::size_t compared = 0, solvable = 0;
  for (long k = -7; k <= 7; ++k) {
    if (k == 0 || k == 2 || k == -2) continue;
    // Every difference at infinity that is a multiple of 1/60, up to 4.
    for (long n = 0; n <= 240; ++n) {
      const cl_RA tau = over(n, 60);
      const cl_RA lambda = (4 * k * k * tau * tau - (k - 2) * (k - 2)) / (8 * k);
      const auto expected = kimura(straight_line_differences(k, lambda));
      EXPECT_EQ(integrable_eigenvalue(k, lambda).has_value(), expected.has_value())
          << "k = " << k << ", lambda = " << lambda;
      ++compared;
      solvable += expected.has_value();
    }
  }
  EXPECT_EQ(compared, 2892u);
  EXPECT_GT(solvable, 200u);
}

TEST(HomogeneousTable, IrrationalDifferencesAreInNeither) {
  for (const long k : {-5, -4, -3, -1, 1, 3, 4, 5}) {
    const cl_RA lambda = over(17, 1000 * k);
    EXPECT_FALSE(integrable_eigenvalue(k, lambda)) << k;
    EXPECT_FALSE(kimura(straight_line_differences(k, lambda))) << k;
  }
}

TEST(HomogeneousTable, FirstValuesOfDegreeThree) {
  std::set<cl_RA> values;
  for (long n = 0; n <= 1200; ++n)
    if (integrable_eigenvalue(3, over(n, 600))) values.insert(over(n, 600));
  const std::set<cl_RA> expected{0,
                                 over(11, 600),
                                 over(5, 96),
                                 over(1, 8),
                                 over(119, 600),
                                 over(1, 3),
                                 over(299, 600),
                                 over(5, 8),
                                 over(551, 600),
                                 1,
                                 over(1271, 600)};
  for (const cl_RA& value : expected) EXPECT_TRUE(integrable_eigenvalue(3, value)) << value;
  for (const cl_RA& value : values)
    EXPECT_TRUE(expected.count(value) > 0 || value > over(1, 1)) << value;
}

TEST(HomogeneousTable, DegreeTwoExcludesNothing) {
  EXPECT_TRUE(integrable_eigenvalue(2, over(17, 19)));
  EXPECT_TRUE(integrable_eigenvalue(-2, over(17, 19)));
}

using Lists = std::set<std::vector<cl_RA>>;

Lists relation_solutions(long k) {
  const auto found = darboux_relation_solutions(k);
  return {found.begin(), found.end()};
}

TEST(DarbouxRelation, HasFourSolutionsForDegreeThree) {
  EXPECT_EQ(
      relation_solutions(3),
      (Lists{
          {-1, -1, 1}, {over(-7, 8), 14, 14}, {over(-2, 3), 4, 4}, {over(-2, 3), over(7, 3), 14}}));
}

TEST(DarbouxRelation, HasFiveSolutionsForDegreeFour) {
  EXPECT_EQ(relation_solutions(4), (Lists{{-1, -1, 2, 2},
                                          {over(-5, 8), 5, 5, 5},
                                          {over(-5, 8), 2, 20, 20},
                                          {over(-5, 8), over(27, 8), over(27, 8), 135},
                                          {over(-5, 8), 2, 14, 35}}));
}

TEST(Kimura, SumsOfRootsAreDecidedExactly) {
  // sqrt(2) + 1 - sqrt(2) = 1, and 2 sqrt(2) - sqrt(8) + 3 = 3.
  EXPECT_TRUE(kimura({2, 1, 2}));
  EXPECT_TRUE(kimura({8, 9, 8}));
  EXPECT_FALSE(kimura({2, 1, 8}));
  EXPECT_FALSE(kimura({2, 4, 2}));
  EXPECT_FALSE(kimura({2, 3, 5}));
  // Imaginary differences cancel as well.
  EXPECT_TRUE(kimura({-3, 1, -3}));
  EXPECT_FALSE(kimura({-3, 1, 3}));
  // Two halves of odd integers and anything.
  EXPECT_TRUE(kimura({over(1, 4), over(9, 4), -7}));
  EXPECT_FALSE(kimura({over(1, 4), over(9, 16), -7}));
}

TEST(Kimura, TheSumOfTheIntegersHasToBeEvenWhereTheListSaysSo) {
  EXPECT_TRUE(kimura({over(4, 9), over(1, 16), over(1, 16)}));
  EXPECT_FALSE(kimura({over(4, 9), over(1, 16), over(25, 16)}));
  EXPECT_TRUE(kimura({over(4, 25), over(4, 25), over(4, 25)}));
  EXPECT_FALSE(kimura({over(49, 25), over(4, 25), over(4, 25)}));
}

}  // namespace
}  // namespace casimir::obstruction
