// Poles that motions pass, in functions and in the equations.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/symbolic/proof/proof_of_text.hpp"

namespace casimir::test {
namespace {

/// Of bare equations of x and y, with functions U.
std::string flow(const std::string& x, const std::string& y, const std::string& claims) {
  return "[phase_space]\nvariables = [\"x\", \"y\"]\n[functions]\nU = [\"r\"]\n[equations]\nx = "
         "\"" +
         x + "\"\ny = \"" + y + "\"\n" + claims;
}

Proof measure_of(const std::string& x, const std::string& y, const std::string& density) {
  return proof_in_case("measure", flow(x, y, "[[measure]]\ndensity = \"" + density + "\"\n"));
}

const std::vector<std::string> kNotAcrossZero{"on motions that do not cross x = 0"};

/// Each field takes [-2, -1] x [0, 1] to a set of another measure.
TEST(PassedPoles, AMeasureLeaksWhereItsFluxJumps) {
  EXPECT_EQ(measure_of("2 + sign(x)", "0", "1").where, kNotAcrossZero);
  EXPECT_EQ(measure_of("2 + sign(x)", "0", "1 + y^2").where, kNotAcrossZero);
  EXPECT_EQ(measure_of("1/x^2", "0", "3*x^2 + abs(x)*x").where, kNotAcrossZero);
  EXPECT_EQ(measure_of("1/x^2", "0", "x^2*(2 + sign(x))").where, kNotAcrossZero);
}

/// The density jumps, or the field does, and what flows through the surface does not.
TEST(PassedPoles, AMeasureIsKeptWhereItsFluxIsContinuous) {
  for (const auto& proof :
       {measure_of("2 + sign(x)", "0", "2 - sign(x)"), measure_of("y", "-sign(x)", "1"),
        measure_of("cos(y)/(1 + sign(x)/2)", "0", "1 + sign(x)/2")}) {
    EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
    EXPECT_TRUE(proof.where.empty()) << proof.where.front();
  }
}

/// The gradient of 1 - sin(x) is zero where it is: it is twice the square of the sine of half of
/// Pi/2 - x, through whose zero the flux jumps.
TEST(PassedPoles, ADoubleZeroHidesAFlux) {
  const Proof proof = measure_of("2 + cos(x)/(sqrt(1 - sin(x))*sqrt(1 + sin(x)))", "0", "1");
  EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
  EXPECT_FALSE(proof.where.empty());
}

/// All motions meet at the origin, where each may go on as any other.
TEST(PassedPoles, AMeasureLeaksWhereMotionsMeet) {
  EXPECT_EQ(measure_of("-1", "-2*y/x", "x^2/(x^4 + y^2)").where, kNotAcrossZero);
}

TEST(PassedPoles, OfABracketLeakForEveryHamiltonian) {
  const auto where = [](const std::string& bracket, const std::string& density) {
    return proof_in_case("measure",
                         "hamiltonian = \"y\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n"
                         "[phase_space.brackets]\n\"x,y\" = \"" +
                             bracket + "\"\n[[measure]]\ndensity = \"" + density +
                             "\"\nevery_hamiltonian = true\n")
        .where;
  };
  EXPECT_EQ(where("2 + sign(x)", "1"), kNotAcrossZero);
  EXPECT_EQ(where("1/x^2", "x^2*(2 + sign(x))"), kNotAcrossZero);
  EXPECT_TRUE(where("1 + x^2", "1/(1 + x^2)").empty());
}

/// tanh(1/x) and its kind jump as atan(1/x) does.
TEST(PassedPoles, OfExponentialsAreJumps) {
  struct Integral {
    std::string y, f;
  };
  for (const auto& [y, f] :
       {Integral{"exp(1/x)/(x^2*(1 + exp(1/x))^2)", "y - 1/(1 + exp(1/x))"},
        Integral{"exp(1/x)/(x^2*(1 + exp(2/x)))", "y + atan(exp(1/x))"},
        Integral{"(1 - tanh(1/x)^2)/x^2", "y + tanh(1/x)"},
        Integral{"(1 - tanh(tan(x))^2)/cos(x)^2", "y - tanh(tan(x))"},
        Integral{"cos(1/x)/x^2", "y + sin(1/x)"}, Integral{"U'(1/x)/x^2", "y + U(1/x)"}}) {
    const Proof integral =
        proof_in_case("integral", flow("1", y, "[integrals]\nF = \"" + f + "\"\n"));
    EXPECT_EQ(integral.verdict, Verdict::proved) << f << ": " << integral.reason;
    EXPECT_FALSE(integral.jumps.empty()) << f;
    const Proof relation = proof_in_case(
        "invariant_relation",
        flow("1", y, "[[invariant_relation]]\nname = \"R\"\nexpression = \"" + f + "\"\n"));
    EXPECT_EQ(relation.verdict, Verdict::undecided) << f;
  }
}

/// Each side of x = 0 has its own y*exp(1/x^2), and its own quotient of two such functions.
TEST(PassedPoles, OfTheEquationsPartMotions) {
  const auto jumps = [](const std::string& x, const std::string& y, const std::string& f) {
    return proof_in_case("integral", flow(x, y, "[integrals]\nF = \"" + f + "\"\n")).jumps;
  };
  const std::vector<std::string> at_zero{"x = 0"};
  EXPECT_EQ(jumps("1", "2*y/x^3", "y*exp(1/x^2)"), at_zero);
  EXPECT_EQ(jumps("1", "2*y/x", "y/x^2"), at_zero);
  EXPECT_TRUE(jumps("x", "2*y", "y/x^2").empty());  // a motion stays on its side
}

/// With y = 0 for x <= 0 goes y = x^2, exp(-1/x^2), .. behind: what leaves a level takes the claims
/// on it along.
TEST(PassedPoles, OfACofactorLetMotionsLeaveALevel) {
  struct Motion {
    std::string x, y, relation, pole;
  };
  const auto claims = [](const std::string& f) {
    return std::vector<std::pair<const char*, std::string>>{
        {"invariant_relation",
         "[[invariant_relation]]\nname = \"R\"\nexpression = \"" + f + "\"\n"},
        {"conditional",
         "[[conditional]]\nname = \"C\"\nexpression = \"" + f + "\"\non = [\"" + f + "\"]\n"},
        {"lax", "[[lax]]\non = [\"" + f + "\"]\nL = [[\"" + f + "\"]]\nA = [[\"0\"]]\n"}};
  };
  for (const Motion& m :
       {Motion{"1", "2*y/x", "y", "x"}, Motion{"1", "2*y/x^3", "y", "x"},
        Motion{"1", "2*y/x", "y - x^2", "x"}, Motion{"1", "2*x*y/(x^2 + y^2)", "y", "x^2 + y^2"},
        Motion{"1", "3*y*cos(x)/sin(x)", "y", "sin(x)"}, Motion{"y/x", "1", "x - y", "x"}}) {
    for (const auto& [kind, claim] : claims(m.relation)) {
      const Proof proof = proof_in_case(kind, flow(m.x, m.y, claim));
      if (proof.verdict != Verdict::proved) continue;
      EXPECT_EQ(std::ranges::count(proof.where, "on motions that do not cross " + m.pole + " = 0"),
                1)
          << kind << " " << m.y;
    }
  }
  // A motion keeps to its side, or there is no pole.
  for (const Motion& m : {Motion{"x", "2*y/x", "y", ""}, Motion{"1", "2*x*y/(1 + x^2)", "y", ""}}) {
    for (const auto& [kind, claim] : claims(m.relation)) {
      const Proof proof = proof_in_case(kind, flow(m.x, m.y, claim));
      EXPECT_EQ(proof.verdict, Verdict::proved) << kind << " " << m.y;
      EXPECT_TRUE(std::ranges::none_of(
          proof.where,
          [](const std::string& where) { return where.find("motions") != std::string::npos; }))
          << kind << " " << m.y;
    }
  }
}

Model of_two_particles(const std::string& potential, const std::string& claims) {
  return model_of(
      "hamiltonian = \"p1^2/2 + p2^2/2 + " + potential +
      "\"\n[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", \"p2\"]\ncanonical = true\n"
      "[parameters]\ng = {}\nk = {}\n[definitions]\nf = \"(p1 - p2)^2/4 + " +
      potential + "\"\n" + claims);
}

/// With a coupling g without a sign: where it is not zero the energy keeps motions from the poles,
/// and where it is there are none.
TEST(PassedPoles, EndMotionsForEachValueOfACoupling) {
  const auto verdict = [](const std::string& potential) {
    return prove(of_two_particles(potential,
                                  "[[invariant_relation]]\nname = \"R\"\nexpression = \"f - 1\"\n"))
        .at(2)
        .verdict;
  };
  EXPECT_EQ(verdict("g/(q1 - q2)^2"), Verdict::proved);
  EXPECT_EQ(verdict("g*k/(q1 - q2)^2 + k*(q1 - q2)^2"), Verdict::proved);
  EXPECT_EQ(verdict("(g^2 - k)/(q1 - q2)^2"), Verdict::proved);
  // Where g is zero, a weaker pole is left, whose coefficient may be.
  EXPECT_EQ(verdict("g/(q1 - q2)^2 + (q1 - q2 - k)/(q1 - q2)"), Verdict::undecided);
}

/// Poles of one sign do not cancel: on a level the motion ends at each of them.
TEST(PassedPoles, OfOneSignEndMotionsOnEachLevel) {
  const auto where = [](const std::string& hamiltonian, const std::string& on) {
    return proof_in_case("conditional",
                         "hamiltonian = \"" + hamiltonian +
                             "\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\", \"px\", \"py\", "
                             "\"pz\"]\ncanonical = true\n[parameters]\nm = {}\nk = {}\n"
                             "[[conditional]]\nname = \"C\"\nexpression = \"x + z\"\non = [" +
                             on + "]\n");
  };
  const auto is_free = [&](const std::string& hamiltonian, const std::string& on) {
    const Proof proof = where(hamiltonian, on);
    EXPECT_EQ(proof.verdict, Verdict::proved) << hamiltonian << ": " << proof.reason;
    return std::ranges::none_of(proof.where, [](const std::string& condition) {
      return condition.find("motions") != std::string::npos;
    });
  };
  const std::string kinetic = "(px^2 + py^2 + pz^2)/2";
  const std::string symmetric = R"("x + z", "px + pz", "y", "py")";
  EXPECT_TRUE(is_free(kinetic + " + 1/(x - y)^2 + 1/(y - z)^2 + 1/(x - z)^2", symmetric));
  EXPECT_TRUE(is_free(kinetic + " + k/(x - y)^2 + k/(y - z)^2 + k/(x - z)^2", symmetric));
  EXPECT_TRUE(is_free(kinetic + " + log((x - y)^2) + log((y - z)^2)", symmetric));
  // Poles of both signs may cancel where they meet.
  EXPECT_FALSE(is_free(kinetic + " + 1/(x - y)^2 + 1/(y - z)^2 - m/(x - z)^2", symmetric));
}

/// Walls that meet, walls of sines, centrifugal terms: almost all motions end there.
TEST(PassedPoles, OfTheEnergyArePassedByFewMotions) {
  for (const char* potential : {"1/q1^2 + 1/q2^2", "1/cos(q1)^2", "g/sin(q1 - q2)^2",
                                "p2^2/q1^2 - k/q1", "g/(q1 - q2)^2 + g/(q1 + q2)^2"}) {
    const Model model = of_two_particles(
        potential, "[[measure]]\ndensity = \"1\"\n[integrals]\nH = \"p1^2/2 + p2^2/2 + " +
                       std::string(potential) + "\"\n");
    for (const Proof& proof : prove(model)) {
      if (proof.kind != casimir::ClaimKind::measure && proof.kind != casimir::ClaimKind::integral)
        continue;
      EXPECT_EQ(proof.verdict, Verdict::proved) << potential;
      EXPECT_TRUE(proof.where.empty()) << potential << ": " << proof.where.front();
      EXPECT_TRUE(proof.jumps.empty()) << potential << ": " << proof.jumps.front();
    }
  }
}

/// A bracket that has a pole itself, or keeps x = 0, takes all motions there at a finite energy:
/// x = -t, y = t*|t|.
TEST(PassedPoles, OfTheEnergyArePassedWhereTheBracketLeadsThere) {
  struct System {
    std::string energy, yz, zx;
  };
  for (const auto& [energy, yz, zx] :
       {System{"z + (w + abs(w))/x", "-2*y/x", "1"}, System{"z + sin(x)/x", "-2*y/x", "1"},
        System{"z + w/x", "-2*y/x", "1"}, System{"z/x^4", "-2*y*x^3", "x^4"}}) {
    const Proof proof = proof_in_case(
        "integral", "hamiltonian = \"" + energy +
                        "\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\", \"w\"]\n"
                        "[phase_space.brackets]\n\"y,z\" = \"" +
                        yz + "\"\n\"z,x\" = \"" + zx + "\"\n[integrals]\nF = \"y/x^2\"\n");
    EXPECT_EQ(proof.verdict, Verdict::proved) << energy;
    EXPECT_EQ(proof.jumps, std::vector<std::string>{"x = 0"}) << energy;
  }
}

/// |x|^(2 a) is a pole for a < 0, and log|x| times what is zero there may be anything.
/// All motions of H = p1 p2/q1^2 with p2 != 0 come to q1 = 0 through p1 = 0, where H is 0/0: q1 is
/// (3 p2 t)^(1/3) and p1 = c q1^2, with a c of its own on each side. So do those of (p1^2/2 -
/// 1)/q1^2. A factor that the motion keeps zero there leads none: the angular momentum L of
/// L^2/r^2.
TEST(PassedPoles, OfTheEnergyArePassedWhereItsCoefficientVanishesToo) {
  const auto with = [](const std::string& energy, const std::string& rest) {
    return "hamiltonian = \"" + energy +
           "\"\n[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", \"p2\"]\ncanonical = true\n" +
           rest;
  };
  const std::vector<std::string> wall{"q1 = 0"};
  EXPECT_EQ(proof_in_case("integral", with("p1*p2/q1^2", "[integrals]\nK = \"p1/q1^2\"\n")).jumps,
            wall);
  EXPECT_FALSE(proof_in_case("measure", with("p1*p2/q1^2", "[[measure]]\ndensity = \"p1/q1^2\"\n"))
                   .where.empty());
  EXPECT_EQ(proof_in_case("integral", with("(p1^2/2 - 1)/q1^2",
                                           "[integrals]\nG = \"(p1^2/2 - 1)/q1^2 + p2\"\n"))
                .jumps,
            wall);
  EXPECT_TRUE(proof_in_case("integral", with("p1^2/2 + p2^2/(2*q1^2)",
                                             "[integrals]\nG = \"p1^2 + p2^2/q1^2\"\n"))
                  .jumps.empty());
}

TEST(PassedPoles, OfPowersAndLogarithmsAreSeen) {
  const auto relation = [](const std::string& y, const std::string& f) {
    return proof_in_case(
               "invariant_relation",
               "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\na = {}\n[equations]\n"
               "x = \"1\"\ny = \"" +
                   y + "\"\n[[invariant_relation]]\nname = \"R\"\nexpression = \"" + f + "\"\n")
        .verdict;
  };
  EXPECT_EQ(
      relation("(2*a+1)*exp(a*log(x^2))/(1+x^2*exp(2*a*log(x^2)))", "y - atan(x*exp(a*log(x^2)))"),
      Verdict::undecided);
  EXPECT_EQ(relation("-2*a*y/x", "y*exp(a*log(x^2)) - 1"), Verdict::undecided);
  EXPECT_EQ(relation("-y/(x*log(abs(x)))", "y*log(abs(x)) - 1"), Verdict::undecided);
}

/// x' = x U(1/x) is 1 for U(s) = s, and x' = 2 x sinh(1/x) passes zero in finite time.
TEST(PassedPoles, OfCofactorsLetAMotionPass) {
  for (const char* rate : {"U(1/x)", "(exp(1/x) - exp(-1/x))", "y*log(abs(x))^2"}) {
    const Proof proof = proof_in_case(
        "integral",
        "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[functions]\nU = "
        "[\"s\"]\n[equations]\nx = \"x*" +
            std::string(rate) + "\"\ny = \"1\"\nz = \"0\"\n[integrals]\nF = \"z*x/abs(x)\"\n");
    EXPECT_EQ(proof.verdict, Verdict::proved) << rate;
    EXPECT_EQ(proof.jumps, std::vector<std::string>{"x = 0"}) << rate;
  }
}

/// On z = x^2 the surface x = 0 is z = 0 as well, and dz is zero there.
TEST(PassedPoles, OnConstraintsASurfaceHasSeveralNames) {
  const Proof proof = proof_in_case(
      "measure",
      "[phase_space]\nvariables = [\"x\", \"z\", \"w\"]\nconstraints = [\"z - x^2\"]\n[equations]\n"
      "x = \"2 + x*abs(x)/z\"\nz = \"4*x + 4*abs(x) - 2*z/abs(x)\"\nw = \"-w*(2*abs(x)/z - "
      "2/abs(x))\"\n[[measure]]\ndensity = \"1\"\n");
  EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
  EXPECT_FALSE(proof.where.empty());
}

TEST(PassedPoles, OfABracketMakeCasimirFunctionsJump) {
  const Proof proof =
      proof_in_case("casimir",
                    "hamiltonian = \"z\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n"
                    "[phase_space.brackets]\n\"x,z\" = \"1\"\n\"y,z\" = \"2*y/x\"\n[casimirs]\nC = "
                    "\"y/x^2\"\n");
  EXPECT_EQ(proof.jumps, std::vector<std::string>{"x = 0"});
}

TEST(PassedPoles, OfTheSpectrumAreSaid) {
  const auto lax = [](const std::string& entry) {
    return proof_in_case("lax",
                         flow("1", "0", "[[lax]]\nL = [[\"" + entry + "\"]]\nA = [[\"0\"]]\n"))
        .jumps;
  };
  EXPECT_EQ(lax("y*x/abs(x)"), std::vector<std::string>{"x = 0"});
  EXPECT_TRUE(lax("y").empty());
}

}  // namespace
}  // namespace casimir::test
