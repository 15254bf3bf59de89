// Claims about maps between phase spaces: of which sign they are, where they hold and where they
// lead.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "symbolic/prove.hpp"
#include "tests/folder.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/proof/proof_of.hpp"

namespace casimir::test {
namespace {

const std::string kRotations =
    "[phase_space]\nvariables = [\"M1\",\"M2\",\"M3\"]\nalgebra = \"so(3)\"\n";

TEST(MapClaims, AntiPoissonMapNeedsItsSign) {
  const std::string head = "hamiltonian = \"0\"\n" + kRotations +
                           "[[map]]\nname = \"minus\"\nto = \"so(3)\"\nexpressions = { M1 = "
                           "\"-M1\", M2 = \"-M2\", M3 = \"-M3\" }\n";
  EXPECT_EQ(proof_of(model_of(head + "sign = \"-\"\n"), "map").verdict, Verdict::proved);
  EXPECT_EQ(proof_of(model_of(head + "sign = \"+\"\n"), "map").verdict, Verdict::refuted);
}

TEST(MapClaims, MapOnALevelHoldsThereOnly) {
  // Directions of a rotation: {N1, N2} = N3 needs ga = al x be.
  const std::string head =
      "hamiltonian = \"0\"\n[phase_space]\nvariables = [\"M1\",\"M2\",\"M3\",\"a1\",\"a2\",\"a3\","
      "\"b1\",\"b2\",\"b3\",\"c1\",\"c2\",\"c3\"]\nalgebra = \"so(3)+3*R3\"\n[[map]]\nname = "
      "\"N\"\nto "
      "= \"so(3)\"\nsign = \"-\"\nexpressions = { M1 = \"M1*a1 + M2*a2 + M3*a3\", M2 = \"M1*b1 + "
      "M2*b2 + M3*b3\", M3 = \"M1*c1 + M2*c2 + M3*c3\" }\n";
  const std::string level =
      "on = [\"a2*b3 - a3*b2 - c1\", \"a3*b1 - a1*b3 - c2\", \"a1*b2 - a2*b1 - c3\", "
      "\"b2*c3 - b3*c2 - a1\", \"b3*c1 - b1*c3 - a2\", \"b1*c2 - b2*c1 - a3\", "
      "\"c2*a3 - c3*a2 - b1\", \"c3*a1 - c1*a3 - b2\", \"c1*a2 - c2*a1 - b3\"]\n";
  EXPECT_EQ(proof_of(model_of(head + level), "map").verdict, Verdict::proved);
  EXPECT_EQ(proof_of(model_of(head), "map").verdict, Verdict::refuted);
}

// The file beside the case comes first, then those that the caller knows.
TEST(MapClaims, AMapLeadsToTheCaseBesideIt) {
  const Folder folder;
  const std::string plane = "hamiltonian = \"0\"\n[phase_space]\nvariables = [\"Q\", \"P\"]\n";
  folder.write("double.toml", plane + "brackets = { \"Q,P\" = \"2\" }\n");
  folder.write(
      "a.toml",
      "hamiltonian = \"0\"\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n"
      "[[map]]\nname = \"m\"\nto = \"double\"\nexpressions = { Q = \"2*q\", P = \"p\" }\n");
  const CaseFile file = read_case(folder / "a.toml");
  EXPECT_EQ(proof_of(build_model(file), "map").verdict, Verdict::proved);
  const FindCase known = [&](const std::string&) -> std::optional<CaseFile> {
    return parse_case(plane + "canonical = true\n", "known.toml");
  };
  EXPECT_EQ(proof_of(build_model(file, {}, known), "map").verdict, Verdict::proved);
  std::filesystem::remove(folder / "double.toml");
  EXPECT_EQ(proof_of(build_model(file, {}, known), "map").verdict, Verdict::refuted);
  EXPECT_THROW(build_model(file), CaseError);
}

// Whatever a bracket multiplies sign(p) by: at p = 0 there is none.
TEST(MapClaims, ABracketIsOneWhereTheFunctionsAreDifferentiable) {
  const auto where = [](const std::string& image) {
    const Proof proof = proof_of(model_of(R"toml(
hamiltonian = "p^2/2"
[phase_space]
variables = ["q", "p"]
canonical = true
[[map]]
name = "kink"
to = { variables = ["Q", "P"], canonical = true }
expressions = { Q = "q + )toml" + image + "\", P = \"p\" }\n"),
                                 "map");
    EXPECT_EQ(proof.verdict, Verdict::proved) << image << ' ' << proof.reason;
    return proof.where;
  };
  const std::vector<std::string> beside = {"p != 0"};
  EXPECT_EQ(where("abs(p)"), beside);
  EXPECT_EQ(where("sqrt(p^2)"), beside);
  EXPECT_EQ(where("atan2(p, -1)"), beside);
  EXPECT_TRUE(where("p*abs(p)").empty());
  EXPECT_TRUE(where("(p^2)^(3/2)").empty());
  const Proof involution = proof_of(model_of(R"toml(
hamiltonian = "(p1^2 + p2^2)/2"
[phase_space]
variables = ["q1", "q2", "p1", "p2"]
canonical = true
[integrals]
A = "abs(p1)"
B = "p2"
)toml"),
                                    "involution");
  EXPECT_EQ(involution.verdict, Verdict::proved);
  EXPECT_EQ(involution.where, std::vector<std::string>{"p1 != 0"});
}

/// A map of the plane, and of a Casimir function c, to x, y and L.
Proof mapped(const std::string& l, const std::string& domain, const std::string& more = {}) {
  return proof_of(
      model_of("hamiltonian = \"p^2/2\"\n[phase_space]\nvariables = [\"q\", \"p\", \"c\"]\n"
               "brackets = { \"q,p\" = \"1\" }\n" +
               more +
               "[[map]]\nname = \"m\"\nto = { variables = [\"x\", \"y\", \"L\"], brackets = "
               "{\"x,y\" = \"1\"}, domain = [\"" +
               domain +
               "\"] }\nexpressions = { x = \"q\", "
               "y = \"p\", L = \"" +
               l + "\" }\n"),
      "map", "m");
}

TEST(MapClaims, AMapIntoTheComplementOfTheDomainIsNotProved) {
  for (const auto& [l, domain] :
       std::vector<std::pair<std::string, std::string>>{{"-1", "L > 0"},
                                                        {"0", "L > 0"},
                                                        {"0", "L != 0"},
                                                        {"1", "L < 0"},
                                                        {"1", "L <= 0"},
                                                        {"(c + 1)^2 - c^2 - 2*c - 1", "L != 0"}}) {
    const Proof proof = mapped(l, domain);
    EXPECT_EQ(proof.verdict, Verdict::undecided) << l << ' ' << domain;
    EXPECT_FALSE(proof.reason.empty());
  }
  // An equation of the domain has to hold at every point, as what `image` says.
  EXPECT_EQ(mapped("c", "L = 1").verdict, Verdict::refuted);
  EXPECT_EQ(mapped("1", "L = 1").verdict, Verdict::proved);
  EXPECT_EQ(mapped("0", "L <= 0").verdict, Verdict::proved);
}

TEST(MapClaims, AMapSaysWhereItLeadsIntoTheDomain) {
  const auto where = [](const std::string& l, const std::string& domain) {
    const Proof proof = mapped(l, domain);
    EXPECT_EQ(proof.verdict, Verdict::proved) << l << ' ' << domain << ' ' << proof.reason;
    return proof.where;
  };
  EXPECT_EQ(where("c", "L > 0"), std::vector<std::string>{"c > 0"});
  EXPECT_EQ(where("c", "L != 0"), std::vector<std::string>{"c != 0"});
  EXPECT_TRUE(where("1", "L > 0").empty());
}

// |x| is x where x > 0, and at q = -1/2 the inverse for that part is not used.
TEST(MapClaims, AnInverseOfAMapLeadsBackIntoTheDomain) {
  const auto verdict = [](const std::string& q, const std::string& p) {
    return proof_of(
               model_of("hamiltonian = \"p\"\n[phase_space]\nvariables = [\"q\", \"p\"]\n"
                        "domain = [\"q > 0\"]\ncanonical = true\n[[map]]\nname = \"m\"\n"
                        "to = { variables = [\"u\", \"v\"], brackets = { \"u,v\" = \"2*u\" } }\n"
                        "expressions = { u = \"q^2\", v = \"p*q\" }\n[[map.inverse]]\n"
                        "expressions = { q = \"" +
                        q + "\", p = \"" + p + "\" }\n"),
               "map", "m, right inverse")
        .verdict;
  };
  EXPECT_EQ(verdict("sqrt(u)", "v/sqrt(u)"), Verdict::proved);
  EXPECT_EQ(verdict("-sqrt(u)", "-v/sqrt(u)"), Verdict::undecided);
}

TEST(MapClaims, AnInverseOfAMapHoldsOnItsDomainAlone) {
  const auto verdict = [](const std::string& name, const std::string& q, const std::string& domain,
                          const std::string& image = {}) {
    return proof_of(
               model_of("hamiltonian = \"p^2/2\"\n[phase_space]\nvariables = [\"q\", \"p\"]\n"
                        "canonical = true\n[[map]]\nname = \"id\"\nto = { variables = [\"x\", "
                        "\"y\"], brackets = {\"x,y\" = \"1\"} }\nexpressions = { x = \"q\", y = "
                        "\"p\" }\n" +
                        image + "[[map.inverse]]\nexpressions = { q = \"" + q +
                        "\", p = \"y\" }\n" + domain),
               "map", name)
        .verdict;
  };
  const std::string inverse = "id, right inverse";
  const std::string positive = "domain = [\"x > 0\"]\n", negative = "domain = [\"x < 0\"]\n";
  EXPECT_EQ(verdict(inverse, "abs(x)", positive), Verdict::proved);
  EXPECT_EQ(verdict(inverse, "-abs(x)", negative), Verdict::proved);
  EXPECT_EQ(verdict(inverse, "abs(x)", negative), Verdict::refuted);
  EXPECT_EQ(verdict(inverse, "abs(x)", ""), Verdict::refuted);
  EXPECT_EQ(verdict(inverse, "abs(x)", "domain = [\"x^2 < 0\"]\n"), Verdict::undecided);
  // What is said of the image is said of all of it, beside the domain of the inverse too.
  EXPECT_EQ(verdict("id", "x", positive, "image = [\"abs(x) - x\"]\n"), Verdict::refuted);
}

}  // namespace
}  // namespace casimir::test
