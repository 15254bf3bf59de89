// Maps with arbitrary functions.
#include <gtest/gtest.h>

#include "symbolic/discrete/map_inverse.hpp"
#include "tests/symbolic/discrete/maps.hpp"

namespace casimir::test {
namespace {

/// A standard-like map q' = q + p, p' = p - U(q').
MapModel standard_like(const std::string& claims, const std::string& kick = "p - U(q + p)") {
  return map_of(
      "[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n[functions]\nU = "
      "[\"x\"]\n[map]\nq = \"q + p\"\np = \"" +
      kick + "\"\n" + claims);
}

TEST(MapFunctions, WhatHoldsForEachOfThemIsProved) {
  const MapModel map = standard_like(
      "[[measure]]\ndensity = \"1\"\n[[symmetry]]\nname = \"S\"\nexpressions = { q = "
      "\"q + p\", p = \"-p\" }\nreverses = true\n");
  for (const auto& [kind, name] : {std::pair{ClaimKind::map, "Poisson map"},
                                   {ClaimKind::measure, ""},
                                   {ClaimKind::map, "S, reversal"}}) {
    const Proof proof = proof_of(map, kind, name);
    EXPECT_EQ(proof.verdict, Verdict::proved) << name << ": " << proof.reason;
  }
  EXPECT_TRUE(discrete::proved_inverse(map));
}

/// Written as steps of a leapfrog or as one; no symmetry is given.
TEST(MapFunctions, MapsOfTheStandardKindHaveInverses) {
  EXPECT_TRUE(discrete::proved_inverse(standard_like("")));
  for (const char* map :
       {"p = \"p + K*sin(q)\"\nq = \"q + p + K*sin(q)\"\n",
        "q = \"q + p\"\np = \"p + K*sin(q + p)\"\n", "q = \"q + p + K*q^3\"\np = \"p + K*q^3\"\n"})
    EXPECT_TRUE(discrete::proved_inverse(
        map_of("[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n[parameters]\nK = "
               "{}\n[map]\n" +
               std::string(map))))
        << map;
  // Two points go to one.
  EXPECT_FALSE(discrete::proved_inverse(
      map_of(kPhaseSpaceOfPlane + "[map]\nx = \"x^2 + y\"\ny = \"x^2 - y\"\n")));
}

/// A rotation whose sine is tau(H): a claim is about something only for functions that are small.
TEST(MapFunctions, ADomainMayAskThemToBeSmall) {
  const auto rotation = [](const std::string& sign) {
    return map_of(R"toml(
[phase_space]
variables = ["q", "p"]
canonical = true
domain = ["1 - S^2 > 0"]
[functions]
tau = ["energy"]
[definitions]
H = "q^2 + p^2"
S = "tau(H)"
C = "sqrt(1 - S^2)"
[map]
q = "C*q + S*p"
p = "C*p )toml" + sign +
                  R"toml( S*q"
[integrals]
energy = "H"
)toml");
  };
  const MapModel right = rotation("-"), wrong = rotation("+");
  for (const auto& [kind, name] :
       {std::pair{ClaimKind::map, "Poisson map"}, {ClaimKind::integral, "energy"}}) {
    const Proof proof = proof_of(right, kind, name);
    EXPECT_EQ(proof.verdict, Verdict::proved) << name << ": " << proof.reason;
    EXPECT_EQ(verdict_of(wrong, kind, name), Verdict::refuted) << name;
  }
}

TEST(MapFunctions, ADensityHasASignWithoutThem) {
  const auto of = [](const std::string& density) {
    return proof_of(map_of("[phase_space]\nvariables = [\"x\", \"y\"]\n[functions]\nU = [\"r\"]\n"
                           "[map]\nx = \"x\"\ny = \"y + U(x)\"\n[[measure]]\ndensity = \"" +
                           density + "\"\n"),
                    ClaimKind::measure);
  };
  for (const char* density : {"1 + x^2", "exp(x)", "1 + U(x)^2"})
    EXPECT_EQ(of(density).verdict, Verdict::proved) << density << ": " << of(density).reason;
  EXPECT_EQ(of("1 + y^2").verdict, Verdict::refuted);
  EXPECT_EQ(of("exp(U(x))").evidence.find("both signs"), std::string::npos);
}

TEST(MapFunctions, WhatFailsForOneOfThemIsRefutedWithIt) {
  const Proof integral = proof_of(standard_like("[integrals]\nF = \"p\"\n"), ClaimKind::integral);
  EXPECT_EQ(integral.verdict, Verdict::refuted);
  ASSERT_TRUE(integral.witness);
  EXPECT_TRUE(std::ranges::any_of(integral.witness->point,
                                  [](const auto& value) { return value.first == "U(x)"; }));
  // An area is kept for U(q + p) and not for U(p).
  EXPECT_EQ(verdict_of(standard_like("", "p - U(p)"), ClaimKind::map, "Poisson map"),
            Verdict::refuted);
}

/// The same as two steps, each of which keeps areas for every U.
TEST(MapFunctions, StepsKeepWhatEachOfThemKeeps) {
  const MapModel steps = map_of(
      "[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n[functions]\nU = "
      "[\"x\"]\n[[map_step]]\nexpressions = { q = \"q + p\", p = \"p\" "
      "}\n[[map_step]]\nexpressions "
      "= { q = \"q\", p = \"p - U(q)\" }\n[[measure]]\ndensity = \"1\"\n[integrals]\nF = \"q\"\n");
  EXPECT_EQ(verdict_of(steps, ClaimKind::map, "Poisson map"), Verdict::proved);
  EXPECT_EQ(verdict_of(steps, ClaimKind::measure), Verdict::proved);
  EXPECT_EQ(verdict_of(steps, ClaimKind::integral), Verdict::refuted);
}

}  // namespace
}  // namespace casimir::test
