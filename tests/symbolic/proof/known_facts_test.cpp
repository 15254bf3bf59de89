// What `verify` says of a candidate beyond the claim itself.
#include <gtest/gtest.h>

#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

Model goryachev_chaplygin() {
  return model_of(
      "hamiltonian = \"(M1^2 + M2^2 + 4*M3^2)/2 - r*g1\"\n[phase_space]\nvariables = "
      "[\"M1\",\"M2\",\"M3\",\"g1\",\"g2\",\"g3\"]\nalgebra = \"e(3)\"\n[parameters]\nr = {}\n"
      "[casimirs]\nF1 = \"g1^2 + g2^2 + g3^2\"\nF2 = \"M1*g1 + M2*g2 + M3*g3\"\n");
}

Proof judgement(const Model& model, const std::string& f) {
  Candidates candidates;
  candidates.integrals = {{f, {"--integral", 1, 1}, f}};
  const std::vector<Proof> proofs = prove(model, candidates);
  EXPECT_EQ(proofs.size(), 2U);
  EXPECT_EQ(proofs.back().kind, casimir::ClaimKind::judgement);
  EXPECT_TRUE(proofs.back().note);
  return proofs.back();
}

const Proof* finding(const Proof& judgement, const std::string& kind) {
  for (const Proof& proof : judgement.findings) {
    if (to_string(proof.kind) == kind) return &proof;
  }
  return nullptr;
}

TEST(Judgement, ARelationSaysWhereItDeterminesTheCandidate) {
  // At a = 0 nothing follows from G = 0.
  const Model model = model_of(
      "hamiltonian = \"p1^2/2\"\n[phase_space]\nvariables = [\"q1\",\"q2\",\"p1\",\"p2\"]\n"
      "canonical = true\n[parameters]\na = {}\n[integrals]\nG = \"a*p2\"\n");
  const Proof note = judgement(model, "p2");
  const Proof* dependence = finding(note, "independence");
  ASSERT_NE(dependence, nullptr);
  EXPECT_NE(dependence->reason.find("where a != 0"), std::string::npos) << dependence->reason;
  const Proof plain = judgement(model, "2*p1^2");
  ASSERT_NE(finding(plain, "independence"), nullptr);
  EXPECT_EQ(finding(plain, "independence")->reason.find("where"), std::string::npos);
}

TEST(Judgement, DependentCandidateComesWithItsRelation) {
  const Proof note = judgement(goryachev_chaplygin(), "3*H^2 - r^2*F1 + F2/2");
  const Proof* dependence = finding(note, "independence");
  ASSERT_NE(dependence, nullptr);
  EXPECT_EQ(dependence->verdict, Verdict::refuted);
  EXPECT_NE(dependence->reason.find("= 1/2*F2 + 3*H^2 - F1*r^2"), std::string::npos)
      << dependence->reason;
}

TEST(Judgement, AlgebraicDependenceIsFoundToo) {
  const Proof* dependence = nullptr;
  const Proof note = judgement(goryachev_chaplygin(), "H*sqrt(F1)");
  dependence = finding(note, "independence");
  ASSERT_NE(dependence, nullptr);
  EXPECT_EQ(dependence->verdict, Verdict::refuted);
  EXPECT_NE(dependence->reason.find("(H*sqrt(F1))^2 - F1*H^2 = 0"), std::string::npos)
      << dependence->reason;
}

// The known functions may depend on each other: F - 2*H = 0 says nothing of p1.
TEST(Judgement, ARelationBetweenTheKnownFunctionsIsNoneOfTheCandidate) {
  const Model model = model_of(
      "hamiltonian = \"(p1^2 + p2^2)/2\"\n[phase_space]\nvariables = "
      "[\"q1\",\"q2\",\"p1\",\"p2\"]\ncanonical = true\n[integrals]\nF = \"p1^2 + p2^2\"\n");
  for (const char* f : {"p1", "q1*p2 - q2*p1", "p1^3 + p1*p2"}) {
    const Proof note = judgement(model, f);
    const Proof* dependence = finding(note, "independence");
    ASSERT_NE(dependence, nullptr);
    EXPECT_NE(dependence->verdict, Verdict::refuted) << f << ": " << dependence->reason;
  }
  const Proof note = judgement(model, "p1^2 + p2^2 + 1");
  EXPECT_EQ(finding(note, "independence")->verdict, Verdict::refuted);
}

// F = p1 + |p1| is 0 on half of the space, where p1 is no function of it.
TEST(Judgement, ARelationThatIsEmptyOnAPartOfTheDomainIsNone) {
  const Model model = model_of(
      "hamiltonian = \"p1^2 + p2^2\"\n[phase_space]\nvariables = "
      "[\"q1\",\"q2\",\"p1\",\"p2\"]\ncanonical = true\n[integrals]\nF = \"p1 + abs(p1)\"\n");
  for (const char* f : {"p1", "abs(p1) - p1", "abs(p2)"}) {
    const Proof note = judgement(model, f);
    const Proof* dependence = finding(note, "independence");
    ASSERT_NE(dependence, nullptr);
    EXPECT_NE(dependence->verdict, Verdict::refuted) << f << ": " << dependence->reason;
  }
  const Proof note = judgement(model, "(p1 + abs(p1))^2");
  EXPECT_EQ(finding(note, "independence")->verdict, Verdict::refuted);
}

TEST(Judgement, IndependenceHasConditionsOnParameters) {
  const Model model = model_of(
      "hamiltonian = \"p1^2\"\n[phase_space]\nvariables = [\"q1\",\"q2\",\"p1\",\"p2\"]\n"
      "canonical = true\n[parameters]\na = {}\n");
  const Proof note = judgement(model, "(sin(a) - 1/2)*p2");
  const Proof* dependence = finding(note, "independence");
  ASSERT_NE(dependence, nullptr);
  EXPECT_EQ(dependence->verdict, Verdict::proved);
  EXPECT_EQ(dependence->where, std::vector<std::string>{"2*sin(a) - 1 != 0"});
  EXPECT_EQ(dependence->evidence, "it is independent of H where 2*sin(a) - 1 != 0");
}

TEST(Judgement, IndependentIntegralIsSaidToBeOne) {
  const Model lagrange = model_of(
      "hamiltonian = \"(M1^2 + M2^2 + 2*M3^2)/2 - g3\"\n[phase_space]\nvariables = "
      "[\"M1\",\"M2\",\"M3\",\"g1\",\"g2\",\"g3\"]\nalgebra = \"e(3)\"\n");
  const Proof note = judgement(lagrange, "M3");
  const Proof* dependence = finding(note, "independence");
  ASSERT_NE(dependence, nullptr);
  EXPECT_EQ(dependence->verdict, Verdict::proved);
  const Proof* casimir = finding(note, "casimir");
  ASSERT_NE(casimir, nullptr);
  EXPECT_EQ(casimir->verdict, Verdict::refuted);
}

TEST(Judgement, CasimirIsRecognised) {
  const Proof note = judgement(goryachev_chaplygin(), "F1*F2");
  const Proof* casimir = finding(note, "casimir");
  ASSERT_NE(casimir, nullptr);
  EXPECT_EQ(casimir->verdict, Verdict::proved);
}

TEST(Judgement, IntegralOnAKnownLevelIsFound) {
  const Proof note = judgement(goryachev_chaplygin(), "M3*(M1^2 + M2^2) + r*M1*g3");
  EXPECT_EQ(finding(note, "integral")->verdict, Verdict::refuted);
  const Proof* on_level = finding(note, "conditional");
  ASSERT_NE(on_level, nullptr);
  EXPECT_EQ(on_level->on, std::vector<std::string>{"F2"});
  // The twin: with another sign it is an integral nowhere.
  EXPECT_EQ(finding(judgement(goryachev_chaplygin(), "M3*(M1^2 + M2^2) - r*M1*g3"), "conditional"),
            nullptr);
}

TEST(Judgement, ConstantIsSaidToBeOne) {
  const Proof note = judgement(goryachev_chaplygin(), "r^2 + 1");
  EXPECT_EQ(finding(note, "independence")->reason, "it is a constant");
}

// |z| is written as sqrt(z^2), which for complex z is z or -z: so it is refused, wherever the I is.
TEST(Candidates, AbsoluteValuesOfComplexNumbersAreRefused) {
  const Model model = goryachev_chaplygin();
  const auto verify = [&](const char* left) {
    Candidates candidates;
    candidates.identities = {{left, {"--identity", 1, 1}, left}};
    return prove(model, candidates);
  };
  for (const char* identity :
       {"abs(1 + I) = 1 + I", "abs(M1 + I*M2)^2 = (M1 + I*M2)^2", "sign(I) = 1", "I*abs(I) = I^2"})
    EXPECT_THROW(verify(identity), CaseError) << identity;
  EXPECT_EQ(verify("abs(M1)^2 = M1^2").front().verdict, Verdict::proved);
  EXPECT_EQ(verify("(M1 + I*M2)*(M1 - I*M2) = M1^2 + M2^2").front().verdict, Verdict::proved);
}

// A '#' in a string does not begin a comment, whichever its quotes are.
TEST(Candidates, TheImaginaryUnitIsSeenBehindEveryKindOfString) {
  const std::string space = "[phase_space]\nvariables = [\"x\"]\n[equations]\nx = \"0\"\n";
  const std::string rest = "\", right = \"-x^2\" }]\n";
  for (const char* name : {"'#'", "\"#\"", "'\"#'", "\"\\\"#\""}) {
    const std::string text = std::string("identity = [{ name = ") + name;
    EXPECT_THROW(model_of(text + ", left = \"abs(I*x)^2" + rest + space), CaseError) << name;
    EXPECT_NO_THROW(model_of(text + ", left = \"abs(x)^2" + rest + space)) << name;
  }
}

}  // namespace
}  // namespace casimir::test
