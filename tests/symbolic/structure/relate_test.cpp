// Linear isomorphisms of cases: algebras in changed bases, algebras that are alike and are none,
// and Hamiltonians. What is said of there being none is compared with the classification of Lie
// algebras of low dimension (Bianchi; Patera and Winternitz 1977).
#include "symbolic/structure/relate/relate.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "symbolic/structure/relate/invariants.hpp"
#include "symbolic/structure/relate/matching.hpp"
#include "symbolic/structure/relate/symmetries.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

using structure::relate;
using structure::Relation;

Model algebra(const std::string& name, const std::string& hamiltonian) {
  const std::string variables = name == "so(3)" || name == "sl(2)"
                                    ? R"("M1", "M2", "M3")"
                                    : R"("M1", "M2", "M3", "g1", "g2", "g3")";
  return model_of(
      fmt::format("hamiltonian = \"{}\"\n[phase_space]\nvariables = [{}]\nalgebra = \"{}\"\n",
                  hamiltonian, variables, name));
}

/// An algebra of three dimensions by its brackets.
Model constants(const std::string& ab, const std::string& bc, const std::string& ac) {
  return model_of(
      fmt::format("hamiltonian = \"a^2\"\n[phase_space]\nvariables = [\"a\", \"b\", "
                  "\"c\"]\n[phase_space.structure_constants]\n\"a,b\" = \"{}\"\n"
                  "\"b,c\" = \"{}\"\n\"a,c\" = \"{}\"\n",
                  ab, bc, ac));
}

Verdict brackets(const Model& a, const Model& b) { return relate(a, b, false).verdict; }

TEST(Relate, FindsTheRotationsInAnotherBasis) {
  // a = M1 + M2, b = M2, c = 2*M3 with {M1, M2} = -M3 and so on.
  const Model changed = constants("-c/2", "-2*(a - b)", "2*b - 2*(a - b)");
  EXPECT_EQ(brackets(algebra("so(3)", "M1^2"), changed), Verdict::proved);
}

TEST(Relate, NeedsASquareRootWhereTheBasesDifferByOne) {
  const Relation relation = relate(algebra("so(3)", "M1^2"), constants("2*c", "a", "-b"), false);
  ASSERT_EQ(relation.verdict, Verdict::proved);
  EXPECT_NE(relation.map[0].second.find("sqrt(2)"), std::string::npos);
}

TEST(Relate, TellsCompactFromNotCompactByTheKillingForm) {
  const Relation relation = relate(algebra("so(3)", "M1^2"), algebra("sl(2)", "M1^2"), false);
  EXPECT_EQ(relation.verdict, Verdict::refuted);
  ASSERT_FALSE(relation.differences.empty());
  EXPECT_EQ(relation.differences[0].name, "signature of the Killing form");
  for (const auto& [first, second] :
       {std::pair("so(4)", "so(3,1)"), std::pair("so(4)", "e(3)"), std::pair("e(3)", "so(3,1)")})
    EXPECT_EQ(brackets(algebra(first, "M1^2"), algebra(second, "M1^2")), Verdict::refuted);
}

TEST(Relate, TellsMembersOfBianchisFamilyApartAndFindsEqualOnes) {
  const auto member = [](const std::string& h) { return constants("b", "0", h + "*c"); };
  EXPECT_EQ(brackets(member("2"), member("1/2")), Verdict::proved);  // h and 1/h
  EXPECT_EQ(brackets(member("2"), member("3")), Verdict::refuted);
  EXPECT_EQ(brackets(member("2"), member("-2")), Verdict::refuted);
  EXPECT_EQ(brackets(member("1"), constants("b", "0", "b + c")), Verdict::refuted);
}

/// Complex rotations take one to the other: only the signature says that no real map does.
TEST(Relate, TakesTheSignatureAsAnInvariantOfRealMapsOnly) {
  const structure::LinearCase so3 = structure::linear_case(algebra("so(3)", "M1^2"), false);
  const structure::LinearCase sl2 = structure::linear_case(algebra("sl(2)", "M1^2"), false);
  const auto of_so3 = structure::linear_invariants(so3), of_sl2 = structure::linear_invariants(sl2);
  ASSERT_EQ(of_so3.size(), of_sl2.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < of_so3.size(); ++i) different += of_so3[i] == of_sl2[i] ? 0 : 1;
  EXPECT_EQ(different, 1U);
}

TEST(Relate, TakesHamiltoniansToEachOtherUpToAFactorAndCasimirFunctions) {
  const Relation relation = relate(algebra("so(3)", "M1^2 + 2*M2^2 + 3*M3^2"),
                                   algebra("so(3)", "3*M1^2 + 5*M2^2 + M3^2 + 7"), true);
  EXPECT_EQ(relation.verdict, Verdict::proved);
  EXPECT_EQ(relation.factor, "2");
  // The moments 1, 2, 3 have equal differences, and 1, 3, 7 have not.
  EXPECT_EQ(relate(algebra("so(3)", "M1^2 + 2*M2^2 + 3*M3^2"),
                   algebra("so(3)", "3*M1^2 + 7*M2^2 + M3^2"), true)
                .verdict,
            Verdict::refuted);
}

TEST(Relate, FindsATopInItsOtherAxes) {
  const Model top = algebra("e(3)", "M1^2 + M2^2 + 2*M3^2 - 2*g1");
  EXPECT_EQ(relate(top, algebra("e(3)", "M3^2 + M2^2 + 2*M1^2 - 2*g2"), true).verdict,
            Verdict::proved);
  EXPECT_EQ(relate(top, algebra("e(3)", "M1^2 + M2^2 + 3*M3^2 - 2*g1"), true).verdict,
            Verdict::refuted);
}

TEST(Relate, BringsConstantBracketsToNormalForm) {
  const Model canonical = model_of(
      "hamiltonian = \"q\"\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n");
  const Model scaled = model_of(
      "hamiltonian = \"u\"\n[phase_space]\nvariables = [\"u\", \"v\"]\n[phase_space.brackets]\n"
      "\"u,v\" = \"-3\"\n");
  EXPECT_EQ(brackets(canonical, scaled), Verdict::proved);
}

TEST(Relate, IsAboutPoissonBracketsAlone) {
  const Model none = constants("c", "b", "a");
  EXPECT_THROW(relate(none, none, false), ModelError);
}

TEST(Relate, AsksForNumbersInPlaceOfParameters) {
  EXPECT_THROW(relate(bundled("euler"), bundled("euler"), true), ModelError);
}

TEST(Symmetries, AreThoseOfNoether) {
  const auto report = structure::linear_symmetries(bundled("lagrange"));
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].integral, "M3");
  EXPECT_EQ(report.found[0].verdict, Verdict::proved);
  EXPECT_TRUE(report.complete);
  EXPECT_TRUE(structure::linear_symmetries(bundled("kovalevskaya")).found.empty());
}

// At a = 1, the only value, the rotation about the third axis is one.
TEST(Symmetries, OfParametersWithoutGenericValuesAreNotAll) {
  const Model top = model_of(R"toml(
hamiltonian = "M1^2 + a*M2^2 + 3*M3^2"
[phase_space]
variables = ["M1", "M2", "M3"]
algebra = "so(3)"
[parameters]
a = { assume = ["a >= 1", "a <= 1"] }
)toml");
  const auto report = structure::linear_symmetries(top);
  EXPECT_FALSE(report.complete);
  EXPECT_NE(report.reason.find("equality"), std::string::npos) << report.reason;
}

}  // namespace
}  // namespace casimir::test
