// Claims and facts of a phase space that constraints make a part of the space of the variables:
// what is so outside of them neither proves nor refutes anything. Each test drops a hypothesis.
#include <gtest/gtest.h>

#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

/// The proof of the only claim of a kind, or of the one with this name.
Proof proof_within(const std::string& kind, const std::string& text, const std::string& name = "") {
  const Model model = model_of(text);
  for (Proof& proof : prove(model)) {
    if (to_string(proof.kind) == kind && (name.empty() || proof.name == name))
      return std::move(proof);
  }
  ADD_FAILURE() << "no claim of the kind " << kind;
  return {};
}

/// The line y = 0, or the curve that is given, of a plane.
std::string on_curve(const std::string& constraint, const std::string& dx, const std::string& dy,
                     const std::string& more) {
  return "[phase_space]\nvariables = [\"x\", \"y\"]\nconstraints = [\"" + constraint +
         "\"]\n[equations]\nx = \"" + dx + "\"\ny = \"" + dy + "\"\n" + more;
}

TEST(Constraints, AnIntegralOfTheMotionOnThemIsProved) {
  const std::string integral = "[integrals]\nF = \"x\"\n";
  const Proof proved = proof_within("integral", on_curve("y", "y", "x*y", integral));
  EXPECT_EQ(proved.verdict, Verdict::proved);
  EXPECT_EQ(proved.on, (std::vector<std::string>{"y"}));
  // Outside of constraints that the motion leaves nothing is known of it.
  EXPECT_NE(proof_within("integral", on_curve("y", "y", "1 + x*y", integral)).verdict,
            Verdict::proved);
  // The witness lies on the constraints.
  const Proof refuted = proof_within("integral", on_curve("y", "1 + y", "x*y", integral));
  EXPECT_EQ(refuted.verdict, Verdict::refuted);
  ASSERT_TRUE(refuted.witness);
  EXPECT_EQ(refuted.witness->point.at(1), (std::pair<std::string, std::string>{"y", "0"}));
}

TEST(Constraints, AnIdentityOnThemIsProved) {
  const auto identity = [](const char* left) {
    return proof_within(
        "identity", on_curve("y", "0", "0",
                             std::string("[[identity]]\nname = \"i\"\nleft = \"") + left + "\"\n"));
  };
  EXPECT_EQ(identity("x*y").verdict, Verdict::proved);
  EXPECT_EQ(identity("x*y + x").verdict, Verdict::refuted);
}

TEST(Constraints, ARelationThatOnlyBreaksOutsideOfThemIsProved) {
  const std::string relation = "[[invariant_relation]]\nname = \"r\"\nexpression = \"x - 1\"\n";
  EXPECT_EQ(proof_within("invariant_relation", on_curve("y", "y", "x*y", relation), "r").verdict,
            Verdict::proved);
  EXPECT_EQ(
      proof_within("invariant_relation", on_curve("y", "y + 1", "x*y", relation), "r").verdict,
      Verdict::refuted);
}

// What is about points nearby as well is not proved by its residual being zero on the constraints.
TEST(Constraints, ADensityIsNotProvedByWhatHoldsOnThem) {
  const std::string measure = "[[measure]]\ndensity = \"1\"\n";
  EXPECT_EQ(proof_within("measure", on_curve("y", "x*y", "0", measure)).verdict,
            Verdict::undecided);
  EXPECT_EQ(proof_within("measure", on_curve("y", "x", "0", measure)).verdict, Verdict::refuted);
}

std::string neumann(const std::string& more) {
  return "hamiltonian = \"(p1^2+p2^2+p3^2)/2 + (q1^2 + 2*q2^2 + 4*q3^2)/2\"\nintegrable = true\n"
         "[phase_space]\nvariables = [\"q[1..3]\",\"p[1..3]\"]\ncanonical = true\n"
         "constraints = [\"q1^2+q2^2+q3^2-1\",\"q1*p1+q2*p2+q3*p3\"]\ndirac = true\n"
         "[integrals]\n" +
         more;
}

// Uhlenbeck's integrals of Neumann's system are constant on the sphere, not around it.
TEST(Constraints, NeumannsIntegralsAreProvedOnTheSphere) {
  const std::string two =
      "K1 = \"q1^2 + (q1*p2-q2*p1)^2/(1-2) + (q1*p3-q3*p1)^2/(1-4)\"\n"
      "K2 = \"q2^2 + (q1*p2-q2*p1)^2/(2-1) + (q2*p3-q3*p2)^2/(2-4)\"\n";
  for (const char* name : {"K1", "K2"})
    EXPECT_EQ(proof_within("integral", neumann(two), name).verdict, Verdict::proved) << name;
  EXPECT_EQ(proof_within("liouville", neumann(two)).verdict, Verdict::proved);
  const Proof wrong = proof_within("integral", neumann("K = \"q1^2 + (q1*p2-q2*p1)^2\"\n"));
  EXPECT_EQ(wrong.verdict, Verdict::refuted);
}

// Functions that are equal on the constraints are not independent there.
TEST(Constraints, FunctionsAreIndependentOnThem) {
  const std::string energy =
      "E = \"(p1^2+p2^2+p3^2)/2 + (q1^2 + 2*q2^2 + 4*q3^2)/2 + (q1^2 + q2^2 + q3^2 - 1)*q1\"\n";
  EXPECT_EQ(proof_within("independence", neumann(energy)).verdict, Verdict::undecided);
  EXPECT_EQ(proof_within("independence", neumann("K = \"q1*p2\"\n")).verdict, Verdict::proved);
}

std::string on_leaf(const std::string& c, const std::string& constraint) {
  return "hamiltonian = \"x\"\nintegrable = true\n[phase_space]\nvariables = [\"x\", \"y\", "
         "\"c\"]\n"
         "brackets = { \"x,y\" = \"" +
         c + "\" }\nconstraints = [\"" + constraint + "\"]\n[casimirs]\nC = \"c\"\n";
}

// The leaves on the constraints may be smaller than almost all others.
TEST(Constraints, TheRankIsThatOnThem) {
  for (const char* kind : {"rank", "liouville"}) {
    EXPECT_EQ(proof_within(kind, on_leaf("c", "c")).verdict, Verdict::undecided) << kind;
    EXPECT_EQ(proof_within(kind, on_leaf("c", "c - 1")).verdict, Verdict::proved) << kind;
    EXPECT_EQ(proof_within(kind, on_leaf("1 + c", "c")).verdict, Verdict::proved) << kind;
  }
}

}  // namespace
}  // namespace casimir::test
