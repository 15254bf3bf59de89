// The frame of the Poincare-Chetaev equations: structure functions, bracket, Legendre transform.
#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

/// The rigid body in Euler angles: fields of the rotations about the body's axes.
const std::string kEulerAngles =
    "[phase_space]\ndomain = [\"sin(th) != 0\"]\n[phase_space.vector_fields]\n"
    "coordinates = [\"th\",\"ph\",\"ps\"]\nmomenta = [\"M1\",\"M2\",\"M3\"]\n"
    "M1 = { th = \"cos(ph)\", ph = \"-sin(ph)*cos(th)/sin(th)\", ps = \"sin(ph)/sin(th)\" }\n"
    "M2 = { th = \"-sin(ph)\", ph = \"-cos(ph)*cos(th)/sin(th)\", ps = \"cos(ph)/sin(th)\" }\n"
    "M3 = { ph = \"1\" }\n[parameters]\nI1 = {}\nI2 = {}\nI3 = {}\n";

Proof proof_of(const Model& model, const std::string& name) {
  for (const Proof& proof : prove(model)) {
    if (proof.name == name) return proof;
  }
  ADD_FAILURE() << "no claim " << name;
  return {};
}

GiNaC::ex bracket(const Model& model, const std::string& text) {
  return model.parse({text, {"test", 1, 1}, text});
}

TEST(Frame, RotationsHaveTheBracketOfTheBody) {
  const Model model = model_of("hamiltonian = \"M1^2/I1 + M2^2/I2 + M3^2/I3\"\n" + kEulerAngles);
  ASSERT_TRUE(model.frame.has_value());
  // (1.26): {M_i, M_j} = - c_ij^s M_s with c = eps.
  EXPECT_TRUE(bracket(model, "{M1, M2} + M3").expand().is_zero());
  EXPECT_TRUE(bracket(model, "{M2, M3} + M1").expand().is_zero());
  EXPECT_TRUE(bracket(model, "{ph, M3} - 1").expand().is_zero());
  EXPECT_TRUE(bracket(model, "{th, M1} - cos(ph)").expand().is_zero());
  EXPECT_EQ(proof_of(model, "Jacobi identity").verdict, Verdict::proved);
  EXPECT_EQ(proof_of(model, "the frame closes").verdict, Verdict::proved);
}

TEST(Frame, StructureFunctionsMayDependOnTheCoordinates) {
  // [d1 + q2 d2, q1 d2] = (1 - q1) d2 = (1/q1 - 1) q1 d2.
  const Model model = model_of(
      "hamiltonian = \"M1^2 + M2^2\"\n[phase_space]\n[phase_space.vector_fields]\n"
      "coordinates = [\"q1\",\"q2\"]\nmomenta = [\"M1\",\"M2\"]\n"
      "M1 = [\"1\", \"q2\"]\nM2 = [\"0\", \"q1\"]\n");
  const GiNaC::ex c = model.frame->c(0, 1, 1);
  EXPECT_TRUE((c - (1 / GiNaC::ex(model.frame->coordinates[0]) - 1)).normal().is_zero()) << c;
  EXPECT_EQ(proof_of(model, "the frame closes").verdict, Verdict::proved);
  EXPECT_EQ(proof_of(model, "Jacobi identity").verdict, Verdict::proved);
}

TEST(Frame, LagrangianGivesTheEquationsOfEulerAndLagrange) {
  const Model model = model_of(
      "lagrangian = \"(I1*w1^2 + I2*w2^2 + I3*w3^2)/2 + w1*sin(th) - cos(th)\"\n" + kEulerAngles);
  for (const char* name : {"Legendre transform", "Poincare-Chetaev equations",
                           "Euler-Lagrange equations", "the frame closes"}) {
    const Proof proof = proof_of(model, name);
    EXPECT_EQ(proof.verdict, Verdict::proved) << name << ": " << proof.residual;
  }
}

/// Where the fields are dependent the velocities are no functions of dx/dt: for c = 0 there are no
/// such equations, though nothing is left of c in them.
TEST(Frame, EquationsOfEulerAndLagrangeNeedIndependentFields) {
  const Proof proof = proof_of(model_of("lagrangian = \"w1^2/2\"\n[phase_space]\nvariables = "
                                        "[\"x\", \"M\"]\n[phase_space.vector_fields]\n"
                                        "coordinates = [\"x\"]\nmomenta = [\"M\"]\nM = "
                                        "[\"c*x\"]\n[parameters]\nc = {}\n"),
                               "Euler-Lagrange equations");
  EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
  for (const char* divisor : {"c", "x"})
    EXPECT_EQ(std::ranges::count(proof.nonzero, divisor), 1) << divisor;
}

TEST(Frame, FieldsThatDependOnTheTimeAreRefusedWhereTheyStand) {
  try {
    model_of(
        "hamiltonian = \"M^2/2\"\n[phase_space]\nvariables = [\"x\", \"M\"]\n"
        "time = \"t\"\n[phase_space.vector_fields]\ncoordinates = [\"x\"]\nmomenta = [\"M\"]\nM = "
        "[\"1 + "
        "t^2\"]\n");
    FAIL() << "no refusal";
  } catch (const CaseError& error) {
    EXPECT_EQ(error.where().line, 8);
    EXPECT_NE(error.text().find("not on 't'"), std::string::npos) << error.text();
  }
}

// The twin: with another Hamiltonian than the transform of the Lagrangian every one of them fails.
TEST(Frame, AnotherHamiltonianThanTheLagrangiansIsRefuted) {
  const Model model = model_of(
      "lagrangian = \"(I1*w1^2 + I2*w2^2 + I3*w3^2)/2 - cos(th)\"\n"
      "hamiltonian = \"(M1^2/I1 + M2^2/I2 + 2*M3^2/I3)/2 + cos(th)\"\n" +
      kEulerAngles);
  for (const char* name :
       {"Legendre transform", "Poincare-Chetaev equations", "Euler-Lagrange equations"}) {
    const Proof proof = proof_of(model, name);
    EXPECT_EQ(proof.verdict, Verdict::refuted) << name << ": " << proof.residual;
    EXPECT_TRUE(proof.witness.has_value());
  }
}

TEST(Frame, LagrangianWithLongFractionsAsExponentsIsRefused) {
  EXPECT_THROW(
      model_of("lagrangian = \"(1 + ph^-.2222222222222222223)^(1/2)*(w1^2 + w2^2 + w3^2)\"\n" +
               kEulerAngles),
      TooLarge);
}

TEST(Frame, LagrangianThatIsNotQuadraticIsCheckedBesideItsHamiltonian) {
  // L = w^4/4: M = w^3, H = 3/4 M^(4/3), for M > 0.
  const std::string rest =
      "[phase_space]\ndomain = [\"M > 0\"]\n[phase_space.vector_fields]\ncoordinates = "
      "[\"q\"]\nmomenta = [\"M\"]\nvelocities = [\"w\"]\nM = [\"1\"]\n";
  const std::string lagrangian = "lagrangian = \"w^4/4\"\n";
  EXPECT_EQ(proof_of(model_of(lagrangian + "hamiltonian = \"3*M^(4/3)/4\"\n" + rest),
                     "Legendre transform")
                .verdict,
            Verdict::proved);
  EXPECT_EQ(
      proof_of(model_of(lagrangian + "hamiltonian = \"M^(4/3)/4\"\n" + rest), "Legendre transform")
          .verdict,
      Verdict::refuted);
}

}  // namespace
}  // namespace casimir::test
