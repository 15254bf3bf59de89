// The hypotheses of the theorems behind facts on pieces of the domain: each test drops one.
#include <gtest/gtest.h>

#include <set>

#include "symbolic/functions/function_ring.hpp"
#include "tests/symbolic/proof/proof_of_text.hpp"

namespace casimir::test {
namespace {

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

// Numbers that are put for sines, roots and quotients obey no relation, and show no factor.
TEST(SpecialParameters, AreFoundThroughRelationsOfFunctions) {
  using Set = std::set<std::string>;
  for (const char* kind : {"independence", "liouville"}) {
    for (const char* f : {"p1*(a*sin(p2)^2 + cos(p2)^2 - 1)", "p1*(a*cos(2*p2) - 1 + 2*sin(p2)^2)",
                          "p1*(a/(p2 + 1) + a*p2/(p2 + 1) - 1)",
                          "p1*(a*p1^2/sqrt(p1^2 + p2^2)^2 + a*p2^2/(p1^2 + p2^2) - 1)"})
      EXPECT_EQ(conditions_of(kind, f).count("a - 1 != 0"), 1U) << kind << ' ' << f;
    // On one of the pieces alone, or by a relation that the ring does not know.
    for (const char* f : {"a*abs(p1) - p1", "p1*(sqrt((1 - cos(p2))/2) - a*sin(p2/2))"})
      EXPECT_EQ(conditions_of(kind, f).count("a is generic"), 1U) << kind << ' ' << f;
    // Independent functions, which vanish together for no parameters.
    for (const char* f : {"p1*(a*sin(p2) + cos(p2))", "a*sqrt(p1^2 + 1) + p1", "a*abs(p1) + p1^3",
                          "p1*exp(p2) + a*log(p1^2 + 1)"})
      EXPECT_EQ(conditions_of(kind, f), Set{}) << kind << ' ' << f;
  }
}

// At a = b = 1 alone the bracket is zero: no factor of one minor is one of all.
TEST(SpecialParameters, AreFoundInMinorsWithOtherRows) {
  const auto where = [](const std::string& xy, const std::string& yz) {
    return proof_in_case("rank",
                         "hamiltonian = \"x\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n"
                         "brackets = { \"x,y\" = \"" +
                             xy + "\", \"y,z\" = \"" + yz + "\" }\n[parameters]\na = {}\nb = {}\n")
        .where;
  };
  using Conditions = std::vector<std::string>;
  EXPECT_EQ(where("a - 1", "b - 1"), Conditions{"(a - 1)^2 + (b - 1)^2 != 0"});
  EXPECT_EQ(where("a", "b"), Conditions{"a^2 + b^2 != 0"});
  EXPECT_EQ(where("a", "b + 1 - a"), Conditions{"a^2 + (b + 1)^2 != 0"});
  EXPECT_EQ(where("a", "1"), Conditions{});
  EXPECT_EQ(where("(a - 1)*sin(z) + (b - 1)*cos(z)", "0"),
            Conditions{"(a - 1)^2 + (b - 1)^2 != 0"});
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

/// Quotients have them in their numerators; that of what is divided by is none.
TEST(SpecialParameters, OfQuotientsAreThoseOfTheirNumerators) {
  for (const char* kind : {"independence", "liouville"}) {
    EXPECT_EQ(conditions_of(kind, "p2/(p2 + a) - p2/(p2 + b)").count("a - b != 0"), 1U) << kind;
    EXPECT_EQ(conditions_of(kind, "(p2 + a)/(b*p2 + 1)").count("a*b - 1 != 0"), 1U) << kind;
    EXPECT_EQ(conditions_of(kind, "atan(a*p2) - atan(b*p2)").count("a - b != 0"), 1U) << kind;
    EXPECT_EQ(conditions_of(kind, "p2/a").size(), 0U) << kind;
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

/// Conditions of a proved claim, in one text.
std::string where_in_case(const std::string& kind, const std::string& text) {
  const Proof proof = proof_in_case(kind, text);
  EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
  std::string where;
  for (const std::string& condition : proof.where) where += condition + "; ";
  return where;
}

std::string planar_with(const std::string& hamiltonian, const std::string& more) {
  return "hamiltonian = \"" + hamiltonian + "\"\nintegrable = true\n" +
         (more.starts_with("super") ? more.substr(0, more.find('\n') + 1) : "") +
         "[phase_space]\nvariables = [\"x\",\"y\",\"u\",\"v\"]\ncanonical = true\n[integrals]\n" +
         (more.starts_with("super") ? more.substr(more.find('\n') + 1) : more);
}

/// Three gravitating sheets are chaotic: the motion goes from piece to piece, and K jumps between
/// them.
TEST(Pieces, IntegralsThatJumpWhereTheMotionPassesAreNotCounted) {
  const std::string sheets = "(u^2+v^2)/2 + abs(x) + abs(x+y)";
  const Proof jumping =
      proof_in_case("liouville", planar_with(sheets, "K = \"v^2/2 + y*sign(x+y)\"\n"));
  EXPECT_EQ(jumping.verdict, Verdict::undecided);
  EXPECT_NE(jumping.reason.find("K is not counted, since it may jump where x + y = 0"),
            std::string::npos)
      << jumping.reason;
  // Continuous, beside a separable motion through kinks.
  EXPECT_EQ(where_in_case("liouville",
                          planar_with("(u^2+v^2)/2 + abs(x) + abs(y)", "K = \"v^2/2 + abs(y)\"\n")),
            "");
  // It jumps where no motion passes.
  EXPECT_EQ(where_in_case("liouville", planar_with("x*u + v", "K = \"v*x/abs(x)\"\n")), "");
  EXPECT_EQ(proof_in_case("integral", planar_with(sheets, "K = \"v^2/2 + y*sign(x+y)\"\n")).jumps,
            std::vector<std::string>{"x + y = 0"});
  // What divides by something that is never 0 does not jump, and where there is a pole no motion
  // may pass.
  for (const char* smooth : {"exp(-abs(x))", "1/(1 + sqrt(x^2))", "1/(2 + abs(x))"})
    EXPECT_EQ(where_in_case("liouville", planar_with(std::string("(u^2+v^2)/2 + y^2 + ") + smooth,
                                                     "K = \"v^2/2 + y^2\"\n"))
                  .find("do not cross"),
              std::string::npos)
        << smooth;
  // Quotients within functions that split them.
  for (const char* within : {"log(2 + (v^2/2 + y*sign(x+y))^2)", "atan2(2 + v^2 + sign(x+y), 1)",
                             "(2 + (v^2/2 + y*sign(x+y))^2)^Pi", "exp(v^2/2 + y*sign(x+y))"})
    EXPECT_EQ(
        proof_in_case("liouville", planar_with(sheets, std::string("K = \"") + within + "\"\n"))
            .verdict,
        Verdict::undecided)
        << within;
  for (const char* within : {"log(2 + v^2 + sign(x))", "atan2(2 + v^2 + sign(x), 1)"})
    EXPECT_EQ(proof_in_case("liouville",
                            planar_with("(u^2+v^2)/2", std::string("K = \"") + within + "\"\n"))
                  .verdict,
              Verdict::undecided)
        << within;
  EXPECT_EQ(
      proof_in_case("integral", planar_with(sheets, "K = \"log(2 + (v^2/2 + y*sign(x+y))^2)\"\n"))
          .jumps,
      std::vector<std::string>{"x + y = 0"});
  // A motion ends at a pole that is one everywhere.
  EXPECT_EQ(where_in_case("liouville",
                          planar_with("(u^2+v^2)/2 + 1/abs(x) + y^2", "K = \"v^2/2 + y^2\"\n")),
            "");
  EXPECT_NE(where_in_case("liouville", planar_with("(u^2+v^2)/2 + v/abs(x)", "K = \"v\"\n"))
                .find("on motions that do not cross x = 0"),
            std::string::npos);
  // The Hamiltonian, too.
  EXPECT_EQ(proof_in_case("liouville", planar_with("(u^2+v^2)/2 + sign(x)", "K = \"v\"\n")).verdict,
            Verdict::undecided);
}

/// With frequencies 1 and sqrt(2) motions are dense on tori of dimension 2: what would make them
/// closed is an angle that jumps again and again.
TEST(Pieces, AnglesMakeNoMotionClosedThatPassesTheirCuts) {
  const auto judged = [](const std::string& frequency, const std::string& angle) {
    const Model model =
        model_of(planar_with("(u^2+x^2)/2 + " + frequency + "*(v^2+y^2)/2",
                             "superintegrable = true\nA = \"u^2+x^2\"\nB = \"" + angle + "\"\n"));
    for (const Proof& proof : prove(model))
      if (proof.name == "superintegrability") return proof;
    ADD_FAILURE();
    return Proof{};
  };
  for (const char* angle :
       {"sqrt(2)*atan2(u,x) - atan2(v,y)", "cos(sqrt(2)*atan2(u,x) - atan2(v,y))"}) {
    const Proof dense = judged("sqrt(2)", angle);
    EXPECT_EQ(dense.verdict, Verdict::undecided) << angle;
    EXPECT_NE(dense.reason.find("B is not counted"), std::string::npos) << dense.reason;
  }
  // Of frequencies 1 and 2 the cosine is a function that does not jump.
  EXPECT_EQ(judged("2", "cos(2*atan2(u,x) - atan2(v,y))").verdict, Verdict::proved);
}

/// x' = 1 carries what has the density 1 to where it has the density 3.
TEST(Pieces, ADensityThatJumpsWhereTheFlowPassesIsOneBesideIt) {
  const auto where = [](const std::string& x, const std::string& density) {
    return where_in_case("measure",
                         "[phase_space]\nvariables = [\"x\",\"y\"]\n[equations]\nx = \"" + x +
                             "\"\ny = \"0\"\n[[measure]]\ndensity = \"" + density + "\"\n");
  };
  EXPECT_NE(where("1", "2+sign(x)").find("do not cross x = 0"), std::string::npos);
  EXPECT_EQ(where("1", "2+sign(y)"), "");
  EXPECT_EQ(where("1", "2+abs(y)"), "");
  EXPECT_EQ(where("x", "(2+sign(x))/x"), "");
}

TEST(Facts, IntegrabilityThatIsClaimedIsNotProvedByOtherClaims) {
  const std::string lorenz =
      "integrable = true\n[phase_space]\nvariables = [\"x\",\"y\",\"z\"]\n[equations]\n"
      "x = \"10*(y-x)\"\ny = \"28*x-y-x*z\"\nz = \"x*y-8/3*z\"\n";
  EXPECT_EQ(overall(model_of(lorenz), prove(model_of(lorenz))), Verdict::undecided);
  const std::string forced =
      "integrable = true\nhamiltonian = \"p^2/2 + q*cos(t)\"\n[phase_space]\n"
      "variables = [\"q\",\"p\"]\ncanonical = true\ntime = \"t\"\n";
  EXPECT_EQ(overall(model_of(forced), prove(model_of(forced))), Verdict::undecided);
}

TEST(Facts, CasimirFunctionsThatAreNoPolynomialsAreNotSaidToBeNone) {
  const Proof rank = proof_in_case(
      "rank",
      "hamiltonian = \"x\"\n[phase_space]\nvariables = [\"x\",\"y\",\"z\"]\nalgebra = \"so(3)\"\n"
      "[casimirs]\nC = \"exp(x^2+y^2+z^2)\"\n");
  EXPECT_NE(rank.evidence.find("0 independent polynomial Casimir functions"), std::string::npos)
      << rank.evidence;
}

}  // namespace
}  // namespace casimir::test
