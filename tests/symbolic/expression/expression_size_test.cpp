// A density is a real function that is not zero everywhere.
#include <gtest/gtest.h>

#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

/// On a canonical plane every function of the Hamiltonian is the density of an invariant measure.
Proof measure(const std::string& density, const std::string& more = {},
              const std::string& domain = {}) {
  const Model model =
      model_of("hamiltonian = \"q^2 + p^2\"\n[[measure]]\ndensity = \"" + density + "\"\n" + more +
               "[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n" + domain);
  for (const Proof& proof : prove(model)) {
    if (proof.kind == ClaimKind::measure) return proof;
  }
  ADD_FAILURE() << "no measure";
  return {};
}

TEST(Measure, OfDensityZeroIsNone) {
  for (const char* zero : {"0", "q - q", "sin(q)^2 + cos(q)^2 - 1", "(q + p)^2 - q^2 - 2*q*p - p^2",
                           "0*q", "sqrt(H)^2 - H", "2*sin(q)*cos(q) - sin(2*q)"}) {
    const Proof proof = measure(zero);
    EXPECT_EQ(proof.verdict, Verdict::undecided) << zero;
    EXPECT_NE(proof.reason.find("identically zero"), std::string::npos) << zero << proof.reason;
  }
}

TEST(Measure, OfDensityZeroUnderTheAssumptionsIsNone) {
  EXPECT_NE(measure("sqrt(q^2) - q", {}, "domain = [\"q > 0\"]\n").verdict, Verdict::proved);
  EXPECT_NE(measure("a - 1", "[parameters]\na = { assume = \"a == 1\" }\n").verdict,
            Verdict::proved);
  const std::string toml =
      "hamiltonian = \"q^2 + p^2\"\n[[measure]]\ndensity = \"a - 1\"\n[parameters]\na = {}\n"
      "[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n";
  const Model fixed = build_model(parse_case(toml, "test.toml"), {{{"a", {}, {}}, {"1", {}, {}}}});
  for (const Proof& proof : prove(fixed)) {
    if (proof.kind == ClaimKind::measure) {
      EXPECT_EQ(proof.verdict, Verdict::undecided);
    }
  }
}

TEST(Measure, NeedsARealDensityThatIsNotZeroSomewhere) {
  for (const char* nowhere :
       {"I", "I*H", "H + I", "log(-1 - H)", "sqrt(-1 - H)", "asin(2 + H)", "log(exp(q)) - q"}) {
    EXPECT_NE(measure(nowhere).verdict, Verdict::proved) << nowhere;
  }
  EXPECT_EQ(measure("(H + I)*(H - I)").verdict, Verdict::proved);
}

TEST(Measure, OfDensityZeroIsNoneForEveryHamiltonianEither) {
  const Proof proof = measure("0", "every_hamiltonian = true\n");
  EXPECT_EQ(proof.verdict, Verdict::undecided);
}

TEST(Measure, OfUsualDensitiesIsProved) {
  for (const char* density : {"1", "-1", "H", "1/H", "exp(H)", "sqrt(H)", "1/sqrt(H)", "2 + sin(H)",
                              "log(H)", "1/(1 + H)", "a", "a - 1"}) {
    const Proof proof = measure(density, "[parameters]\na = {}\n");
    EXPECT_EQ(proof.verdict, Verdict::proved) << density << ' ' << proof.reason;
  }
}

TEST(Measure, OfDensityWithBothSignsSaysSo) {
  EXPECT_NE(measure("H - 1").evidence.find("both signs"), std::string::npos);
  EXPECT_EQ(measure("1 + H").evidence, "");
  EXPECT_EQ(measure("-1 - H").evidence, "");
  EXPECT_EQ(measure("H - 1").verdict, Verdict::proved);
}

TEST(Measure, ThatIsNotInvariantIsRefuted) {
  const Proof proof = measure("1 + q^2");
  EXPECT_EQ(proof.verdict, Verdict::refuted);
  EXPECT_TRUE(proof.witness.has_value());
}

}  // namespace
}  // namespace casimir::test
