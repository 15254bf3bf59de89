// Dirac's bracket of constraints of the second class, against closed forms and through case files.
#include "symbolic/model/dirac_bracket.hpp"

#include <gtest/gtest.h>

#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

using GiNaC::ex;

std::string particle(const std::string& constraints, const std::string& rest = "") {
  return "hamiltonian = \"(p1^2 + p2^2 + p3^2)/2 + g*q3\"\n[phase_space]\nvariables = "
         "[\"q1\",\"q2\",\"q3\",\"p1\",\"p2\",\"p3\"]\ncanonical = true\ndirac = true\nconstraints "
         "= [" +
         constraints + "]\n[parameters]\ng = {}\n" + rest;
}

const char* const kSphere = "\"q1^2 + q2^2 + q3^2 - 1\", \"q1*p1 + q2*p2 + q3*p3\"";

Verdict verdict_of(const std::vector<Proof>& proofs, const std::string& kind,
                   const std::string& name) {
  for (const Proof& proof : proofs)
    if (to_string(proof.kind) == kind && proof.name == name) return proof.verdict;
  ADD_FAILURE() << "no claim " << kind << " " << name;
  return Verdict::undecided;
}

TEST(DiracBracket, OfASphereHasTheKnownClosedForm) {
  const Model model = model_of(particle(kSphere));
  const auto& x = model.variables;
  const ex square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const ex momenta = -(x[i] * x[3 + j] - x[j] * x[3 + i]) / square;
      const ex mixed = (i == j ? 1 : 0) - x[i] * x[j] / square;
      EXPECT_TRUE((*model.poisson)(i, j).is_zero());
      EXPECT_TRUE(((*model.poisson)(i, 3 + j) - mixed).normal().is_zero()) << i << j;
      EXPECT_TRUE(((*model.poisson)(3 + i, 3 + j) - momenta).normal().is_zero()) << i << j;
    }
  }
  EXPECT_EQ(model.phase_space, "canonical, Dirac bracket");
}

TEST(DiracBracket, HasItsConstraintsAsCasimirFunctions) {
  const auto proofs = prove(model_of(
      particle(kSphere, "[integrals]\nJ = \"q1*p2 - q2*p1\"\nfalse_one = \"q1*p3 - q3*p1\"\n")));
  EXPECT_EQ(verdict_of(proofs, "jacobi", "Jacobi identity"), Verdict::proved);
  EXPECT_EQ(verdict_of(proofs, "casimir", "phi1"), Verdict::proved);
  EXPECT_EQ(verdict_of(proofs, "casimir", "phi2"), Verdict::proved);
  EXPECT_EQ(verdict_of(proofs, "integral", "J"), Verdict::proved);
  EXPECT_EQ(verdict_of(proofs, "integral", "false_one"), Verdict::refuted);
  EXPECT_EQ(verdict_of(proofs, "rank", "rank 4"), Verdict::proved);
}

/// Of q1 = 0 and q1*p1 = 0 the matrix has the determinant q1^2: not zero, but on the constraints.
TEST(DiracBracket, NeedsARegularMatrixOnTheConstraints) {
  EXPECT_THROW(model_of(particle("\"q1\", \"q1*p1\"")), CaseError);
  EXPECT_NO_THROW(model_of(particle("\"q1\", \"(1 + q1)*p1\"")));
}

/// The names are free ones, and a constraint that is claimed already is not claimed twice.
TEST(DiracBracket, NamesItsConstraintsOnce) {
  const Model model =
      model_of(particle(kSphere, "phi2 = {}\n[casimirs]\nlength = \"q1^2 + q2^2 + q3^2\"\n"));
  ASSERT_EQ(model.casimirs.size(), 2U);
  EXPECT_EQ(model.casimirs[0].name, "length");
  EXPECT_EQ(model.casimirs[1].name, "phi2_");
}

/// Another bracket than the canonical one, a spin that is tied to a particle; and four constraints.
TEST(DiracBracket, OfASpinAndOfFourConstraints) {
  const std::string spins = R"(
    hamiltonian = "M1"
    [phase_space]
    variables = ["M1", "M2", "M3", "q", "p"]
    dirac = true
    constraints = ["M1 - q", "M2 - p"]
    brackets = { "M1,M2" = "-M3", "M1,M3" = "M2", "M2,M3" = "-M1", "q,p" = "1" }
    [casimirs]
    C = "M1^2 + M2^2 + M3^2"
  )";
  for (const Proof& proof : prove(model_of(spins)))
    EXPECT_TRUE(proof.fact || proof.verdict == Verdict::proved) << proof.name;
  const auto proofs =
      prove(model_of(particle("\"q1^2 + q2^2 + q3^2 - 1\", \"q1*p1 + q2*p2 + q3*p3\", \"q3 - "
                              "q1*q2\", \"p3 - p1*q2 - q1*p2\"")));
  EXPECT_EQ(verdict_of(proofs, "jacobi", "Jacobi identity"), Verdict::proved);
  EXPECT_EQ(verdict_of(proofs, "rank", "rank 2"), Verdict::proved);
}

TEST(DiracBracket, NeedsConstraintsOfTheSecondClass) {
  const auto error_of = [](const std::string& text) {
    try {
      model_of(text);
    } catch (const CaseError& error) {
      return error.text();
    }
    return std::string("accepted");
  };
  for (const char* constraints :
       {"\"q1\"", "\"q1\", \"q2\"", "\"q1\", \"p1\", \"q2\"", "\"q1*p2 - q2*p1\", \"q1^2 + q2^2\"",
        // 1 = sin^2 + cos^2 is seen, whatever GiNaC makes of it
        "\"p1*(sin(q1)^2 + cos(q1)^2 - 1) + q2\", \"q1\""})
    EXPECT_NE(error_of(particle(constraints)).find("not of the second class"), std::string::npos)
        << constraints;
  EXPECT_EQ(error_of(particle("\"q1\", \"p1\"")), "accepted");
}

}  // namespace
}  // namespace casimir::test
