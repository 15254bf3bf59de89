// Claims and facts of a phase space that constraints make a part of the space of the variables:
// what is so outside of them neither proves nor refutes anything. Each test drops a hypothesis.
#include <gtest/gtest.h>

#include <set>

#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

/// The proof of the only claim of a kind, or of the one with this name.
Proof proof_within(const std::string& kind, const std::string& text, const std::string& name = "") {
  const Model model = model_of(text);
  for (Proof& proof : prove(model)) {
    if (to_string(proof.kind) == kind && (name.empty() || proof.name == name))
      return std::move(proof);
  }
  ADD_FAILURE() << "no claim of the kind " << kind;
  return {};
}

/// The line y = 0, or the curve that is given, of a plane.
std::string on_curve(const std::string& constraint, const std::string& dx, const std::string& dy,
                     const std::string& more) {
  return "[phase_space]\nvariables = [\"x\", \"y\"]\nconstraints = [\"" + constraint +
         "\"]\n[equations]\nx = \"" + dx + "\"\ny = \"" + dy + "\"\n" + more;
}

TEST(Constraints, AnIntegralOfTheMotionOnThemIsProved) {
  const std::string integral = "[integrals]\nF = \"x\"\n";
  const Proof proved = proof_within("integral", on_curve("y", "y", "x*y", integral));
  EXPECT_EQ(proved.verdict, Verdict::proved);
  EXPECT_EQ(proved.on, (std::vector<std::string>{"y"}));
  // Outside of constraints that the motion leaves nothing is known of it.
  EXPECT_NE(proof_within("integral", on_curve("y", "y", "1 + x*y", integral)).verdict,
            Verdict::proved);
  // The witness lies on the constraints.
  const Proof refuted = proof_within("integral", on_curve("y", "1 + y", "x*y", integral));
  EXPECT_EQ(refuted.verdict, Verdict::refuted);
  ASSERT_TRUE(refuted.witness);
  EXPECT_EQ(refuted.witness->point.at(1), (std::pair<std::string, std::string>{"y", "0"}));
}

// Numerators are decided, and what is shown is about the functions.
TEST(Constraints, CofactorsHaveTheirDenominators) {
  const auto evidence = [](const char* dx, const char* dy, const char* relation) {
    return proof_within(
               "invariant_relation",
               std::string("[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"") + dx +
                   "\"\ny = \"" + dy + "\"\n[[invariant_relation]]\nname = \"a\"\n" +
                   "expression = \"" + relation + "\"\n")
        .evidence;
  };
  EXPECT_EQ(evidence("1 + x^2", "3*y", "y"), "d(a)/dt has the cofactor 3 of a");
  EXPECT_EQ(evidence("1 + x^2", "y/x", "y"), "d(a)/dt has the cofactor 1/x of a");
  EXPECT_EQ(evidence("x", "y/x", "y/x"), "d(a)/dt has the cofactor (-x + 1)/x of a");
  // A motion that comes to x = 0 may go on as another one.
  EXPECT_EQ(evidence("1 + x^2", "y/x", "y/x"), "");
  EXPECT_EQ(evidence("1 + x^2", "3*y/2", "2*y"), "d(a)/dt has the cofactor 3/2 of a");
}

TEST(Constraints, AnIdentityOnThemIsProved) {
  const auto identity = [](const char* left) {
    return proof_within(
        "identity", on_curve("y", "0", "0",
                             std::string("[[identity]]\nname = \"i\"\nleft = \"") + left + "\"\n"));
  };
  EXPECT_EQ(identity("x*y").verdict, Verdict::proved);
  EXPECT_EQ(identity("x*y + x").verdict, Verdict::refuted);
}

TEST(Constraints, ARelationThatOnlyBreaksOutsideOfThemIsProved) {
  const std::string relation = "[[invariant_relation]]\nname = \"r\"\nexpression = \"x - 1\"\n";
  EXPECT_EQ(proof_within("invariant_relation", on_curve("y", "y", "x*y", relation), "r").verdict,
            Verdict::proved);
  EXPECT_EQ(
      proof_within("invariant_relation", on_curve("y", "y + 1", "x*y", relation), "r").verdict,
      Verdict::refuted);
}

// What is about points nearby as well is not proved by its residual being zero on the constraints.
TEST(Constraints, ADensityIsNotProvedByWhatHoldsOnThem) {
  const std::string measure = "[[measure]]\ndensity = \"1\"\n";
  EXPECT_EQ(proof_within("measure", on_curve("y", "x*y", "0", measure)).verdict,
            Verdict::undecided);
  EXPECT_EQ(proof_within("measure", on_curve("y", "x", "0", measure)).verdict, Verdict::refuted);
}

std::string neumann(const std::string& more) {
  return "hamiltonian = \"(p1^2+p2^2+p3^2)/2 + (q1^2 + 2*q2^2 + 4*q3^2)/2\"\nintegrable = true\n"
         "[phase_space]\nvariables = [\"q[1..3]\",\"p[1..3]\"]\ncanonical = true\n"
         "constraints = [\"q1^2+q2^2+q3^2-1\",\"q1*p1+q2*p2+q3*p3\"]\ndirac = true\n"
         "[integrals]\n" +
         more;
}

// Uhlenbeck's integrals of Neumann's system are constant on the sphere, not around it.
TEST(Constraints, NeumannsIntegralsAreProvedOnTheSphere) {
  const std::string two =
      "K1 = \"q1^2 + (q1*p2-q2*p1)^2/(1-2) + (q1*p3-q3*p1)^2/(1-4)\"\n"
      "K2 = \"q2^2 + (q1*p2-q2*p1)^2/(2-1) + (q2*p3-q3*p2)^2/(2-4)\"\n";
  for (const char* name : {"K1", "K2"})
    EXPECT_EQ(proof_within("integral", neumann(two), name).verdict, Verdict::proved) << name;
  EXPECT_EQ(proof_within("liouville", neumann(two)).verdict, Verdict::proved);
  const Proof wrong = proof_within("integral", neumann("K = \"q1^2 + (q1*p2-q2*p1)^2\"\n"));
  EXPECT_EQ(wrong.verdict, Verdict::refuted);
}

// Functions that are equal on the constraints are not independent there.
TEST(Constraints, FunctionsAreIndependentOnThem) {
  const std::string energy =
      "E = \"(p1^2+p2^2+p3^2)/2 + (q1^2 + 2*q2^2 + 4*q3^2)/2 + (q1^2 + q2^2 + q3^2 - 1)*q1\"\n";
  EXPECT_EQ(proof_within("independence", neumann(energy)).verdict, Verdict::undecided);
  EXPECT_EQ(proof_within("independence", neumann("K = \"q1*p2\"\n")).verdict, Verdict::proved);
}

std::string on_leaf(const std::string& c, const std::string& constraint) {
  return "hamiltonian = \"x\"\nintegrable = true\n[phase_space]\nvariables = [\"x\", \"y\", "
         "\"c\"]\n"
         "brackets = { \"x,y\" = \"" +
         c + "\" }\nconstraints = [\"" + constraint + "\"]\n[casimirs]\nC = \"c\"\n";
}

// The leaves on the constraints may be smaller than almost all others.
TEST(Constraints, TheRankIsThatOnThem) {
  for (const char* kind : {"rank", "liouville"}) {
    EXPECT_EQ(proof_within(kind, on_leaf("c", "c")).verdict, Verdict::undecided) << kind;
    EXPECT_EQ(proof_within(kind, on_leaf("c", "c - 1")).verdict, Verdict::proved) << kind;
    EXPECT_EQ(proof_within(kind, on_leaf("1 + c", "c")).verdict, Verdict::proved) << kind;
  }
}

/// The proof of a kind for a bracket {x, y} = c with Casimir functions c and d.
Proof proof_on_parts(const std::string& kind, const std::string& constraint) {
  return proof_within(
      kind,
      "hamiltonian = \"(x^2 + y^2)/2\"\nintegrable = true\n[phase_space]\nvariables = [\"x\", "
      "\"y\", \"c\", \"d\"]\nbrackets = { \"x,y\" = \"c\" }\nconstraints = [" +
          constraint + "]\n[casimirs]\nC = \"c\"\nD = \"d\"\n");
}

// c*d = 0 has a part on which the bracket is zero. A point of the other one says nothing of that.
TEST(Constraints, ARankIsThatOfThePartOfThemWithThePoint) {
  const Proof parts = proof_on_parts("rank", "\"c*d\"");
  EXPECT_EQ(parts.verdict, Verdict::proved);
  ASSERT_EQ(parts.where.size(), 1u);
  EXPECT_EQ(parts.where[0].find("the state is on the part of the constraints with x = "), 0u);
  EXPECT_EQ(proof_on_parts("rank", "\"c*d\", \"x*y - 1\"").where.size(), 1u);
}

// At a = 1 all states are on (a - 1)*c = 0; for almost all a only those are where the bracket is
// zero.
TEST(Constraints, AreNotZeroByTheirParametersAlone) {
  const std::string scene =
      "[parameters]\na = {}\n[[scene]]\nname = \"default\"\nparameters = { a = \"1\" }\n"
      "initial = { x = \"1\", y = \"1\", c = \"5\" }\n";
  for (const char* kind : {"rank", "liouville"})
    EXPECT_EQ(proof_within(kind, on_leaf("c", "(a - 1)*c") + scene).verdict, Verdict::undecided)
        << kind;
}

// One irreducible equation, and parts on none of which a minor is zero.
TEST(Constraints, OfAllPartsNothingIsSaid) {
  for (const char* constraint :
       {"\"c*d - 1\"", "\"d^2\"", "\"d*(c^2 - 4)\"", "\"x^2 + y^2 - 1\", \"c^2 + d^2 - 1\"",
        "\"x^2 + y^2 + c^2 - 1\", \"x*d + y\"", "\"c^2 - 1\", \"d^2 - 1\""}) {
    const Proof proof = proof_on_parts("rank", constraint);
    EXPECT_EQ(proof.verdict, Verdict::proved) << constraint;
    EXPECT_TRUE(proof.where.empty()) << constraint << ": " << proof.where[0];
  }
}

// The real points of an irreducible set may be two: on c = 0 the bracket is zero, on c = 1 not.
TEST(Constraints, PointsThatAreNotRegularSpeakForThemselves) {
  EXPECT_EQ(proof_on_parts("rank", "\"d^2 + (c^2 - c)^2\"").where.size(), 1u);
}

// Rounded to doubles, a state lies beside the constraints, where the bracket is not zero.
TEST(Constraints, AScenesRoundedStateIsNoPointOfThem) {
  CaseFile file =
      parse_case(on_leaf("c + x - 1", "c + x - 1") +
                     "[[scene]]\nname = \"default\"\n"
                     "initial = { x = \"0.1\", y = \"1\", c = \"0.90000000000000002\" }\n",
                 "test.toml");
  for (SceneText& scene : file.scenes) scene.rounded = true;
  const Model model = build_model(file);
  ASSERT_TRUE(model.scenes.at(0).unusable.empty());
  for (const Proof& proof : prove(model)) {
    if (to_string(proof.kind) == "rank") {
      EXPECT_EQ(proof.verdict, Verdict::undecided);
    }
  }
}

// x = 0 makes x + y^2 the square of y: at y = 0, where the scene is, only its gradient looks like
// that of a constant.
TEST(Constraints, AFunctionWithACriticalPointIsNoConstant) {
  const auto independence = [](const std::string& f) {
    return proof_within("independence",
                        "hamiltonian = \"y\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n"
                        "brackets = { \"y,z\" = \"1\" }\nconstraints = [\"x\"]\n"
                        "[casimirs]\nC = \"" +
                            f +
                            "\"\n[[scene]]\nname = \"default\"\n"
                            "initial = { x = \"0\", y = \"0\", z = \"1\" }\n");
  };
  EXPECT_EQ(independence("x + y^2").verdict, Verdict::undecided);
  EXPECT_EQ(independence("x + x*y^2").verdict, Verdict::proved);
}

const std::string kWithCasimirs =
    "[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", \"p2\", \"c\", \"d\"]\n"
    "constraints = [\"c\"]\nbrackets = { \"q1,p1\" = \"1\", \"q2,p2\" = \"1\" }\n";

// On c = 0 the spectrum is p1 and 0.
TEST(Constraints, TheSpectrumOfALaxPairIsCountedOnThem) {
  const auto spectrum = [](const std::string& entry) {
    return proof_within("lax", "hamiltonian = \"(p1^2 + p2^2)/2\"\n" + kWithCasimirs +
                                   "[[lax]]\nL = [[\"p1\", \"0\"], [\"0\", \"" + entry +
                                   "\"]]\nA = [[\"0\", \"0\"], [\"0\", \"0\"]]\n")
        .spectrum;
  };
  const auto vanishing = spectrum("c*p2"), other = spectrum("(1 + c)*p2");
  ASSERT_TRUE(vanishing && other);
  EXPECT_EQ(vanishing->verdict, Verdict::undecided);
  EXPECT_EQ(other->verdict, Verdict::proved);
}

TEST(Constraints, LiouvillesCountOnALevelIsOneOnThem) {
  const auto count_on_level = [](const std::string& f) {
    const Model model =
        model_of("hamiltonian = \"p1 + d*q1*p2*q2\"\n" + kWithCasimirs +
                 "[[conditional]]\nname = \"F\"\nexpression = \"" + f + "\"\non = [\"d\"]\n");
    for (const Proof& proof : prove(model))
      if (proof.note && to_string(proof.kind) == "liouville") return proof.verdict;
    ADD_FAILURE() << "nothing is said of the level";
    return Verdict::refuted;
  };
  EXPECT_EQ(count_on_level("c*p2"), Verdict::undecided);
  EXPECT_EQ(count_on_level("(1 + c)*p2"), Verdict::proved);
}

TEST(Constraints, AMeasureOfTheSpaceNeedBeNoneOnThem) {
  const auto measure = [](const std::string& dz, const std::string& density) {
    return proof_within("measure",
                        "[phase_space]\nvariables = [\"x\", \"z\"]\nconstraints = [\"z\"]\n"
                        "[equations]\nx = \"x\"\nz = \"" +
                            dz + "\"\n[[measure]]\ndensity = \"" + density + "\"\n")
        .verdict;
  };
  EXPECT_EQ(measure("-z", "1"), Verdict::undecided);  // not refuted either: of dx/x nothing is said
  EXPECT_EQ(measure("-z", "1/x"), Verdict::undecided);
  EXPECT_EQ(measure("0", "1/x"), Verdict::proved);
  EXPECT_EQ(measure("x*z^2", "1"), Verdict::refuted);
}

// One of two constraints is the rate of the other: the volume across both is kept.
TEST(Constraints, AMeasureIsOneOnThemWhereTheirRatesHaveNoTrace) {
  const Proof proof = proof_within("measure", R"toml(
[phase_space]
variables = ["x", "y", "z"]
constraints = ["y", "z"]
[equations]
x = "1"
y = "z"
z = "0"
[[measure]]
density = "1"
)toml");
  EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
}

/// so(3) with a coordinate c that moves with nothing.
std::string so3_within(const std::string& hamiltonian, const std::string& constraint,
                       const std::string& more) {
  return "hamiltonian = \"" + hamiltonian + R"toml("
[phase_space]
variables = ["x", "y", "z", "c"]
brackets = { "x,y" = "z", "y,z" = "x", "z,x" = "y" }
constraints = [")toml" +
         constraint + "\"]\n" + more;
}

// What is not zero around the constraints may be zero, or have no value, all over them.
TEST(Constraints, ADensityIsNotZeroOnThem) {
  const auto measure = [](const std::string& density, const std::string& constraint) {
    return proof_within("measure", so3_within("x*y", constraint,
                                              "[[measure]]\ndensity = \"" + density + "\"\n"))
        .verdict;
  };
  for (const char* density : {"c", "c^2", "abs(c)", "1/c", "1/c^2"})
    EXPECT_EQ(measure(density, "c"), Verdict::undecided) << density;
  for (const char* density : {"c - 1", "1/(c - 1)", "x^2 + y^2 + z^2", "2"})
    EXPECT_EQ(measure(density, "c"), Verdict::proved) << density;
  const std::string sphere = "x^2 + y^2 + z^2 - 1";
  for (const char* density : {"x^2 + y^2 + z^2 - 1", "sqrt(x^2 + y^2 + z^2 - 2)",
                              "log(x^2 + y^2 + z^2)", "1/(x^2 + y^2 + z^2 - 1)"})
    EXPECT_EQ(measure(density, sphere), Verdict::undecided) << density;
  EXPECT_EQ(measure("sqrt(x^2 + y^2 + z^2)", sphere), Verdict::proved);
  // Without a rational point (7 is no sum of three squares), of which c is free.
  EXPECT_EQ(measure("c", "x^2 + y^2 + z^2 - 7"), Verdict::proved);
}

// A claim about functions that have a value at no point of the constraints is about nothing.
TEST(Constraints, AClaimIsAboutAPointOfThem) {
  const auto verdicts = [&](const std::string& root, const std::string& constraint) {
    std::set<Verdict> found;
    for (const char* kind : {"casimir", "integral"}) {
      const Proof proof = proof_within(
          kind, so3_within("x^2 + 2*y^2", constraint,
                           "[casimirs]\nC = \"" + root + "\"\n[integrals]\nF = \"x^2 + 2*y^2 + " +
                               root + "\"\n"));
      found.insert(proof.verdict);
      if (proof.verdict == Verdict::undecided) {
        EXPECT_NE(proof.reason.find("about nothing"), std::string::npos) << proof.reason;
      }
    }
    return found;
  };
  using Set = std::set<Verdict>;
  const std::string sphere = "x^2 + y^2 + z^2 - 1";
  EXPECT_EQ(verdicts("sqrt(x^2 + y^2 + z^2 - 2)", sphere), Set{Verdict::undecided});
  EXPECT_EQ(verdicts("log(1/2 - x^2 - y^2 - z^2)", sphere), Set{Verdict::undecided});
  EXPECT_EQ(verdicts("sqrt(x^2 + y^2 + z^2)", sphere), Set{Verdict::proved});
  // A value on a set without inner points, where it is not differentiable.
  EXPECT_EQ(verdicts("sqrt(c - (x^2 + y^2 + z^2))", "c"), Set{Verdict::undecided});
  EXPECT_EQ(verdicts("sqrt(1 - (x^2 + y^2 + z^2))", sphere), Set{Verdict::undecided});
  // No rational point.
  EXPECT_EQ(verdicts("sqrt(x^2 + y^2 + z^2)", "x^2 + y^2 + z^2 - 7"), Set{Verdict::proved});
  // An empty phase space.
  EXPECT_EQ(verdicts("x^2 + y^2 + z^2", "x^2 + y^2 + z^2 + 1"), Set{Verdict::undecided});
}

// u^2 - a^2 is a - a^2 where u^2 = a, and z (b - |x|^2) is zero on the sphere of the radius r where
// b = r^2: no minor off the constraints shows it.
TEST(Constraints, ConditionsOnParametersAreThoseOnThem) {
  const auto where = [](const std::string& kind, const std::string& text) {
    const Proof proof = proof_within(kind, text);
    EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
    return std::set<std::string>(proof.where.begin(), proof.where.end());
  };
  EXPECT_EQ(where("rank", R"toml(
hamiltonian = "x"
[phase_space]
variables = ["x", "y", "u"]
brackets = { "x,y" = "u^2 - a^2" }
constraints = ["u^2 - a"]
[parameters]
a = {}
)toml")
                .count("a - 1 != 0"),
            1U);
  // u is zero all over u^2 = a at a = 0, and not modulo the constraint.
  EXPECT_EQ(where("rank", R"toml(
hamiltonian = "x"
[phase_space]
variables = ["x", "y", "u"]
brackets = { "x,y" = "u" }
constraints = ["u^2 - a"]
[parameters]
a = {}
)toml")
                .count("a != 0"),
            1U);
  EXPECT_EQ(where("independence", R"toml(
hamiltonian = "z*(b - x^2 - y^2 - z^2)"
[phase_space]
variables = ["x", "y", "z"]
algebra = "so(3)"
constraints = ["x^2 + y^2 + z^2 - r^2"]
[casimirs]
R = "x^2 + y^2 + z^2"
[parameters]
b = {}
r = {}
)toml")
                .count("r^2 - b != 0"),
            1U);
}

// At a point where the constraint has no gradient functions may seem independent that it makes
// dependent: beside a cusp, two lines, an isolated point, and where squares vanish.
TEST(Constraints, IndependenceOnThemIsTakenAtARegularPoint) {
  const auto independence = [](const char* constraint, const char* functions) {
    return proof_within("independence",
                        "hamiltonian = \"p^2/2 + q^4\"\n[phase_space]\nvariables = [\"q\", \"p\", "
                        "\"u\", \"v\"]\nbrackets = { \"q,p\" = \"1\" }\nconstraints = [\"" +
                            std::string(constraint) + "\"]\n[casimirs]\n" + functions)
        .verdict;
  };
  const char* both = "F = \"u\"\nG = \"v\"\n";
  for (const char* constraint : {"v^2 - u^3", "u^2 - 2*v^2", "v^2 - u^2*(u - 1)", "u^2 + v^2"})
    EXPECT_NE(independence(constraint, both), Verdict::proved) << constraint;
  EXPECT_EQ(independence("v^2 - u^3", "F = \"v\"\n"), Verdict::proved);
  EXPECT_EQ(independence("v^2 - u^2 - 1", "F = \"v\"\n"), Verdict::proved);
  // Constraints that follow from others leave a regular point one, and an isolated one none.
  EXPECT_EQ(independence("v - u\", \"v^2 - u^2", "F = \"v\"\n"), Verdict::proved);
  EXPECT_NE(independence("v - u\", \"v^2 - u^2", both), Verdict::proved);
  EXPECT_EQ(independence("(v - u)*(v^2 + u^2 + 1)\", \"(v - u)*(v + u^2 + 7)", "F = \"v\"\n"),
            Verdict::proved);
  EXPECT_NE(independence("v^2 - u^3\", \"v^3 - u^3*v", both), Verdict::proved);
}

TEST(Constraints, ALaxPairOfTheMotionOnThemIsProved) {
  const std::string pair =
      "[[lax]]\nL = [[\"x\", \"0\"], [\"0\", \"1\"]]\nA = [[\"0\", \"0\"], [\"0\", \"0\"]]\n";
  const Proof proved = proof_within("lax", on_curve("y", "y", "x*y", pair));
  EXPECT_EQ(proved.verdict, Verdict::proved) << proved.reason;
  EXPECT_EQ(proved.on, std::vector<std::string>{"y"});
  EXPECT_EQ(proved.integrals.back(), "x");
  // Of constraints that the motion leaves nothing follows.
  EXPECT_NE(proof_within("lax", on_curve("y", "y", "1 + x*y", pair)).verdict, Verdict::proved);
  EXPECT_EQ(proof_within("lax", on_curve("y", "1 + y", "x*y", pair)).verdict, Verdict::refuted);
}

TEST(Constraints, AMapIsPoissonOnALevelOfCasimirFunctions) {
  const auto map = [](const std::string& space, const std::string& image) {
    return proof_within("map", "hamiltonian = \"0\"\n[phase_space]\n" + space +
                                   "[[map]]\nname = \"m\"\n"
                                   "to = { variables = [\"Q\", \"P\"], canonical = true }\n"
                                   "expressions = { Q = \"" +
                                   image + "\", P = \"y\" }\n");
  };
  const std::string leaf =
      "variables = [\"x\", \"y\", \"z\"]\nbrackets = { \"x,y\" = \"1\" }\n"
      "constraints = [\"z\"]\n";
  const Proof proved = map(leaf, "x + x*z");
  EXPECT_EQ(proved.verdict, Verdict::proved) << proved.reason;
  EXPECT_EQ(proved.on, std::vector<std::string>{"z"});
  EXPECT_EQ(map(leaf, "2*x + x*z").verdict, Verdict::refuted);
  // On another level there is no bracket.
  const std::string line = "variables = [\"x\", \"y\"]\ncanonical = true\nconstraints = [\"x\"]\n";
  EXPECT_EQ(map(line, "x + x^2").verdict, Verdict::undecided);
}

TEST(Constraints, ACandidateThatIsConstantOnThemIsSaidToBe) {
  const Model model = model_of(
      "hamiltonian = \"(x^2 + y^2)/2\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n"
      "brackets = { \"x,y\" = \"1\" }\nconstraints = [\"z\"]\n");
  const auto independence = [&](const std::string& f) {
    Candidates candidates;
    candidates.integrals = {{f, {"test", 1, 1}, f}};
    for (const Proof& proof : prove(model, candidates))
      for (const Proof& finding : proof.findings)
        if (to_string(finding.kind) == "independence") return finding;
    return Proof{};
  };
  EXPECT_EQ(independence("z*x").reason, "it is a constant on the constraints");
  EXPECT_EQ(independence("x^2 + y^2 + z").verdict, Verdict::undecided);
}

}  // namespace
}  // namespace casimir::test
