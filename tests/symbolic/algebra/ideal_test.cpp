// Groebner bases, and what claims on a level owe to them.
#include "symbolic/algebra/ideal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

/// The scalar products of the columns of a 3 x 3 matrix of variables, as for a rotation.
class Orthogonal : public testing::Test {
 protected:
  Polynomial x(std::size_t row, std::size_t column) const {
    return ring_.variable(3 * column + row);
  }

  std::vector<Polynomial> relations() const {
    std::vector<Polynomial> result;
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = a; b < 3; ++b) {
        Polynomial sum = ring_.constant(a == b ? -1 : 0);
        for (std::size_t i = 0; i < 3; ++i) sum += x(i, a) * x(i, b);
        result.push_back(sum);
      }
    }
    return result;
  }

  Polynomial determinant() const {
    Polynomial sum(ring_);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      sum += x(i, 0) * (x(j, 1) * x(k, 2) - x(k, 1) * x(j, 2));
    }
    return sum;
  }

  bool contains(const std::vector<Polynomial>& basis, const Polynomial& p) const {
    std::vector<Polynomial> quotients;
    return p.remainder(basis, &quotients).is_zero();
  }

  PolynomialRing ring_{9};
};

TEST(Groebner, BasisHasEveryGeneratorAndEveryPair) {
  std::mt19937_64 random(11);
  const PolynomialRing ring(5);
  for (int round = 0; round < 300; ++round) {
    std::vector<Polynomial> generators;
    for (int k = 0; k < 4; ++k) {
      Polynomial sum(ring);
      for (int t = 0; t < 3; ++t) {
        const auto number = static_cast<int>(random() % 5) - 2;
        sum += (ring.variable(random() % 5) * ring.variable(random() % 5).pow(random() % 2))
                   .scaled(number);
      }
      if (!sum.is_zero()) generators.push_back(sum);
    }
    const std::vector<Polynomial> basis = groebner_basis(generators);
    std::vector<Polynomial> quotients;
    const auto is_in = [&](const Polynomial& p) {
      return p.remainder(basis, &quotients).is_zero();
    };
    for (const Polynomial& g : generators) EXPECT_TRUE(is_in(g)) << round;
    // Buchberger's criterion itself.
    for (const Polynomial& a : basis) {
      for (const Polynomial& b : basis) {
        const auto [number_a, powers_a] = a.term_list().front();
        const auto [number_b, powers_b] = b.term_list().front();
        Polynomial to_a = ring.constant(1 / number_a), to_b = ring.constant(1 / number_b);
        for (std::size_t i = 0; i < 5; ++i) {
          const unsigned long both = std::max(powers_a[i], powers_b[i]);
          to_a *= ring.variable(i).pow(both - powers_a[i]);
          to_b *= ring.variable(i).pow(both - powers_b[i]);
        }
        EXPECT_TRUE(is_in(a * to_a - b * to_b)) << round;
      }
    }
  }
}

TEST_F(Orthogonal, BasisDecidesWhatFollowsFromTheColumns) {
  const std::vector<Polynomial> basis = groebner_basis(relations());
  for (const Polynomial& relation : relations()) EXPECT_TRUE(contains(basis, relation));
  const Polynomial det = determinant();
  EXPECT_TRUE(contains(basis, det * det - ring_.constant(1)));
  EXPECT_FALSE(contains(basis, det - ring_.constant(1)));
  // The rows are orthonormal too.
  EXPECT_TRUE(contains(basis, x(0, 0) * x(1, 0) + x(0, 1) * x(1, 1) + x(0, 2) * x(1, 2)));
  EXPECT_FALSE(contains(basis, x(0, 0) * x(1, 0) + x(0, 1) * x(1, 1) - x(0, 2) * x(1, 2)));
}

TEST_F(Orthogonal, BasisOfNothingIsEmpty) {
  EXPECT_TRUE(groebner_basis({Polynomial(ring_)}).empty());
}

Verdict verdict_on(const std::string& on, const std::string& left, const std::string& right) {
  const Model model = model_of(
      "hamiltonian = \"p\"\n[phase_space]\nvariables = [\"x\",\"q\",\"y\",\"p\"]\ncanonical = "
      "true\n"
      "[[identity]]\nname = \"claim\"\nleft = \"" +
      left + "\"\nright = \"" + right + "\"\non = [\"" + on + "\"]\n");
  for (const Proof& proof : prove(model)) {
    if (proof.name == "claim") return proof.verdict;
  }
  return Verdict::undecided;
}

TEST(Level, FunctionsKeepTheirRelationsOnIt) {
  EXPECT_EQ(verdict_on("x - cos(q)", "x^2", "1 - sin(q)^2"), Verdict::proved);
  EXPECT_NE(verdict_on("x - cos(q)", "x^2", "1 + sin(q)^2"), Verdict::proved);
  EXPECT_EQ(verdict_on("cos(q) - 1", "x*sin(q)^2", "0"), Verdict::proved);
  EXPECT_EQ(verdict_on("sqrt(x^2 + y^2) - 1", "x^2 + y^2", "1"), Verdict::proved);
  EXPECT_NE(verdict_on("sqrt(x^2 + y^2) - 1", "x^2 - y^2", "1"), Verdict::proved);
}

TEST(Level, RootsAreSimplifiedOnIt) {
  const auto verdict = [](const std::string& domain, const std::string& right) {
    const Model model = model_of(
        "hamiltonian = \"p\"\n[phase_space]\nvariables = [\"q\",\"p\"]\ncanonical = true\n"
        "domain = [" +
        domain +
        "]\n[[identity]]\nname = \"claim\"\nleft = \"sqrt(q^2 - p^2)\"\n"
        "right = \"" +
        right + "\"\non = [\"p\"]\n");
    const std::vector<Proof> proofs = prove(model);
    return std::find_if(proofs.begin(), proofs.end(),
                        [](const Proof& proof) { return proof.name == "claim"; })
        ->verdict;
  };
  EXPECT_EQ(verdict("\"q > 0\"", "q"), Verdict::proved);
  EXPECT_EQ(verdict("\"q < 0\"", "-q"), Verdict::proved);
  EXPECT_EQ(verdict("", "sqrt(q^2)"), Verdict::proved);
  EXPECT_EQ(verdict("", "q"), Verdict::refuted);
  EXPECT_EQ(verdict("\"q < 0\"", "q"), Verdict::refuted);
}

TEST(Level, WhatIsZeroOnlyByItsSquareIsZero) {
  EXPECT_EQ(verdict_on("cos(q) - 1", "sin(q)", "0"), Verdict::proved);
  EXPECT_EQ(verdict_on("(x - y)^2", "x", "y"), Verdict::proved);
  EXPECT_NE(verdict_on("cos(q)", "sin(q)", "1"), Verdict::proved);
}

}  // namespace
}  // namespace casimir::test
