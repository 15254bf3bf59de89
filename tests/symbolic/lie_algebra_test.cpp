#include "symbolic/lie_algebra.hpp"

#include <gtest/gtest.h>

#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

std::string space(const std::string& algebra, std::size_t dimension, const std::string& more = "") {
  std::string text = "hamiltonian = \"x0^2\"\n" + more + "\n[phase_space]\nvariables = [";
  for (std::size_t i = 0; i < dimension; ++i) text += "\"x" + std::to_string(i) + "\",";
  return text + "]\nalgebra = \"" + algebra + "\"\n";
}

class NamedAlgebra
    : public testing::TestWithParam<std::tuple<const char*, std::size_t, const char*>> {};

TEST_P(NamedAlgebra, SatisfiesJacobiAndHasItsRank) {
  const auto [name, dimension, rank] = GetParam();
  ASSERT_EQ(find_lie_algebra(name)->dimension, dimension);
  for (const Proof& proof : prove(model_of(space(name, dimension)))) {
    if (proof.kind == ClaimKind::jacobi) {
      EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
    }
    if (proof.kind == ClaimKind::rank) {
      EXPECT_EQ(proof.name, rank);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, NamedAlgebra,
    testing::Values(std::tuple("so(3)", 3, "rank 2"), std::tuple("e(3)", 6, "rank 4"),
                    std::tuple("so(4)", 6, "rank 4"), std::tuple("so(3,1)", 6, "rank 4"),
                    std::tuple("l(7)", 7, "rank 6"), std::tuple("so(5)", 10, "rank 8"),
                    std::tuple("so(6)", 15, "rank 12"), std::tuple("e(4)", 10, "rank 8"),
                    std::tuple("so(3)+3*R3", 12, "rank 6"), std::tuple("so(3) + 2*R3", 9, "rank 6"),
                    std::tuple("sl(2)", 3, "rank 2"), std::tuple("h(3)", 3, "rank 2")));

TEST(LieAlgebra, BodyFrameConvention) {
  // {M1,M2} = -M3, {M1,g2} = -g3, and for so(4) {g1,g2} = -M3.
  const Model e3 = model_of(space("e(3)", 6));
  const auto& x = e3.variables;
  EXPECT_EQ((*e3.poisson)(0, 1), -x[2]);
  EXPECT_EQ((*e3.poisson)(0, 4), -x[5]);
  EXPECT_EQ((*e3.poisson)(0, 3), 0);
  EXPECT_EQ((*e3.poisson)(3, 4), 0);
  const Model so4 = model_of(space("so(4)", 6));
  EXPECT_EQ((*so4.poisson)(3, 4), -so4.variables[2]);
}

TEST(LieAlgebra, QuaternionsFollowTheBook) {
  // (1.65): {M1,l0} = l1/2, {M1,l1} = -l0/2, {M1,l2} = -l3/2.
  const Model model = model_of(space("l(7)", 7));
  const auto& x = model.variables;
  EXPECT_EQ((*model.poisson)(0, 3), x[4] / 2);
  EXPECT_EQ((*model.poisson)(0, 4), -x[3] / 2);
  EXPECT_EQ((*model.poisson)(0, 5), -x[6] / 2);
}

TEST(LieAlgebra, OtherSignConventionFlipsEveryBracket) {
  const Model minus = model_of(space("e(3)", 6));
  const Model plus = model_of(space("e(3)", 6) + "sign = \"+\"\n");
  EXPECT_EQ((*plus.poisson)(0, 1), plus.variables[2]);
  EXPECT_EQ((*minus.poisson)(0, 1), -minus.variables[2]);
}

TEST(LieAlgebra, UnknownNamesAreNotGuessed) {
  for (const char* name :
       {"so(2)", "so(99)", "e(2)", "E(3)", "so(3)+0*R3", "so(3)+R4", "", "so(3"}) {
    EXPECT_FALSE(find_lie_algebra(name).has_value()) << name;
  }
}

}  // namespace
}  // namespace casimir::test
