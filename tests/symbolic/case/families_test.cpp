// Systems of n parts: sums, products, members of families, and keys that stand for many names.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <variant>

#include "symbolic/case/name_families.hpp"
#include "symbolic/discrete/map_case.hpp"
#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/expression/reads_expressions.hpp"

namespace casimir::test {
namespace {

class Families : public ReadsExpressions {
 protected:
  Families(std::initializer_list<const char*> names = {"x1", "x2", "x3", "x12", "x1_12", "y", "j"})
      : ReadsExpressions(names) {
    names_.add("n", {GiNaC::numeric(3)});
  }
};

std::string names_in(const std::string& text) {
  std::string names;
  for (const FamilyMember& member : members_of({text, {"test", 1, 1}, text}, {{"n", 3}}, {})) {
    names += member.name.value;
    for (const auto& [letter, value] : member.indices)
      names += " " + letter + std::to_string(value);
    names += "; ";
  }
  return names;
}

std::string error_of_names(const std::string& text) {
  return error_in([&] { names_in(text); });
}

TEST_F(Families, SumsAndProductsAreWrittenOut) {
  const std::pair<const char*, const char*> same[] = {
      {"sum(i, 1, n, x[i]^i)", "x1 + x2^2 + x3^3"},
      {"product(i, 1, 3, x[i] + i)", "(x1 + 1)*(x2 + 2)*(x3 + 3)"},
      {"sum(i, 1, n, sum(k, i + 1, n, x[i]*x[k]))", "x1*x2 + x1*x3 + x2*x3"},
      {"sum(i, 2, 1, x[i]) + product(i, 5, n, unread(i))", "1"},
      {"x[1, 2] + x[1, 12] + x[12] + x[n]", "2*x12 + x1_12 + x3"},
      {"sum(i, 1, n, x[mod(i, n) + 1]*x[mod(i - 2, n) + 1])", "x2*x3 + x3*x1 + x1*x2"},
      {"2^sum(i, 1, 3, 1) + sin(sum(i, -1, 1, i*y))", "8"},
      {"-sum(i, 1, 2, x[i])^2", "-(x1 + x2)^2"},
  };
  for (const auto& [families, plain] : same)
    EXPECT_TRUE((parse(families) - parse(plain)).expand().is_zero())
        << families << " is " << parse(families);
}

TEST_F(Families, WhatIsMeantOtherwiseIsRefusedWithItsPlace) {
  const std::pair<const char*, const char*> wrong[] = {
      {"sum(i, 1, y, i)", "11: the last value has to be an integer"},
      {"sum(i, 1/2, 3, i)", "8: the first value has to be an integer"},
      {"sum(j, 1, 3, x1)", "5: 'j' is a name of this case, and no index"},
      {"sum(Pi, 1, 3, Pi)", "5: "},
      {"sum(I, 1, 3, I)", "5: "},
      {"sum(sin, 1, 3, sin)", "5: "},
      {"\\sqrt[3]{y}", "2: 'sqrt' is a function"},
      {"sum(i, 1, 3, sum(i, 1, 2, i))", "18: the index 'i' has a range already"},
      {"sum(i, 1, 3, x[i]) + i", "22: 'i' is not declared"},
      {"sum(i, 1, i, x[i])", "11: 'i' is not declared"},
      {"sum(i, 1, 4, x[i])", "14: 'x4' is not declared"},
      {"x[y]", "3: an index has to be an integer"},
      {"x[1 - n]", "3: an index is not negative"},
      {"sum(i, 1, 3)", "12: unexpected ')'"},
      {"mod(2, 0)", "1: mod(a, b) needs b > 0"},
      {"mod(y, 2)", "5: what is divided has to be an integer"},
      {"x[1", "4: unexpected end"},
      {"sum(i, 1, 10^12, 1)", "11: the last value has to be an integer"},
  };
  expect_errors(wrong);
}

class Vectors : public Families {
 protected:
  Vectors()
      : Families({"a1", "a2", "a3", "b1", "b2", "b3", "c1", "c2", "c3", "p1", "p2", "s", "x1", "x2",
                  "x3"}) {}
};

TEST_F(Vectors, ObeyTheirIdentities) {
  const std::pair<const char*, const char*> same[] = {
      {"dot(a, b)", "a1*b1 + a2*b2 + a3*b3"},
      {"dot(p, p)", "p1^2 + p2^2"},
      {"cross(a, b)[1]", "a2*b3 - a3*b2"},
      {"cross(a, b)[n]", "a1*b2 - a2*b1"},
      {"dot(cross(a, b), a)", "0"},
      {"dot(cross(a, b), c)", "a1*(b2*c3 - b3*c2) + a2*(b3*c1 - b1*c3) + a3*(b1*c2 - b2*c1)"},
      {"cross(a, cross(b, c))[2]", "b2*dot(a, c) - c2*dot(a, b)"},
      {"dot(cross(a, b), cross(a, b))", "dot(a, a)*dot(b, b) - dot(a, b)^2"},
      {"dot(s*a - 2*(b + c)/s, a)", "s*dot(a, a) - 2*(dot(b, a) + dot(c, a))/s"},
      {"dot(dot(a, b)*c, -a)", "-dot(a, b)*dot(c, a)"},
      {"sum(k, 1, 3, cross(a, b)[k]^2)", "dot(cross(a, b), cross(a, b))"},
      {"dot(sum(i, 1, 2, i*a), b)", "3*dot(a, b)"},
      {"dot(cross(a, b)[1]*p, p) + dot(p, cross(a, b)[2]*p)",
       "((a2*b3 - a3*b2) + (a3*b1 - a1*b3))*(p1^2 + p2^2)"},
      {"sqrt(dot(a, a))*a[2]", "sqrt(a1^2 + a2^2 + a3^2)*a2"},
  };
  for (const auto& [vectors, plain] : same)
    EXPECT_TRUE((parse(vectors) - parse(plain)).expand().is_zero())
        << vectors << " is " << parse(vectors);
}

TEST_F(Vectors, WhatIsNoVectorAlgebraIsRefusedWithItsPlace) {
  const std::pair<const char*, const char*> wrong[] = {
      {"a", "1: 'a' is not declared"},
      {"dot(a*b, c)", "6: a vector times a vector"},
      {"dot(a, 1/b)", "9: this divides by a vector"},
      {"dot(a + 1, b)", "7: a vector and a number are added"},
      {"dot(1 - a, b)", "7: a vector and a number are added"},
      {"dot(a^2, b)", "6: a vector has no powers"},
      {"dot(s^a, b)", "6: a number stands here, and no vector"},
      {"dot(sin(a), b)", "9: a number stands here, and no vector"},
      {"dot(a, s)", "7: a vector stands here"},
      {"dot(a, p)", "8: 'p' has 2 components, and 3 are needed here"},
      {"dot(p, cross(a, b))", "8: cross(a, b) has 3 components, and 2 are needed here"},
      {"dot(a, q)", "8: 'q' is not declared"},
      {"dot(a)", "6: unexpected ')'"},
      {"dot(a, b, c)", "9: unexpected ','"},
      {"cross(a, b)", "1: cross(a, b) is a vector"},
      {"cross(a, b)[4]", "13: a vector of cross(a, b) has"},
      {"cross(p, p)[1]", "7: 'p' has 2 components, and 3 are needed here"},
      {"dot(product(i, 1, 2, a), b)", "5: a product of vectors"},
      {"dot(x[a]*a, b)", "7: a number stands here"},
  };
  expect_errors(wrong);
  std::string nested = "a";
  for (int i = 0; i < 60; ++i) nested = "cross(a, " + nested + ")";
  EXPECT_NE(error_of(nested + "[1]").find("write out more than"), std::string::npos);
}

TEST_F(Vectors, AHeavyBodyIsTheOneThatIsWrittenOut) {
  const Model body = model_of(R"toml(
[phase_space]
variables = ["M[1..3]", "g[1..3]"]
[definitions]
"w[i=1..3]" = "a[i]*M[i]"
[parameters]
"a[1..3]" = {}
"r[1..3]" = {}
[equations]
"M[k=1..3]" = "cross(M, w)[k] + cross(g, r)[k]"
"g[k=1..3]" = "cross(g, w)[k]"
[integrals]
F1 = "dot(g, g)"
F2 = "dot(M, g)"
E = "sum(i, 1, 3, a[i]*M[i]^2)/2 + dot(r, g)"
wrong = "dot(M, M)"
)toml");
  const Model plain = model_of(R"toml(
hamiltonian = "(a1*M1^2 + a2*M2^2 + a3*M3^2)/2 + r1*g1 + r2*g2 + r3*g3"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
[parameters]
a1 = {}
a2 = {}
a3 = {}
r1 = {}
r2 = {}
r3 = {}
)toml");
  GiNaC::exmap rename;
  for (std::size_t i = 0; i < 6; ++i) {
    rename[body.variables[i]] = plain.variables[i];
    rename[body.parameters[i]] = plain.parameters[i];
  }
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_TRUE((body.field[i].subs(rename) - plain.field[i]).expand().is_zero()) << i;
  for (const Proof& proof : prove(body))
    if (proof.kind == ClaimKind::integral)
      EXPECT_EQ(proof.verdict, proof.name == "wrong" ? Verdict::refuted : Verdict::proved)
          << proof.name;
}

// A name of the case is never taken for a function of the language.
TEST_F(Families, NamesOfTheCaseComeFirst) {
  names_.add("sum", {GiNaC::numeric(7)});
  names_.add("mod", {GiNaC::numeric(5)});
  EXPECT_EQ(parse("sum + mod"), 12);
}

TEST_F(Families, NoTextOfAFewBytesTakesLong) {
  for (const std::string& text : {std::string("sum(i, 1, 99999, sum(k, 1, 99999, 1))"),
                                  std::string("sum(i, 1, 999999999, sum(k, 2, 1, 1))"),
                                  std::string("x[sum(i, 1, 999999999, 1)]"),
                                  "sum(i, 1, 99999, " + std::string(1000000, ' ') + "1)",
                                  std::string("product(i, 1, 99999, product(k, 1, 99999, x1))")}) {
    const std::string error = error_of(text);
    EXPECT_TRUE(error.find("write out more than") != std::string::npos ||
                error.find("the degree here exceeds") != std::string::npos)
        << text.substr(0, 50) << ": " << error;
  }
  for (const char* text : {"x[i=1..999999999]", "x[i=1..999999, k=2..1]", "x[1..99999, 1..99999]"})
    EXPECT_NE(error_of_names(text).find("stands for more than 100000 names"), std::string::npos);
  EXPECT_NE(error_of_names("x" + std::string(501, ' ') + "[1]"), "accepted");
}

TEST_F(Families, KeysStandForTheirMembers) {
  EXPECT_EQ(names_in("q"), "q; ");
  EXPECT_EQ(names_in("q[1..n]"), "q1; q2; q3; ");
  EXPECT_EQ(names_in("q[ k = 2 .. n ]"), "q2 k2; q3 k3; ");
  EXPECT_EQ(names_in("{q[i=1..2], p[i + 1]}"), "{q1, p2} i1; {q2, p3} i2; ");
  EXPECT_EQ(names_in("M[i=1..n, k=i+1..n]"), "M12 i1 k2; M13 i1 k3; M23 i2 k3; ");
  EXPECT_EQ(names_in("M[9..10, 1]"), "M91; M10_1; ");
  EXPECT_EQ(names_in("q[2..1]"), "");
}

TEST_F(Families, KeysThatMeanNothingAreRefusedWithTheirPlace) {
  const std::pair<const char*, const char*> wrong[] = {
      {"q[1..m]", "6: 'm' is no integer that is known here"},
      {"q[1..3", "2: '[' is not closed"},
      {"[1..3]", "1: an index stands behind a name"},
      {"q[i=1..2, i=1..2]", "11: the index 'i' has a range already"},
      {"q[n=1..2]", "3: 'n' is a number of this case, and no index"},
      {"q[i]", "3: 'i' is no integer that is known here"},
      {"q[1/2..3]", "4: a bound has integers"},
      {"q[-1..2]", "3: an index is not negative"},
      {"q[sum(i,1,9,1)]", "6: a bound has integers"},
      {"a[1]b[1]c[1]d[1]e[1]f[1]g[1]h[1]k[1]", "1: more than 8 families"},
  };
  for (const auto& [text, message] : wrong)
    EXPECT_TRUE(error_of_names(text).starts_with(message)) << text << ": " << error_of_names(text);
}

const char* const kRing = R"toml(
hamiltonian = "sum(i, 1, n, m[i]*p[i]^2/2 + a[i])"
[phase_space]
variables = ["q[1..n]", "p[1..n]"]
[phase_space.brackets]
"q[i=1..n], p[i]" = "1"
[definitions]
n = 3
"a[i=1..n]" = "exp(q[i] - q[mod(i, n) + 1])"
[parameters]
"m[i=1..n]" = { assume = "m[i] > i - 1" }
[integrals]
"P[k=1..1]" = "sum(i, k, n, p[i])"
[[scene]]
name = "default"
parameters = { "m[i=1..n]" = "i" }
initial = { "q[i=1..n]" = "i/10", "p[1..2]" = "0", p3 = "1" }
duration = 1
observe = ["q[2..3]"]
)toml";

const char* const kWrittenOut = R"toml(
hamiltonian = "(m1*p1^2 + m2*p2^2 + m3*p3^2)/2 + exp(q1 - q2) + exp(q2 - q3) + exp(q3 - q1)"
[phase_space]
variables = ["q1", "q2", "q3", "p1", "p2", "p3"]
canonical = true
[parameters]
m1 = { assume = "m1 > 0" }
m2 = { assume = "m2 > 1" }
m3 = { assume = "m3 > 2" }
[integrals]
P1 = "p1 + p2 + p3"
)toml";

TEST_F(Families, ACaseOfNPartsIsTheOneThatIsWrittenOut) {
  const Model ring = model_of(kRing), plain = model_of(kWrittenOut);
  ASSERT_EQ(ring.variables.size(), plain.variables.size());
  GiNaC::exmap rename;
  for (std::size_t i = 0; i < ring.variables.size(); ++i) {
    EXPECT_EQ(ring.variables[i].get_name(), plain.variables[i].get_name());
    rename[ring.variables[i]] = plain.variables[i];
  }
  ASSERT_EQ(ring.parameters.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(ring.parameters[i].get_name(), plain.parameters[i].get_name());
    rename[ring.parameters[i]] = plain.parameters[i];
  }
  ASSERT_EQ(ring.field.size(), plain.field.size());
  for (std::size_t i = 0; i < ring.field.size(); ++i)
    EXPECT_TRUE((ring.field[i].subs(rename) - plain.field[i]).expand().is_zero()) << i;
  ASSERT_EQ(ring.assumptions.size(), 3u);
  ASSERT_EQ(ring.scenes.size(), 1u);
  EXPECT_EQ(ring.scenes[0].observe.size(), 2u);
}

// Another number of parts is another system, and what holds for all is proved for it.
TEST_F(Families, TheNumberOfPartsStandsInOnePlace) {
  for (const char* n : {"2", "4", "11"}) {
    std::string text = R"toml(
hamiltonian = "sum(i, 1, n, sum(k, 1, 3, p[i, k]^2)/(2*m[i])) - G*sum(i, 1, n, sum(j, i + 1, n, m[i]*m[j]*sum(k, 1, 3, (q[i, k] - q[j, k])^2)))"
[phase_space]
variables = ["q[1..n, 1..3]", "p[1..n, 1..3]"]
canonical = true
[definitions]
n = "N"
[parameters]
"m[1..n]" = {}
G = {}
[integrals]
"L[k=1..3]" = "sum(i, 1, n, q[i, mod(k, 3) + 1]*p[i, mod(k + 1, 3) + 1] - q[i, mod(k + 1, 3) + 1]*p[i, mod(k, 3) + 1])"
wrong = "sum(i, 1, n, q[i, 1]*p[i, 2])"
)toml";
    text.replace(text.find("\"N\"") + 1, 1, n);
    const Model model = model_of(text);
    EXPECT_EQ(model.variables.size(), 6u * std::stoul(n));
    std::size_t proved = 0, refuted = 0;
    for (const Proof& proof : prove(model)) {
      if (proof.kind != ClaimKind::integral) continue;
      proved += proof.verdict == Verdict::proved;
      refuted += proof.verdict == Verdict::refuted;
    }
    EXPECT_EQ(proved, 3u) << n;
    EXPECT_EQ(refuted, 1u) << n;
  }
}

TEST_F(Families, AMapHasItsNextValuesByFamilies) {
  const AnyCaseFile file = parse_any_case(R"toml(
[phase_space]
variables = ["x[1..n]"]
[definitions]
n = 3
[map]
"x[i=1..n]" = "x[mod(i, n) + 1]"
)toml",
                                          "test.toml");
  const auto& next = std::get<MapCaseFile>(file).next;
  ASSERT_EQ(next.size(), 3u);
  EXPECT_EQ(next[2].first.value, "x3");
  EXPECT_EQ(next[2].second.indices->at("i"), 3);
}

// What the page on case files shows is a case, and what it says of it is proved.
TEST_F(Families, TheExampleOfThePageOnCaseFilesIsRead) {
  std::ifstream stream(CASIMIR_SOURCE_DIR "/cases/FORMAT.md");
  const std::string page((std::istreambuf_iterator<char>(stream)), {});
  const std::size_t families = page.find("## Families"), begin = page.find("```toml", families) + 8;
  ASSERT_LT(families, begin);
  const Model ring = model_of(page.substr(begin, page.find("```", begin) - begin));
  EXPECT_EQ(ring.variables.size(), 10u);
  std::size_t proved = 0;
  for (const Proof& proof : prove(ring))
    proved += proof.kind == ClaimKind::integral && proof.verdict == Verdict::proved;
  EXPECT_EQ(proved, 2u);
}

// A letter of a range that is a name of the case would mean two things.
TEST_F(Families, ALetterThatIsANameIsRefusedWhereItIsUsed) {
  std::string text = kRing;
  text.insert(text.find("[parameters]\n") + 13, "i = {}\n");
  const std::string error = error_in([&] { model_of(text); });
  EXPECT_NE(error.find("is a name of this case"), std::string::npos) << error;
}

}  // namespace
}  // namespace casimir::test
