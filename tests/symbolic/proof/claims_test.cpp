// For each kind of claim one that holds and one that does not, by one sign, term or function.
#include <gtest/gtest.h>

#include <string>

#include "symbolic/proof/claims/claim_kinds.hpp"
#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/proof/proof_of.hpp"

namespace casimir::test {
namespace {

const std::string kE3 =
    "[phase_space]\nvariables = [\"M1\",\"M2\",\"M3\",\"g1\",\"g2\",\"g3\"]\nalgebra = \"e(3)\"\n";
const std::string kEuler =
    "hamiltonian = \"(a1*M1^2 + a2*M2^2 + a3*M3^2)/2\"\n[parameters]\na1 = {}\na2 = {}\na3 = {}\n";
const std::string kSo3 = "[phase_space]\nvariables = [\"M1\",\"M2\",\"M3\"]\nalgebra = \"so(3)\"\n";

struct Twins {
  const char* kind;
  std::string good, bad;
};

void PrintTo(const Twins& twins, std::ostream* stream) { *stream << twins.kind; }

class ClaimKind : public testing::TestWithParam<Twins> {};

TEST_P(ClaimKind, HoldsAndItsTwinIsRefutedByAWitness) {
  const auto& [kind, good, bad] = GetParam();
  const Proof proved = proof_of(model_of(good), kind);
  EXPECT_EQ(proved.verdict, Verdict::proved) << proved.reason << ' ' << proved.residual;
  const Proof refuted = proof_of(model_of(bad), kind);
  ASSERT_EQ(refuted.verdict, Verdict::refuted) << refuted.reason << ' ' << refuted.residual;
  const std::string kind_name = kind;
  if (kind_name == "independence" || kind_name == "liouville") {
    EXPECT_FALSE(refuted.reason.empty());
    return;
  }
  ASSERT_TRUE(refuted.witness.has_value());
  EXPECT_FALSE(refuted.witness->point.empty());
  EXPECT_NE(refuted.witness->value, "0");
}

std::vector<Twins> twins() {
  const std::string brackets =
      "hamiltonian = \"M1\"\n[phase_space]\nvariables = [\"M1\",\"M2\",\"M3\"]\n"
      "[phase_space.brackets]\n\"M1,M3\" = \"M2\"\n\"M2,M3\" = \"-M1\"\n";
  const std::string goryachev = "hamiltonian = \"(M1^2 + M2^2 + 4*M3^2)/2 - r*g1\"\n" + kE3 +
                                "[parameters]\nr = {}\n[[conditional]]\nname = \"G\"\n"
                                "on = [\"M1*g1 + M2*g2 + M3*g3\"]\n";
  const std::string hess = "hamiltonian = \"(M1^2 + M2^2 + 2*M3^2)/2 - r*g1\"\n" + kE3 +
                           "[parameters]\nr = {}\n[[invariant_relation]]\nname = \"delaunay\"\n"
                           "on = [\"M1*M2 + r*g2\"]\n";
  const std::string lax_head = kEuler + kSo3 +
                               "[[lax]]\nL = [[\"0\",\"M3\",\"-M2\"],[\"-M3\",\"0\",\"M1\"],"
                               "[\"M2\",\"-M1\",\"0\"]]\n";
  const std::string map_head = "hamiltonian = \"0\"\n" + kE3 +
                               "[[map]]\nname = \"shift\"\nto = \"e(3)\"\nexpressions = { M1 = "
                               "\"M1 - c*g2\", ";
  const std::string map_rest =
      ", M3 = \"M3\", g1 = \"g1\", g2 = \"g2\", g3 = \"g3\" }\n[parameters]\nc = {}\n";
  const std::string two =
      "hamiltonian = \"a11*M1^2/2 + a22*M2^2/2 + a12*M1*M2\"\n[phase_space]\n"
      "variables = [\"M1\",\"M2\"]\nstructure_constants = { \"M1,M2\" = \"M1\" "
      "}\n[parameters]\na11 = {}\na22 = {}\na12 = {}\n";
  return {
      {"jacobi", brackets + "\"M1,M2\" = \"-M3\"\n", brackets + "\"M1,M2\" = \"M1^2 - M3\"\n"},
      {"casimir", kEuler + kSo3 + "[casimirs]\nF = \"M1^2 + M2^2 + M3^2\"\n",
       kEuler + kSo3 + "[casimirs]\nF = \"M1^2 + M2^2 - M3^2\"\n"},
      {"integral", kEuler + kSo3 + "[integrals]\nF = \"a1*M1^2 + a2*M2^2 + a3*M3^2\"\n",
       kEuler + kSo3 + "[integrals]\nF = \"a1*M1^2 + a2*M2^2 + a2*M3^2\"\n"},
      {"conditional", goryachev + "expression = \"M3*(M1^2 + M2^2) + r*M1*g3\"\n",
       goryachev + "expression = \"M3*(M1^2 + M2^2) + r*M1*g2\"\n"},
      {"invariant_relation", hess + "expression = \"M1^2 - M2^2 + 2*r*g1\"\n",
       hess + "expression = \"M1^2 + M2^2 + 2*r*g1\"\n"},
      {"lax",
       lax_head + "A = [[\"0\",\"-a3*M3\",\"a2*M2\"],[\"a3*M3\",\"0\",\"-a1*M1\"],[\"-a2*M2\","
                  "\"a1*M1\",\"0\"]]\n",
       lax_head + "A = [[\"0\",\"-a3*M3\",\"a2*M2\"],[\"a3*M3\",\"0\",\"-a1*M1\"],[\"-a2*M2\","
                  "\"a3*M1\",\"0\"]]\n"},
      {"map", map_head + "M2 = \"M2 + c*g1\"" + map_rest,
       map_head + "M2 = \"M2 - c*g1\"" + map_rest},
      {"measure", two + "[[measure]]\ndensity = \"1/M1\"\n",
       two + "[[measure]]\ndensity = \"1\"\n"},
      {"involution", kEuler + kSo3 + "[integrals]\nF = \"M1^2 + M2^2 + M3^2\"\nG = \"M1\"\n",
       kEuler + kSo3 + "[integrals]\nF = \"M2\"\nG = \"M1\"\n"},
      {"independence", kEuler + kSo3 + "[casimirs]\nF = \"M1^2 + M2^2 + M3^2\"\n",
       kEuler + kSo3 + "[casimirs]\nF = \"M1^2 + M2^2 + M3^2\"\nG = \"(M1^2 + M2^2 + M3^2)^2\"\n"},
      {"identity",
       kEuler + kSo3 +
           "[[identity]]\nname = \"J\"\nleft = \"{M1, {M2, M3}} + {M2, {M3, "
           "M1}}\"\nright = \"-{M3, {M1, M2}}\"\n",
       kEuler + kSo3 + "[[identity]]\nname = \"J\"\nleft = \"{M1, M2}\"\nright = \"M3\"\n"},
  };
}

INSTANTIATE_TEST_SUITE_P(Each, ClaimKind, testing::ValuesIn(twins()),
                         [](const auto& twins) { return std::string(twins.param.kind); });

TEST(Claims, EachRowSaysWhatTheOthersOfItsKindAreCalled) {
  for (const ClaimRow& row : claim_rows()) {
    const std::string name = to_string(row.kind);
    EXPECT_EQ(claim_kind_of(name), row.kind) << name;
    EXPECT_EQ(claim_row(row.kind).name, name);
    if (row.name == nullptr) EXPECT_TRUE(row.read || row.read_of_map) << name;
    // What is asked about can be made, and a theorem is about something that is read.
    EXPECT_TRUE(row.candidates == nullptr || (row.make && row.make_of_map)) << name;
    EXPECT_TRUE(row.candidates == nullptr || (row.certify != nullptr) == (row.letter != nullptr))
        << name;
    EXPECT_TRUE(row.certify == nullptr || row.read != nullptr) << name;
  }
  EXPECT_EQ(claim_kind_of("no kind"), std::nullopt);
}

TEST(Claims, ARowTakesItsClaimsOutOfACase) {
  for (const auto& [kind, good, bad] : twins()) {
    Model model = model_of(good);
    const ClaimRow& row = claim_row(*claim_kind_of(kind));
    if (row.clear == nullptr) continue;
    EXPECT_FALSE(row.read(model).empty()) << kind;
    row.clear(model);
    EXPECT_TRUE(row.read(model).empty()) << kind;
  }
}

TEST(Claims, LiouvilleNamesWhatIsMissing) {
  const std::string lagrange = "hamiltonian = \"(M1^2 + M2^2 + 2*M3^2)/2 - g3\"\n" + kE3;
  const Proof missing = proof_of(model_of(lagrange), "liouville");
  EXPECT_EQ(missing.verdict, Verdict::undecided);
  EXPECT_NE(missing.reason.find("need 2 independent integrals in involution; 1 known"),
            std::string::npos)
      << missing.reason;
  const Proof found = proof_of(model_of(lagrange + "[integrals]\nL = \"M3\"\n"), "liouville");
  EXPECT_EQ(found.verdict, Verdict::proved) << found.reason;
}

TEST(Claims, LiouvilleIsCountedOnALevelOfCasimirsToo) {
  const auto goryachev_chaplygin = [](const std::string& g) {
    return model_of("hamiltonian = \"(M1^2 + M2^2 + 4*M3^2)/2 - r*g1\"\n" + kE3 +
                    "[parameters]\nr = {}\n[casimirs]\nF1 = \"g1^2 + g2^2 + g3^2\"\n"
                    "[[conditional]]\nname = \"G\"\nexpression = \"" +
                    g + "\"\non = [\"M1*g1 + M2*g2 + M3*g3\"]\n");
  };
  const auto on_level = [](const Model& model) {
    for (const Proof& proof : prove(model)) {
      if (proof.kind == casimir::ClaimKind::liouville && proof.note) return proof;
    }
    return Proof{};
  };
  const Proof found = on_level(goryachev_chaplygin("M3*(M1^2 + M2^2) + r*M1*g3"));
  EXPECT_EQ(found.verdict, Verdict::proved) << found.reason;
  EXPECT_EQ(found.on, std::vector<std::string>{"M1*g1 + M2*g2 + M3*g3"});
  // Twins: a function of H, and one that does not commute with H there.
  EXPECT_EQ(on_level(goryachev_chaplygin("((M1^2 + M2^2 + 4*M3^2)/2 - r*g1)^2")).verdict,
            Verdict::undecided);
  EXPECT_EQ(on_level(goryachev_chaplygin("M3*(M1^2 + M2^2) - r*M1*g3")).verdict,
            Verdict::undecided);
}

TEST(Claims, TheHamiltonianIsCalledHInTheFileToo) {
  const std::string rest =
      "[casimirs]\nF = \"M1^2 + M2^2 + M3^2\"\n[definitions]\nE2 = \"2*H\"\n[integrals]\nQ = "
      "\"H^2 + F\"\n[[identity]]\nname = \"twice\"\nleft = \"E2\"\nright = \"M1^2 + 2*M2^2\"\n";
  const Model model = model_of("hamiltonian = \"M1^2/2 + M2^2\"\n" + kSo3 + rest);
  EXPECT_EQ(proof_of(model, "integral").verdict, Verdict::proved);
  EXPECT_EQ(proof_of(model, "identity").verdict, Verdict::proved);
  // Not inside of itself.
  EXPECT_THROW(model_of("hamiltonian = \"M1^2 + E2\"\n" + kSo3 + rest), CaseError);
}

TEST(Claims, LaxPairGivesItsIntegralsIdenticallyInTheSpectralParameter) {
  // Manakov's pair for so(3): L = M + lambda J^2, A = w + lambda J.
  const std::string pair =
      "hamiltonian = \"(M1^2/(j2 + j3) + M2^2/(j1 + j3) + M3^2/(j1 + j2))/2\"\n" + kSo3 +
      "[parameters]\nj1 = {}\nj2 = {}\nj3 = {}\n[casimirs]\nF = \"M1^2 + M2^2 + M3^2\"\n"
      "[[lax]]\nspectral = \"z\"\nL = [[\"z*j1^2\",\"M3\",\"-M2\"],[\"-M3\",\"z*j2^2\",\"M1\"],"
      "[\"M2\",\"-M1\",\"z*j3^2\"]]\nA = [[\"-z*j1\",\"-M3/(j1 + j2)\",\"M2/(j1 + j3)\"],"
      "[\"M3/(j1 + j2)\",\"-z*j2\",\"-M1/(j2 + j3)\"],[\"-M2/(j1 + j3)\",\"M1/(j2 + "
      "j3)\",\"-z*j3\"]]\n";
  const Proof proof = proof_of(model_of(pair), "lax");
  ASSERT_EQ(proof.verdict, Verdict::proved) << proof.residual;
  ASSERT_EQ(proof.integrals.size(), 2U);
  EXPECT_EQ(proof.integrals[0], "M1^2 + M2^2 + M3^2");
  EXPECT_EQ(proof.integrals[1], "M1^2*j1^2 + M2^2*j2^2 + M3^2*j3^2");
  EXPECT_NE(proof.evidence.find("all follow from the known ones"), std::string::npos);
}

TEST(Claims, UnimodularityOfAnAlgebraIsANote) {
  const Proof yes = proof_of(euler_with(""), "measure", "unimodular algebra");
  EXPECT_TRUE(yes.note);
  EXPECT_EQ(yes.verdict, Verdict::proved);
  const Model model = model_of(
      "hamiltonian = \"M1^2 + M2^2\"\n[phase_space]\nvariables = "
      "[\"M1\",\"M2\"]\nstructure_constants = { \"M1,M2\" = \"M1\" }\n");
  EXPECT_EQ(proof_of(model, "measure", "unimodular algebra").verdict, Verdict::refuted);
  EXPECT_EQ(overall(model, prove(model)), Verdict::proved) << "a note must not count";
}

TEST(Claims, FalseIdentityOnALevelOfAnglesHasAWitness) {
  for (const char* on : {"[\"cos(q) - 1\"]", "[\"cos(q) + 1\"]", "[\"p - cos(q)\"]",
                         "[\"cos(q) - 3/5\", \"p - sin(q)\"]"}) {
    const Model model =
        model_of(std::string("hamiltonian = \"p^2/2 + cos(q)\"\n[phase_space]\nvariables = "
                             "[\"q\",\"p\"]\ncanonical = true\n[[identity]]\nname = \"F\"\nleft = "
                             "\"cos(q) + p\"\nright = \"7\"\non = ") +
                 on + "\n");
    const Proof proof = proof_of(model, "identity");
    EXPECT_EQ(proof.verdict, Verdict::refuted) << on;
    EXPECT_TRUE(proof.witness.has_value()) << on;
  }
}

TEST(Claims, TimeDependentIntegralNeedsItsExplicitDerivative) {
  const std::string head =
      "hamiltonian = \"p^2/2 + q*t\"\n[phase_space]\nvariables = [\"q\",\"p\"]\ncanonical = "
      "true\ntime = \"t\"\n[integrals]\n";
  EXPECT_EQ(proof_of(model_of(head + "F = \"p + t^2/2\"\n"), "integral").verdict, Verdict::proved);
  EXPECT_EQ(proof_of(model_of(head + "F = \"p + t^2\"\n"), "integral").verdict, Verdict::refuted);
  EXPECT_EQ(proof_of(model_of(head + "F = \"p^2/2 + q*t\"\n"), "integral").verdict,
            Verdict::refuted);
}

/// Whether f is an integral where g vanishes.
Verdict test_conditional(const Model& model, const std::string& f, const std::string& g) {
  Candidates candidates;
  candidates.integrals = {{f, {"f", 1, 1}, f}};
  candidates.on = {{g, {"g", 1, 1}, g}};
  return prove(model, candidates).at(0).verdict;
}

const std::string kOscillator =
    "hamiltonian = \"(p1^2 + p2^2 + q1^2 + q2^2)/2\"\n[phase_space]\n"
    "variables = [\"q1\", \"q2\", \"p1\", \"p2\"]\ncanonical = true\n[integrals]\n"
    "L = \"q1*p2 - q2*p1\"\n";

// More integrals than degrees of freedom: those that do not commute are named and do not count.
TEST(Superintegrable, CountsIndependentIntegralsOnly) {
  const std::string more = "A = \"p1*p2 + q1*q2\"\nB = \"L^2 + A^2\"\n";
  const Model claimed = model_of("superintegrable = true\n" + kOscillator + more);
  const std::vector<Proof> proofs = prove(claimed);
  EXPECT_EQ(overall(claimed, proofs), Verdict::proved);
  const Proof count = proof_of(claimed, "liouville", "superintegrability");
  EXPECT_EQ(count.verdict, Verdict::proved);
  EXPECT_NE(count.evidence.find("as many as there can be"), std::string::npos) << count.evidence;
  EXPECT_NE(count.evidence.find("B follows from them"), std::string::npos) << count.evidence;
  EXPECT_EQ(proof_of(claimed, "involution", "{L, A}").verdict, Verdict::refuted);
  const Proof dependent = proof_of(claimed, "independence");
  EXPECT_EQ(dependent.verdict, Verdict::refuted);
  EXPECT_NE(dependent.reason.find("B depends"), std::string::npos) << dependent.reason;
  // The same integrals are too many for Liouville's theorem as `integrable` claims it.
  const Model liouville = model_of("integrable = true\n" + kOscillator + more);
  EXPECT_EQ(overall(liouville, prove(liouville)), Verdict::refuted);
}

// The twins: two integrals are no more than Liouville's theorem needs, whatever a third one is that
// follows from them; a function that is no integral refutes the case as before.
TEST(Superintegrable, NeedsOneMore) {
  const Model two = model_of("superintegrable = true\n" + kOscillator + "B = \"L^2\"\n");
  EXPECT_EQ(overall(two, prove(two)), Verdict::undecided);
  EXPECT_EQ(proof_of(two, "liouville", "superintegrability").verdict, Verdict::undecided);
  const Model wrong =
      model_of("superintegrable = true\n" + kOscillator + "A = \"p1*p2 - q1*q2\"\n");
  EXPECT_EQ(overall(wrong, prove(wrong)), Verdict::refuted);
  // Three functions are independent there, of which one is no integral.
  EXPECT_EQ(proof_of(wrong, "liouville", "superintegrability").verdict, Verdict::undecided);
  EXPECT_THROW(model_of("superintegrable = true\n[phase_space]\nvariables = [\"x\"]\n"
                        "[equations]\nx = \"x\"\n"),
               CaseError);
}

// Of constant flows the rank is known, and no points are.
TEST(Superintegrable, ConstantFlowsAreCounted) {
  const auto decided = [](const char* integrals) {
    const Model model = model_of(
        std::string("superintegrable = true\nhamiltonian = \"p1\"\n[phase_space]\nvariables = "
                    "[\"q1\", \"q2\", \"p1\", \"p2\"]\ncanonical = true\n[integrals]\n") +
        integrals);
    return proof_of(model, "liouville", "superintegrability").verdict;
  };
  EXPECT_EQ(decided("A = \"p2\"\nB = \"q2\"\n"), Verdict::proved);
  EXPECT_EQ(decided("A = \"p2\"\nB = \"p2 + p1\"\nC = \"q2\"\n"), Verdict::proved);
  EXPECT_EQ(decided("A = \"p2\"\nB = \"p2 + p1\"\n"), Verdict::undecided);
}

// A root gives each claim a prover of its own, which has to have the motion.
TEST(Superintegrable, KeplersProblemIs) {
  const std::string kepler =
      "superintegrable = true\nhamiltonian = \"(p1^2 + p2^2)/2 - 1/sqrt(q1^2 + q2^2)\"\n"
      "[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", \"p2\"]\ncanonical = true\n[integrals]\n"
      "L = \"q1*p2 - q2*p1\"\n";
  const std::string vector = "A = \"p2*(q1*p2 - q2*p1) - q1/sqrt(q1^2 + q2^2)\"\n";
  EXPECT_EQ(proof_of(model_of(kepler + vector), "liouville", "superintegrability").verdict,
            Verdict::proved);
  EXPECT_EQ(proof_of(model_of(kepler), "liouville", "superintegrability").verdict,
            Verdict::undecided);
}

// H, q3, p3, q4 and p4 are five integrals on leaves of dimension eight, and the motion of q1 and q2
// is that of Henon and Heiles.
TEST(Superintegrable, NeedsEnoughThatCommute) {
  const std::string idle =
      "superintegrable = true\nhamiltonian = \"(p1^2 + p2^2 + q1^2 + q2^2)/2 + q1^2*q2 - q2^3/3\"\n"
      "[phase_space]\nvariables = [\"q1\", \"q2\", \"q3\", \"q4\", \"p1\", \"p2\", \"p3\", "
      "\"p4\"]\ncanonical = true\n[integrals]\n"
      "A = \"q3\"\nB = \"p3\"\nC = \"q4\"\nD = \"p4\"\n";
  const Proof count = proof_of(model_of(idle), "liouville", "superintegrability");
  EXPECT_EQ(count.verdict, Verdict::undecided);
  EXPECT_NE(count.reason.find("rank"), std::string::npos) << count.reason;
  // The twin: what is left of it is one oscillator.
  std::string twin = idle;
  twin.replace(twin.find(" + q1^2*q2 - q2^3/3"), 19, "");
  twin += "L = \"q1*p2 - q2*p1\"\nM = \"p1*p2 + q1*q2\"\n";
  EXPECT_EQ(proof_of(model_of(twin), "liouville", "superintegrability").verdict, Verdict::proved);
}

std::string lax_on(const std::string& z, const std::string& more) {
  return "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[equations]\nx = \"y + z\"\n"
         "y = \"-x\"\nz = \"" +
         z +
         "\"\n[[lax]]\nL = [[\"x\", \"y\"], [\"y\", \"-x\"]]\n"
         "A = [[\"0\", \"-1/2\"], [\"1/2\", \"0\"]]\n" +
         more;
}

// det(mu - L) has the coefficient (x + lam)/(lam - x) of mu, which is no polynomial in lam: on the
// level z = 0 of x' = 1 its parts 1/(lam - x) and x/(lam - x) are no integrals.
TEST(LaxOnALevel, PartsThatAreNoPolynomialsInTheSpectralParameterAreNoIntegrals) {
  const Proof proof = proof_of(
      model_of("[phase_space]\nvariables = [\"x\", \"z\"]\n[equations]\nx = \"1\"\nz = \"z\"\n"
               "[[lax]]\nspectral = \"lam\"\non = [\"z\"]\n"
               "L = [[\"lam/(lam-x)\", \"lam/(lam-x)\"], [\"-x/(lam-x)\", \"-x/(lam-x)\"]]\n"
               "A = [[\"-lam/(lam-x)^2\", \"-lam/(lam-x)^2\"], "
               "[\"lam/(lam-x)^2\", \"lam/(lam-x)^2\"]]\n"),
      "lax");
  EXPECT_TRUE(proof.integrals.empty()) << proof.integrals.front();
}

TEST(LaxOnALevel, HoldsWhereTheLevelIsInvariant) {
  const Model model = model_of(lax_on("x*z", "on = [\"z\"]\n"));
  const Proof proof = proof_of(model, "lax");
  EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
  EXPECT_EQ(proof.on, std::vector<std::string>{"z"});
  ASSERT_EQ(proof.integrals.size(), 1U);
  EXPECT_EQ(test_conditional(model, proof.integrals[0], "z"), Verdict::proved);
  // Without the level, and on one that motions leave although the equation holds on it.
  EXPECT_EQ(proof_of(model_of(lax_on("x*z", "")), "lax").verdict, Verdict::refuted);
  const Proof leaves = proof_of(model_of(lax_on("x*z + x", "on = [\"z\"]\n")), "lax");
  EXPECT_EQ(leaves.verdict, Verdict::refuted);
  EXPECT_NE(leaves.reason.find("not invariant"), std::string::npos) << leaves.reason;
  // On an invariant level where it does not hold.
  EXPECT_EQ(proof_of(model_of(lax_on("0", "on = [\"z - 1\"]\n")), "lax").verdict, Verdict::refuted);
}

/// Its value at the witness is the one that stands there: denominators are not left out.
TEST(Residual, OfAQuotientIsAQuotient) {
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\ndomain = [\"x != 0\"]\n[equations]\nx = "
      "\"y\"\ny = \"-x\"\n[integrals]\nF = \"y/x\"\n");
  const Proof proof = proof_of(model, "integral");
  ASSERT_EQ(proof.verdict, Verdict::refuted);
  EXPECT_EQ(proof.residual, "(-x^2 - y^2)/(x^2)");
}

}  // namespace
}  // namespace casimir::test

namespace casimir {
namespace {

// Its rate vanishes where q^2 does, and yet the motion leaves q = 0.
TEST(Claims, SquareOfAFunctionThatIsNotInvariantIsNotInvariant) {
  const std::string toml =
      "hamiltonian = \"p^2/2\"\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n";
  const Model model = build_model(parse_case(toml, "test"));
  const auto verdict = [&](const std::string& f) {
    Candidates candidates;
    candidates.invariant_relations = {{f, {"test", 1, 1}, f}};
    return prove(model, candidates).at(0).verdict;
  };
  EXPECT_EQ(verdict("q^2"), Verdict::refuted);
  EXPECT_EQ(verdict("q^2*(1 + p^2)"), Verdict::refuted);
  EXPECT_EQ(verdict("p^2"), Verdict::proved);
}

}  // namespace
}  // namespace casimir
