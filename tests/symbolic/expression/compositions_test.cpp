// What a composition f(phi(x)) is written with has values where f has them at phi(x), though they
// cancel in it: log(w) - log(-1 - u^2) at w = -1 - q^2, u = q has a value nowhere, w/v at
// w = p^3, v = p^2 none at p = 0.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/discrete/maps.hpp"

namespace casimir::test {
namespace {

using Conditions = std::vector<std::string>;

const std::string kThreeNames = R"toml([phase_space]
variables = ["x", "y", "w"]
)toml";

/// Of a map from (q, p), with what is said of its target, its expressions and its inverse.
Proof of_map(const std::string& said, const std::string& name) {
  const std::string plane = R"toml(hamiltonian = "p^2"
[phase_space]
variables = ["q", "p"]
canonical = true
[[map]]
name = "m"
)toml";
  for (const Proof& proof : prove(model_of(plane + said)))
    if (proof.kind == ClaimKind::map && proof.name == name) return proof;
  ADD_FAILURE() << "no claim " << name;
  return {};
}

TEST(Compositions, OfAnInverseWithItsMap) {
  const std::string logarithms = R"toml(
to = { variables = ["u", "v", "w"], brackets = { "u,v" = "1", "v,w" = "2*u" } }
expressions = { u = "q", v = "p", w = "-q^2 - 1" }
[[map.inverse]]
expressions = { q = "u + log(w) - log(-1 - u^2)", p = "v" }
)toml";
  EXPECT_EQ(of_map(logarithms, "m, right inverse").verdict, Verdict::undecided);
  const std::string quotient = R"toml(
to = { variables = ["u", "v"], brackets = { "u,v" = "v" } }
expressions = { u = "q*p", v = "p" }
[[map.inverse]]
expressions = { q = "u/v", p = "v" }
)toml";
  EXPECT_EQ(of_map(quotient, "m, right inverse").verdict, Verdict::proved);
  EXPECT_EQ(of_map(quotient, "m, right inverse").nonzero, Conditions{"p"});
}

TEST(Compositions, OfABracketWithAMap) {
  const std::string logarithms = R"toml(
expressions = { u = "q", v = "p", w = "-q^2 - 1" }
[map.to]
variables = ["u", "v", "w"]
brackets = { "u,v" = "1 + log(w) - log(-1 - u^2)", "v,w" = "2*u" }
)toml";
  EXPECT_EQ(of_map(logarithms, "m").verdict, Verdict::undecided);
  const std::string quotient = R"toml(
expressions = { u = "q", v = "p^2/2", w = "p^3/2" }
[map.to]
variables = ["u", "v", "w"]
brackets = { "u,v" = "w/v", "u,w" = "3*v" }
)toml";
  EXPECT_EQ(of_map(quotient, "m").verdict, Verdict::proved);
  EXPECT_EQ(of_map(quotient, "m").nonzero, Conditions{"p"});
}

TEST(Compositions, OfADomainAndAnImageWithAMap) {
  const auto target = [](const std::string& more, const std::string& domain) {
    return "expressions = { u = \"q\", v = \"p\", w = \"-q^2 - 1\" }\n" + more +
           "[map.to]\nvariables = [\"u\", \"v\", \"w\"]\n" +
           "brackets = { \"u,v\" = \"1\", \"v,w\" = \"2*u\" }\n" + domain;
  };
  EXPECT_EQ(of_map(target("", "domain = [\"w < 0\"]\n"), "m").verdict, Verdict::proved);
  EXPECT_EQ(of_map(target("", "domain = [\"w + log(w) - log(-1 - u^2) < 0\"]\n"), "m").verdict,
            Verdict::undecided);
  const Proof image = of_map(target("image = [\"w/u - (-1 - u^2)/u\"]\n", ""), "m");
  EXPECT_EQ(image.verdict, Verdict::proved);
  EXPECT_EQ(image.nonzero, Conditions{"q"});
}

TEST(Compositions, OfStepsOfADiscreteMap) {
  const auto verdict = [](const std::string& second) {
    return verdict_of(map_of(kThreeNames +
                             "[[map_step]]\nexpressions = { y = \"-1 - x^2\", w = \"-1 - x^2\" }\n"
                             "[[map_step]]\nexpressions = { x = \"" +
                             second + "\" }\n[integrals]\nF = \"x\"\n"),
                      ClaimKind::integral);
  };
  EXPECT_EQ(verdict("x + y - w"), Verdict::proved);
  EXPECT_EQ(verdict("x + log(y) - log(w)"), Verdict::undecided);
}

TEST(Compositions, OfAFunctionWithADiscreteMap) {
  const MapModel quotient = map_of(kThreeNames + R"toml([map]
x = "x*y/w"
y = "x - x^3"
w = "x - x^3"
[integrals]
F = "x*y/w"
)toml");
  EXPECT_EQ(verdict_of(quotient, ClaimKind::integral), Verdict::proved);
  EXPECT_EQ(proof_of(quotient, ClaimKind::integral).nonzero,
            (Conditions{"w", "x", "x + 1", "x - 1"}));
  const MapModel conjugate = map_of(kPhaseSpaceOfPlane + R"toml([map]
x = "x^2*y"
y = "y"
[[conjugacy]]
name = "k"
expressions = { u = "x*y^2", v = "y" }
map = { u = "u^2/v", v = "v" }
)toml");
  const Proof conjugacy = proof_of(conjugate, ClaimKind::conjugacy);
  EXPECT_EQ(conjugacy.verdict, Verdict::proved);
  EXPECT_NE(std::ranges::find(conjugacy.nonzero, "y"), conjugacy.nonzero.end());
}

}  // namespace
}  // namespace casimir::test
