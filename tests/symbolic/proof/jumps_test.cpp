// Functions that jump where they have no value, at places that motions pass.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/symbolic/proof/proof_of_text.hpp"

namespace casimir::test {
namespace {

/// x' = 1, and nothing else moves.
std::string shift(const std::string& claims, const std::string& domain = "") {
  return "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n" +
         (domain.empty() ? "" : "domain = [\"" + domain + "\"]\n") +
         "[equations]\nx = \"1\"\ny = \"0\"\nz = \"0\"\n" + claims;
}

Proof of_integral(const std::string& f, const std::string& domain = "") {
  return proof_in_case("integral", shift("[integrals]\nF = \"" + f + "\"\n", domain));
}

Proof of_relation(const std::string& f, const std::string& on = "",
                  const std::string& domain = "") {
  return proof_in_case("invariant_relation",
                       shift("[[invariant_relation]]\nname = \"R\"\nexpression = \"" + f + "\"\n" +
                                 (on.empty() ? "" : "on = [\"" + on + "\"]\n"),
                             domain));
}

struct Jumping {
  std::string f, domain;
};

/// Signs of functions whose squares are none in the ring: of (sin(x) + cos(x))^2 it has
/// 1 + 2*sin(x)*cos(x), of (sqrt(x) - 1)^2 it has x + 1 - 2*sqrt(x).
const std::vector<Jumping> kJumping{{"sign(sin(x) + cos(x))", ""},
                                    {"sign(sin(x) - 1/2)", ""},
                                    {"sign(sqrt(x) - 1)", "x > 0"},
                                    {"sign(sqrt(1 + x^2) - 2)", ""},
                                    {"sign(x + cos(y))", ""},
                                    {"sign(x*cos(y) - sin(y))", ""},
                                    {"(x + cos(y))^3/abs(x + cos(y))^3", ""},
                                    {"(x + cos(y))/sqrt((x + cos(y))^2*(1 + y^2))", ""},
                                    {"exp(sign(sqrt(1 + x^2) - 2))", ""},
                                    {"sin(sign(x + cos(y)))", ""},
                                    {"log(2 + sign(sin(x) + cos(x)))", ""},
                                    {"atan2(2 + sign(sin(x) + cos(x)), 1)", ""},
                                    {"(2 + sign(x + cos(y)))^Pi", ""},
                                    {"asin(sign(x + cos(y))/2)", ""},
                                    {"sqrt(x + 1 - 2*sqrt(x))/(sqrt(x) - 1)", "x > 0"}};

TEST(Jumps, OfSignsWhoseSquaresAreHiddenAreSaid) {
  for (const auto& [f, domain] : kJumping) {
    const Proof proof = of_integral(f, domain);
    EXPECT_EQ(proof.verdict, Verdict::proved) << f;
    EXPECT_FALSE(proof.jumps.empty()) << f;
  }
  EXPECT_EQ(of_integral("sqrt(x + 1 - 2*sqrt(x))/(sqrt(x) - 1)", "x > 0").jumps,
            std::vector<std::string>{"sqrt(x) - 1 = 0"});
  // Both factors of sin(x) (1 + 2 cos(x)), and the pole with the zero of tan(x) - 1.
  EXPECT_EQ(of_integral("sign(sin(x) + sin(2*x))").jumps.size(), 2U);
  EXPECT_EQ(of_integral("sign(tan(x) - 1)").jumps.size(), 2U);
}

TEST(Jumps, AMotionLeavesALevelByThem) {
  for (const auto& [f, domain] : kJumping)
    EXPECT_EQ(of_relation("z - " + f, "", domain).verdict, Verdict::undecided) << f;
  // On y = 0 the root has no value where x is zero, and this is x/|x|.
  EXPECT_EQ(of_relation("z - x/sqrt(x^2 + y^2)", "y").verdict, Verdict::undecided);
  EXPECT_EQ(of_relation("z - x/sqrt(x^2 + y^2 + y^4)", "y").verdict, Verdict::undecided);
  // The numerator is smooth, and the quotient is not.
  for (const char* f : {"x*abs(x)/(x^2 + y^2)", "x^3*abs(x)/(x^2 + y^2)^2", "(x^2)^(3/2)/(x^3 + y)",
                        // That it has a value says nothing of where it has none.
                        "x/sqrt(x^2 + y^2) - log(x*(x + y)) + log(x^2)"})
    EXPECT_EQ(of_relation(std::string("z - ") + f, "y").verdict, Verdict::undecided) << f;
  // Where nothing is crossed.
  EXPECT_EQ(of_relation("z - sign(y)").verdict, Verdict::proved);
  EXPECT_EQ(of_relation("z - sign(x)", "", "x > 0").verdict, Verdict::proved);
}

TEST(Jumps, AFreeParticleComesOutOfTheOriginOnTheOtherSide) {
  const auto relation = [](const std::string& hamiltonian, const std::string& parameters = "") {
    return proof_in_case("invariant_relation", "hamiltonian = \"" + hamiltonian + R"toml("
[phase_space]
variables = ["q1", "q2", "p1", "p2"]
canonical = true
[[invariant_relation]]
name = "R"
expression = "q1/sqrt(q1^2 + q2^2) - 3/5"
on = ["q1*p2 - q2*p1"]
)toml" + parameters)
        .verdict;
  };
  EXPECT_EQ(relation("(p1^2 + p2^2)/2"), Verdict::undecided);
  const std::string kepler = "(p1^2 + p2^2)/2 - k/sqrt(q1^2 + q2^2)";
  EXPECT_EQ(relation(kepler, "[parameters]\nk = {}\n"), Verdict::undecided);
  EXPECT_EQ(relation(kepler, "[parameters]\nk = { assume = \"k > 0\" }\n"), Verdict::proved);
  EXPECT_EQ(relation("(p1^2 + p2^2)/2 + sqrt(q1^2 + q2^2)"), Verdict::undecided);
  EXPECT_EQ(relation("(p1^2 + p2^2)/2 - 1/sqrt(q1^2 + q2^2)"), Verdict::proved);  // it does not
  // What is divided by is infinite nowhere.
  for (const char* potential :
       {"(1 - sqrt(1 + q1^2 + q2^2))/(q1^2 + q2^2)", "(q1^2 + q2^2)/sqrt(q1^2 + q2^2)",
        "(q1^2 + q2^2)^(3/2)", "sin(sqrt(q1^2 + q2^2))/sqrt(q1^2 + q2^2)",
        "log(1 + sqrt(q1^2 + q2^2))/sqrt(q1^2 + q2^2)"})
    EXPECT_EQ(relation("(p1^2 + p2^2)/2 - " + std::string(potential)), Verdict::undecided)
        << potential;
}

/// As bare equations, which conserve no energy that is known: x' = 1/x^2 has the solution (3
/// t)^(1/3).
TEST(Jumps, NoVelocityEndsAMotion) {
  for (const char* rate : {"sin(x)/x", "exp(-1/x^2)", "1/sqrt(abs(x))", "x*y/(x^2 + y^2)", "1/x^2"})
    EXPECT_EQ(proof_in_case("invariant_relation",
                            "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[equations]\nx = "
                            "\"1\"\ny = \"" +
                                std::string(rate) +
                                "\"\nz = \"0\"\n[[invariant_relation]]"
                                "\nname = \"R\"\nexpression = \"z - sign(x)\"\n")
                  .verdict,
              Verdict::undecided)
        << rate;
}

/// An energy that depends on the time is not conserved, and t is zero once.
TEST(Jumps, AnEnergyThatIsNotConservedEndsNoMotion) {
  const std::string text = R"toml(
hamiltonian = "y + 1/(z + t)"
[phase_space]
time = "t"
variables = ["x", "y", "z", "w"]
[phase_space.brackets]
"x,y" = "1"
[integrals]
F = "sign(z + t)"
[[measure]]
density = "2 + sign(z + t)"
[[invariant_relation]]
name = "R"
expression = "w - (z + t)/abs(z + t)"
)toml";
  EXPECT_FALSE(proof_in_case("integral", text).jumps.empty());
  EXPECT_FALSE(proof_in_case("measure", text).where.empty());
  EXPECT_EQ(proof_in_case("invariant_relation", text).verdict, Verdict::undecided);
}

/// y = x |x|/2 along a motion that is once differentiable.
TEST(Jumps, QuotientsOfWhatHasKinksJump) {
  const std::string text = R"toml(
[phase_space]
variables = ["x", "y", "z"]
[equations]
x = "1"
y = "abs(x)"
z = "0"
[[conditional]]
name = "F"
expression = "y/x^2"
on = ["y - x*abs(x)/2"]
[[invariant_relation]]
name = "R"
expression = "z - y/x^2"
on = ["y - x*abs(x)/2"]
)toml";
  const Proof integral = proof_in_case("conditional", text);
  EXPECT_EQ(integral.verdict, Verdict::proved) << integral.reason;
  EXPECT_EQ(integral.jumps, std::vector<std::string>{"x = 0"});
  EXPECT_EQ(proof_in_case("invariant_relation", text).verdict, Verdict::undecided);
}

/// (q^2)^a is q^4 where a is 2.
TEST(Jumps, PowersWithOpenExponentsEndNoMotion) {
  const std::string text = R"toml(
integrable = true
hamiltonian = "(p1^2 + p2^2)/2 + (q1^2)^a"
[parameters]
a = { assume = "a > 1" }
[phase_space]
variables = ["q1", "q2", "p1", "p2"]
canonical = true
[integrals]
F = "p2*sign(q1)"
[[invariant_relation]]
name = "R"
expression = "p2 - sign(q1)"
)toml";
  EXPECT_EQ(proof_in_case("invariant_relation", text).verdict, Verdict::undecided);
  EXPECT_FALSE(proof_in_case("integral", text).jumps.empty());
  EXPECT_EQ(proof_in_case("liouville", text).verdict, Verdict::undecided);
}

/// A rotor that is free on one side of u = sin(q1) + cos(q1) and kicked on the other one: every
/// motion passes both again and again.
TEST(Jumps, WithHiddenSquaresAreNotCounted) {
  const std::string rotor = R"toml(
integrable = true
hamiltonian = "p1 + (u^2 + u*r)/2*p2^2/2 + (u^2 - u*r)/2*4*cos(q2)"
[phase_space]
variables = ["q1", "q2", "p1", "p2"]
canonical = true
[definitions]
u = "sin(q1) + cos(q1)"
r = "abs(u)"
[integrals]
F = "(1 + r/u)/2*p2^2/2 + (1 - r/u)/2*4*cos(q2)"
[[measure]]
density = "2 + r/u"
)toml";
  const Proof count = proof_in_case("liouville", rotor);
  EXPECT_EQ(count.verdict, Verdict::undecided);
  EXPECT_NE(count.reason.find("F is not counted"), std::string::npos) << count.reason;
  const Proof measure = proof_in_case("measure", rotor);
  ASSERT_FALSE(measure.where.empty());
  EXPECT_NE(measure.where.back().find("do not cross"), std::string::npos) << measure.where.back();
  // The order of a pole is counted in the ring, where no square of u is one.
  for (const char* sign : {"sign(sin(q1) + cos(q1))", "sign(q1 + cos(q2))", "sign(sqrt(q1) - 1)",
                           "sign(q1 - sqrt(1 + q1^2)/2)"})
    EXPECT_NE(proof_in_case("liouville",
                            "integrable = true\nhamiltonian = \"p1\"\n[phase_space]\nvariables = "
                            "[\"q1\", \"q2\", \"p1\", \"p2\"]\ncanonical = true\n[integrals]\nA = "
                            "\"p2*" +
                                std::string(sign) + "\"\n")
                  .verdict,
              Verdict::proved)
        << sign;
}

/// Of (u^2)^(1/2) the ring does not know that u is as small: u^3/|u|^3 is no pole.
TEST(Jumps, ThatLookLikePolesAreNone) {
  const auto count = [](const std::string& hamiltonian, const std::string& integral) {
    return proof_in_case("liouville", "integrable = true\nhamiltonian = \"" + hamiltonian +
                                          "\"\n[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", "
                                          "\"p2\"]\ncanonical = true\n[integrals]\nA = \"" +
                                          integral + "\"\n")
        .verdict;
  };
  EXPECT_NE(count("p1 + p2*sign(sin(q1) + cos(q1))", "p2"), Verdict::proved);
  EXPECT_NE(count("p1 + p2*(sin(q1) + cos(q1))^3/(1 + sin(2*q1))^(3/2)", "p2"), Verdict::proved);
  EXPECT_NE(count("p1", "p2*(q1 + cos(q2))^3/abs(q1 + cos(q2))^3"), Verdict::proved);
  EXPECT_EQ(count("p1 + 1/abs(sin(q1) + cos(q1))", "p2"), Verdict::proved);
  EXPECT_EQ(count("p1 + 1/abs(q1)", "p2"), Verdict::proved);
}

TEST(Jumps, OfAnglesAtPolesOfTheirArgumentsAreSaid) {
  for (const char* f :
       {"atan(1/x) + atan(x)", "atan2(1/x, 1) + atan(x)", "atan2(1/sin(x), 1) + atan(sin(x))"})
    EXPECT_FALSE(of_integral(f).jumps.empty()) << f;
  EXPECT_TRUE(of_integral("atan2(x, 1) - atan(x)").jumps.empty());
}

TEST(Jumps, AreNotSaidWhereNothingIsZeroAtOnce) {
  // The root is analytic where z is zero.
  EXPECT_TRUE(of_integral("sqrt(1 + y^2)/z").jumps.empty());
  EXPECT_TRUE(of_integral("y*sqrt(x^2 + 1)/sqrt(x^2 + 1)/z").jumps.empty());
}

}  // namespace
}  // namespace casimir::test
