// Claims about arbitrary functions: what holds for all of them, what fails for one that is named,
// and what is neither.
#include <gtest/gtest.h>

#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

/// The plane with a central force, in Cartesian coordinates.
std::string central(const std::string& more, const std::string& scene = "") {
  return "hamiltonian = \"(px^2 + py^2)/2 + U(sqrt(x^2 + y^2))\"\n" + more +
         "\n[phase_space]\nvariables = [\"x\", \"y\", \"px\", \"py\"]\ncanonical = true\n"
         "[functions]\nU = [\"r\"]\n" +
         (scene.empty() ? ""
                        : "[[scene]]\nname = \"default\"\ninitial = { x = \"1\", y = \"0\", px "
                          "= \"0\", py = \"1\" }\n" +
                              scene);
}

Proof integral(const Model& model, const std::string& f) {
  return prove_claim(model, ClaimKind::integral, model.parse_named({f, {}, {}}));
}

TEST(ArbitraryFunctions, LeaveTheAngularMomentumAnIntegralOfEveryCentralForce) {
  const Model model = model_of(central(""));
  EXPECT_EQ(integral(model, "x*py - y*px").verdict, Verdict::proved);
  EXPECT_EQ(integral(model, "(px^2 + py^2)/2 + U(sqrt(x^2 + y^2))").verdict, Verdict::proved);
}

/// Runge and Lenz: of Kepler's force and of no other.
TEST(ArbitraryFunctions, ArePolynomialsThatAreNamedWhereAClaimFails) {
  const Model model = model_of(central(""));
  const Proof proof = integral(model, "py*(x*py - y*px) - x/sqrt(x^2 + y^2)");
  ASSERT_EQ(proof.verdict, Verdict::refuted);
  ASSERT_TRUE(proof.witness);
  EXPECT_EQ(proof.witness->point.back().first, "U(r)");
  EXPECT_NE(proof.witness->point.back().second, "");
}

TEST(ArbitraryFunctions, ObeyTheChainRule) {
  const Model model = model_of(
      "hamiltonian = \"p\"\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n"
      "[functions]\nU = [\"r\"]\nV = [\"a\", \"b\"]\n");
  const auto holds = [&](const std::string& text) {
    Candidates candidates;
    candidates.identities = {{text, {}, {}}};
    return prove(model, candidates)[0].verdict;
  };
  EXPECT_EQ(holds("diff(U(q^2), q) = 2*q*U'(q^2)"), Verdict::proved);
  EXPECT_EQ(holds("diff(U(q^2), q) = 2*q*U'(q)"), Verdict::refuted);
  EXPECT_EQ(holds("diff(diff(U(2*q), q), q) = 4*U''(2*q)"), Verdict::proved);
  EXPECT_EQ(holds("diff(V(q, p*q), q) = V'[1](q, p*q) + p*V'[2](q, p*q)"), Verdict::proved);
  EXPECT_EQ(holds("diff(diff(V(q, p), q), p) = V'[2,1](q, p)"), Verdict::proved);
  EXPECT_EQ(holds("U((q + p)^2) = U(q^2 + 2*p*q + p^2)"), Verdict::proved);
  EXPECT_EQ(holds("U(0) = 0"), Verdict::refuted);
  EXPECT_EQ(holds("diff(U(0), q) = 0"), Verdict::proved);
  EXPECT_EQ(holds("U(q) = U(p)"), Verdict::refuted);
  EXPECT_EQ(holds("V(q, p) = V(p, q)"), Verdict::refuted);
}

/// Of no function with sqrt(-1 - U^2) anything is claimed.
TEST(ArbitraryFunctions, DoNotMakeAClaimAboutNothingTrue) {
  const Model model = model_of(
      "hamiltonian = \"p^2/2 + U(q)\"\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = "
      "true\n[functions]\nU = [\"r\"]\n");
  EXPECT_EQ(integral(model, "(p^2/2 + U(q))*sqrt(-1 - U(q)^2)^2/(-1 - U(q)^2)").verdict,
            Verdict::undecided);
}

/// U(sqrt(A)) is 1 + A for U = 1 + r^2, which has values where A < 0.
TEST(ArbitraryFunctions, KeepTheDomainsOfTheirArguments) {
  const auto identity = [](const std::string& text, const std::string& more = "") {
    const Model model = model_of(
        "hamiltonian = \"p^2/2 + q^2/2\"\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = "
        "true\n" +
        more + "[functions]\nU = [\"r\"]\n");
    Candidates candidates;
    candidates.identities = {{text, {}, {}}};
    return prove(model, candidates)[0].verdict;
  };
  // True wherever the root is real.
  EXPECT_NE(identity("U(sqrt(q^3 + q + exp(q) - 1))*(abs(q) - q) = 0"), Verdict::refuted);
  EXPECT_NE(identity("U(sqrt(atan2(p, q)))*(abs(p) - p) = 0"), Verdict::refuted);
  EXPECT_NE(identity("U'(sqrt(q^3 + q + exp(q) - 1))*(abs(q) - q) = 0"), Verdict::refuted);
  EXPECT_NE(identity("sqrt((q - U(q))*(q - 3)) = sqrt(q - U(q))*sqrt(q - 3)"), Verdict::refuted);
  EXPECT_NE(identity("(abs(q) - q)*sqrt(q*U(0))*sqrt(U(0)) = 0"), Verdict::refuted);
  EXPECT_NE(identity("log(-1 - U(0)^2) = log(-1 - U(0)^2) + 0*q"), Verdict::proved);
  // About nothing.
  EXPECT_EQ(identity("U(sqrt(q)) = U(sqrt(-q))", "domain = [\"q > 0\"]\n"), Verdict::undecided);
  EXPECT_EQ(identity("(sin(q)^2 + cos(q)^2)*U(sqrt(-1 - q^2)) = U(sqrt(-1 - q^2))"),
            Verdict::undecided);
  // About something.
  EXPECT_EQ(identity("(sin(q)^2 + cos(q)^2)*U(sqrt(1 - q^2)) = U(sqrt(1 - q^2))"), Verdict::proved);
  EXPECT_EQ(identity("U(sqrt(q)) = U(2*sqrt(q))"), Verdict::refuted);
  const Model model = model_of(
      "hamiltonian = \"p^2/2 + q^2/2\"\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = "
      "true\n[functions]\nU = [\"r\"]\n");
  EXPECT_NE(integral(model, "U(sqrt(q^3 + q + exp(q) - 1))*(abs(q) - q)").verdict,
            Verdict::refuted);
}

TEST(ArbitraryFunctions, KeepTheirSignsWhereThatIsAssumed) {
  const Model model = model_of(
      "hamiltonian = \"p^2/2 + U(q)\"\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = "
      "true\ndomain = [\"U(q) > 0\"]\n[functions]\nU = [\"r\"]\n");
  EXPECT_EQ(integral(model, "p^2/2 + sqrt(U(q)^2)").verdict, Verdict::proved);
}

TEST(ArbitraryFunctions, HaveNoNumberAtThePointOfARank) {
  const Model model = model_of(R"toml(
hamiltonian = "M1^2 + U(g3)"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
[functions]
U = ["r"]
[casimirs]
C = "g1^2 + g2^2 + g3^2"
D = "M1*g1 + M2*g2 + M3*g3"
)toml");
  Candidates candidates;
  candidates.only = ClaimKind::rank;
  const std::vector<Proof> proofs = prove(model, candidates);
  ASSERT_EQ(proofs.size(), 1U);
  EXPECT_EQ(proofs[0].verdict, Verdict::proved);
  EXPECT_EQ(proofs[0].evidence.find("U(r)"), std::string::npos) << proofs[0].evidence;
}

TEST(ArbitraryFunctions, AreGivenByScenes) {
  const Model model = model_of(central("", "functions = { U = \"-1/r\" }\n"));
  const GiNaC::ex h = model.at_parameters(*model.hamiltonian, model.scenes[0]);
  const GiNaC::ex expected = model.parse({"(px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)", {}, {}});
  EXPECT_TRUE((h - expected).normal().is_zero());
}

TEST(ArbitraryFunctions, AreAskedForWhereNumbersAreNeeded) {
  const Model model = model_of(central("", "duration = \"1\"\n"));
  EXPECT_THROW(model.at_parameters(*model.hamiltonian, model.scenes[0]), ModelError);
}

TEST(ArbitraryFunctions, HaveNamesOfTheirOwnAndArguments) {
  const auto with = [](const std::string& functions, const std::string& h = "p") {
    return "hamiltonian = \"" + h +
           "\"\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = " + "true\n[functions]\n" +
           functions;
  };
  for (const char* bad :
       {"q = [\"r\"]", "sin = [\"r\"]", "U = []", "U = \"r\"", "U = [\"r\", \"r\"]",
        "\"U(r)\" = [\"r\"]", "U = [\"sin\"]", "U = [1]", "U = [\"a\",\"b\",\"c\",\"d\",\"e\"]",
        "value = [\"r\"]", "int = [\"r\"]"})
    EXPECT_THROW(model_of(with(bad)), CaseError) << bad;
  for (const char* bad :
       {"U", "U*q", "U(q, p)", "U()", "U'", "U'[1](q)", "U''''''''''(q)", "q'", "V(q)"})
    EXPECT_THROW(model_of(with("U = [\"r\"]", bad)), CaseError) << bad;
  for (const char* bad : {"V'(q, p)", "V'[3](q, p)", "V'[0](q, p)", "V'[](q, p)", "V''[1](q, p)"})
    EXPECT_THROW(model_of(with("V = [\"a\", \"b\"]", bad)), CaseError) << bad;
  EXPECT_THROW(model_of(with("U = [\"r\"]\n[parameters]\nU = {}")), CaseError);
  EXPECT_THROW(model_of(with("U = [\"r\"]\n[definitions]\nU = \"q\"")), CaseError);
  EXPECT_THROW(model_of(with("U = [\"r\"]\n[parameters]\n\"V(r)\" = {}")), CaseError);
}

}  // namespace
}  // namespace casimir::test
