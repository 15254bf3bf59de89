// The hypotheses of the theorems behind claims on levels and domains: each test drops one.
#include <gtest/gtest.h>

#include <set>

#include "tests/symbolic/proof/proof_of_text.hpp"

namespace casimir::test {
namespace {

/// z on a level of x and y, which rest, where dz/dt is given.
Proof on_level(const std::string& level, const std::string& rate, const std::string& more = "") {
  return proof_in_case("conditional",
                       equations(more + "[equations]\nx = \"0\"\ny = \"0\"\nz = \"" + rate +
                                 "\"\n[[conditional]]\nname = \"C\"\nexpression = \"z\"\non = [\"" +
                                 level + "\"]\n"));
}

TEST(Levels, ALeadingCoefficientThatVanishesOnAPartOfTheLevel) {
  EXPECT_EQ(on_level("y", "y").verdict, Verdict::proved);
  for (const char* level : {"x*y", "sin(x)*y", "log(x)*y", "(exp(x) - 1)*y", "y*atan2(x, 1)"})
    EXPECT_EQ(on_level(level, "y").verdict, Verdict::refuted) << level;
  for (const char* level : {"sqrt(x)*y", "y*sqrt(x^2)"})
    EXPECT_NE(on_level(level, "y").verdict, Verdict::proved) << level;
}

TEST(Levels, AParameterThatMayVanishIsACondition) {
  const std::string parameters = "[parameters]\na = {}\nb = { assume = \"b != 0\" }\n";
  EXPECT_EQ(on_level("b*y", "y", parameters).verdict, Verdict::proved);
  EXPECT_TRUE(on_level("b*y", "y", parameters).where.empty());
  EXPECT_EQ(on_level("a*y", "y", parameters).verdict, Verdict::refuted);
  // Where a = 0 the level is everything, and what is claimed holds there as well.
  const Proof both = on_level("a*y", "a*y", parameters);
  EXPECT_EQ(both.verdict, Verdict::proved);
  EXPECT_TRUE(both.where.empty());
}

TEST(Levels, ALevelWithoutRealPointsIsNothing) {
  EXPECT_EQ(on_level("x^2 + 1", "y").verdict, Verdict::undecided);
  EXPECT_EQ(on_level("x^2 + y^2", "x^2 + y^2").verdict, Verdict::proved);
  EXPECT_EQ(on_level("x^2 + y^2 - 1", "x^2 + y^2 - 1").verdict, Verdict::proved);
  EXPECT_EQ(on_level("x", "x", "domain = [\"x > 0\"]\n").verdict, Verdict::undecided);
}

TEST(Levels, AnInequalityThatHoldsTriviallyThereSaysNothing) {
  const std::string product = "domain = [\"x^2*y >= 0\"]\n";
  EXPECT_EQ(on_level("x", "sqrt(y^2) - y", product).verdict, Verdict::refuted);
  EXPECT_EQ(on_level("x", "sqrt(y^2) - y", "domain = [\"y >= 0\"]\n").verdict, Verdict::proved);
  EXPECT_EQ(on_level("x - 1", "sqrt(y^2) - y", "domain = [\"x^2*y > 0\"]\n").verdict,
            Verdict::proved);
}

/// R(t) = t^2/4 starts on y = 0 and leaves it, though dy/dt vanishes there.
TEST(Levels, InvarianceNeedsARegularCofactor) {
  const auto relation = [](const std::string& rate, const std::string& f) {
    return proof_in_case("invariant_relation", equations("[equations]\nx = \"1\"\ny = \"" + rate +
                                                         "\"\nz = \"0\"\n[[invariant_relation]]\n"
                                                         "name = \"R\"\nexpression = \"" +
                                                         f + "\"\n"))
        .verdict;
  };
  EXPECT_EQ(relation("x*y", "y"), Verdict::proved);
  EXPECT_EQ(relation("y^2", "y"), Verdict::proved);
  EXPECT_NE(relation("sqrt(y)", "y"), Verdict::proved);
  EXPECT_NE(relation("y^(2/3)", "y"), Verdict::proved);
  EXPECT_NE(relation("0", "sqrt(x^2) - x"), Verdict::proved);
}

/// x and y rest; each level is that of what it is compared with, since what is left out of it
/// vanishes nowhere, or since it is a sum of squares.
TEST(Levels, AreThoseOfSimplerFunctionsWithTheSameRealZeros) {
  for (const char* level : {"(x^2 + 1)*y", "y^2", "y^3*exp(x)", "(x^2 + x + 1)*y", "y*(2 + sin(x))",
                            "y*(1 + acos(x/4))", "sqrt(1 + x^2)*y"})
    EXPECT_EQ(on_level(level, "y").verdict, Verdict::proved) << level;
  for (const char* level : {"(x^2 - 1)*y", "(x^2 + 2*x + 1)*y", "y*(1 + sin(x))", "y*acos(x/4)",
                            "y*(x^2 + x - 1)", "sqrt(x^2 - 1)*y"})
    EXPECT_NE(on_level(level, "y").verdict, Verdict::proved) << level;
  for (const char* level : {"x^2 + y^2", "x^4 + 3*y^2", "x^2 + x*y + y^2", "sqrt(x^2) + sqrt(y^2)"})
    EXPECT_EQ(on_level(level, "x + sin(y)").verdict, Verdict::proved) << level;
  for (const char* level : {"x^2 - y^2", "x^4 + 3*y^3", "x^2 + 2*x*y + y^2", "x^2 + x*y"})
    EXPECT_EQ(on_level(level, "x").verdict, Verdict::refuted) << level;
}

/// Only on one side of its pole is an arctangent what its rate says that it stays.
TEST(Levels, AreLeftWhereAnAngleJumpsAtAPoleOfItsArgument) {
  const auto relation = [](const std::string& rate, const std::string& expression) {
    return proof_in_case("invariant_relation",
                         equations("[equations]\nx = \"" + rate +
                                   "\"\ny = \"0\"\nz = \"0\"\n[[invariant_relation]]\nname = "
                                   "\"R\"\nexpression = \"" +
                                   expression + "\"\n"))
        .verdict;
  };
  for (const char* half_turn : {"atan(x) + atan(1/x) - Pi/2", "atan2(1/x, 1) + atan(x) - Pi/2",
                                "atan2(1, 1/x) - atan(x)", "sqrt(x^2)/x - 1"}) {
    EXPECT_NE(relation("1", half_turn), Verdict::proved) << half_turn;
    EXPECT_EQ(relation("x", half_turn), Verdict::proved) << half_turn;  // x = 0 is not reached
  }
  EXPECT_EQ(relation("1", "atan2(1, 1/(1 + x^2)) - atan(1 + x^2) + y"), Verdict::proved);
}

/// The rate of x^2 vanishes on x = 0, whatever that of x is.
TEST(Levels, OfSquaresAreLeftWhereTheirRootsAre) {
  const auto relation = [](const std::string& rate, const std::string& f) {
    return proof_in_case("invariant_relation",
                         equations("[equations]\nx = \"" + rate +
                                   "\"\ny = \"0\"\nz = \"0\"\n[[invariant_relation]]\n"
                                   "name = \"R\"\nexpression = \"" +
                                   f + "\"\n"))
        .verdict;
  };
  for (const char* f : {"x^2", "x^3*(1 + y^2)", "x^2*exp(z)"}) {
    EXPECT_EQ(relation("x*exp(z)", f), Verdict::proved) << f;
    EXPECT_EQ(relation("1", f), Verdict::refuted) << f;
    EXPECT_NE(relation("x^(2/3)", f), Verdict::proved) << f;
  }
}

/// What a root of higher power leaves differentiable, and what it does not.
TEST(Levels, MeetRootsThatAreDifferentiable) {
  const auto conditional = [](const std::string& rate, const std::string& f) {
    return proof_in_case("conditional", equations("[equations]\nx = \"x\"\ny = \"" + rate +
                                                  "\"\nz = \"0\"\n[[conditional]]\nname = \"C\"\n"
                                                  "expression = \"" +
                                                  f + "\"\non = [\"x\"]\n"))
        .verdict;
  };
  EXPECT_EQ(conditional("sqrt(x)", "y + x^(3/2)"), Verdict::proved);
  EXPECT_EQ(conditional("sin(x)", "y + x*sqrt(x^2)"), Verdict::proved);
  EXPECT_NE(conditional("sqrt(x)", "y + sqrt(x)"), Verdict::proved);
  EXPECT_NE(conditional("1 + sqrt(x)", "y + x^(3/2)"), Verdict::proved);
  // |x| stays zero on x = 0.
  EXPECT_EQ(conditional("x", "y + sqrt(x^2)"), Verdict::proved);
}

/// On y = 0 and x < 0 dF/dt is |x| - x, though the derivative of the root has 1/sqrt(y) in it.
TEST(Levels, MeetRootsWhoseDerivativesSayNoMore) {
  const auto conditional = [](const std::string& domain) {
    return proof_in_case(
               "conditional",
               "[phase_space]\nvariables = [\"x\",\"y\",\"z\",\"q\",\"w\"]\ndomain = [\"" + domain +
                   "\"]\n[equations]\nx = \"0\"\ny = \"sqrt(x^2) - x\"\n"
                   "z = \"sqrt(x^2) - x\"\nq = \"0\"\nw = \"0\"\n[[conditional]]\n"
                   "name = \"C\"\nexpression = \"z + sqrt(y)*(y + y*w)\"\non = [\"q\"]\n")
        .verdict;
  };
  EXPECT_NE(conditional("x*y >= 0"), Verdict::proved);
  EXPECT_EQ(conditional("x*(y + 1) >= q"), Verdict::proved);
}

/// y = 0 and y = 1 solve the equations, and the functions change with x there.
TEST(Levels, MeetAbsoluteValuesOfWhatKeepsItsSign) {
  // z where x, y and z have these rates, on a level.
  const auto verdict = [](const std::string& x, const std::string& y, const std::string& z,
                          const std::string& level, const std::string& f = "z") {
    return proof_in_case("conditional",
                         equations("[equations]\nx = \"" + x + "\"\ny = \"" + y + "\"\nz = \"" + z +
                                   "\"\n[[conditional]]\nname = \"C\"\nexpression = \"" + f +
                                   "\"\non = [\"" + level + "\"]\n"))
        .verdict;
  };
  const std::string half = "abs(x) - x";
  EXPECT_EQ(verdict("x", "1", half, half), Verdict::proved);
  EXPECT_EQ(verdict("x", "1", half, "2*(sqrt(x^2) - x)"), Verdict::proved);
  EXPECT_EQ(verdict("x*(y + z^2)", "1", half, half), Verdict::proved);
  EXPECT_EQ(verdict("x", "1", half, half, "z + abs(x) - x"), Verdict::proved);
  // The half-space x >= 0 is left.
  EXPECT_NE(verdict("-1", "1", half, half), Verdict::proved);
  EXPECT_NE(verdict("-sqrt(abs(x))", "1", half, half), Verdict::proved);
  EXPECT_NE(verdict("-abs(x)^(1/3)", "1", half, half), Verdict::proved);
  EXPECT_NE(verdict("x - y", "1", half, half), Verdict::proved);
  // It is kept, but z grows on it; or z is another root of x, which has no rate at zero.
  EXPECT_EQ(verdict("x", "1", "abs(x) + x", half), Verdict::refuted);
  EXPECT_NE(verdict("x", "1", half, half, "z + abs(y) - y"), Verdict::proved);
  EXPECT_NE(verdict("x", "1", "y", "y*abs(x)"), Verdict::proved);
}

TEST(Integrals, AreNoneWhereARootInTheMotionVanishes) {
  const auto where = [](const std::string& rate, const std::string& f) {
    const Proof proof =
        proof_in_case("integral", equations("[equations]\nx = \"1\"\ny = \"" + rate +
                                            "\"\nz = \"0\"\n[integrals]\nF = \"" + f + "\"\n"));
    EXPECT_EQ(proof.verdict, Verdict::proved) << f;
    return std::set<std::string>(proof.where.begin(), proof.where.end());
  };
  const std::set<std::string> inside{"y != 0", "y - 1 != 0"};
  EXPECT_EQ(where("2*sqrt(y)", "sqrt(y) - x"), std::set<std::string>{"y != 0"});
  for (const char* f :
       {"asin(sqrt(1 - y))", "acos(sqrt(y))", "acos(2*y - 1)/2", "atan2(sqrt(1 - y), sqrt(y))"})
    EXPECT_EQ(where("-2*sqrt(y*(1 - y))", f + std::string(" - x")), inside) << f;
  EXPECT_TRUE(where("0", "asin(y) + z").empty()) << "there is no root in the motion";
}

TEST(Signs, OfAProductNeedTheOthersNotToVanish) {
  const auto claim = [](const std::string& assume_a, const std::string& assume_b) {
    return proof_in_case("identity",
                         equations("[parameters]\na = { assume = \"" + assume_a +
                                   "\" }\nb = { assume = \"" + assume_b +
                                   "\" }\n[equations]\nx = \"0\"\ny = \"0\"\nz = \"0\"\n"
                                   "[[identity]]\nname = \"i\"\nleft = \"sqrt(b^2)\"\n"
                                   "right = \"b\"\n"))
        .verdict;
  };
  EXPECT_EQ(claim("a > 0", "a*b >= 0"), Verdict::proved);
  EXPECT_EQ(claim("a != 0", "a^2*b >= 0"), Verdict::proved);
  EXPECT_EQ(claim("a >= 0", "a*b > 0"), Verdict::proved);
  EXPECT_EQ(claim("a >= 0", "a*b >= 0"), Verdict::refuted);
  EXPECT_EQ(claim("a >= 0", "a^2*b >= 0"), Verdict::refuted);
}

/// |b| = b follows from what is assumed of b, or not.
TEST(Signs, OfSumsFollowFromThoseOfTheirParts) {
  const auto follows = [](const std::string& a, const std::string& b, const std::string& c,
                          const std::string& function) {
    return proof_in_case("identity",
                         "hamiltonian = \"p^2\"\n[phase_space]\nvariables = [\"q\",\"p\"]\n"
                         "canonical = true\n[parameters]\na = { assume = [" +
                             a + "] }\nb = { assume = [" + b + "] }\nc = { assume = [" + c +
                             "] }\n[[identity]]\nname = \"I\"\nleft = \"sqrt((" + function +
                             ")^2)*q\"\nright = \"(" + function + ")*q\"\n")
        .verdict;
  };
  EXPECT_EQ(follows("'a > b'", "'b > c'", "'c > 0'", "a - c"), Verdict::proved);
  EXPECT_EQ(follows("'a > b'", "'b > c'", "'c > 0'", "a + c"), Verdict::proved);
  EXPECT_EQ(follows("'a > b'", "'b > c'", "'c > 0'", "a*b - c^2"), Verdict::undecided);
  EXPECT_EQ(follows("'a >= 0'", "'b - a^2 >= 0'", "", "b"), Verdict::proved);
  EXPECT_EQ(follows("", "'a*b > 0'", "'a*c > 0', 'c > 0'", "b"), Verdict::proved);
  EXPECT_EQ(follows("'a > 1'", "", "", "a^2 - a*b + b^2"), Verdict::proved);
  EXPECT_EQ(follows("'a > b'", "'b > c'", "'c < 0'", "a + c"), Verdict::refuted);
  EXPECT_EQ(follows("'a > b'", "'c > b'", "", "a - c"), Verdict::refuted);
  EXPECT_EQ(follows("'a >= 0'", "'b + a^2 >= 0'", "", "b"), Verdict::refuted);
  EXPECT_EQ(follows("", "'a*b >= 0'", "'a*c >= 0', 'c > 0'", "b"), Verdict::refuted);
  EXPECT_EQ(follows("'a > 1'", "", "", "a^2 - 3*a*b + b^2"), Verdict::refuted);
}

/// {u, v} is |q|/q: 1 where sqrt(q) has a value.
TEST(Domain, OfAMapIsWhereItsExpressionsHaveValuesAsWritten) {
  const auto map = [](const std::string& v) {
    return proof_in_case("map",
                         "hamiltonian = \"p^2\"\n[phase_space]\nvariables = [\"q\",\"p\"]\n"
                         "canonical = true\n[[map]]\nname = \"M\"\nexpressions = { u = \"q\", "
                         "v = \"" +
                             v +
                             "\" }\n[map.to]\nvariables = [\"u\", \"v\"]\n[map.to.brackets]\n"
                             "\"u,v\" = \"1\"\n")
        .verdict;
  };
  EXPECT_EQ(map("p*sqrt(q^2)/sqrt(q)^2"), Verdict::proved);
  EXPECT_EQ(map("p*sqrt(q^2)/q"), Verdict::refuted);
}

TEST(Domain, AClaimAboutNothingIsNotProved) {
  const auto identity = [](const std::string& left, const std::string& right) {
    return proof_in_case("identity",
                         equations("[equations]\nx = \"0\"\ny = \"0\"\nz = \"0\"\n[[identity]]\n"
                                   "name = \"i\"\nleft = \"" +
                                   left + "\"\nright = \"" + right + "\"\n"))
        .verdict;
  };
  EXPECT_EQ(identity("log(x*y)", "log(x) + log(y)"), Verdict::proved);
  EXPECT_EQ(identity("log(-x)", "log(x)"), Verdict::undecided);
  EXPECT_EQ(identity("sqrt(-1 - x^2)", "sqrt(-1 - x^2)"), Verdict::undecided);
  // GiNaC makes 2 + y^2 of the left side, and x of exp(log(x)).
  EXPECT_EQ(identity("cos(acos(2 + y^2))", "2 + y^2"), Verdict::undecided);
  EXPECT_EQ(identity("exp(log(x))", "sqrt(x^2)"), Verdict::proved);
  EXPECT_EQ(identity("sqrt(x)^2", "sqrt(x^2)"), Verdict::proved);
  EXPECT_EQ(identity("x", "sqrt(x^2)"), Verdict::refuted);
}

/// What an assumption says where GiNaC has simplified it.
TEST(Domain, AnAssumptionHoldsOnlyWhereItHasAValue) {
  const auto verdict = [](const std::string& assumption, const std::string& f) {
    return proof_in_case("integral", equations("domain = [\"" + assumption +
                                               "\"]\n[equations]\nx = \"0\"\ny = \"0\"\nz = "
                                               "\"1\"\n[integrals]\nF = \"" +
                                               f + "\"\n"))
        .verdict;
  };
  EXPECT_EQ(verdict("z*0 + 1 > 0", "(sqrt(x^2) - x)*z"), Verdict::refuted);
  EXPECT_EQ(verdict("exp(log(x)) > -1", "(sqrt(x^2) - x)*z"), Verdict::proved);
  EXPECT_EQ(verdict("sqrt(x) < sqrt(x) + 1", "(sqrt(x^2) - x)*z"), Verdict::proved);
  EXPECT_EQ(verdict("0*asin(2 + x^2) > -1", "x"), Verdict::undecided);
  EXPECT_EQ(verdict("0*log(-1 - x^2) > -1", "x"), Verdict::undecided);
}

/// sqrt(-x^2) has a value at x = 0, and no derivative.
TEST(Domain, WithoutAnInsideIsNothingToDifferentiateOn) {
  const auto integral = [](const std::string& f) {
    return proof_in_case("integral", equations("[equations]\nx = \"0\"\ny = \"0\"\nz = \"1\"\n"
                                               "[integrals]\nF = \"" +
                                               f + "\"\n"))
        .verdict;
  };
  EXPECT_EQ(integral("x + sqrt(-x^2)^2"), Verdict::undecided);
  EXPECT_EQ(integral("x + sqrt(x^2)^2"), Verdict::proved);
}

}  // namespace
}  // namespace casimir::test
