#include "symbolic/proof/generic_rank.hpp"

#include <gtest/gtest.h>

#include "symbolic/proof/parameter_minors.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

/// Matrices over the functions of four variables.
class GenericRanks : public testing::Test {
 protected:
  PolynomialRows rows(const std::vector<std::vector<std::string>>& texts) {
    PolynomialRows result;
    for (const auto& row : texts) {
      result.emplace_back();
      for (const std::string& text : row)
        result.back().push_back(prover_.ring().convert(value(text)));
    }
    return result;
  }
  std::optional<GenericRank> rank_of(const std::vector<std::vector<std::string>>& texts) {
    return generic_rank(prover_, rows(texts));
  }

  GiNaC::ex value(const std::string& text) { return model_.parse({text, {"test", 1, 1}, text}); }

  Model model_ = model_of(
      "[phase_space]\nvariables = [\"a\",\"b\",\"c\",\"d\"]\n[equations]\na = \"sin(a)/b\"\n"
      "b = \"cos(a)/(a - b)\"\nc = \"sqrt(1 + c^2)\"\nd = \"0\"\n");
  Prover prover_{model_, {}};
};

TEST_F(GenericRanks, FullRankNeedsNoMinors) {
  const auto found = rank_of({{"a", "b"}, {"c", "d"}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->rank, 2U);
  EXPECT_TRUE(found->exact);
}

TEST_F(GenericRanks, DependentRowsAreShownToBe) {
  // The third row is c times the first plus d times the second.
  const auto found =
      rank_of({{"a", "b", "1"}, {"b", "d", "a"}, {"a*c + b*d", "b*c + d^2", "c + a*d"}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->rank, 2U);
  EXPECT_TRUE(found->exact);
  const auto bent =
      rank_of({{"a", "b", "1"}, {"b", "d", "a"}, {"a*c + b*d", "b*c + d^2", "c + a*d + 1"}});
  EXPECT_EQ(bent->rank, 3U);
}

TEST_F(GenericRanks, WideAndTallMatrices) {
  const std::vector<std::vector<std::string>> wide = {
      {"a", "b", "c", "d"}, {"a*b", "b^2", "b*c", "b*d"}, {"1", "a", "a^2", "a^3"}};
  std::vector<std::vector<std::string>> tall(4);
  for (const auto& row : wide) {
    for (std::size_t j = 0; j < row.size(); ++j) tall[j].push_back(row[j]);
  }
  for (const auto& matrix : {wide, tall}) {
    const auto found = rank_of(matrix);
    EXPECT_EQ(found->rank, 2U);
    EXPECT_TRUE(found->exact);
  }
}

TEST_F(GenericRanks, ZeroMatrix) {
  const auto found = rank_of({{"0", "0"}, {"0", "a - a"}});
  EXPECT_EQ(found->rank, 0U);
  EXPECT_TRUE(found->exact);
}

TEST_F(GenericRanks, RelationsAndDenominatorsCount) {
  // Proportional by sin^2 + cos^2 = 1 only.
  const auto found = rank_of({{"1 - sin(a)^2", "cos(a)/b"}, {"b*cos(a)", "1"}});
  EXPECT_EQ(found->rank, 1U);
  EXPECT_TRUE(found->exact);
  EXPECT_EQ(rank_of({{"1 - sin(a)^2", "cos(a)/b"}, {"b*cos(a)", "2"}})->rank, 2U);
  EXPECT_EQ(rank_of({{"sqrt(1 + c^2)", "1 + c^2"}, {"1", "sqrt(1 + c^2)"}})->rank, 1U);
}

TEST_F(GenericRanks, SkewMatricesHaveEvenRank) {
  const auto found = rank_of({{"0", "-c", "b"}, {"c", "0", "-a"}, {"-b", "a", "0"}});
  EXPECT_EQ(found->rank, 2U);
  EXPECT_TRUE(found->exact);
}

TEST_F(GenericRanks, KernelCandidatesAreChecked) {
  // The rows are orthogonal to (b, -a, 0), not to the other candidates.
  const PolynomialRows matrix = rows({{"a", "b", "0"}, {"a*c", "b*c", "0"}, {"0", "0", "1"}});
  const auto with = [&](const std::vector<std::string>& vector,
                        const std::function<bool(std::size_t)>& orthogonal = {}) {
    int asked = 0;
    const auto found = generic_rank(prover_, matrix, [&] {
      ++asked;
      return std::vector<KernelCandidate>{{rows({vector})[0], orthogonal}};
    });
    EXPECT_EQ(found->rank, 2U);
    EXPECT_TRUE(found->exact);  // at the latest by minors
    return asked;
  };
  EXPECT_EQ(with({"b", "-a", "0"}), 1);
  EXPECT_EQ(with({"b", "a", "0"}), 1);
  EXPECT_EQ(with({"0", "0", "0"}), 1);
  // A matrix of full rank does not become less by what a candidate says.
  const auto full = generic_rank(prover_, rows({{"a", "0"}, {"0", "b"}}), [&] {
    return std::vector<KernelCandidate>{{rows({{"a", "b"}})[0], [](std::size_t) { return true; }}};
  });
  EXPECT_EQ(full->rank, 2U);
}

/// The rank of the gradients of functions of q1..q9, p1..p9, more than minors are tried for.
GenericRank canonical_rank(const std::vector<std::string>& functions) {
  std::string names;
  for (const char* letter : {"q", "p"}) {
    for (int i = 1; i <= 9; ++i)
      names += (names.empty() ? "\"" : ", \"") + (letter + std::to_string(i)) + "\"";
  }
  const Model model = model_of("hamiltonian = \"p1^2\"\n[phase_space]\nvariables = [" + names +
                               "]\ncanonical = true\n");
  Prover prover(model, {});
  std::vector<Polynomial> values;
  for (const std::string& f : functions)
    values.push_back(prover.ring().convert(model.parse({f, {"test", 1, 1}, f})));
  return *gradient_rank(prover, values);
}

TEST(GradientRank, FlowsOfCommutingFunctionsBoundIt) {
  std::vector<std::string> momenta;
  for (int i = 1; i <= 9; ++i) momenta.push_back("p" + std::to_string(i));
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = momenta;
    all.insert(all.end(), more.begin(), more.end());
    return canonical_rank(all);
  };
  EXPECT_EQ(with({"p1^2 + p2*p3"}).rank, 9U);
  EXPECT_TRUE(with({"p1^2 + p2*p3"}).exact);
  EXPECT_EQ(with({"p1^2 + p2*q3"}).rank, 10U);
  // The flows of p2, .., p9 are left where p1 has its partner, and they are just enough.
  EXPECT_EQ(with({"q1", "p1*q1"}).rank, 10U);
  EXPECT_TRUE(with({"q1", "p1*q1"}).exact);
  // Where every function has its partner there is no flow, and nothing is shown.
  const GenericRank pairs =
      canonical_rank({"q1", "p1", "q2", "p2", "q3", "p3", "q4", "p4", "q5", "p5", "q1*p1 + q2"});
  EXPECT_EQ(pairs.rank, 10U);
  EXPECT_FALSE(pairs.exact);
}

TEST_F(GenericRanks, TooMuchWorkIsNotAProof) {
  // Six rows and columns, five of the rows long and independent, and the last one their sum.
  std::vector<std::vector<std::string>> matrix(6, std::vector<std::string>(6));
  const std::string nodes[] = {"a", "b", "c", "d", "(a + b)"};
  for (std::size_t j = 0; j < 6; ++j) {
    for (std::size_t i = 0; i < 5; ++i) {
      matrix[i][j] = "(a + b + c + d + 1)^7 + " + nodes[i] + "^" + std::to_string(j + 1);
      matrix[5][j] += (i > 0 ? " + " : "") + matrix[i][j];
    }
  }
  const auto found = rank_of(matrix);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->rank, 5U);
  EXPECT_FALSE(found->exact);
}

// Modulo a prime the rank may be smaller, and is never larger.
TEST(MatrixModulo, HasNoLargerRankThanOverTheRationalNumbers) {
  const PolynomialRing ring(2);
  const Polynomial x = ring.variable(0), y = ring.variable(1), zero(ring);
  const MatrixModulo matrix({{x, y}, {x * x, x * y}});
  const auto at = [&](const GiNaC::ex& a, const GiNaC::ex& b) { return matrix.rank_at({a, b}); };
  EXPECT_EQ(at(1, 2), 1U);
  EXPECT_EQ(at(0, 0), 0U);
  EXPECT_EQ(at(GiNaC::sqrt(GiNaC::ex(2)), 0), 0U) << "has no residue";
  EXPECT_EQ(MatrixModulo({{x, y}, {y, x}}).rank_at({GiNaC::ex(1) / 3, 2}), 2U);
  EXPECT_EQ(MatrixModulo({{x, y}, {y, x}}).rank_at({-5, 5}), 1U);
  EXPECT_EQ(MatrixModulo({{zero, zero}}).rank_at({1, 1}), 0U);
}

}  // namespace
}  // namespace casimir::test
