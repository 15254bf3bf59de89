// What the integrals of a Lax pair are enough for: Liouville's count of a spectrum.
#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

/// Of the only Lax pair, which is proved.
Proof lax_of(const Model& model) {
  Candidates candidates;
  candidates.only = casimir::ClaimKind::lax;
  const std::vector<Proof> proofs = prove(model, candidates);
  const auto own = std::ranges::find(proofs, casimir::ClaimKind::lax, &Proof::kind);
  EXPECT_NE(own, proofs.end());
  EXPECT_EQ(own->verdict, Verdict::proved) << own->reason << own->residual;
  return *own;
}

SpectrumCount count_of(const Model& model) {
  const Proof proof = lax_of(model);
  EXPECT_TRUE(proof.spectrum.has_value());
  return proof.spectrum.value_or(SpectrumCount{});
}

/// A diagonal L of integrals, and A = 0.
std::string diagonal(const std::vector<std::string>& integrals) {
  std::string l, a;
  for (std::size_t i = 0; i < integrals.size(); ++i) {
    l += i == 0 ? "[" : ", [";
    a += i == 0 ? "[" : ", [";
    for (std::size_t j = 0; j < integrals.size(); ++j) {
      l += std::string(j == 0 ? "" : ", ") + "\"" + (i == j ? integrals[i] : "0") + "\"";
      a += j == 0 ? "\"0\"" : ", \"0\"";
    }
    l += "]";
    a += "]";
  }
  return "[[lax]]\nL = [" + l + "]\nA = [" + a + "]\n";
}

/// Two free particles on a line.
Model free_particles(const std::string& lax) {
  return model_of(
      "hamiltonian = \"(p1^2 + p2^2)/2\"\n[phase_space]\nvariables = [\"q1\", \"q2\", "
      "\"p1\", \"p2\"]\ncanonical = true\n" +
      lax);
}

/// The pair of Goryachev and Chaplygin is complex, and its spectrum real: I^2 is -1. What is zero
/// on (M, g) = 0 is none of its integrals.
TEST(SpectrumCount, OfAComplexPairMayBeReal) {
  const Proof proof = lax_of(bundled("goryachev-chaplygin-lax"));
  EXPECT_EQ(proof.integrals.size(), 3U);
  for (const std::string& integral : proof.integrals)
    EXPECT_EQ(integral.find('I'), std::string::npos) << integral;
  ASSERT_TRUE(proof.spectrum);
  EXPECT_EQ(proof.spectrum->verdict, Verdict::proved) << proof.spectrum->reason;
}

// One at a = 0 and two at a = 1, the only values.
TEST(SpectrumCount, ARankThatDiffersFromPieceToPieceIsNotSaid) {
  const auto evidence = [](const std::string& assume) {
    return lax_of(
               free_particles("[parameters]\na = { " + assume + " }\n" + diagonal({"a*p1", "p2"})))
        .evidence;
  };
  EXPECT_NE(evidence("assume = \"a > 0\"").find(", 2 independent"), std::string::npos);
  EXPECT_EQ(evidence("assume = \"a^2*(a - 1)^2 <= 0\"").find("independent"), std::string::npos);
}

TEST(SpectrumCount, OfLagrangesTopIsEnough) {
  const SpectrumCount count = count_of(bundled("lagrange-lax"));
  EXPECT_EQ(count.involution, Verdict::proved);
  EXPECT_EQ(count.leaf, 4U);
  EXPECT_EQ(count.on_leaves, 2U);
  EXPECT_EQ(count.verdict, Verdict::proved) << count.reason;
}

TEST(SpectrumCount, OfTheEnergyAloneIsNotEnough) {
  const SpectrumCount count = count_of(free_particles(diagonal({"p1^2 + p2^2"})));
  EXPECT_EQ(count.involution, Verdict::proved);
  EXPECT_EQ(count.on_leaves, 1U);
  EXPECT_EQ(count.verdict, Verdict::refuted);
}

/// Dependent ones are not counted twice, and Casimir functions not at all.
TEST(SpectrumCount, IsOfIndependentFlows) {
  const SpectrumCount count =
      count_of(free_particles(diagonal({"p1^2 + p2^2", "(p1^2 + p2^2)^2"})));
  EXPECT_EQ(count.on_leaves, 1U);
  EXPECT_EQ(count.verdict, Verdict::refuted);
  const SpectrumCount casimir = count_of(model_of(
      "hamiltonian = \"a1*M1^2 + M2^2\"\n[phase_space]\nvariables = [\"M1\", \"M2\", \"M3\"]\n"
      "algebra = \"so(3)\"\n[parameters]\na1 = {}\n" +
      diagonal({"M1^2 + M2^2 + M3^2"})));
  EXPECT_EQ(casimir.on_leaves, 0U);
  EXPECT_EQ(casimir.verdict, Verdict::refuted);
}

/// The momentum and the angular momentum of a plane are two, and do not commute.
TEST(SpectrumCount, OfWhatDoesNotCommuteIsOpen) {
  const SpectrumCount count = count_of(free_particles(diagonal({"p1", "q1*p2 - q2*p1"})));
  EXPECT_EQ(count.involution, Verdict::refuted);
  EXPECT_EQ(count.on_leaves, 2U);
  EXPECT_EQ(count.verdict, Verdict::undecided);
  EXPECT_FALSE(count.reason.empty());
}

/// A complex function commutes with itself, and its parts need not commute.
TEST(SpectrumCount, OfComplexFunctionsIsOpen) {
  const SpectrumCount count =
      count_of(free_particles(diagonal({"p1 + I*(q1*p2 - q2*p1)", "p1^2 + p2^2"})));
  EXPECT_EQ(count.verdict, Verdict::undecided);
  EXPECT_NE(count.reason.find("complex"), std::string::npos);
}

/// p1 + |p1| is 2*p1 on one half of the plane, and zero on the other, where nothing is left of it.
TEST(SpectrumCount, IsAboutEveryPiece) {
  const SpectrumCount count = count_of(
      model_of("hamiltonian = \"p1^2/2\"\n[phase_space]\nvariables = [\"q1\", \"p1\"]\ncanonical = "
               "true\n" +
               diagonal({"p1 + abs(p1)"})));
  EXPECT_NE(count.verdict, Verdict::proved);
}

TEST(SpectrumCount, IsNotMadeOnALevelThatIsNoUnionOfLeaves) {
  const SpectrumCount count = count_of(model_of(
      "hamiltonian = \"(p1^2 + p2^2)/2\"\n[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", "
      "\"p2\"]\ncanonical = true\n[[lax]]\non = [\"p2\"]\nL = [[\"p1 + "
      "q2*p2\"]]\nA = [[\"0\"]]\n"));
  EXPECT_EQ(count.verdict, Verdict::undecided);
  EXPECT_EQ(count.leaf, 0U);
}

/// The spectral parameter stands in a function of the state: each of its values gives another
/// integral, here p1 + p2, p1^2 + p2^2, .. in powers of 1/s.
TEST(SpectrumCount, IsNotMadeOfFunctionsOfTheSpectralParameter) {
  for (const char* entry : {"1/(s - p1) + 1/(s - p2)", "p1/(1 + s*p2)", "exp(s*p1) + exp(s*p2)",
                            "1/(s - p1) + 1/(s - q1*p2 + q2*p1)"}) {
    const SpectrumCount count = count_of(free_particles("[[lax]]\nL = [[\"" + std::string(entry) +
                                                        "\"]]\nA = [[\"0\"]]\nspectral = \"s\"\n"));
    EXPECT_EQ(count.verdict, Verdict::undecided) << entry;
    EXPECT_EQ(count.involution, Verdict::undecided) << entry;
  }
}

/// Van der Pol's equation, with a limit cycle, by a bracket that has no leaves.
TEST(SpectrumCount, NeedsTheJacobiIdentity) {
  const Model model = model_of(
      "hamiltonian = \"z\"\nintegrable = true\n[phase_space]\nvariables = [\"x\", \"y\", \"z\", "
      "\"w\"]\n[phase_space.brackets]\n\"x,z\" = \"y\"\n\"y,z\" = \"-x + (1 - x^2)*y\"\n\"x,w\" = "
      "\"1\"\n" +
      diagonal({"z", "w"}));
  EXPECT_EQ(count_of(model).verdict, Verdict::undecided);
  for (const Proof& proof : prove(model))
    if (proof.kind == casimir::ClaimKind::liouville) EXPECT_NE(proof.verdict, Verdict::proved);
}

/// For a < -1000 the leaves are planes, and one integral is enough.
TEST(SpectrumCount, IsNotRefutedWhereLeavesMayBeSmaller) {
  const SpectrumCount count = count_of(model_of(
      "hamiltonian = \"p1^2/2\"\n[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", \"p2\"]\n"
      "[phase_space.brackets]\n\"q1,p1\" = \"1\"\n\"q2,p2\" = \"a + 1000 + abs(a + 1000)\"\n"
      "[parameters]\na = {}\n" +
      diagonal({"p1"})));
  EXPECT_EQ(count.verdict, Verdict::undecided);
}

/// On p2 = 0 the second function is a constant.
TEST(SpectrumCount, IsNotMadeOnConstraints) {
  const Model model = model_of(
      "hamiltonian = \"(p1^2 + p2^2)/2\"\n[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", "
      "\"p2\"]\ncanonical = true\nconstraints = [\"p2\"]\n" +
      diagonal({"p1", "p2"}));
  EXPECT_EQ(count_of(model).verdict, Verdict::undecided);
}

TEST(SpectrumCount, IsOfARealMotion) {
  const Model model = model_of(
      "hamiltonian = \"I*(p1^2 + p2^2)/2\"\n[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", "
      "\"p2\"]\ncanonical = true\n" +
      diagonal({"p1", "p2"}));
  EXPECT_EQ(count_of(model).verdict, Verdict::undecided);
}

/// Two bodies that a third, which rests at c, turns: p1 and p2 are integrals where c = 0 alone.
std::string on_level(const std::string& brackets, const std::string& hamiltonian,
                     const std::string& level, const std::vector<std::string>& integrals) {
  return "hamiltonian = \"" + hamiltonian +
         "\"\n[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", \"p2\", \"c\"]\n"
         "[phase_space.brackets]\n" +
         brackets + diagonal(integrals) + "on = [\"" + level + "\"]\n";
}
const std::string canonical_with_c = "\"q1,p1\" = \"1\"\n\"q2,p2\" = \"1\"\n";

TEST(SpectrumCount, OnALevelIsAroundAPoint) {
  const SpectrumCount count = count_of(
      model_of(on_level(canonical_with_c, "(p1^2 + p2^2)/2 + c*q1*q2^3", "c", {"p1", "p2"})));
  EXPECT_EQ(count.verdict, Verdict::proved) << count.reason;
  EXPECT_EQ(count.leaf, 4U);
  EXPECT_EQ(count.on_leaves, 2U);
  EXPECT_NE(count.at.find("c = 0"), std::string::npos) << count.at;
}

/// Integrals that do not commute on the level, and one that is no Casimir function's.
TEST(SpectrumCount, OnALevelAsksForAllHypotheses) {
  const SpectrumCount turning = count_of(model_of(
      on_level(canonical_with_c, "(p1^2 + p2^2)/2 + c*q1*q2^3", "c", {"p1", "q1*p2 - q2*p1"})));
  EXPECT_EQ(turning.verdict, Verdict::undecided);
  const SpectrumCount other = count_of(
      model_of(on_level(canonical_with_c, "(p1^2 + p2^2)/2 + p1*q2^3", "p1", {"p1 + p2", "c"})));
  EXPECT_EQ(other.verdict, Verdict::undecided);
}

/// {q1, p1} = c: the leaves in c = 0 are smaller than all others.
TEST(SpectrumCount, OnALevelOfSmallerLeavesIsNotKnown) {
  const SpectrumCount count = count_of(model_of(on_level(
      "\"q1,p1\" = \"c\"\n\"q2,p2\" = \"1\"\n", "(p1^2 + p2^2)/2 + c*q1*q2^3", "c", {"p1", "p2"})));
  EXPECT_EQ(count.verdict, Verdict::undecided);
  EXPECT_NE(count.reason.find("leaves"), std::string::npos) << count.reason;
}

}  // namespace
}  // namespace casimir::test
