// Symmetries, reversals and conjugacies of maps.
#include <gtest/gtest.h>

#include "tests/symbolic/discrete/maps.hpp"

namespace casimir::test {
namespace {

/// A shear of the plane beside a conjugacy of it.
MapModel sheared(const std::string& expressions, const std::string& other,
                 const std::string& more = "") {
  return map_of(kPhaseSpaceOfPlane +
                "[parameters]\na = {}\n[map]\nx = \"x + y\"\ny = \"y + a*(x + y)\"\n" +
                "[[conjugacy]]\nname = \"c\"\nexpressions = { " + expressions + " }\nmap = { " +
                other + " }\n" + more);
}

TEST(MapSymmetryClaims, AConjugacyTakesOneMapIntoAnother) {
  // x+ + x- = (2 + a) x, with X = x and Y the x before, (1 + a) x - y.
  const std::string change = "X = \"x\", Y = \"(1 + a)*x - y\"";
  const std::string recurrence = "X = \"(2 + a)*X - Y\", Y = \"X\"";
  EXPECT_EQ(verdict_of(sheared(change, recurrence), ClaimKind::conjugacy), Verdict::proved);
  const Proof wrong =
      proof_of(sheared(change, "X = \"(1 + a)*X - Y\", Y = \"X\""), ClaimKind::conjugacy);
  EXPECT_EQ(wrong.verdict, Verdict::refuted);
  EXPECT_TRUE(wrong.witness);
  // Into the inverse: backwards the next X is the Y of now.
  const std::string backwards = "X = \"Y\", Y = \"(2 + a)*Y - X\"";
  EXPECT_EQ(verdict_of(sheared(change, backwards, "reverses = true\n"), ClaimKind::conjugacy),
            Verdict::proved);
  EXPECT_EQ(verdict_of(sheared(change, backwards), ClaimKind::conjugacy), Verdict::refuted);
}

/// A constant is carried into any map that has it as a fixed point.
TEST(MapSymmetryClaims, AConjugacyIsInvertible) {
  const Proof constant =
      proof_of(sheared("X = \"0\", Y = \"0\"", "X = \"X*Y\", Y = \"X^2\""), ClaimKind::conjugacy);
  EXPECT_EQ(constant.verdict, Verdict::refuted);
  EXPECT_NE(constant.reason.find("not invertible"), std::string::npos);
  // x and 2 x obey the same recurrence: a line in the plane of X, Y.
  EXPECT_EQ(verdict_of(map_of(kPhaseSpaceOfPlane +
                              "[map]\nx = \"2*x\"\ny = \"y/3\"\n[[conjugacy]]\nname = "
                              "\"c\"\nexpressions = { X = \"x\", Y = \"2*x\" }\nmap = { X = "
                              "\"2*X\", Y = \"2*Y\" }\n"),
                       ClaimKind::conjugacy),
            Verdict::refuted);
}

/// Everything is mapped to x = 0, where (x, x*y) has one value: it would take the doubling of y
/// into a constant map.
TEST(MapSymmetryClaims, AConjugacyIsInvertibleWhereTheMapLeads) {
  const Proof proof =
      proof_of(map_of(kPhaseSpaceOfPlane +
                      "[map]\nx = \"0\"\ny = \"2*y\"\n[[conjugacy]]\nname = \"c\"\nexpressions = { "
                      "X = \"x\", Y = \"x*y\" }\nmap = { X = \"0\", Y = \"0\" }\n"),
               ClaimKind::conjugacy);
  EXPECT_EQ(proof.verdict, Verdict::undecided);
  EXPECT_NE(proof.reason.find("where the map leads"), std::string::npos) << proof.reason;
}

/// x + y and x*y are the same for (x, y) and (y, x): what is proved is local.
TEST(MapSymmetryClaims, AConjugacyIsLocal) {
  const Proof proof =
      proof_of(map_of(kPhaseSpaceOfPlane +
                      "[map]\nx = \"y\"\ny = \"x\"\n[[conjugacy]]\nname = \"c\"\nexpressions = { X "
                      "= \"x + y\", Y = \"x*y\" }\nmap = { X = \"X\", Y = \"Y\" }\n"),
               ClaimKind::conjugacy);
  EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
  EXPECT_EQ(proof.evidence.find("locally"), 0U) << proof.evidence;
}

/// abs(x) takes -x into itself, but no point of x > 0 stays there.
TEST(MapSymmetryClaims, OfConjugaciesNothingIsSaidOnDomains) {
  EXPECT_EQ(verdict_of(map_of("[phase_space]\nvariables = [\"x\"]\ndomain = [\"x > 0\"]\n[map]\nx "
                              "= \"-x\"\n[[conjugacy]]\nname = \"c\"\nexpressions = { X = "
                              "\"abs(x)\" }\nmap = { X = \"X\" }\n"),
                       ClaimKind::conjugacy),
            Verdict::undecided);
}

TEST(MapSymmetryClaims, AConjugacyThatCannotBeReadIsRefused) {
  const std::string change = "X = \"x\", Y = \"(1 + a)*x - y\"";
  EXPECT_THROW(sheared("X = \"x\"", "X = \"X\""), CaseError);
  EXPECT_THROW(sheared(change, "X = \"x\", Y = \"Y\""), CaseError);
  EXPECT_THROW(sheared("a = \"x\", Y = \"y\"", "a = \"a\", Y = \"Y\""), CaseError);
  EXPECT_THROW(sheared("x = \"x\", Y = \"y\"", "x = \"x\", Y = \"Y\""), CaseError);
}

TEST(MapSymmetryClaims, ReversalsTakeParametersAlong) {
  const std::string shear = kPhaseSpaceOfPlane +
                            "[parameters]\ne = {}\n[map]\nx = \"x + e*y^2\"\ny = \"y\"\n"
                            "[[symmetry]]\nname = \"s\"\nreverses = true\nexpressions = ";
  EXPECT_EQ(verdict_of(map_of(shear + "{ e = \"-e\" }\n"), ClaimKind::map), Verdict::proved);
  EXPECT_EQ(verdict_of(map_of(shear + "{ x = \"-x\" }\n"), ClaimKind::map), Verdict::proved);
  EXPECT_EQ(verdict_of(map_of(shear + "{ y = \"-y\" }\n"), ClaimKind::map), Verdict::refuted);
}

// A constant S, to a fixed point, obeys both equations of every map.
TEST(MapSymmetryClaims, ASymmetryIsInvertible) {
  const auto verdict = [](const std::string& s, const std::string& more = "") {
    return verdict_of(
        map_of(kPhaseSpaceOfPlane +
               "[parameters]\ne = {}\n[map]\nx = \"x + y^2\"\ny = \"2*y + x*y + y^3\"\n" +
               "[[symmetry]]\nname = \"s\"\n" + more + "expressions = " + s + "\n"),
        ClaimKind::map);
  };
  EXPECT_EQ(verdict("{ x = \"0\", y = \"0\" }"), Verdict::refuted);
  EXPECT_EQ(verdict("{ x = \"0\", y = \"0\" }", "reverses = true\n"), Verdict::refuted);
  EXPECT_EQ(verdict("{ x = \"x\", y = \"-y\" }"), Verdict::proved);
  // A parameter that the map does not have may go anywhere, but not to one value.
  EXPECT_EQ(verdict("{ y = \"-y\", e = \"e^3\" }"), Verdict::proved);
  EXPECT_EQ(verdict("{ y = \"-y\", e = \"1\" }"), Verdict::refuted);
  EXPECT_THROW(verdict("{ e = \"x\" }"), CaseError);
}

/// y -> |y| commutes with a shift of x, and is not one to one.
TEST(MapSymmetryClaims, ASymmetryThatIsNotAffineIsLocal) {
  const auto evidence = [](const std::string& y) {
    const Proof proof =
        proof_of(map_of(kPhaseSpaceOfPlane +
                        "[map]\nx = \"x + 1\"\ny = \"y\"\n[[symmetry]]\nname = \"S\"\n"
                        "expressions = { y = \"" +
                        y + "\" }\n"),
                 ClaimKind::map);
    EXPECT_EQ(proof.verdict, Verdict::proved) << y;
    return proof.evidence;
  };
  for (const char* y : {"abs(y)", "y^2", "y + sin(y)/2"})
    EXPECT_NE(evidence(y).find("locally"), std::string::npos) << y;
  EXPECT_EQ(evidence("-2*y + 1").find("locally"), std::string::npos);
}

TEST(MapSymmetryClaims, ASymmetryKeepsConstraintsAndDomain) {
  // S and R take the line z = 0 to one point.
  const MapModel constrained = map_of(R"toml(
[phase_space]
variables = ["x", "z"]
constraints = ["z"]
[map]
x = "2*x"
z = "z"
[[symmetry]]
name = "S"
expressions = { x = "z*x", z = "z" }
[[symmetry]]
name = "R"
expressions = { x = "z/x", z = "z" }
reverses = true
)toml");
  EXPECT_EQ(verdict_of(constrained, ClaimKind::map, "S, symmetry"), Verdict::undecided);
  EXPECT_EQ(verdict_of(constrained, ClaimKind::map, "R, reversal"), Verdict::undecided);
  const MapModel bounded = map_of(R"toml(
[phase_space]
variables = ["x", "y"]
domain = ["x > 0"]
[parameters]
eps = { assume = "eps > 0" }
[map]
x = "x + eps*x*y^2"
y = "y"
[[symmetry]]
name = "out"
expressions = { x = "-x" }
[[symmetry]]
name = "parameter"
expressions = { y = "2*y", eps = "eps/4" }
[[symmetry]]
name = "in"
expressions = { x = "3*x", y = "-y" }
)toml");
  EXPECT_EQ(verdict_of(bounded, ClaimKind::map, "out, symmetry"), Verdict::undecided);
  EXPECT_EQ(verdict_of(bounded, ClaimKind::map, "parameter, symmetry"), Verdict::proved);
  EXPECT_EQ(verdict_of(bounded, ClaimKind::map, "in, symmetry"), Verdict::proved);
}

TEST(MapSymmetryClaims, AConjugacySaysWhereTheMapLeadsToWhereItIsInvertible) {
  const MapModel map =
      map_of(kPhaseSpaceOfPlane +
             "[parameters]\na = {}\n[map]\nx = \"a*x\"\ny = \"y\"\n"
             "[[conjugacy]]\nname = \"c\"\nexpressions = { u = \"x^2\", v = \"y\" }"
             "\nmap = { u = \"a^2*u\", v = \"v\" }\n");
  const Proof proof = proof_of(map, ClaimKind::conjugacy);
  EXPECT_EQ(proof.verdict, Verdict::proved);
  EXPECT_EQ(proof.where, std::vector<std::string>{"a != 0"});
}

}  // namespace
}  // namespace casimir::test
