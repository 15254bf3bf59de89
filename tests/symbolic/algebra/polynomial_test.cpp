#include "symbolic/algebra/polynomial.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>
#include <gtest/gtest.h>

#include <thread>

#include "symbolic/algebra/factor_memory.hpp"
#include "symbolic/algebra/ideal.hpp"

namespace casimir {
namespace {

class Ring3 : public testing::Test {
 protected:
  PolynomialRing ring_{3};
  Polynomial x_ = ring_.variable(0), y_ = ring_.variable(1), z_ = ring_.variable(2);
  Polynomial one_ = ring_.constant(1);
};

TEST_F(Ring3, ArithmeticIsExact) {
  const Polynomial p = (x_ + y_).pow(2) - x_ * x_ - y_ * y_;
  EXPECT_EQ(p, (x_ * y_).scaled(2));
  EXPECT_TRUE((p - x_ * y_ - y_ * x_).is_zero());
  const cln::cl_RA huge = cln::expt_pos(cln::cl_I(10), 60);
  EXPECT_EQ(ring_.constant(huge).scaled(1 / huge), one_);
}

/// -2^62 and -2^124 were 0: a negative number may be longer than the count of its bits says.
TEST_F(Ring3, KeepsNumbersOfEveryLengthAndSign) {
  constexpr int kLongest = 200;
  for (int k = 0; k <= kLongest; ++k) {
    for (const int beside : {-1, 0, 1}) {
      for (const int sign : {1, -1}) {
        const cln::cl_I number = sign * (cln::ash(cln::cl_I(1), k) + beside);
        if (number == 0) continue;
        TermCollector collector(ring_);
        collector.add(number, {1, 0, 0});
        collector.add(1, {0, 1, 0});
        const Polynomial sum = collector.finish();
        EXPECT_EQ(sum.terms(), 2U) << number;
        EXPECT_EQ(sum.evaluate({1, 0, 0}), number);
        EXPECT_EQ(x_.scaled(number) + y_, sum) << number;
        EXPECT_EQ(x_.scaled(1 / cln::cl_RA(number)).evaluate({1, 0, 0}), 1 / cln::cl_RA(number));
      }
    }
  }
}

TEST_F(Ring3, EvaluatesAndDifferentiates) {
  const Polynomial p = x_.pow(3) * y_ + z_.scaled(cln::cl_RA(1) / 2);
  EXPECT_EQ(p.evaluate({2, 3, 5}), 24 + cln::cl_RA(5) / 2);
  EXPECT_EQ(p.derivative(0), (x_.pow(2) * y_).scaled(3));
  EXPECT_EQ(p.degree(0), 3);
  EXPECT_EQ(Polynomial(ring_).degree(0), -1);
}

TEST_F(Ring3, CoefficientsPutTheirPolynomialTogetherAgain) {
  const Polynomial p = (x_ + y_ * z_ + one_).pow(4);
  const std::vector<Polynomial> parts = p.coefficients(1);
  Polynomial sum(ring_);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    EXPECT_FALSE(parts[k].uses(1));
    sum += parts[k] * y_.pow(k);
  }
  EXPECT_EQ(sum, p);
}

TEST_F(Ring3, FactorsMultiplyBackToThePolynomial) {
  const Polynomial p = ((x_ - y_).pow(3) * (x_ + z_)).scaled(-6);
  Polynomial product = one_;
  std::size_t factors = 0;
  for (const auto& [f, k] : p.factors()) {
    product *= f.pow(k);
    factors += f.is_constant() ? 0 : 1;
  }
  EXPECT_EQ(product, p);
  EXPECT_EQ(factors, 2U);
}

TEST_F(Ring3, GroebnerBasisDecidesMembershipThatDivisionAloneDoesNot) {
  // x*y - 1 and y^2 - 1 generate x - y, which no single division shows.
  const std::vector<Polynomial> generators{x_ * y_ - one_, y_ * y_ - one_};
  std::vector<Polynomial> quotients;
  EXPECT_FALSE((x_ - y_).remainder(generators, &quotients).is_zero());
  const std::vector<Polynomial> basis = groebner_basis(generators);
  EXPECT_TRUE((x_ - y_).remainder(basis, &quotients).is_zero());
  EXPECT_FALSE((x_ - z_).remainder(basis, &quotients).is_zero());
}

TEST_F(Ring3, TriangularSetEliminatesItsMainVariables) {
  // x z = y and y^2 = 2, with the parameter z: then x^2 z^2 = 2.
  const std::vector<Polynomial> relations{y_ * y_ - one_.scaled(2), x_ * z_ - y_};
  const auto uses_x_or_y = [](const Polynomial& p) { return p.uses(0) || p.uses(1); };
  const std::vector<SolvedRelation> set = triangular_set(relations, 2, uses_x_or_y);
  ASSERT_EQ(set.size(), 2U);
  EXPECT_EQ(set[0].variable, 0U);
  EXPECT_EQ(set[0].leading, z_);
  EXPECT_TRUE(pseudo_remainder(x_ * x_ * z_ * z_ - one_.scaled(2), set).is_zero());
  EXPECT_FALSE(pseudo_remainder(x_ * x_ * z_ * z_ + one_.scaled(2), set).is_zero());
  // Without a main variable of its own for each relation there is no such set.
  EXPECT_TRUE(triangular_set({x_ * y_ - one_, x_ + y_.pow(3) * x_}, 2, uses_x_or_y).empty());
}

TEST_F(Ring3, QuotientsAndRemainderPutTheDividendTogether) {
  const std::vector<Polynomial> divisors{x_ * y_ - z_, y_ * y_ + one_};
  const Polynomial p = (x_ + y_ + z_).pow(4);
  std::vector<Polynomial> quotients;
  Polynomial sum = p.remainder(divisors, &quotients);
  for (std::size_t i = 0; i < divisors.size(); ++i) sum += quotients[i] * divisors[i];
  EXPECT_EQ(sum, p);
}

// x*y + z is irreducible without a look by FLINT, and so it is where FLINT has to look; what has a
// monomial for a factor is not.
TEST_F(Ring3, AVariableOfOneTermMakesIrreducible) {
  const Polynomial alone = (x_ * y_ + z_ * z_ * y_ * y_ - z_).scaled(-6);
  ASSERT_EQ(alone.factors().size(), 2U);
  const auto [number, f] = std::pair(alone.factors()[0].first, alone.factors()[1].first);
  EXPECT_TRUE(number.is_constant());
  EXPECT_TRUE(number * f == alone);
  const auto squared = (alone * alone).factors();  // in which no variable is in one term only
  ASSERT_EQ(squared.size(), 2U);
  EXPECT_EQ(squared[1].second, 2U);
  EXPECT_TRUE(squared[1].first == f);
  EXPECT_EQ((x_ * y_ + z_ * y_).factors().size(), 3U);      // 1, y, x + z
  EXPECT_EQ((x_.pow(2) - y_.pow(2)).factors().size(), 3U);  // each in one term, with a power
}

TEST_F(Ring3, FactorsAreFoundInTheVariablesThatOccur) {
  const std::vector<std::pair<Polynomial, unsigned long>> factors =
      ((x_ * x_ - z_ * z_) * z_).scaled(2).factors();
  ASSERT_EQ(factors.size(), 4U);  // 2, z, x - z, x + z
  Polynomial product = one_;
  for (const auto& [f, k] : factors) product *= f.pow(k);
  EXPECT_EQ(product, ((x_ * x_ - z_ * z_) * z_).scaled(2));
  EXPECT_EQ((x_ * x_ + z_ * z_).factors().size(), 2U);
  EXPECT_EQ((x_.pow(2) * z_).scaled(-3).factors()[1].second, 2U);
}

// As from FLINT: f times g is factored by it, while f alone, with a variable in one term, is not.
TEST_F(Ring3, AVariableInOneTermAloneMakesAFactorLikeOthers) {
  const Polynomial other = x_ * x_ + x_ * z_ + z_ * z_;
  for (const Polynomial& f : {x_ * x_ - y_.scaled(2) + z_ * x_, (one_ - x_).scaled(6),
                              y_.scaled(cln::cl_RA(-1) / 3) + x_ * z_.pow(2)}) {
    const auto alone = f.factors();
    ASSERT_EQ(alone.size(), 2U);
    EXPECT_EQ(alone[0].first * alone[1].first, f);
    const auto both = (f * other).factors();
    ASSERT_EQ(both.size(), 3U);
    EXPECT_TRUE(both[1].first == alone[1].first || both[2].first == alone[1].first);
  }
  // In two terms it says nothing: x y - y = (x - 1) y.
  EXPECT_EQ((x_ * y_ - y_).factors().size(), 3U);
  EXPECT_EQ((x_ * y_ + x_ + y_ + one_).factors().size(), 3U);
}

TEST_F(Ring3, SumOfManyIsTheSumOneByOne) {
  std::vector<Polynomial> summands;
  Polynomial expected(ring_);
  for (unsigned long k = 0; k < 13; ++k) {
    summands.push_back((x_ + y_.pow(k)).pow(k % 4) - z_.scaled(cln::cl_I(k)));
    expected += summands.back();
    EXPECT_EQ(Polynomial::sum(ring_, summands), expected);
    std::vector<const Polynomial*> pointers;
    for (const Polynomial& p : summands) pointers.push_back(&p);
    EXPECT_EQ(Polynomial::sum(ring_, pointers), expected);
  }
  summands.back() += one_;
  EXPECT_FALSE(Polynomial::sum(ring_, summands) == expected);
  EXPECT_TRUE(Polynomial::sum(ring_, std::vector<Polynomial>{}).is_zero());
}

TEST_F(Ring3, SumOfProductsKeepsItsDenominators) {
  const Polynomial half_x = x_.scaled(cln::cl_RA(1) / 2);
  const Polynomial p = (y_ - z_).pow(3).scaled(cln::cl_RA(4) / 15);
  const auto sum_of = [&](const Polynomial& last) {
    SumOfProducts sum(ring_);
    sum.add(half_x, p);
    sum.add(p, x_ + one_.scaled(cln::cl_RA(2) / 7));
    sum.add(Polynomial(ring_), p);
    sum.add(x_ * x_, x_.scaled(6));
    sum.add(last, p);
    return sum.finish();
  };
  EXPECT_EQ(sum_of(y_), half_x * p + p * (x_ + one_.scaled(cln::cl_RA(2) / 7)) +
                            (x_ * x_ * x_).scaled(6) + y_ * p);
  EXPECT_FALSE(sum_of(y_) == sum_of(z_));
  SumOfProducts cancelling(ring_);
  cancelling.add(half_x, p);
  cancelling.add(-p, half_x);
  EXPECT_TRUE(cancelling.finish().is_zero());
  EXPECT_TRUE(SumOfProducts(ring_).finish().is_zero());
}

TEST_F(Ring3, CollectedTermsAddUp) {
  const cln::cl_RA huge = cln::expt_pos(cln::cl_I(10), 30);
  TermCollector terms(ring_);
  terms.add(cln::cl_RA(1) / 6, {0, 1, 0});
  terms.add(huge, {2, 0, 1});
  terms.add(0, {5, 5, 5});
  terms.add(cln::cl_RA(1) / 10, {0, 1, 0});
  terms.add(-7, {0, 0, 0});
  EXPECT_EQ(terms.finish(),
            y_.scaled(cln::cl_RA(4) / 15) + (x_.pow(2) * z_).scaled(huge) - one_.scaled(7));
  TermCollector cancelling(ring_);
  cancelling.add(cln::cl_RA(2) / 3, {1, 0, 0});
  cancelling.add(cln::cl_RA(-2) / 3, {1, 0, 0});
  EXPECT_TRUE(cancelling.finish().is_zero());
  EXPECT_TRUE(TermCollector(ring_).finish().is_zero());
}

TEST_F(Ring3, LinearFormsAreToldFromOthers) {
  const auto form = (x_.scaled(cln::cl_RA(1) / 2) - z_.scaled(cln::cl_RA(2) / 3)).linear_form();
  ASSERT_TRUE(form);
  EXPECT_EQ(form->denominator, 6);
  EXPECT_EQ(form->coefficients, (std::vector<std::pair<std::size_t, long>>{{0, 3}, {2, -4}}));
  EXPECT_TRUE(Polynomial(ring_).linear_form());
  EXPECT_FALSE((x_ + one_).linear_form());
  EXPECT_FALSE((x_ + y_ * z_).linear_form());
  EXPECT_FALSE((x_ + y_ * y_).linear_form());
  EXPECT_FALSE(x_.scaled(cln::expt_pos(cln::cl_I(2), 40)).linear_form());
}

TEST(Factors, AreKeptByTheirOwnRingForAllThreads) {
  const PolynomialRing ring(3), other(3);
  const auto product = [](const PolynomialRing& own, long k) {
    const Polynomial x = own.variable(0), y = own.variable(1), z = own.variable(2);
    return (x * y * z + own.constant(k)) * (x * x * y + y * z * z - own.constant(2 * k + 1));
  };
  std::vector<std::thread> threads;
  std::vector<int> right(4, 0);
  for (std::size_t t = 0; t < right.size(); ++t) {
    threads.emplace_back([&, t] {
      for (long k = 1; k <= 30; ++k) right[t] += product(ring, k).factors().size() == 3 ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, std::vector<int>(4, 30));
  EXPECT_TRUE(ring.factor_memory().of(product(ring, 7)).has_value());
  EXPECT_FALSE(ring.factor_memory().of(product(ring, 31)).has_value());
  EXPECT_FALSE(other.factor_memory().of(product(other, 7)).has_value());
}

/// A product is found again, and so are its factors, scaled ones too; another ring in the same
/// place of memory knows nothing of them.
TEST(Factors, AreTheSameWhenTheyAreAskedForAgain) {
  for (std::size_t variables = 2; variables < 6; ++variables) {
    const PolynomialRing ring(variables);
    const Polynomial x = ring.variable(0), y = ring.variable(variables - 1);
    const Polynomial f = x * x + y * y, g = x * x - (y * y).scaled(2);
    const Polynomial product = (f * f * g).scaled(cln::cl_RA(-3) / 2);
    const auto first = product.factors();
    EXPECT_EQ(product.factors(), first);
    for (const Polynomial& own : {f, g, f.scaled(cln::cl_RA(-5) / 7)}) {
      for (int k = 0; k < 2; ++k) {
        const auto factors = own.factors();
        ASSERT_EQ(factors.size(), 2U);
        EXPECT_TRUE(factors[0].first.is_constant());
        EXPECT_EQ(factors[0].first * factors[1].first, own);
      }
    }
  }
}

}  // namespace
}  // namespace casimir
