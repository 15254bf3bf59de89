// What the prover says of true, false and hard statements.
#include "symbolic/prove.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

Text typed(const std::string& text) { return {text, {"--integral", 1, 1}, text}; }

Proof test_integral(const Model& model, const std::string& f,
                    const std::vector<std::string>& on = {}) {
  Candidates candidates;
  candidates.integrals = {typed(f)};
  for (const std::string& g : on) candidates.on.push_back(typed(g));
  return prove(model, candidates).at(0);
}

Model kovalevskaya(const std::string& parameters = "r = {}") {
  return model_of(
      "hamiltonian = \"(M1^2 + M2^2 + 2*M3^2)/2 - r*g1\"\n[phase_space]\nvariables = "
      "[\"M1\",\"M2\",\"M3\",\"g1\",\"g2\",\"g3\"]\n"
      "algebra = \"e(3)\"\n[parameters]\n" +
      parameters + "\n");
}

TEST(Prove, KovalevskayaIntegral) {
  const Proof proof =
      test_integral(kovalevskaya(), "(M1^2 - M2^2 + 2*r*g1)^2 + (2*M1*M2 + 2*r*g2)^2");
  EXPECT_EQ(proof.verdict, Verdict::proved);
  EXPECT_FALSE(proof.witness.has_value());
}

TEST(Prove, KovalevskayaWithOneSignFlippedIsRefuted) {
  const Proof proof =
      test_integral(kovalevskaya(), "(M1^2 - M2^2 - 2*r*g1)^2 + (2*M1*M2 + 2*r*g2)^2");
  ASSERT_EQ(proof.verdict, Verdict::refuted);
  ASSERT_TRUE(proof.witness.has_value());
  EXPECT_EQ(proof.witness->point.size(), 7U);
  EXPECT_NE(proof.witness->value, "0");
  EXPECT_FALSE(proof.residual.empty());
}

TEST(Prove, TowersOfPowersAreRefutedWhereTheirNumbersAreSmall) {
  // At x = 7 and the like GiNaC would compute 7^7^7^7.
  const Model free = model_of(
      "hamiltonian = \"y^2/2\"\n[phase_space]\nvariables = [\"x\",\"y\"]\ncanonical = true\n");
  for (const char* tower : {"x^x^x^x", "(2*x*y)^(x^x^x)", "2^(exp(x)^exp(x)^exp(x))"}) {
    const Proof proof = test_integral(free, tower);
    ASSERT_EQ(proof.verdict, Verdict::refuted) << tower;
    EXPECT_TRUE(proof.witness.has_value()) << tower;
  }
}

TEST(Prove, BranchOfARootDecides) {
  const char* const h = "[integrals]\nF = \"sqrt(M3^2)\"\n";
  const std::string body = "hamiltonian = \"(M1^2 + M2^2 + 2*M3^2)/2\"\n";
  const std::string space =
      "[phase_space]\nvariables = [\"M1\",\"M2\",\"M3\"]\nalgebra = \"so(3)\"\n";
  // M3 is an integral of the symmetric top, so both signs of the root are; M3 - sqrt(M3^2) is one
  // too.
  EXPECT_EQ(test_integral(model_of(body + space), "sqrt(M3^2) - M3").verdict, Verdict::proved);
  EXPECT_EQ(test_integral(model_of(body + h + space), "sqrt(M1^2)").verdict, Verdict::refuted);
}

/// sqrt(x) has values for x >= 0, where |x| - x is zero: of that the other claim knows nothing.
TEST(Prove, AClaimWithoutValuesInTheDomainOfAnotherIsDecidedForItself) {
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"0\"\ny = "
      "\"1\"\n[integrals]\nA = "
      "\"1/(abs(x) - x)\"\nB = \"sqrt(x)\"\n");
  Candidates integrals;
  integrals.only = ClaimKind::integral;
  const std::vector<Proof> proofs = prove(model, integrals);
  ASSERT_EQ(proofs.size(), 2U);
  EXPECT_EQ(proofs[0].verdict, Verdict::proved);
  EXPECT_EQ(proofs[1].verdict, Verdict::proved);
}

TEST(Prove, BentBracketFailsJacobi) {
  const Model bent = model_of(
      "hamiltonian = \"M1\"\n[phase_space]\nvariables = "
      "[\"M1\",\"M2\",\"M3\"]\n[phase_space.brackets]\n"
      "\"M1,M2\" = \"M1^2 - M3\"\n\"M1,M3\" = \"M2\"\n\"M2,M3\" = \"-M1\"\n");
  const std::vector<Proof> proofs = prove(bent);
  ASSERT_EQ(proofs.at(1).kind, ClaimKind::jacobi);
  EXPECT_EQ(proofs[1].verdict, Verdict::refuted);
  EXPECT_EQ(proofs[1].residual, "-2*M1*M2");
}

/// The verdict on the Jacobi identity for brackets of x1, x2, x3.
Verdict jacobi(const std::string& x12, const std::string& x13, const std::string& x23) {
  Candidates only;
  only.only = ClaimKind::jacobi;
  return prove(model_of("hamiltonian = \"x1\"\n[phase_space]\nvariables = [\"x1\",\"x2\",\"x3\"]\n"
                        "[phase_space.brackets]\n\"x1,x2\" = \"" +
                        x12 + "\"\n\"x1,x3\" = \"" + x13 + "\"\n\"x2,x3\" = \"" + x23 +
                        "\"\n[parameters]\nk = {}\n"),
               only)
      .at(0)
      .verdict;
}

TEST(Prove, JacobiOfLinearBrackets) {
  // {x1,x2} = a x1 + b x2 gives a solvable algebra; with x3 in it, it must act on x3 as well.
  EXPECT_EQ(jacobi("x1/2 + x2/3", "0", "0"), Verdict::proved);
  EXPECT_EQ(jacobi("x1/2 + x2/3", "x3", "0"), Verdict::refuted);
  EXPECT_EQ(jacobi("-x3", "x2", "-x1"), Verdict::proved);
  EXPECT_EQ(jacobi("-x3 + x1/7", "x2", "-x1"), Verdict::refuted);
  // With a parameter, or with numbers too large for machine integers, the same by polynomials.
  EXPECT_EQ(jacobi("-x3", "x2", "-k*x1"), Verdict::proved);
  EXPECT_EQ(jacobi("-x3 + k*x1", "x2", "-x1"), Verdict::refuted);
  const std::string huge = "123456789012345678901234567890";
  EXPECT_EQ(jacobi("-x3", "x2", "-" + huge + "*x1"), Verdict::proved);
  EXPECT_EQ(jacobi("-x3 + " + huge + "*x1", "x2", "-x1"), Verdict::refuted);
  // Just below the limit of the input, just above that of the sums: 2^30.
  EXPECT_EQ(jacobi("-x3 + 1073741823*x1", "1073741823*x2", "-1073741823*x1"), Verdict::refuted);
  EXPECT_EQ(jacobi("-1073741823*x3", "1073741823*x2", "-1073741823*x1"), Verdict::proved);
  EXPECT_EQ(jacobi("x3 + 1", "0", "0"), Verdict::proved);
  EXPECT_EQ(jacobi("x1*x2", "x1*x3", "0"), Verdict::proved);
  EXPECT_EQ(jacobi("x1*x2", "x3", "x1"), Verdict::refuted);
}

TEST(Prove, ConditionalIntegralHoldsOnItsLevelOnly) {
  const Model chaplygin = model_of(
      "hamiltonian = \"(M1^2 + M2^2 + 4*M3^2)/2 - r*g1\"\n[phase_space]\nvariables = "
      "[\"M1\",\"M2\",\"M3\",\"g1\",\"g2\",\"g3\"]\n"
      "algebra = \"e(3)\"\n[parameters]\nr = {}\n");
  const std::string g = "M3*(M1^2 + M2^2) + r*M1*g3";
  const Proof on = test_integral(chaplygin, g, {"M1*g1 + M2*g2 + M3*g3"});
  EXPECT_EQ(on.verdict, Verdict::proved);
  EXPECT_NE(on.evidence.find("cofactor"), std::string::npos);
  EXPECT_EQ(test_integral(chaplygin, g).verdict, Verdict::refuted);
  const Proof wrong =
      test_integral(chaplygin, "M3*(M1^2 + M2^2) - r*M1*g3", {"M1*g1 + M2*g2 + M3*g3"});
  ASSERT_EQ(wrong.verdict, Verdict::refuted);
}

TEST(Prove, LeadingCoefficientsOfALevelMustNotVanish) {
  Candidates candidates;
  candidates.invariant_relations = {typed("M1^2 - M2^2 + 2*r*g1")};
  candidates.on = {typed("r*(M1*M2 + r*g2)")};
  // Where r = 0 the level is that of M1^2 - M2^2 alone, which the motion leaves.
  const Proof everywhere = prove(kovalevskaya(), candidates).at(0);
  ASSERT_EQ(everywhere.verdict, Verdict::refuted);
  EXPECT_EQ(everywhere.witness->point.back(), (std::pair<std::string, std::string>("r", "0")));
  const Model model = kovalevskaya("r = { assume = \"r != 0\" }");
  const Proof proof = prove(model, candidates).at(0);
  EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
  EXPECT_TRUE(proof.where.empty());
  candidates.on = {typed("r*(M1*M2 - r*g2)")};
  EXPECT_EQ(prove(model, candidates).at(0).verdict, Verdict::refuted);
}

TEST(Prove, LevelThatIsNotInvariantIsSaidSo) {
  const Proof proof = test_integral(kovalevskaya(), "M1", {"M1"});
  EXPECT_EQ(proof.verdict, Verdict::refuted);
  EXPECT_NE(proof.reason.find("the level is not invariant"), std::string::npos);
}

/// p is an integral where b = a, which no proof makes use of.
TEST(Prove, AnEquationThatIsAssumedIsNamedWhereItMayDecide) {
  const auto with = [](const std::string& assumed) {
    const Model model = model_of(
        "hamiltonian = \"p^2/2 + (a - b)*q^2/2\"\n[phase_space]\nvariables = [\"q\", \"p\"]\n"
        "canonical = true\n[parameters]\na = {}\nb = { assume = \"" +
        assumed + "\" }\n[integrals]\nP = \"p\"\n");
    for (const Proof& proof : prove(model))
      if (proof.name == "P" && proof.kind == ClaimKind::integral) return proof;
    return Proof{};
  };
  const Proof equal = with("b = a");
  EXPECT_EQ(equal.verdict, Verdict::undecided);
  EXPECT_NE(equal.reason.find("'b = a' is assumed"), std::string::npos) << equal.reason;
  EXPECT_EQ(with("b > a").verdict, Verdict::refuted);
}

TEST(Prove, WitnessLiesInsideEveryAssumption) {
  const Model model = model_of(
      "hamiltonian = \"(M1^2 + M2^2 + 2*M3^2)/2 - r*g1\"\n[phase_space]\nvariables = "
      "[\"M1\",\"M2\",\"M3\",\"g1\",\"g2\",\"g3\"]\n"
      "algebra = \"e(3)\"\ndomain = [\"M3 > 1\", \"g1 < 0\"]\n[parameters]\nr = { assume = \"r > "
      "2\" }\n");
  const Proof proof = test_integral(model, "M1");
  ASSERT_EQ(proof.verdict, Verdict::refuted);
  for (const auto& [name, value] : proof.witness->point) {
    const GiNaC::numeric number(value.c_str());
    if (name == "M3") {
      EXPECT_GT(number, 1);
    }
    if (name == "g1") {
      EXPECT_LT(number, 0);
    }
    if (name == "r") {
      EXPECT_GT(number, 2);
    }
  }
}

TEST(Prove, GiantIsUndecidedNotWrong) {
  const Proof proof = test_integral(kovalevskaya(), "(M1 + M2 + M3 + g1 + g2 + g3)^200");
  EXPECT_EQ(proof.verdict, Verdict::undecided);
  EXPECT_NE(proof.reason.find("a larger limit 'terms' allows more"), std::string::npos)
      << proof.reason;
}

TEST(Prove, RankAndIndependenceCountForIntegrableSystems) {
  const Model dependent = euler_with(
      "integrable = true\n[casimirs]\nF = \"M1^2 + M2^2 + M3^2\"\n[integrals]\nG = \"(M1^2 + M2^2 "
      "+ M3^2)^2\"\n");
  const std::vector<Proof> proofs = prove(dependent);
  EXPECT_EQ(overall(dependent, proofs), Verdict::refuted);
  for (const Proof& proof : proofs) {
    if (proof.kind == ClaimKind::independence) {
      EXPECT_EQ(proof.verdict, Verdict::refuted);
    }
    if (proof.kind == ClaimKind::rank) {
      EXPECT_EQ(proof.name, "rank 2");
    }
    if (proof.kind == ClaimKind::liouville) {
      EXPECT_EQ(proof.verdict, Verdict::proved);
    }
  }
}

const Proof& of_kind(const std::vector<Proof>& proofs, const std::string& kind) {
  return *std::find_if(proofs.begin(), proofs.end(),
                       [&](const Proof& proof) { return to_string(proof.kind) == kind; });
}

TEST(Prove, RankIsNotBoundedByFunctionsThatAreNoCasimirs) {
  // On so(3) + so(3) with rank 4, declare two false Casimir functions besides the true ones. The
  // rank is found nevertheless, and its proof is not theirs.
  const std::string body =
      "hamiltonian = \"x1 + y1\"\n[phase_space]\nvariables = "
      "[\"x1\",\"x2\",\"x3\",\"y1\",\"y2\",\"y3\"]\n[phase_space.brackets]\n\"x1,x2\" = "
      "\"-x3\"\n\"x1,x3\" = \"x2\"\n\"x2,x3\" = \"-x1\"\n\"y1,y2\" = \"-y3\"\n\"y1,y3\" = "
      "\"y2\"\n\"y2,y3\" = \"-y1\"\n[casimirs]\n";
  for (const char* casimirs : {"A = \"x1\"\nB = \"y1\"\n",
                               "A = \"x1^2 + x2^2 + x3^2\"\nB = \"y1^2 + y2^2 + y3^2\"\n", ""}) {
    const std::vector<Proof> proofs = prove(model_of(body + casimirs));
    EXPECT_EQ(of_kind(proofs, "rank").verdict, Verdict::proved) << casimirs;
    EXPECT_EQ(of_kind(proofs, "rank").name, "rank 4") << casimirs;
  }
}

TEST(Prove, SuperintegrableSystemHasDependentIntegrals) {
  // Kepler's problem has five independent integrals of the seven.
  const std::string kepler =
      "hamiltonian = \"(p1^2 + p2^2 + p3^2)/2 - 1/sqrt(q1^2 + q2^2 + q3^2)\"\n"
      "[phase_space]\nvariables = [\"q1\",\"q2\",\"q3\",\"p1\",\"p2\",\"p3\"]\n"
      "canonical = true\n[definitions]\nr = \"sqrt(q1^2 + q2^2 + q3^2)\"\n[integrals]\n"
      "L1 = \"q2*p3 - q3*p2\"\nL2 = \"q3*p1 - q1*p3\"\nL3 = \"q1*p2 - q2*p1\"\n"
      "A1 = \"p2*L3 - p3*L2 - q1/r\"\n";
  EXPECT_EQ(of_kind(prove(model_of(kepler)), "independence").verdict, Verdict::proved);
  const std::vector<Proof> all =
      prove(model_of(kepler + "A2 = \"p3*L1 - p1*L3 - q2/r\"\nA3 = \"p1*L2 - p2*L1 - q3/r\"\n"));
  EXPECT_EQ(of_kind(all, "independence").verdict, Verdict::refuted);
  EXPECT_EQ(of_kind(all, "independence").reason.substr(0, 20), "only 5 of the 7 func");
  EXPECT_EQ(of_kind(all, "liouville").verdict, Verdict::proved);
}

TEST(Prove, LiouvilleSaysWhatIsMissing) {
  for (const Proof& proof : prove(kovalevskaya())) {
    if (proof.kind != ClaimKind::liouville) continue;
    EXPECT_EQ(proof.verdict, Verdict::undecided);
    EXPECT_EQ(proof.reason,
              "leaves of dimension 4 need 2 independent integrals in involution; 1 known");
  }
}

TEST(Prove, SystemsWithoutABracket) {
  const Model lotka = model_of(
      "[phase_space]\nvariables = [\"x\",\"y\"]\n[equations]\nx = \"x*(1 - y)\"\ny = \"y*(x - "
      "1)\"\n[integrals]\nF = \"x + y - log(x*y)\"\n"
      "[[measure]]\ndensity = \"1/(x*y)\"\n");
  for (const Proof& proof : prove(lotka))
    EXPECT_EQ(proof.verdict, Verdict::proved) << to_string(proof.kind) << proof.residual;
  EXPECT_EQ(test_integral(lotka, "x + y").verdict, Verdict::refuted);
}

TEST(Prove, TimeDependentIntegral) {
  const Model free = model_of(
      "hamiltonian = \"p^2/2\"\n[phase_space]\nvariables = [\"q\",\"p\"]\ncanonical = true\ntime = "
      "\"t\"\n[integrals]\nF = \"q - p*t\"\n");
  EXPECT_EQ(overall(free, prove(free)), Verdict::proved);
  EXPECT_EQ(test_integral(free, "q + p*t").verdict, Verdict::refuted);
}

TEST(Prove, AnglesAndExponentialsHaveExactWitnesses) {
  const Model pendulum = model_of(
      "hamiltonian = \"p^2/2 - w*cos(q)\"\n[phase_space]\nvariables = [\"q\",\"p\"]\n"
      "canonical = true\n[parameters]\nw = { assume = \"w > 0\" }\n");
  EXPECT_EQ(test_integral(pendulum, "p^2/2 - w*(1 - 2*sin(q/2)^2)").verdict, Verdict::proved);
  const Proof wrong = test_integral(pendulum, "p^2/2 + w*cos(q)");
  ASSERT_EQ(wrong.verdict, Verdict::refuted);
  EXPECT_NE(wrong.witness->point.at(0).second.find("atan"), std::string::npos);
  // An angle that also occurs outside of its sine keeps a rational value, which only 0 can be.
  EXPECT_EQ(test_integral(pendulum, "q*cos(q)").verdict, Verdict::refuted);
  const Model toda = model_of(
      "hamiltonian = \"p^2/2 + exp(2*q)\"\n[phase_space]\nvariables = [\"q\",\"p\"]\n"
      "canonical = true\n");
  EXPECT_EQ(test_integral(toda, "p^2 + 2*exp(q)^2").verdict, Verdict::proved);
  EXPECT_EQ(test_integral(toda, "p^2 + 2*exp(q)").verdict, Verdict::refuted);
}

TEST(Prove, DependentLogarithmsAreNotCalledIndependent) {
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\",\"y\",\"z\"]\n[equations]\nx = \"0\"\ny = \"0\"\nz = "
      "\"0\"\n[integrals]\nF = \"x*log(x*y)\"\nG = \"x*log(x) + x*log(y)\"\n");
  for (const Proof& proof : prove(model)) {
    if (proof.kind == ClaimKind::independence) {
      EXPECT_NE(proof.verdict, Verdict::proved);
    }
  }
}

TEST(Prove, LaxPairAndItsBentTwin) {
  const std::string lax =
      "[[lax]]\nL = [[\"0\",\"M3\",\"-M2\"],[\"-M3\",\"0\",\"M1\"],[\"M2\",\"-M1\",\"0\"]]\n"
      "A = "
      "[[\"0\",\"-a3*M3\",\"a2*M2\"],[\"a3*M3\",\"0\",\"-a1*M1\"],[\"-a2*M2\",\"a1*M1\",\"0\"]]\n";
  std::string bent = lax;
  bent.replace(bent.find("-a3*M3"), 6, "+a3*M3");
  const Model right = euler_with(lax);
  const Model wrong = euler_with(bent);
  EXPECT_EQ(overall(right, prove(right)), Verdict::proved);
  EXPECT_EQ(overall(wrong, prove(wrong)), Verdict::refuted);
}

TEST(Prove, PoissonMapAndItsBentTwin) {
  // Canonical variables on the symplectic leaves of so(3) by a map from R^4 (Schwinger).
  const auto schwinger = [](const std::string& third) {
    return model_of(
        "hamiltonian = \"q1^2\"\n[phase_space]\nvariables = "
        "[\"q1\",\"q2\",\"p1\",\"p2\"]\ncanonical = true\n[[map]]\nname = \"spin\"\nto = "
        "\"so(3)\"\n"
        "expressions = { S1 = \"(q1*q2 + p1*p2)/2\", S2 = \"(q2*p1 - q1*p2)/2\", S3 = \"" +
        third + "\" }\n");
  };
  const Model right = schwinger("(q1^2 + p1^2 - q2^2 - p2^2)/4");
  const Model wrong = schwinger("(q1^2 + p1^2 + q2^2 - p2^2)/4");
  EXPECT_EQ(overall(right, prove(right)), Verdict::proved);
  EXPECT_EQ(overall(wrong, prove(wrong)), Verdict::refuted);
}

TEST(Prove, FixedParameterIsReplacedBeforeAnythingElse) {
  const CaseFile file = parse_case(
      "hamiltonian = \"(M1^2 + M2^2 + a3*M3^2)/2 - r*g1\"\n[phase_space]\nvariables = "
      "[\"M1\",\"M2\",\"M3\",\"g1\",\"g2\",\"g3\"]\n"
      "algebra = \"e(3)\"\n[parameters]\nr = {}\na3 = {}\n[integrals]\nK = \"(M1^2 - M2^2 + "
      "2*r*g1)^2 + (2*M1*M2 + 2*r*g2)^2\"\n",
      "test.toml");
  const auto with = [&](const std::string& value) {
    return build_model(file, {{{"a3", {"--param", 1, 1}, ""}, {value, {"--param", 1, 4}, ""}}});
  };
  const Model kovalevskaya_value = with("2");
  EXPECT_EQ(overall(kovalevskaya_value, prove(kovalevskaya_value)), Verdict::proved);
  const Model other = with("3");
  EXPECT_EQ(overall(other, prove(other)), Verdict::refuted);
}

TEST(Prove, StopsWhenToldTo) {
  int calls = 0;
  prove(kovalevskaya(), {}, [&](const Proof&) { return ++calls < 2; });
  EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace casimir::test
