// Claims of maps that live on constraints.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/symbolic/discrete/maps.hpp"

namespace casimir::test {
namespace {

/// The point (x(n-1), x(n)) of two spheres, which the map exchanges.
const std::string kDiscreteNeumann = R"toml(
[phase_space]
variables = ["x1", "x2", "x3", "y1", "y2", "y3"]
constraints = ["x1^2 + x2^2 + x3^2 - 1", "y1^2 + y2^2 + y3^2 - 1"]
[parameters]
j1 = { assume = ["j1 > 0", "j2 > j1", "j3 > j2"] }
j2 = {}
j3 = {}
[definitions]
s = "2*(y1*x1/j1 + y2*x2/j2 + y3*x3/j3)/((y1/j1)^2 + (y2/j2)^2 + (y3/j3)^2)"
[map]
x1 = "y1"
x2 = "y2"
x3 = "y3"
y1 = "s*y1/j1 - x1"
y2 = "s*y2/j2 - x2"
y3 = "s*y3/j3 - x3"
[[measure]]
density = "1"
[[symmetry]]
name = "exchange"
expressions = { x1 = "y1", x2 = "y2", x3 = "y3", y1 = "x1", y2 = "x2", y3 = "x3" }
reverses = true
[[symmetry]]
name = "mirror"
expressions = { x1 = "-x1", y1 = "-y1" }
[[symmetry]]
name = "other"
expressions = { x1 = "x2", y1 = "y2", x2 = "x1", y2 = "y1" }
[[symmetry]]
name = "longer"
expressions = { x1 = "2*x1", x2 = "2*x2", x3 = "2*x3", y1 = "2*y1", y2 = "2*y2", y3 = "2*y3" }
)toml";

TEST(MapsOnConstraints, HaveSymmetriesAndMeasures) {
  const MapModel map = map_of(kDiscreteNeumann);
  for (const char* name : {"exchange, reversal", "mirror, symmetry"})
    EXPECT_EQ(verdict_of(map, ClaimKind::map, name), Verdict::proved) << name;
  EXPECT_EQ(verdict_of(map, ClaimKind::measure), Verdict::proved);
  const Proof other = proof_of(map, ClaimKind::map, "other, symmetry");
  EXPECT_EQ(other.verdict, Verdict::refuted);
  EXPECT_TRUE(other.witness);
  // It commutes with the map, and leads out of the spheres.
  EXPECT_EQ(verdict_of(map, ClaimKind::map, "longer, symmetry"), Verdict::refuted);
}

MapModel on_line(const std::string& map, const std::string& claims,
                 const std::string& constraints = R"("z")") {
  return map_of("[phase_space]\nvariables = [\"x\", \"z\"]\nconstraints = [" + constraints +
                "]\n[map]\n" + map + claims);
}

std::string density(const std::string& text) { return "[[measure]]\ndensity = \"" + text + "\"\n"; }

// On z = 0 the measure is rho dx dz/dz: what is done across the line is divided by.
TEST(MapsOnConstraints, KeepMeasuresWithoutWhatTheyDoAcrossThem) {
  const std::string squeezed = "x = \"2*x\"\nz = \"z/2\"\n";
  EXPECT_EQ(verdict_of(on_line(squeezed, density("1")), ClaimKind::measure), Verdict::refuted);
  EXPECT_EQ(verdict_of(on_line(squeezed, density("1/x")), ClaimKind::measure), Verdict::proved);
  const Proof turned =
      proof_of(on_line("x = \"x + z\"\nz = \"-3*z\"\n", density("1")), ClaimKind::measure);
  EXPECT_EQ(turned.verdict, Verdict::proved) << turned.reason;
  // Beside the line it is another density that is kept.
  EXPECT_EQ(verdict_of(on_line("x = \"x + 1\"\nz = \"z*(2 + x^2)\"\n", density("1 + z*x")),
                       ClaimKind::measure),
            Verdict::proved);
  // The map leaves the line, and the constraints are not independent.
  EXPECT_EQ(verdict_of(on_line("x = \"x\"\nz = \"z + 1\"\n", density("1")), ClaimKind::measure),
            Verdict::undecided);
  EXPECT_EQ(
      verdict_of(on_line("x = \"x\"\nz = \"2*z\"\n", density("1"), R"toml("z", "z*(1 + x^2)")toml"),
                 ClaimKind::measure),
      Verdict::undecided);
  EXPECT_EQ(
      verdict_of(on_line("x = \"x\"\nz = \"2*z\"\n", density("1"), R"("z^2")"), ClaimKind::measure),
      Verdict::undecided);
}

std::string symmetry(const std::string& expressions) {
  return "[[symmetry]]\nname = \"S\"\nexpressions = { " + expressions + " }\n";
}

TEST(MapsOnConstraints, HaveSymmetriesThatTheyDoNotHaveBesideThem) {
  const std::string shift = "x = \"x + 1\"\nz = \"z\"\n";
  EXPECT_EQ(verdict_of(on_line(shift, symmetry(R"(x = "x + 3 + z*x")")), ClaimKind::map),
            Verdict::proved);
  EXPECT_EQ(verdict_of(on_line(shift, symmetry(R"(x = "2*x")")), ClaimKind::map), Verdict::refuted);
  // The line goes to a point; out of itself; the parameter to one value.
  const std::string twice = "x = \"2*x\"\nz = \"z\"\n";
  EXPECT_EQ(verdict_of(on_line(twice, symmetry(R"(x = "z*x + 0*x")")), ClaimKind::map),
            Verdict::undecided);
  EXPECT_EQ(verdict_of(on_line(twice, symmetry(R"(z = "z + 1")")), ClaimKind::map),
            Verdict::refuted);
  EXPECT_EQ(verdict_of(on_line("x = \"2*x\"\nz = \"z\"\n[parameters]\na = {}\n",
                               symmetry(R"(x = "-x", a = "1")")),
                       ClaimKind::map),
            Verdict::refuted);
  EXPECT_EQ(verdict_of(on_line("x = \"2*x\"\nz = \"z\"\n[parameters]\na = {}\n",
                               symmetry(R"(x = "-x", a = "2*a")")),
                       ClaimKind::map),
            Verdict::proved);
}

// The plane z = 0 and the line x = y = 0: S turns the line into one of the plane, where it covers
// no neighbourhood.
TEST(MapsOnConstraints, HaveSymmetriesOnPartsOfThem) {
  const Proof proof = proof_of(map_of(R"toml(
[phase_space]
variables = ["x", "y", "z"]
constraints = ["x*z", "y*z"]
[map]
x = "2*x"
y = "2*y"
z = "2*z"
[[symmetry]]
name = "S"
expressions = { x = "x + z", z = "0" }
)toml"),
                               ClaimKind::map);
  if (proof.verdict == Verdict::undecided) return;
  ASSERT_EQ(proof.verdict, Verdict::proved);
  ASSERT_EQ(proof.where.size(), 1U);
  EXPECT_NE(proof.where[0].find("z = 0"), std::string::npos) << proof.where[0];
}

MapModel on_circle(const std::string& conjugacy) {
  return map_of(R"toml(
[phase_space]
variables = ["x", "y"]
constraints = ["x^2 + y^2 - 1"]
[map]
x = "(3*x - 4*y)/5"
y = "(4*x + 3*y)/5"
[[conjugacy]]
name = "c"
)toml" + conjugacy);
}

TEST(MapsOnConstraints, AreConjugateThere) {
  const Proof doubled = proof_of(on_circle(R"toml(
expressions = { X = "x^2 - y^2", Y = "2*x*y" }
map = { X = "(-7*X - 24*Y)/25", Y = "(24*X - 7*Y)/25" }
)toml"),
                                 ClaimKind::conjugacy);
  EXPECT_EQ(doubled.verdict, Verdict::proved) << doubled.reason;
  EXPECT_EQ(doubled.evidence.find("locally"), 0U) << doubled.evidence;
  // Of angles: the tangent of a half goes where Moebius takes it; the line beside it is a constant.
  EXPECT_EQ(verdict_of(on_circle(R"toml(
expressions = { X = "y/(1 + x)", Y = "x^2 + y^2" }
map = { X = "(1 + 2*X)/(2 - X)", Y = "1" }
)toml"),
                       ClaimKind::conjugacy),
            Verdict::proved);
  // Everything goes to one point.
  EXPECT_EQ(verdict_of(on_circle(R"toml(
expressions = { X = "x^2 + y^2", Y = "1" }
map = { X = "X^2", Y = "Y" }
)toml"),
                       ClaimKind::conjugacy),
            Verdict::undecided);
  EXPECT_EQ(verdict_of(on_circle(R"toml(
expressions = { X = "x", Y = "y" }
map = { X = "X", Y = "Y" }
)toml"),
                       ClaimKind::conjugacy),
            Verdict::refuted);
}

/// M -> M + (|M|^2 - 1) M is the identity on the sphere, and no Poisson map beside it.
TEST(MapsOnConstraints, ArePoissonOnLevelsOfCasimirFunctions) {
  const auto on = [](const std::string& space, const std::string& map) {
    return verdict_of(map_of("[phase_space]\n" + space + "[map]\n" + map), ClaimKind::map);
  };
  const std::string brackets =
      "[phase_space.brackets]\n\"a,b\" = \"c\"\n\"b,c\" = \"a\"\n\"c,a\" = \"b\"\n";
  const std::string sphere = "variables = [\"a\", \"b\", \"c\"]\n";
  const std::string unit = "constraints = [\"a^2 + b^2 + c^2 - 1\"]\n";
  const auto grown = [](const std::string& a) {
    return "a = \"" + a +
           "*(a^2 + b^2 + c^2)\"\nb = \"b*(a^2 + b^2 + c^2)\"\nc = " + "\"c*(a^2 + b^2 + c^2)\"\n";
  };
  EXPECT_EQ(on(sphere + unit + brackets, grown("a")), Verdict::proved);
  EXPECT_EQ(on(sphere + brackets, grown("a")), Verdict::refuted);
  EXPECT_EQ(on(sphere + unit + brackets, grown("-a")), Verdict::refuted);
  // That u and v vanish is no level of Casimir functions: the bracket with v needs what is beside.
  EXPECT_EQ(on("variables = [\"x\", \"u\", \"y\", \"v\"]\ncanonical = true\nconstraints = "
               "[\"u\", \"v\"]\n",
               "x = \"x + u^2*y\"\ny = \"y\"\nu = \"u\"\nv = \"v\"\n"),
            Verdict::undecided);
}

/// Where a map goes back to its constraints from all sides, det A and the Jacobian determinant are
/// zero together, and say nothing of what it does on them.
TEST(MapsOnConstraints, KeepNoMeasureByFlatteningWhatIsBesideThem) {
  EXPECT_EQ(verdict_of(on_line("x = \"2*x\"\nz = \"z^2\"\n", density("1")), ClaimKind::measure),
            Verdict::undecided);
  EXPECT_EQ(verdict_of(map_of(R"toml(
[phase_space]
variables = ["x", "y", "z"]
constraints = ["x^2 + y^2 + z^2 - 1"]
[map]
x = "2*x/sqrt(4*x^2 + y^2 + z^2)"
y = "y/sqrt(4*x^2 + y^2 + z^2)"
z = "z/sqrt(4*x^2 + y^2 + z^2)"
[[measure]]
density = "1"
)toml"),
                       ClaimKind::measure),
            Verdict::undecided);
  // So it is on one of two lines.
  const Proof one =
      proof_of(on_line("x = \"x*(2 - z)\"\nz = \"z^2\"\n", density("1"), R"("z^2 - z")"),
               ClaimKind::measure);
  ASSERT_EQ(one.verdict, Verdict::proved) << one.reason;
  ASSERT_FALSE(one.where.empty());
  EXPECT_NE(one.where[0].find("z = 1"), std::string::npos) << one.where[0];
}

/// The sign differs from line to line, and a point at which the constraints are dependent refutes
/// nothing.
TEST(MapsOnConstraints, KeepMeasuresOfTheirParts) {
  EXPECT_EQ(verdict_of(on_line("x = \"-x*z\"\nz = \"-z\"\n", density("1"), R"("z^2 - 1")"),
                       ClaimKind::measure),
            Verdict::proved);
  EXPECT_EQ(verdict_of(on_line("x = \"x/z\"\nz = \"z\"\n", density("1"), R"("z^2 - 1")"),
                       ClaimKind::measure),
            Verdict::proved);
  EXPECT_EQ(verdict_of(on_line("x = \"2*x*z\"\nz = \"z\"\n", density("1"), R"("z^2 - 1")"),
                       ClaimKind::measure),
            Verdict::refuted);
  EXPECT_NE(verdict_of(map_of(R"toml(
[phase_space]
variables = ["x", "y", "z"]
constraints = ["x*z", "y*z"]
[map]
x = "3*x"
y = "5*y"
z = "z"
[[measure]]
density = "1 + x"
)toml"),
                       ClaimKind::measure),
            Verdict::refuted);
}

/// A step that is Poisson everywhere may leave the constraints that another one is Poisson on.
TEST(MapsOnConstraints, AreNotPoissonByStepsThatLeaveThem) {
  const std::string space = R"toml(
integrable = true
[phase_space]
variables = ["q", "p", "c"]
constraints = ["c"]
[phase_space.brackets]
"q,p" = "1"
[casimirs]
C = "c"
[integrals]
F = "p"
)toml";
  const MapModel leaving = map_of(space + R"toml(
[[map_step]]
expressions = { c = "c + 1" }
[[map_step]]
expressions = { q = "q*(1 + c)" }
[[map_step]]
expressions = { c = "c - 1" }
)toml");
  EXPECT_EQ(verdict_of(leaving, ClaimKind::map), Verdict::refuted);
  EXPECT_NE(verdict_of(leaving, ClaimKind::liouville), Verdict::proved);
  const MapModel staying = map_of(space + "[map]\nq = \"q*(1 + c) + p\"\np = \"p\"\nc = \"c\"\n");
  const Proof poisson = proof_of(staying, ClaimKind::map);
  EXPECT_EQ(poisson.verdict, Verdict::proved);
  EXPECT_EQ(poisson.on, std::vector<std::string>{"c"});
  EXPECT_NE(verdict_of(staying, ClaimKind::liouville), Verdict::proved);
}

/// x is invertible on y = 0, and the map leads there from the other line.
TEST(MapsOnConstraints, AreConjugateOnOnePart) {
  const Proof proof = proof_of(map_of(R"toml(
[phase_space]
variables = ["x", "y"]
constraints = ["x*y"]
[map]
x = "2*x"
y = "0"
[[conjugacy]]
name = "c"
expressions = { X = "x", Y = "y" }
map = { X = "2*X", Y = "0" }
)toml"),
                               ClaimKind::conjugacy);
  ASSERT_EQ(proof.verdict, Verdict::proved) << proof.reason;
  ASSERT_EQ(proof.where.size(), 1U);
  EXPECT_NE(proof.where[0].find("y = 0"), std::string::npos) << proof.where[0];
}

}  // namespace
}  // namespace casimir::test
