// Maps that jump, and compositions without a value on a level.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/symbolic/discrete/maps.hpp"

namespace casimir::test {
namespace {

MapModel of_canonical_plane(const std::string& map) {
  return map_of("integrable = true\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n" +
                map + "[integrals]\nF = \"p^2 + q^2\"\n");
}

/// One half of each circle is turned forwards and the other backwards: two points go to one, and
/// orbits end in cycles of two.
TEST(MapJumps, AMapThatJumpsOnTheToriIsNoShiftOfThem) {
  for (const char* map :
       {"[map]\nq = \"3/5*q - sign(q)*4/5*p\"\np = \"sign(q)*4/5*q + 3/5*p\"\n",
        "[[map_step]]\nexpressions = { q = \"3/5*q - sign(q)*4/5*p\", p = \"sign(q)*4/5*q + "
        "3/5*p\" }\n[[map_step]]\nexpressions = { q = \"p\", p = \"-q\" }\n"}) {
    const Proof proof = proof_of(of_canonical_plane(map), ClaimKind::liouville);
    EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
    EXPECT_EQ(std::ranges::count(proof.where, "on motions that do not cross q = 0"), 1);
  }
  const Proof smooth =
      proof_of(of_canonical_plane("[map]\nq = \"3/5*q - 4/5*p\"\np = \"4/5*q + 3/5*p\"\n"),
               ClaimKind::liouville);
  EXPECT_EQ(smooth.verdict, Verdict::proved) << smooth.reason;
  EXPECT_TRUE(smooth.where.empty());
}

/// Circles inside and outside of the unit circle are turned differently, and none crosses it.
TEST(MapJumps, AMapMayJumpAcrossWhatItKeeps) {
  const Proof proof =
      proof_of(of_canonical_plane(
                   "[map]\nq = \"q*cos(sign(p^2 + q^2 - 1)) - p*sin(sign(p^2 + q^2 - 1))\"\np "
                   "= \"q*sin(sign(p^2 + q^2 - 1)) + p*cos(sign(p^2 + q^2 - 1))\"\n"),
               ClaimKind::liouville);
  EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
  EXPECT_TRUE(std::ranges::none_of(proof.where, [](const std::string& condition) {
    return condition.find("cross") != std::string::npos;
  }));
}

/// The second step has a pole that the first one moves.
TEST(MapJumps, ConditionsOfACompositionAreInTheVariablesOfItsStart) {
  const Proof proof = proof_of(
      of_canonical_plane("[[map_step]]\nexpressions = { q = \"3/5*q - 4/5*p\", p = \"4/5*q + "
                         "3/5*p\" }\n[[map_step]]\nexpressions = { q = \"sign(p)*q\", p = "
                         "\"sign(p)*p\" }\n"),
      ClaimKind::liouville);
  EXPECT_EQ(std::ranges::count(proof.nonzero, "p"), 0);
}

/// From y = 0 the first step leads to the origin, where the second has no value.
TEST(MapJumps, ACompositionWithoutAValueOnALevelSaysNothingOfIt) {
  const std::string steps =
      kPhaseSpaceOfPlane +
      "[[map_step]]\nexpressions = { x = \"x*y + y\", y = \"y\" }\n[[map_step]]\nexpressions = { "
      "x = \"x\", y = \"y/x\" }\n";
  const MapModel nowhere =
      map_of(steps +
             "[[invariant_relation]]\nname = \"r\"\nexpression = \"y\"\n[[conditional]]\nname = "
             "\"c\"\nexpression = \"7*y\"\non = [\"y\"]\n");
  for (const ClaimKind kind : {ClaimKind::invariant_relation, ClaimKind::conditional})
    EXPECT_EQ(verdict_of(nowhere, kind), Verdict::undecided);
  const MapModel somewhere =
      map_of(kPhaseSpaceOfPlane +
             "[[map_step]]\nexpressions = { x = \"x + y + 1\", y = \"y\" }\n[[map_step]]\n"
             "expressions = { x = \"x\", y = \"y/x\" }\n[[invariant_relation]]\nname = "
             "\"r\"\nexpression = \"y\"\n");
  EXPECT_EQ(verdict_of(somewhere, ClaimKind::invariant_relation), Verdict::proved);
}

/// The angle is tripled, so that S takes three points of the circle to one.
TEST(MapJumps, ASymmetryOnConstraintsThatIsNotAffineIsLocal) {
  const Proof proof = proof_of(
      map_of(kPhaseSpaceOfPlane +
             "constraints = [\"x^2 + y^2 - 1\"]\n[map]\nx = \"x^2 - y^2\"\ny = \"2*x*y\"\n"
             "[[symmetry]]\nname = \"S\"\nexpressions = { x = \"x^3 - 3*x*y^2\", y = \"3*x^2*y - "
             "y^3\" }\n"),
      ClaimKind::map, "S, symmetry");
  EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
  EXPECT_NE(proof.evidence.find("locally"), std::string::npos) << proof.evidence;
}

}  // namespace
}  // namespace casimir::test
