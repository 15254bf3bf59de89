// Where a verdict holds: only what the claim itself speaks of has to have values, and all of that.
// Each test drops a hypothesis; without the check beside it, the verdict was a false one.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

/// The proof of the claim of a kind with this name, or with any.
Proof proof_in(const std::string& text, const std::string& kind, const std::string& name = "") {
  for (Proof& proof : prove(model_of(text)))
    if (to_string(proof.kind) == kind && (name.empty() || proof.name == name))
      return std::move(proof);
  ADD_FAILURE() << "no claim of the kind " << kind;
  return {};
}

Verdict verdict_in(const std::string& text, const std::string& kind, const std::string& name = "") {
  return proof_in(text, kind, name).verdict;
}

/// n degrees of freedom with a Hamiltonian.
std::string canonical(const std::string& hamiltonian, const std::string& more, int n = 3) {
  std::string variables;
  for (const char* letter : {"q", "p"})
    for (int i = 1; i <= n; ++i)
      variables +=
          (variables.empty() ? "\"" : ", \"") + std::string(letter) + std::to_string(i) + "\"";
  return "hamiltonian = \"" + hamiltonian + "\"\n[phase_space]\nvariables = [" + variables +
         "]\ncanonical = true\n" + more;
}

std::string identity(const std::string& left, const std::string& right,
                     const std::string& on = "") {
  return "[[identity]]\nname = \"i\"\nleft = \"" + left + "\"\nright = \"" + right + "\"\n" +
         (on.empty() ? "" : "on = [\"" + on + "\"]\n");
}

TEST(Domains, OfTheHamiltonianBoundsTheFactsAboutIt) {
  // H has values for q3 > 100 only, where F is 0: arc tangents of x and 1/x add up to a right
  // angle.
  const std::string integrals =
      "[integrals]\nF = \"p2*(atan(q3-99) + atan(1/(q3-99)) - Pi/2)\"\nG = \"q2*0 + p3*0 + q3\"\n";
  const std::string inside = canonical("p1^2/2 + 0*q1 + exp(log(q3 - 100)) - q3", integrals);
  EXPECT_NE(verdict_in(inside, "liouville"), Verdict::proved);
  EXPECT_NE(verdict_in(inside, "independence"), Verdict::proved);
  // Nowhere at all.
  const std::string nowhere =
      canonical("p1^2/2 + 0*sqrt(-1-q3^2)", "[integrals]\nF = \"p2\"\nG = \"q3\"\n");
  EXPECT_NE(verdict_in(nowhere, "liouville"), Verdict::proved);
  EXPECT_EQ(verdict_in(canonical("p1^2/2", "[integrals]\nF = \"p2\"\nG = \"q3\"\n"), "liouville"),
            Verdict::proved);
}

TEST(Domains, OfALagrangianAndOfAFrameBoundTheMotion) {
  const auto body = [](const std::string& head, const std::string& px) {
    return head +
           "[phase_space]\nvariables = [\"x\",\"y\",\"px\",\"py\"]\n[phase_space.vector_fields]\n"
           "coordinates = [\"x\",\"y\"]\nmomenta = [\"px\",\"py\"]\npx = { x = \"" +
           px +
           "\" }\npy = { y = \"1\" }\n"
           "[integrals]\nF = \"py + (abs(x) - x)*y\"\n";
  };
  EXPECT_EQ(verdict_in(body("lagrangian = \"(w1^2+w2^2)/2 - exp(log(x))\"\n", "1"), "integral"),
            Verdict::proved);
  EXPECT_EQ(verdict_in(body("lagrangian = \"(w1^2+w2^2)/2 - x\"\n", "1"), "integral"),
            Verdict::refuted);
  EXPECT_EQ(verdict_in(body("hamiltonian = \"(px^2+py^2)/2\"\n", "exp(log(x))"), "integral"),
            Verdict::proved);
  EXPECT_EQ(verdict_in(body("hamiltonian = \"(px^2+py^2)/2\"\n", "x"), "integral"),
            Verdict::refuted);
}

TEST(Domains, OfConstraintsBoundThePhaseSpace) {
  const auto on = [](const std::string& constraint) {
    return "[phase_space]\nvariables = [\"x\",\"z\"]\nconstraints = [\"" + constraint +
           "\"]\n[equations]\nx = \"0\"\nz = \"0\"\n" + identity("abs(x)", "x");
  };
  EXPECT_EQ(verdict_in(on("z*log(x)"), "identity"), Verdict::proved);
  EXPECT_EQ(verdict_in(on("z - exp(log(x)) + x"), "identity"), Verdict::proved);
  EXPECT_EQ(verdict_in(on("z*x"), "identity"), Verdict::refuted);
}

TEST(Domains, OfABracketAndOfHBoundTheIdentitiesWithThem) {
  const auto written = [](const std::string& entry, const std::string& left) {
    return "hamiltonian = \"y + exp(log(x))\"\n[phase_space]\nvariables = [\"x\",\"y\"]\n"
           "[phase_space.brackets]\n\"x,y\" = \"" +
           entry + "\"\n" + identity(left, "abs(x)");
  };
  EXPECT_EQ(verdict_in(written("exp(log(x))", "{x,y}"), "identity"), Verdict::proved);
  EXPECT_EQ(verdict_in(written("exp(log(x))", "rate(x)"), "identity"), Verdict::proved);
  EXPECT_EQ(verdict_in(written("1", "H - y"), "identity"), Verdict::proved);
  EXPECT_EQ(verdict_in(written("x", "{x,y}"), "identity"), Verdict::refuted);
}

TEST(Domains, OfOtherClaimsProveNothing) {
  // That x is not 0 where it has a logarithm.
  const std::string rest =
      "[phase_space]\nvariables = [\"x\",\"y\",\"z\"]\ndomain = [\"x >= 0\"]\n"
      "[equations]\nx = \"0\"\ny = \"0\"\nz = \"y\"\n[[conditional]]\nname = \"c\"\nexpression = "
      "\"z\"\non = [\"x*y\"]\n";
  EXPECT_EQ(verdict_in(rest + "[integrals]\nG = \"log(x)\"\n", "conditional"), Verdict::refuted);
  // That a radicand has no pole.
  const std::string divisor =
      "[phase_space]\nvariables = [\"x\",\"y\",\"w\"]\ndomain = [\"w*y^2 >= 0\"]\n"
      "[equations]\nx = \"0\"\ny = \"0\"\nw = \"0\"\n" +
      identity("abs(w)", "w");
  const std::string others =
      "[[identity]]\nname = \"a\"\nleft = \"sqrt(x^2/y^2)\"\nright = \"abs(x)/abs(y)\"\n"
      "[[identity]]\nname = \"b\"\nleft = \"sqrt(x^2+1)\"\nright = "
      "\"(x^2+1)^(1/4)*(x^2+1)^(1/4)\"\n";
  EXPECT_EQ(verdict_in(divisor + others, "identity", "i"), Verdict::refuted);
  // That the square of a root is its radicand, on a level where that is negative: z >= 0 is no
  // invariant relation.
  const std::string level =
      "[phase_space]\nvariables = [\"x\",\"y\",\"z\",\"s\"]\n[equations]\nx = \"0\"\ny = \"0\"\n"
      "z = \"s\"\ns = \"0\"\n[[invariant_relation]]\nname = \"r\"\nexpression = \"abs(z) - z\"\non "
      "= [\"x*y + 1\"]\n";
  EXPECT_NE(verdict_in(level + identity("sqrt(x*y)*sqrt(x*y)*sqrt(x*y)", "x*y*sqrt(x*y)"),
                       "invariant_relation", "r"),
            Verdict::proved);
}

TEST(Domains, OfIntegralsThatAreNotUsedAreSaid) {
  const std::string integrals =
      "[integrals]\nF = \"p2*(abs(q3) + q3)\"\nG = \"q3\"\nK = \"q2 + log(q3)\"\n";
  const Proof proof = proof_in(canonical("p1^2/2", integrals), "liouville");
  EXPECT_EQ(proof.verdict, Verdict::proved);
  EXPECT_EQ(proof.positive, std::vector<std::string>{"q3"});
}

/// What is said of where an identity in x, y and z holds.
std::set<std::string> conditions_of_identity(const std::string& left, const std::string& right) {
  const std::string claim =
      "[equations]\nx = \"1\"\ny = \"1\"\nz = \"1\"\n" + identity(left, right);
  const Proof proof =
      proof_in("[phase_space]\nvariables = [\"x\",\"y\",\"z\"]\n" + claim, "identity");
  EXPECT_EQ(proof.verdict, Verdict::proved) << left;
  std::set<std::string> result;
  for (const std::string& p : proof.positive) {
    const auto& strict = proof.not_zero;
    result.insert(p + (std::ranges::find(strict, p) != strict.end() ? " > 0" : " >= 0"));
  }
  for (const std::string& p : proof.nonzero) result.insert(p + " != 0");
  return result;
}

TEST(Domains, OfProductsUnderRootsAndLogarithmsAreSaid) {
  using Conditions = std::set<std::string>;
  EXPECT_EQ(conditions_of_identity("exp(log(x*y))", "x*y"), Conditions{"x*y > 0"});
  EXPECT_EQ(conditions_of_identity("sqrt(x*y)^2", "x*y"), Conditions{"x*y >= 0"});
  EXPECT_EQ(conditions_of_identity("sqrt(x*y)/sqrt(x*y)", "1"), Conditions{"x*y > 0"});
  EXPECT_EQ(conditions_of_identity("sqrt(x^2*y)^2", "x^2*y"), Conditions{"x^2*y >= 0"});
  EXPECT_EQ(conditions_of_identity("sqrt(-x^2)^2", "-x^2"), Conditions{"-x^2 >= 0"});
  EXPECT_EQ(conditions_of_identity("log(x*y*z) - log(z*y*x)", "0"), Conditions{"x*y*z > 0"});
}

TEST(Domains, OfLogarithmsAreWithoutTheZerosOfSquares) {
  using Conditions = std::set<std::string>;
  EXPECT_EQ(conditions_of_identity("exp(log(x^2))", "x^2"), Conditions{"x != 0"});
  EXPECT_EQ(conditions_of_identity("exp(log(x^2*y))", "x^2*y"), (Conditions{"x != 0", "y > 0"}));
  EXPECT_EQ(conditions_of_identity("exp(log(x^2 + y^2))", "x^2 + y^2"),
            Conditions{"x^2 + y^2 != 0"});
  EXPECT_EQ(conditions_of_identity("exp(log(x^2 + 1))", "x^2 + 1"), Conditions{});
  EXPECT_EQ(conditions_of_identity("sqrt(x)/sqrt(x)", "1"), Conditions{"x > 0"});
  // The roots say that neither is negative, the logarithm that neither is zero.
  EXPECT_EQ(conditions_of_identity("exp(log(x*y))*sqrt(x)*sqrt(y)", "x*y*sqrt(x)*sqrt(y)"),
            (Conditions{"x > 0", "y > 0"}));
}

TEST(Domains, OfAnglesAndEllipticFunctionsAreSaid) {
  using Conditions = std::set<std::string>;
  EXPECT_EQ(conditions_of_identity("atan2(x, y)", "atan2(x, y)"), Conditions{"x^2 + y^2 != 0"});
  EXPECT_EQ(conditions_of_identity("R_F(x, y, 1)", "R_F(y, 1, x)"), (Conditions{"x > 0", "y > 0"}));
  EXPECT_EQ(conditions_of_identity("sn(x, y)^2", "1 - cn(x, y)^2"),
            (Conditions{"y + 1 > 0", "-y + 1 > 0"}));
}

TEST(Domains, WithoutInsideSpeakForThePartOfTheirPoint) {
  const std::string thin = "domain = [\"(q2-1)*p2 = 0\"]\n[integrals]\nF = \"p2^2\"\n";
  for (const char* kind : {"independence", "liouville"}) {
    const Proof proof = proof_in(canonical("p1^2/2", thin, 2), kind);
    if (proof.verdict == Verdict::proved) EXPECT_FALSE(proof.where.empty()) << kind;
  }
  EXPECT_TRUE(
      proof_in(canonical("p1^2/2", "[integrals]\nF = \"p2^2\"\n", 2), "liouville").where.empty());
}

TEST(Domains, OfSeveralPiecesHaveOneSetOfIntegralsOrNone) {
  const std::string pieces =
      "[integrals]\nX = \"q2\"\nB = \"(abs(p1)+p1)*p3\"\nC = \"(abs(p1)-p1)*p3\"\n";
  EXPECT_EQ(verdict_in(canonical("p1^2/2", pieces), "liouville"), Verdict::undecided);
  const std::string same = "[integrals]\nX = \"q2\"\nB = \"(abs(p1)+1)*p3\"\n";
  EXPECT_EQ(verdict_in(canonical("p1^2/2", same), "liouville"), Verdict::proved);
}

TEST(Domains, OfComplexFunctionsAreNoneOfLiouville) {
  // The joint levels of q1 + I*p1 and q2 + I*p2 fix all four.
  const std::string complex = "[integrals]\nF = \"q1 + I*p1\"\nG = \"q2 + I*p2\"\n";
  EXPECT_EQ(verdict_in(canonical("p3", complex), "liouville"), Verdict::undecided);
  EXPECT_EQ(verdict_in(canonical("p3", "[integrals]\nF = \"p1\"\nG = \"p2\"\n"), "liouville"),
            Verdict::proved);
}

TEST(Domains, OfAComplexHamiltonianLeaveNothingToCount) {
  // q1 and q2 commute, and are no integrals.
  const std::string none = "[integrals]\nF = \"q1\"\nG = \"q2\"\nK = \"I*p3\"\n";
  EXPECT_NE(verdict_in(canonical("sqrt(p1^2 + p2^2 + 1)", none), "liouville"), Verdict::proved);
  const std::string two = "[integrals]\nF = \"q1\"\nG = \"q2\"\nK = \"I*p1\"\n";
  EXPECT_NE(verdict_in(canonical("sqrt(p1^2 + p2^2 + 1)", two, 2), "liouville"), Verdict::proved);
}

const Proof* finding_of(const Proof& note, const std::string& kind) {
  const auto found = std::ranges::find_if(
      note.findings, [&](const Proof& proof) { return to_string(proof.kind) == kind; });
  return found == note.findings.end() ? nullptr : &*found;
}

Proof judged(const std::string& text, const std::string& f) {
  Candidates candidates;
  candidates.integrals = {{f, {"--integral", 1, 1}, f}};
  return prove(model_of(text), candidates).back();
}

TEST(Domains, OfOtherFunctionsDoNotJudgeACandidate) {
  // p1 < 0, where the candidate is none.
  const Proof root = judged(canonical("p1^2/2 + p2^2/2", "[integrals]\nF = \"sqrt(p1)\"\n", 2),
                            "(abs(p1)-p1)*q1+p2");
  ASSERT_NE(finding_of(root, "integral"), nullptr);
  EXPECT_EQ(finding_of(root, "integral")->verdict, Verdict::refuted);
  // p2 > 0, where the candidate is 0.
  const std::string levels =
      "[integrals]\nF = \"p2\"\n[[conditional]]\nname = \"c\"\nexpression = \"q1\"\non = "
      "[\"p1*log(p2)\"]\n";
  const Proof level = judged(canonical("p1^2/2 + p2^2/2", levels, 2), "abs(p2)-p2");
  ASSERT_NE(finding_of(level, "casimir"), nullptr);
  EXPECT_EQ(finding_of(level, "casimir")->verdict, Verdict::refuted);
  ASSERT_NE(finding_of(level, "independence"), nullptr);
  EXPECT_NE(finding_of(level, "independence")->reason, "it is a constant");
}

TEST(Domains, InPartsMakeAGradientOfZeroNoConstant) {
  const std::string text = canonical("p1^2/2 + p2^2/2", "", 2);
  // Half a turn or minus one and a half.
  const Proof* angle = nullptr;
  const Proof note = judged(text, "atan2(p1,p2)+atan2(p2,p1)");
  ASSERT_NE(angle = finding_of(note, "independence"), nullptr);
  EXPECT_NE(angle->reason, "it is a constant");
  const Proof constant = judged(text, "(p1+1)^2 - p1^2 - 2*p1");
  ASSERT_NE(finding_of(constant, "independence"), nullptr);
  EXPECT_EQ(finding_of(constant, "independence")->reason, "it is a constant");
}

TEST(Domains, OfIndependenceAreSaidOfACandidate) {
  const Proof note = judged(canonical("p1^2/2", ""), "p2*(abs(q3-5000)-q3+5000)");
  const Proof* independence = finding_of(note, "independence");
  ASSERT_NE(independence, nullptr);
  EXPECT_TRUE(independence->verdict != Verdict::proved || !independence->where.empty())
      << independence->evidence;
}

TEST(Domains, OfWhatHasCancelledAreSaid) {
  const std::string parameter = "[parameters]\na = {}\n";
  const std::vector<std::string> nonzero = {"a"};
  // On a = 0 the level is everything, and q2 is not zero on it.
  EXPECT_EQ(verdict_in(canonical("p1^2/2", parameter + identity("q2", "0", "a*q2"), 2), "identity"),
            Verdict::refuted);
  const Proof quotient =
      proof_in(canonical("p1^2/2", parameter + identity("q2+a/a-1", "0", "a*q2"), 2), "identity");
  EXPECT_EQ(quotient.verdict, Verdict::proved);
  EXPECT_EQ(quotient.nonzero, nonzero);
  const std::string definition = "[definitions]\nk = \"a/a\"\n";
  const Proof defined = proof_in(
      canonical("p1^2/2", parameter + definition + identity("q2*k", "0", "a*q2"), 2), "identity");
  EXPECT_EQ(defined.nonzero, nonzero);
  // A Dirac bracket divides by the determinant a^2 of the constraints' brackets; no entry has it.
  const std::string dirac =
      "hamiltonian = \"p2^2/2\"\n[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", "
      "\"p2\"]\ncanonical = true\nconstraints = [\"a*q1\", \"p1\"]\ndirac = true\n" +
      parameter + "[integrals]\nF = \"p2\"\n";
  const Proof integral = proof_in(dirac, "integral", "F");
  EXPECT_EQ(integral.verdict, Verdict::proved);
  EXPECT_EQ(integral.nonzero, nonzero);
}

}  // namespace
}  // namespace casimir::test
