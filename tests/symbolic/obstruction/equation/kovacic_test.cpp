// Kovacic's decision against equations whose solutions are known, and against Kimura's theorem.
#include "symbolic/obstruction/equation/kovacic.hpp"

#include <cln/integer_io.h>
#include <cln/rational_io.h>
#include <gtest/gtest.h>

#include <random>

#include "symbolic/obstruction/equation/kimura.hpp"
#include "tests/symbolic/obstruction/equation/riemann_equations.hpp"

namespace casimir::obstruction {
namespace {

using cln::cl_RA;

const Univariate z = Univariate::variable();

GaloisCase group_of(const RationalFunction& r) { return decide_liouvillian(r).galois; }

TEST(Kovacic, KovacicsFourExamples) {
  // Examples of cases 1, 2 and 3 of Kovacic (1986), and Airy's equation.
  const RationalFunction first(4 * z.pow(6) - 8 * z.pow(5) + 12 * z.pow(4) + 4 * z.pow(3) +
                                   7 * z.pow(2) - 20 * z + Univariate(4),
                               4 * z.pow(4));
  EXPECT_EQ(group_of(first), GaloisCase::reducible);
  EXPECT_EQ(group_of(RationalFunction(Univariate(1), z) -
                     RationalFunction(Univariate(over(3, 16)), z * z)),
            GaloisCase::imprimitive);
  const RationalFunction third = RationalFunction(Univariate(over(-3, 16)), z * z) -
                                 RationalFunction(Univariate(over(2, 9)), (z - 1) * (z - 1)) +
                                 RationalFunction(Univariate(over(3, 16)), z * (z - 1));
  EXPECT_EQ(group_of(third), GaloisCase::finite);
  EXPECT_EQ(group_of(RationalFunction(z)), GaloisCase::sl2);
  // The second one with its irregular point at zero.
  EXPECT_EQ(group_of(RationalFunction(Univariate(1), z.pow(3)) -
                     RationalFunction(Univariate(over(3, 16)), z * z)),
            GaloisCase::imprimitive);
}

TEST(Kovacic, BesselsEquationHasSolutionsForHalvesOfOddIntegersOnly) {
  for (long n = 0; n <= 24; ++n) {
    const cl_RA nu = over(n, 6);
    const RationalFunction r =
        RationalFunction(Univariate(nu * nu - over(1, 4)), z * z) - RationalFunction(1);
    EXPECT_EQ(group_of(r) != GaloisCase::sl2, n % 6 == 3) << n;
  }
}

TEST(Kovacic, HermitesAndAirysEquations) {
  for (long n = -7; n <= 9; ++n) {
    // y'' = (z^2 - n) y has exp(-z^2/2) H_k for n = 2k + 1, and exp(z^2/2) for n = -2k - 1.
    EXPECT_EQ(
        group_of(RationalFunction(z * z - Univariate(static_cast<int>(n)))) != GaloisCase::sl2,
        n % 2 != 0)
        << n;
  }
  for (unsigned long n = 1; n <= 7; n += 2)
    EXPECT_EQ(group_of(RationalFunction(z.pow(n))), GaloisCase::sl2);
}

TEST(Kovacic, AgreesWithKimuraOnRiemannsEquation) {
  std::mt19937 random(20);
  const auto pick = [&](auto list) {
    return list[std::uniform_int_distribution<std::size_t>(0, list.size() - 1)(random)];
  };
  std::size_t solvable = 0, none = 0;
  for (int trial = 0; trial < 700; ++trial) {
    SquaredDifferences s;
    for (cl_RA& square : s) {
      const long denominator = pick(std::vector<long>{1, 2, 2, 3, 3, 4, 5});
      const cl_RA value = over(pick(std::vector<long>{0, 1, 1, 2, 3, 4, 5, 7, 8}), denominator);
      square = trial % 7 == 0 ? value : value * value;
    }
    const LiouvillianResult result = decide_liouvillian(riemann(s));
    ASSERT_NE(result.galois, GaloisCase::undecided) << result.reason;
    const auto expected = kimura(s);
    EXPECT_EQ(result.galois != GaloisCase::sl2, expected.has_value())
        << s[0] << " " << s[1] << " " << s[2] << " " << expected.value_or("not solvable");
    ++(expected ? solvable : none);
  }
  EXPECT_GT(solvable, 100u);
  EXPECT_GT(none, 100u);
}

TEST(Kovacic, FindsPlantedSolutionsOfTheFirstCase) {
  std::mt19937 random(3);
  const auto number = [&](int low, int high) {
    return cl_RA(std::uniform_int_distribution<int>(low, high)(random));
  };
  for (int trial = 0; trial < 150; ++trial) {
    RationalFunction w(Univariate(std::vector<cl_RA>{number(-2, 2), number(0, 1)}));
    for (int i = 0; i < 3; ++i) {
      const Univariate pole =
          trial % 3 == 0 ? z * z - Univariate(number(-3, 3)) : z - Univariate(number(-4, 4));
      w = w + RationalFunction(Univariate(number(-3, 3) / 2), pole.pow(trial % 5 == 0 ? 2 : 1));
    }
    const RationalFunction r = w.derivative() + w * w;
    const LiouvillianResult result = decide_liouvillian(r);
    if (result.galois == GaloisCase::undecided) {
      EXPECT_NE(result.reason.find("not a rational number"), std::string::npos) << result.reason;
      continue;
    }
    EXPECT_EQ(result.galois, GaloisCase::reducible) << r.text("z");
    EXPECT_TRUE(solves_riccati(result.solution, r));
  }
}

TEST(Kovacic, FindsPlantedSolutionsOfTheOtherCasesThroughPullbacks) {
  const std::array<std::pair<SquaredDifferences, GaloisCase>, 5> groups{{
      {{over(1, 4), over(1, 4), over(1, 49)}, GaloisCase::imprimitive},
      {{over(1, 4), over(1, 4), cl_RA(2)}, GaloisCase::imprimitive},
      {{over(1, 4), over(1, 9), over(1, 9)}, GaloisCase::finite},
      {{over(1, 4), over(1, 9), over(1, 16)}, GaloisCase::finite},
      {{over(1, 4), over(1, 9), over(1, 25)}, GaloisCase::finite},
  }};
  std::mt19937 random(5);
  const auto number = [&] { return cl_RA(std::uniform_int_distribution<int>(-3, 3)(random)); };
  for (const auto& [squares, group] : groups) {
    EXPECT_EQ(group_of(riemann(squares)), group);
    for (int trial = 0; trial < 6; ++trial) {
      const Univariate f = z.pow(2) + Univariate(number()) * z + Univariate(number());
      const RationalFunction pull(f, trial % 2 == 0 ? Univariate(1) : z + Univariate(number()));
      if (pull.is_constant()) continue;
      const RationalFunction r = pulled_back(riemann(squares), pull);
      const LiouvillianResult result = decide_liouvillian(r);
      ASSERT_NE(result.galois, GaloisCase::undecided) << result.reason;
      EXPECT_NE(result.galois, GaloisCase::sl2) << pull.text("z");
      EXPECT_TRUE(solves_riccati(result.solution, r));
    }
  }
}

TEST(Kovacic, PullbacksOfEquationsWithoutSolutionsHaveNone) {
  const SquaredDifferences squares{over(1, 49), over(1, 9), over(4, 25)};
  ASSERT_FALSE(kimura(squares));
  for (int c = -3; c <= 3; ++c) {
    const RationalFunction pull(z * z + Univariate(c), z - Univariate(2));
    EXPECT_EQ(group_of(pulled_back(riemann(squares), pull)), GaloisCase::sl2) << c;
  }
}

TEST(Kovacic, ResiduesMayLieInTheFieldOfTheirPoles) {
  // w has the residues (1 +- sqrt 2)/2 at z = +-sqrt 2: the roots are in no smaller field.
  const RationalFunction w(Univariate(over(1, 1)) * z + Univariate(2), z * z - Univariate(2));
  const RationalFunction r = w.derivative() + w * w;
  EXPECT_EQ(group_of(r), GaloisCase::reducible);
}

TEST(Kovacic, TwoSolutionsMayBeConjugate) {
  // y'' = 2 y: w = +-sqrt 2.
  const LiouvillianResult result = decide_liouvillian(RationalFunction(2));
  EXPECT_EQ(result.galois, GaloisCase::reducible);
  EXPECT_EQ(result.solution.size(), 3u);
}

TEST(Kovacic, AlgebraicPolesOfHighOrderAreUndecided) {
  const RationalFunction w(Univariate(1), (z * z - Univariate(2)).pow(2));
  EXPECT_EQ(group_of(w.derivative() + w * w), GaloisCase::undecided);
}

TEST(Kovacic, AllTriangularMatricesAreToldFromFewer) {
  const auto with = [](const RationalFunction& w) {
    return decide_liouvillian(w.derivative() + w * w);
  };
  // exp(z^2/2), and a logarithmic residue that is not rational.
  for (const RationalFunction& w :
       {RationalFunction(z), RationalFunction(Univariate(1), z * z - Univariate(2))}) {
    EXPECT_EQ(with(w).galois, GaloisCase::reducible);
    EXPECT_TRUE(with(w).borel);
  }
  // Diagonal: exp(z) and exp(-z). Unipotent: z^2 and 1/z. With a logarithm: y = sqrt z.
  EXPECT_FALSE(decide_liouvillian(RationalFunction(1)).borel);
  EXPECT_FALSE(decide_liouvillian(RationalFunction(Univariate(2), z * z)).borel);
  EXPECT_FALSE(with(RationalFunction(Univariate(cln::cl_RA(1) / 2), z)).borel);
}

TEST(Kovacic, ASolutionIsPutIntoItsEquation) {
  const RationalFunction r(Univariate(2), z * z);  // y = z^2, w = 2/z
  EXPECT_TRUE(solves_riccati({RationalFunction(Univariate(-2), z), RationalFunction(1)}, r));
  EXPECT_FALSE(solves_riccati({RationalFunction(Univariate(-3), z), RationalFunction(1)}, r));
}

TEST(SquareRoot, InNumberFields) {
  const Univariate f = z.pow(4) - 10 * z.pow(2) + Univariate(1);  // sqrt 2 + sqrt 3
  for (const int square : {2, 3, 6}) EXPECT_TRUE(square_root(Univariate(square), f)) << square;
  for (const int square : {5, -1, -2}) EXPECT_FALSE(square_root(Univariate(square), f)) << square;
  const Univariate some = (z.pow(3) - 2 * z + Univariate(5)).remainder(f);
  const auto root = square_root((some * some).remainder(f), f);
  ASSERT_TRUE(root);
  EXPECT_TRUE(*root == some || *root == -some);
}

}  // namespace
}  // namespace casimir::obstruction
