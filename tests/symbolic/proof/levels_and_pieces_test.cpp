// The hypotheses of the theorems behind claims on levels and behind facts: each test drops one.
#include <gtest/gtest.h>

#include <set>

#include "symbolic/proof/generic_rank.hpp"
#include "symbolic/proof/points/real_level_point.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

/// Verdict and conditions of the only claim of a kind.
Proof proof_in_case(const std::string& kind, const std::string& text) {
  const Model model = model_of(text);
  for (Proof& proof : prove(model)) {
    if (to_string(proof.kind) == kind) return std::move(proof);
  }
  ADD_FAILURE() << "no claim of the kind " << kind;
  return {};
}

std::string equations(const std::string& rest) {
  return "[phase_space]\nvariables = [\"x\",\"y\",\"z\"]\n" + rest;
}

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

std::string canonical(const std::string& integral) {
  return "integrable = true\nhamiltonian = \"p1^2\"\n[phase_space]\n"
         "variables = [\"q1\",\"q2\",\"p1\",\"p2\"]\ncanonical = true\n[integrals]\nF = \"" +
         integral + "\"\n";
}

TEST(Facts, HoldOnEachPiece) {
  EXPECT_EQ(proof_in_case("liouville", canonical("p2")).verdict, Verdict::proved);
  EXPECT_EQ(proof_in_case("liouville", canonical("p2*exp(p1)")).verdict, Verdict::proved);
  // On each of the two pieces, and each has its own point.
  const Proof both = proof_in_case("liouville", canonical("2*sqrt(p2^2) + p2"));
  EXPECT_EQ(both.verdict, Verdict::proved);
  EXPECT_TRUE(both.where.empty());
  for (const char* one : {"sqrt(p2^2) + p2", "sqrt(p2^2)*p2 - p2^2"}) {
    EXPECT_NE(proof_in_case("independence", canonical(one)).verdict, Verdict::proved) << one;
    EXPECT_NE(proof_in_case("liouville", canonical(one)).verdict, Verdict::proved) << one;
  }
}

TEST(Facts, DoNotCountRefutedCasimirFunctions) {
  const std::string so3 =
      "hamiltonian = \"M1\"\n[phase_space]\nvariables = [\"M1\",\"M2\",\"M3\"]\nalgebra = "
      "\"so(3)\"\n[casimirs]\n";
  const auto rank = [&](const std::string& casimirs) {
    return proof_in_case("rank", so3 + casimirs).evidence;
  };
  EXPECT_NE(rank("C = \"M1^2 + M2^2 + M3^2\"\n").find(" 1 independent Casimir function;"),
            std::string::npos);
  EXPECT_NE(rank("C = \"M1^2 + M2^2\"\n").find(" 0 independent Casimir functions;"),
            std::string::npos);
}

TEST(Facts, DoNotTakeGeneratorsForIndependent) {
  for (const char* zero :
       {"p2*(2*sin(asin(p2/10)/2 + acos(p2/10)/2)^2 - 1)",
        "p2*(2*cos(atan2(p2, p1)/2)^2 - 1 - p1/sqrt(p1^2 + p2^2))",
        "p2*(4*cos(acos(p2/10)/3)^3 - 3*cos(acos(p2/10)/3) - p2/10)",
        "p2*(8*cos(Pi/7)*cos(2*Pi/7)*cos(3*Pi/7) - 1)", "p2*(sqrt(3 + 2*sqrt(2)) - 1 - sqrt(2))"}) {
    EXPECT_NE(proof_in_case("independence", canonical(zero)).verdict, Verdict::proved) << zero;
    EXPECT_NE(proof_in_case("liouville", canonical(zero)).verdict, Verdict::proved) << zero;
  }
}

/// What needs no independence is proved: constants, nested roots, irrational exponents.
TEST(Facts, NeedNoRationalPoints) {
  for (const char* function : {"Pi*p2 + p1", "p2*exp(sqrt(2)*p1)", "sqrt(2 + sqrt(3 + sqrt(5)))*p2",
                               "p2*atan2(p1, 7)", "log(2 + p2^2)"}) {
    const Proof proof = proof_in_case("liouville", canonical(function));
    EXPECT_EQ(proof.verdict, Verdict::proved) << function << ": " << proof.reason;
  }
}

TEST(Pieces, OfRingsOfFunctions) {
  const Model model =
      model_of("[phase_space]\nvariables = [\"x\",\"y\"]\n[equations]\nx = \"0\"\ny = \"0\"\n");
  const auto pieces = [&](const std::string& text) {
    const GiNaC::ex value = model.parse({text, {"test", 1, 1}, text});
    FunctionRing ring(model.variables, {}, {value}, {});
    return ring.pieces({ring.convert(value)});
  };
  EXPECT_TRUE(pieces("x/y + sin(x*y) + exp(x)").rigid);
  EXPECT_TRUE(pieces("sqrt(x^2 - 1)*sqrt(y)").rigid);
  // A square in disguise, and branches that differ by a constant from piece to piece.
  EXPECT_FALSE(pieces("sqrt(1 - sin(x))").rigid);
  EXPECT_FALSE(pieces("atan(x) + atan(1/x)").rigid);
  const auto absolute = pieces("sqrt(x^2) + sqrt((x - y)^2)");
  EXPECT_TRUE(absolute.rigid);
  EXPECT_EQ(absolute.switches.size(), 2U);
}

TEST(LowestTerms, CancelWhatNumeratorsKeep) {
  const Model model =
      model_of("[phase_space]\nvariables = [\"x\",\"y\"]\n[equations]\nx = \"0\"\ny = \"0\"\n");
  const GiNaC::ex value = model.parse({"y*x^(3/2)", {"test", 1, 1}, {}});
  FunctionRing ring(model.variables, {}, {value}, {});
  const Polynomial slope = ring.derivative(ring.convert(value), 0);  // 3/2*y*sqrt(x)
  EXPECT_TRUE(ring.lowest_terms(slope).second.is_constant());
  const Polynomial second = ring.derivative(slope, 0);  // 3/4*y/sqrt(x)
  EXPECT_FALSE(ring.lowest_terms(second).second.is_constant());
}

/// The conditions of a fact about two free motions with the second integral F.
std::set<std::string> conditions_of(const std::string& kind, const std::string& f,
                                    const std::string& assume_a = "") {
  const Proof proof =
      proof_in_case(kind,
                    "integrable = true\nhamiltonian = \"p1^2 + p2^2\"\n[phase_space]\n"
                    "variables = [\"q1\",\"q2\",\"p1\",\"p2\"]\ncanonical = "
                    "true\n[parameters]\na = { assume = [" +
                        assume_a + "] }\nb = {}\n[integrals]\nF = \"" + f + "\"\n");
  EXPECT_EQ(proof.verdict, Verdict::proved) << f << ": " << proof.reason;
  return {proof.where.begin(), proof.where.end()};
}

TEST(SpecialParameters, AreConditionsOfIndependenceAndOfLiouvillesCount) {
  using Set = std::set<std::string>;
  for (const char* kind : {"independence", "liouville"}) {
    EXPECT_EQ(conditions_of(kind, "p1"), Set{}) << kind;
    EXPECT_EQ(conditions_of(kind, "a*p1"), Set{"a != 0"}) << kind;
    EXPECT_EQ(conditions_of(kind, "(a - 1)*p1 + p1^2 + p2^2"), Set{"a - 1 != 0"}) << kind;
    EXPECT_EQ(conditions_of(kind, "(a^2 - 2)*p1"), Set{"a^2 - 2 != 0"}) << kind;
    EXPECT_EQ(conditions_of(kind, "a*p1^2 + b*p2^2"), Set{"a - b != 0"}) << kind;
    EXPECT_EQ(conditions_of(kind, "a*p1 + b*p2"), Set{"a^2 + b^2 != 0"}) << kind;
    EXPECT_EQ(conditions_of(kind, "(a - 1)*p1 + (b - 2)*p2"), Set{"(a - 1)^2 + (b - 2)^2 != 0"})
        << kind;
    // No such values, or none that the assumptions admit.
    EXPECT_EQ(conditions_of(kind, "(a^2 + 1)*p1"), Set{}) << kind;
    EXPECT_EQ(conditions_of(kind, "a*p1", "'a > 1'"), Set{}) << kind;
    EXPECT_EQ(conditions_of(kind, "(a - 1)*p1", "'a > 1'"), Set{}) << kind;
    EXPECT_EQ(conditions_of(kind, "a*p1^2 + b*p2^2", "'a > b'"), Set{}) << kind;
  }
}

TEST(SpecialParameters, InFunctionsAreConditionsToo) {
  using Set = std::set<std::string>;
  const Set generic{"a, b are generic"};
  for (const char* kind : {"independence", "liouville"}) {
    EXPECT_EQ(conditions_of(kind, "(sin(a) - 1/2)*p1"), Set{"2*sin(a) - 1 != 0"}) << kind;
    EXPECT_EQ(conditions_of(kind, "p1*cos(a*b)"), Set{"cos(a*b) != 0"}) << kind;
    EXPECT_EQ(conditions_of(kind, "(sqrt(a) - 2)*p1", "'a > 0'"), Set{"sqrt(a) - 2 != 0"}) << kind;
    EXPECT_EQ(conditions_of(kind, "tan(a)*p1").count("sin(a) != 0"), 1U) << kind;
    for (const auto& [f, condition] :
         {std::pair("(2^a - 4)*p1", "exp(a*log(2)) - 4 != 0"),
          std::pair("log(a)*p1", "log(a) != 0"), std::pair("p1*acos(a)", "acos(a) != 0")})
      EXPECT_EQ(conditions_of(kind, f, "'a > 0'").count(condition), 1U) << f;
    // Dependent at a = b, and at a = Pi/2: no factor shows that.
    EXPECT_EQ(conditions_of(kind, "sin(a*p1) - sin(b*p1)"), generic) << kind;
    EXPECT_EQ(conditions_of(kind, "(sin(a) - 1)*p1 + cos(a)*p2"), Set{"a is generic"}) << kind;
    // A factor without a zero is no condition.
    EXPECT_EQ(conditions_of(kind, "exp(a)*p1"), Set{}) << kind;
    EXPECT_EQ(conditions_of(kind, "p1/sqrt(a^2 + 1)"), Set{}) << kind;
    EXPECT_EQ(conditions_of(kind, "p1*exp(a*p1)"), Set{}) << kind;
  }
}

TEST(SpecialParameters, OfWhichTheAssumptionsAdmitOneRoot) {
  using Set = std::set<std::string>;
  for (const char* sign : {"'a > 0'", "'a < 0'"})
    EXPECT_EQ(conditions_of("independence", "(a^2 - 2)*p1", sign), Set{"a^2 - 2 != 0"}) << sign;
}

/// The identity, from a plane to a half of it: only where it leads there.
TEST(Maps, LeadIntoTheDomainOfTheTarget) {
  const auto map = [](const std::string& domain, const std::string& bracket,
                      const std::string& image) {
    return proof_in_case("map",
                         "hamiltonian = \"p\"\n[phase_space]\nvariables = [\"q\",\"p\"]\n"
                         "canonical = true\n[[map]]\nname = \"M\"\nto = { variables = "
                         "[\"u\",\"v\"], domain = [\"" +
                             domain + "\"], brackets = { \"u,v\" = \"" + bracket +
                             "\" } }\nexpressions = { u = \"" + image + "\", v = \"p\" }\n");
  };
  for (const char* one : {"1", "sqrt(u^2)/u"}) {
    const Proof half = map("u > 0", one, "q");
    EXPECT_TRUE(half.verdict == Verdict::undecided ||
                half.where == std::vector<std::string>{"q > 0"})
        << one;
  }
  const Proof inside = map("u > 0", "u", "exp(q)");
  EXPECT_EQ(inside.verdict, Verdict::proved);
  EXPECT_TRUE(inside.where.empty());
  EXPECT_NE(map("u > 0", "u", "-exp(q)").verdict, Verdict::proved);
  EXPECT_EQ(map("u < 1", "2", "q").verdict, Verdict::refuted);
}

TEST(Maps, LeadWhereTheyAreSaidToLeadAlsoWithoutAnInverse) {
  const auto map = [](const std::string& constraints, const std::string& image) {
    return proof_in_case("map",
                         "hamiltonian = \"p\"\n[phase_space]\n" + constraints +
                             "variables = [\"q\",\"p\"]\ncanonical = true\n"
                             "[[map]]\nname = \"M\"\nto = { variables = [\"u\",\"v\",\"w\"], "
                             "brackets = { \"u,v\" = \"1\" } }\nimage = [\"" +
                             image + "\"]\nexpressions = { u = \"q\", v = \"p\", w = \"3\" }\n");
  };
  EXPECT_EQ(map("", "w - 3").verdict, Verdict::proved);
  EXPECT_EQ(map("", "w - 2").verdict, Verdict::refuted);
  EXPECT_EQ(map("", "u - v").verdict, Verdict::refuted);
  EXPECT_EQ(map("constraints = [\"q - p\"]\n", "u - v").verdict, Verdict::proved);
}

/// z - arg(x + i y) has no derivative along the motion, and jumps by 2 Pi in each turn.
TEST(Pieces, AnIntegralWithAnAngleIsSaidToJump) {
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[equations]\nx = \"-y\"\ny = \"x\"\n"
      "z = \"1\"\n");
  const auto evidence = [&](const std::string& f) {
    const Proof proof =
        prove_claim(model, casimir::ClaimKind::integral, model.parse_named({f, {}, {}}));
    EXPECT_EQ(proof.verdict, Verdict::proved) << f;
    return proof.evidence;
  };
  EXPECT_NE(evidence("z - atan2(y, x)").find("jumps"), std::string::npos);
  EXPECT_EQ(evidence("atan2(x^2 + y^2, 2)").find("jumps"), std::string::npos);
  EXPECT_EQ(evidence("atan2(3, x^2 + y^2)").find("jumps"), std::string::npos);
}

}  // namespace
}  // namespace casimir::test
