// A name of a case file means what the file says, everywhere, or the file is refused. The refusals
// are the files tests/bad_cases/name-*.toml.
#include <gtest/gtest.h>

#include <set>

#include "symbolic/error.hpp"
#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

Model oscillator(const std::string& more, const std::string& head = {}) {
  return model_of("hamiltonian = \"p^2 + q^2\"\n" + head +
                  "[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n" + more);
}

Verdict verdict_of(const Model& model, const std::string& name) {
  for (const Proof& proof : prove(model)) {
    if (proof.name == name) return proof.verdict;
  }
  ADD_FAILURE() << "no claim " << name;
  return Verdict::undecided;
}

Verdict candidate(const Model& model, const std::string& text) {
  Candidates candidates;
  candidates.integrals = {{text, {"--integral", 1, 1}, text}};
  return prove(model, candidates).front().verdict;
}

TEST(NameH, IsTheHamiltonianWhereTheFileDoesNotDeclareIt) {
  const Model model = oscillator("[integrals]\nF = \"H^2\"\n");
  EXPECT_EQ(verdict_of(model, "F"), Verdict::proved);
  EXPECT_EQ(candidate(model, "H"), Verdict::proved);
}

TEST(NameH, IsTheDefinitionOfTheFileWhetherTheHamiltonianUsesItOrNot) {
  const Model model = oscillator("[definitions]\nH = \"p\"\n[integrals]\nF = \"H\"\n");
  EXPECT_EQ(verdict_of(model, "F"), Verdict::refuted);
  EXPECT_EQ(candidate(model, "H"), Verdict::refuted);
  EXPECT_TRUE(model.definitions.front().value.is_equal(model.variables[1]));
  const Model by_another =
      oscillator("[definitions]\nK = \"H + 1\"\nH = \"p\"\n[integrals]\nF = \"K\"\n");
  EXPECT_EQ(verdict_of(by_another, "F"), Verdict::refuted);
}

TEST(NameH, IsNotWhatFactsCallTheHamiltonianThen) {
  const auto independent = [](const Model& model) {
    for (const Proof& proof : prove(model)) {
      if (proof.kind == ClaimKind::independence) return proof.name;
    }
    return std::string();
  };
  EXPECT_EQ(independent(oscillator("[integrals]\nF = \"1\"\n")), "H, F");
  EXPECT_EQ(independent(oscillator("[definitions]\nH = \"p\"\n[integrals]\nF = \"1\"\n")),
            "the Hamiltonian, F");
  EXPECT_EQ(independent(oscillator("[definitions]\nH = \"q^2 + p^2\"\n[integrals]\nF = \"1\"\n")),
            "H, F");
}

TEST(NameH, IsTheParameterOfTheFile) {
  const Model model = oscillator("[parameters]\nH = {}\n[integrals]\nF = \"H*(p^2 + q^2)\"\n");
  EXPECT_TRUE(model.integrals.front().value.has(model.parameters.front()));
  EXPECT_EQ(model.parse({"H", {}, {}}), model.parameters.front());
}

TEST(NameH, IsTheIntegralThatIsTheHamiltonian) {
  const Model model = oscillator("[integrals]\nH = \"q^2 + p^2\"\nF = \"H^2\"\n");
  EXPECT_EQ(verdict_of(model, "F"), Verdict::proved);
}

TEST(NameH, IsFreeWhereThereIsNoHamiltonian) {
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\"]\n[equations]\nx = \"0\"\n[integrals]\nH = \"x\"\nG = "
      "\"H^2\"\n");
  EXPECT_EQ(verdict_of(model, "G"), Verdict::proved);
}

TEST(NamesOfConstants, OfOtherLanguagesAreFreeForTheFile) {
  // Only Pi and I are constants here; e and E, pi and i are names like any other.
  const Model model = oscillator(
      "[parameters]\ne = {}\npi = {}\n[definitions]\nE = \"p\"\ni = \"q\"\nt = \"p\"\n[integrals]\n"
      "F = \"E^2 + i^2\"\nG = \"t\"\n");
  EXPECT_EQ(verdict_of(model, "F"), Verdict::proved);
  EXPECT_EQ(verdict_of(model, "G"), Verdict::refuted);
}

TEST(NamesOfFunctions, MayBeThatOfWhatTheyAre) {
  const Model model = oscillator("[definitions]\nK = \"p^2 + q^2\"\n[integrals]\nK = \"K\"\n");
  EXPECT_EQ(verdict_of(model, "K"), Verdict::proved);
}

/// Two Lax pairs with one name of the spectral parameter, the second false but at one value.
Model two_pairs() {
  return oscillator(
      "[[lax]]\nspectral = \"z\"\nL = [[\"p\",\"q*z\"],[\"q/z\",\"-p\"]]\n"
      "A = [[\"0\",\"z\"],[\"-1/z\",\"0\"]]\n"
      "[[lax]]\nspectral = \"z\"\nL = [[\"p\",\"q*z\"],[\"q\",\"-p\"]]\n"
      "A = [[\"0\",\"-1\"],[\"1\",\"0\"]]\n");
}

TEST(SpectralParameters, WitnessesGiveThatOfTheirOwnPair) {
  const Model model = two_pairs();
  for (const Proof& proof : prove(model)) {
    if (proof.kind != ClaimKind::lax) continue;
    if (proof.name == "Lax pair 1") {
      EXPECT_EQ(proof.verdict, Verdict::proved);
      continue;
    }
    ASSERT_EQ(proof.verdict, Verdict::refuted);
    ASSERT_TRUE(proof.witness.has_value());
    // The values that the witness names, put into all of dL/dt - [L, A], give its value somewhere.
    const LaxPair& pair = model.lax_pairs[1];
    GiNaC::exmap values;
    std::set<std::string> names;
    for (const auto& [name, value] : proof.witness->point) {
      EXPECT_TRUE(names.insert(name).second) << name << " is given twice";
      const GiNaC::symbol symbol = name == "q"   ? model.variables[0]
                                   : name == "p" ? model.variables[1]
                                                 : *pair.spectral;
      values[symbol] = GiNaC::numeric(value.c_str());
    }
    EXPECT_EQ(names, (std::set<std::string>{"p", "q", "z"}));
    const GiNaC::matrix commutator = pair.l.mul(pair.a).sub(pair.a.mul(pair.l));
    bool found = false;
    for (unsigned i = 0; i < 2; ++i) {
      for (unsigned j = 0; j < 2; ++j) {
        const GiNaC::ex defect = (model.rate(pair.l(i, j)) - commutator(i, j)).subs(values);
        found = found || defect.is_equal(GiNaC::numeric(proof.witness->value.c_str()));
      }
    }
    EXPECT_TRUE(found) << proof.witness->value;
  }
}

TEST(SpectralParameters, WitnessesOfOtherClaimsGiveNone) {
  const Model model = two_pairs();
  Candidates candidates;
  candidates.integrals = {{"q", {"--integral", 1, 1}, "q"}};
  const Proof proof = prove(model, candidates).front();
  ASSERT_EQ(proof.verdict, Verdict::refuted);
  for (const auto& [name, value] : proof.witness->point) EXPECT_NE(name, "z");
  EXPECT_EQ(proof.witness->point.size(), 2U);
}

TEST(SpectralParameters, AreNoNamesForCandidates) {
  const Model model = two_pairs();
  EXPECT_THROW(model.parse({"z", {"--integral", 1, 1}, "z"}), CaseError);
}

}  // namespace
}  // namespace casimir::test
