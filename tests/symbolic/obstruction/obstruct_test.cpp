// Systems of which the literature knows whether they are integrable.
#include "symbolic/obstruction/obstruct.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "symbolic/case_file.hpp"

namespace casimir::obstruction {
namespace {

/// A case in canonical variables x, y, px, py, without parameters.
Model planar(const std::string& hamiltonian, const std::string& variables = "x y px py") {
  std::string list;
  for (std::size_t begin = 0; begin < variables.size();) {
    const std::size_t end = std::min(variables.find(' ', begin), variables.size());
    list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", variables.substr(begin, end - begin));
    begin = end + 1;
  }
  return build_model(parse_case(fmt::format("title = \"A test\"\nsource = \"a test\"\n"
                                            "hamiltonian = \"{}\"\n[phase_space]\n"
                                            "variables = [{}]\ncanonical = true\n",
                                            hamiltonian, list),
                                "test.toml"));
}

/// A heavy top with its centre of mass on the first axis.
Model top(const std::string& kinetic, const std::string& weight = "g1") {
  return build_model(parse_case(
      fmt::format("title = \"A test\"\nsource = \"a test\"\nhamiltonian = \"({})/2 + {}\"\n"
                  "[phase_space]\nvariables = [\"M1\", \"M2\", \"M3\", \"g1\", \"g2\", \"g3\"]\n"
                  "algebra = \"e(3)\"\n[casimirs]\nF1 = \"g1^2 + g2^2 + g3^2\"\n"
                  "F2 = \"M1*g1 + M2*g2 + M3*g3\"\n",
                  kinetic, weight),
      "test.toml"));
}

Obstruction obstruction_of(const Model& model, const std::vector<std::string>& along = {}) {
  ObstructionRequest request;
  for (const std::string& text : along) request.along.push_back({text, {"--along", 1, 1}, {}});
  return find_obstruction(model, request);
}

bool refuted(const Model& model) { return obstruction_of(model).proved; }

TEST(Obstruct, CubicPotentials) {
  // Separable, or with an integral of degree 2 or 4 in the momenta.
  for (const char* v : {"x^3 + 5*y^3", "x^2*y/2 + y^3/6", "x^2*y/2 + y^3", "x^2*y/2 + 8*y^3/3"})
    EXPECT_FALSE(refuted(planar(fmt::format("(px^2 + py^2)/2 + {}", v)))) << v;
  // x^2 y/2 + y^3/3 passes at first order, and fails at the third.
  EXPECT_TRUE(refuted(planar("(px^2 + py^2)/2 + x^2*y/2 + y^3/3")));
  for (const char* v : {"x^2*y/2 + y^3/4", "x^2*y/2 + y^3/2", "x^3/7 + x^2*y/2 + y^3/5"})
    EXPECT_TRUE(refuted(planar(fmt::format("(px^2 + py^2)/2 + {}", v)))) << v;
}

TEST(Obstruct, AHamiltonianWithoutRealValuesIsNotJudged) {
  const std::string cubic = "(px^2 + py^2)/2 + x^2*y + y^3";
  EXPECT_TRUE(refuted(planar(cubic)));
  for (const char* lost : {"0*sqrt(x^2 + 1)", "0*log(x - 50)"})
    EXPECT_TRUE(refuted(planar(cubic + " + " + lost))) << lost;
  for (const char* lost : {"0*sqrt(-x^2 - 1)", "0*acos(2)", "0*acos(1 + y^2)", "0*log(-x^2)"}) {
    const Obstruction answer = obstruction_of(planar(cubic + " + " + lost));
    EXPECT_FALSE(answer.proved) << lost;
    EXPECT_NE(answer.reason.find("no real point"), std::string::npos) << answer.reason;
  }
}

TEST(Obstruct, TheCurveIsSaidToBeComplex) {
  // y (1 + x^2) f'(x) - py f(x) is an integral, analytic at all real points, where f solves the
  // equation along y = py = 0, whose coefficients are singular at x = I and -I alone.
  const Obstruction answer = obstruction_of(planar("(1 + x^2)*px + (py^2 + (1 + x)*y^2)/2"));
  EXPECT_TRUE(answer.proved);
  EXPECT_NE(answer.excluded.find("complex curve"), std::string::npos) << answer.excluded;
}

TEST(Obstruct, QuarticPotentials) {
  for (const char* v : {"x^4 + 3*y^4", "x^4 + 6*x^2*y^2 + y^4", "x^4 + 12*x^2*y^2 + 16*y^4",
                        "x^4 + 6*x^2*y^2 + 8*y^4", "(x^2 + y^2)^2"})
    EXPECT_FALSE(refuted(planar(fmt::format("(px^2 + py^2)/2 + {}", v)))) << v;
  for (const char* v : {"x^4 + 2*x^2*y^2 + 3*y^4", "x^2*y^2", "x^4 + x^2*y^2 + y^4"})
    EXPECT_TRUE(refuted(planar(fmt::format("(px^2 + py^2)/2 + {}", v)))) << v;
}

TEST(Obstruct, EigenvaluesOfAllPointsObeyTheirRelation) {
  const auto related = [](const char* h) {
    const Obstruction answer = obstruction_of(planar(h));
    return std::any_of(answer.examined.begin(), answer.examined.end(), [](const Examined& e) {
      return std::any_of(e.cases.begin(), e.cases.end(), [](const auto& c) {
        return c.second == "the sum of 1/(lambda - 1) is -1";
      });
    });
  };
  // Rational, conjugate, and with other masses: it is checked wherever it is said.
  for (const char* h :
       {"(px^2 + py^2)/2 + x^4 + 6*x^2*y^2 + 8*y^4", "(px^2 + py^2)/2 + x^3 + x^2*y + 7*y^3",
        "(px^2 + 3*py^2)/2 + x^5 + 2*x*y^4 - y^5", "px*py + x^4 + 5*x^3*y + y^4"})
    EXPECT_TRUE(related(h)) << h;
  // An eigenvalue 1, and an improper point.
  EXPECT_FALSE(related("(px^2 + py^2)/2 + x^2*y/2 + y^3/3"));
  EXPECT_FALSE(related("(px^2 + py^2)/2 + x^2*y^2"));
}

TEST(Obstruct, MassesCount) {
  // x = X/sqrt(2): x^4 + 6 x^2 y^2 + y^4 becomes another potential.
  EXPECT_TRUE(refuted(planar("(px^2 + 2*py^2)/2 + x^4 + 6*x^2*y^2 + y^4")));
  EXPECT_FALSE(refuted(planar("(px^2 + 2*py^2)/2 + x^4 + 3*x^2*y^2 + y^4/4")));
}

TEST(Obstruct, HenonAndHeilesFamily) {
  const auto family = [](const char* a, const char* b, const char* c) {
    return planar(fmt::format("(px^2 + py^2 + {}*x^2 + {}*y^2)/2 + x^2*y + {}*y^3/3", a, b, c));
  };
  // c = 1 with A = B, c = 6 with any, c = 16 with B = 16 A (Bountis, Segur and Vivaldi 1982).
  EXPECT_FALSE(refuted(family("1", "1", "1")));
  EXPECT_FALSE(refuted(family("1", "1", "6")));
  EXPECT_FALSE(refuted(family("3", "2", "6")));
  EXPECT_FALSE(refuted(family("1", "16", "16")));
  // n = 2 of Lame's equation: excluded by variational equations of higher order only.
  EXPECT_TRUE(refuted(family("1", "1", "2")));
  for (const char* c : {"-1", "3", "1/2", "5", "7"}) EXPECT_TRUE(refuted(family("1", "1", c))) << c;
  EXPECT_TRUE(refuted(family("1", "15", "16")));
}

TEST(Obstruct, HeavyTopWithItsCentreOfMassInTheEquatorialPlane) {
  // Ziglin's theorem: Euler and Lagrange, Kovalevskaya, Goryachev and Chaplygin. a3 = 1/4, of no
  // body, passes along both separatrices and fails on another level of the energy.
  for (const char* a3 : {"1", "2", "4"})
    EXPECT_FALSE(refuted(top(fmt::format("M1^2 + M2^2 + {}*M3^2", a3)))) << a3;
  for (const char* a3 : {"3", "1/2", "3/2", "5", "9", "1/9", "9/4", "1/4"})
    EXPECT_TRUE(refuted(top(fmt::format("M1^2 + M2^2 + {}*M3^2", a3)))) << a3;
  EXPECT_FALSE(refuted(top("2*M1^2 + 3*M2^2 + 3*M3^2")));
  // On the separatrix it is Riemann's P equation with sqrt(a3), 1/2, sqrt(8 a3 - 7)/2.
  const Obstruction answer = obstruction_of(top("M1^2 + M2^2 + 3*M3^2"));
  ASSERT_TRUE(answer.proved);
  EXPECT_EQ(answer.examined.back().exponents,
            (std::vector<std::string>{"g1 = 1: difference of exponents sqrt(3)",
                                      "g1 = -1: difference of exponents 1/2",
                                      "g1 = infinity: difference of exponents sqrt(17/4)"}));
}

TEST(Obstruct, SwingingAtwoodsMachine) {
  const auto machine = [](const std::string& mu) {
    return planar(fmt::format("pr^2/(2*({0} + 1)) + pt^2/(2*r^2) + r*({0} - cos(t))", mu),
                  "r t pr pt");
  };
  // mu = p(p + 1)/(p(p + 1) - 4) pass at first order; mu = 3 is integrable.
  for (const char* mu : {"3", "3/2", "5/4"}) EXPECT_FALSE(refuted(machine(mu))) << mu;
  for (const char* mu : {"2", "4", "5/3", "15"}) EXPECT_TRUE(refuted(machine(mu))) << mu;
}

TEST(Obstruct, AnisotropicKeplerProblem) {
  const auto kepler = [](const char* a) {
    return planar(fmt::format("(px^2 + {}*py^2)/2 - 1/sqrt(x^2 + y^2)", a));
  };
  EXPECT_FALSE(refuted(kepler("1")));
  for (const char* a : {"2", "3", "1/3"}) EXPECT_TRUE(refuted(kepler(a))) << a;
}

TEST(Obstruct, OneDegreeOfFreedomHasNoFurtherIntegralToExclude) {
  EXPECT_FALSE(refuted(planar("p^2/2 + q^7 + q", "q p")));
}

TEST(Obstruct, SeparableSystemsAreNeverRefuted) {
  for (const char* h :
       {"(px^2 + py^2)/2 + x^6 + x^3 + y^8 + y", "(px^2 + py^2)/2 + (x - y)^4 + (x + y)^6",
        "(px^2 + 3*py^2)/2 + x^2 + 7*y^2", "(px^2 + py^2)/2 + (x^2 + y^2)^3",
        "(px^2 + py^2 + (x^2 + y^2)^2)/(2*(x^2 + y^2 + 1))", "px*py + x^3*y"})
    EXPECT_FALSE(refuted(planar(h))) << h;
}

TEST(Obstruct, ASurfaceMayBeGiven) {
  const Model model = planar("(px^2 + py^2 + x^2 + y^2)/2 + x^2*y - y^3/3");
  const Obstruction answer = obstruction_of(model, {"x = 0"});
  ASSERT_TRUE(answer.proved);
  EXPECT_EQ(answer.examined.back().along, "x = 0, px = 0");
  EXPECT_NE(answer.excluded.find("functionally independent of H"), std::string::npos);
  EXPECT_FALSE(obstruction_of(model, {"y = 1"}).proved);
  EXPECT_THROW(obstruction_of(model, {"w = 0"}), CaseError);
}

TEST(Obstruct, InvariantRelationsOfTheCaseAreSurfaces) {
  // Henon and Heiles with c = -2, turned: no coordinate plane is invariant.
  const auto turned = [](const char* relation) {
    return build_model(parse_case(
        fmt::format(
            "title = \"A test\"\nsource = \"a test\"\nhamiltonian = \"(px^2 + py^2 + x^2 + "
            "y^2)/2 + (3*x + 4*y)^2*(4*x - 3*y)/125 - 2*(4*x - 3*y)^3/375\"\n[phase_space]\n"
            "variables = [\"x\", \"y\", \"px\", \"py\"]\ncanonical = true\n{}",
            relation),
        "test.toml"));
  };
  EXPECT_FALSE(refuted(turned("")));
  const Obstruction answer =
      obstruction_of(turned("[[invariant_relation]]\nname = \"a\"\nexpression = \"3*x + 4*y\"\n"));
  ASSERT_TRUE(answer.proved);
  EXPECT_EQ(answer.examined.back().along, "x = -4/3*y, px = -4/3*py");
  // What is claimed is checked.
  EXPECT_FALSE(
      refuted(turned("[[invariant_relation]]\nname = \"a\"\nexpression = \"3*x + 5*y\"\n")));
}

/// (x + y + px)^2, multiplied out: GiNaC sees that it is zero only when it divides.
TEST(Obstruct, ASurfaceOnWhichTheEquationsHaveNoValueIsLeftOut) {
  const Model model = planar("(px^2 + py^2)/2 + 1/(x^2 + y^2 + px^2 + 2*x*y + 2*x*px + 2*y*px)");
  EXPECT_FALSE(obstruction_of(model, {"x + y + px = 0"}).proved);
}

TEST(Obstruct, AnIrregularPointExcludesRationalIntegralsOnly) {
  // z = y = exp-like motion: y'' = y along x = 0, and x'' = -(1 + y) x has an irregular point.
  const Obstruction answer =
      obstruction_of(planar("(px^2 + py^2)/2 - y^2/2 + x^2*(y^3 + 1)/2"), {"x = 0"});
  EXPECT_FALSE(answer.proved);
  ASSERT_TRUE(answer.rational);
  EXPECT_FALSE(answer.examined[*answer.rational].regular);
  EXPECT_NE(answer.reason.find("no further rational integral: proved"), std::string::npos);
  EXPECT_NE(answer.excluded.find("rational in the variables"), std::string::npos);
}

/// y Ai'(x) - py Ai(x) is an integral, an entire one.
TEST(Obstruct, AirysEquationDoesNotExcludeMeromorphicIntegrals) {
  EXPECT_FALSE(refuted(planar("px + (py^2 + x*y^2)/2")));
}

TEST(Obstruct, CasimirFunctionsHaveToBeAllOnes) {
  // Without (M, g) the level is no symplectic leaf, and its normal equations are not those of one.
  const Model model = build_model(parse_case(
      "title = \"A test\"\nsource = \"a test\"\nhamiltonian = \"(M1^2 + M2^2 + 3*M3^2)/2 + g1\"\n"
      "[phase_space]\nvariables = [\"M1\", \"M2\", \"M3\", \"g1\", \"g2\", \"g3\"]\n"
      "algebra = \"e(3)\"\n[casimirs]\nF1 = \"g1^2 + g2^2 + g3^2\"\n",
      "test.toml"));
  const Obstruction answer = obstruction_of(model);
  EXPECT_FALSE(answer.proved);
  EXPECT_TRUE(std::any_of(answer.left_out.begin(), answer.left_out.end(), [](const auto& line) {
    return line.find("do not give the leaves") != std::string::npos;
  }));
}

TEST(Obstruct, SaysThatCasimirFunctionsAreMissing) {
  const auto of = [](const std::string& casimirs) {
    return obstruction_of(build_model(parse_case(
        "title = \"A test\"\nsource = \"a test\"\nhamiltonian = \"(M1^2 + 2*M2^2 + 4*M3^2)/2 + "
        "(3*p1^2 + p2^2 + 7*p3^2)/2\"\n[phase_space]\nvariables = [\"M1\", \"M2\", \"M3\", \"p1\", "
        "\"p2\", \"p3\"]\nalgebra = \"so(4)\"\n" +
            casimirs,
        "test.toml")));
  };
  const Obstruction without = of("");
  EXPECT_NE(without.reason.find("of its 2 Casimir functions the case names 0"), std::string::npos)
      << without.reason;
  const Obstruction with =
      of("[casimirs]\nF1 = \"M1^2 + M2^2 + M3^2 + p1^2 + p2^2 + p3^2\"\nF2 = \"M1*p1 + M2*p2 + "
         "M3*p3\"\n");
  EXPECT_TRUE(with.proved) << with.reason;
}

/// Of a case that ought to be left alone, whether a line of what was left out says so.
bool leaves_out(const Obstruction& answer, const std::string& words) {
  return !answer.proved &&
         (answer.reason.find(words) != std::string::npos ||
          std::any_of(answer.left_out.begin(), answer.left_out.end(),
                      [&](const auto& line) { return line.find(words) != std::string::npos; }));
}

TEST(Obstruct, WhatIsCalledACasimirFunctionHasToBeOne) {
  const Model model = build_model(parse_case(
      "title = \"A test\"\nsource = \"a test\"\nhamiltonian = \"(M1^2 + M2^2 + 3*M3^2)/2 + g1\"\n"
      "[phase_space]\nvariables = [\"M1\", \"M2\", \"M3\", \"g1\", \"g2\", \"g3\"]\n"
      "algebra = \"e(3)\"\n[casimirs]\nF1 = \"g1^2 + g2^2 + g3^2\"\n"
      "F2 = \"M1*g1 + 2*M2*g2 + M3*g3\"\n",
      "test.toml"));
  EXPECT_TRUE(leaves_out(obstruction_of(model), "is no Casimir function"));
}

TEST(Obstruct, TheBracketHasToObeyTheJacobiIdentity) {
  const auto with_bracket = [](const char* bracket) {
    return build_model(
        parse_case(fmt::format("title = \"A test\"\nsource = \"a test\"\n"
                               "hamiltonian = \"(px^2 + py^2 + x^2 + y^2)/2 + x^2*y - y^3/3\"\n"
                               "[phase_space]\nvariables = [\"x\", \"y\", \"px\", \"py\"]\n"
                               "[phase_space.brackets]\n\"x,px\" = \"1\"\n\"y,py\" = \"{}\"\n",
                               bracket),
                   "test.toml"));
  };
  EXPECT_TRUE(refuted(with_bracket("1")));
  EXPECT_TRUE(leaves_out(obstruction_of(with_bracket("1 + x^2")), "Jacobi"));
}

TEST(Obstruct, SystemsWithoutAHamiltonianAreLeftAlone) {
  const Model model = build_model(parse_case(
      "title = \"A test\"\nsource = \"a test\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n"
      "[equations]\nx = \"y\"\ny = \"-x^3\"\n",
      "test.toml"));
  EXPECT_TRUE(leaves_out(obstruction_of(model), "no Hamiltonian"));
}

TEST(Obstruct, NoBundledCaseThatIsIntegrableIsRefuted) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CASIMIR_SOURCE_DIR "/cases")) {
    if (entry.path().extension() != ".toml") continue;
    const CaseFile file = read_case(entry.path());
    // Those of nine and more variables have too many surfaces for a test.
    if (!file.integrable) continue;
    const Model model = build_model(file);
    if (model.variables.size() > 8) continue;
    EXPECT_FALSE(refuted(model)) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 40u);
}

Model written(const std::string& text) { return build_model(parse_case(text, "test.toml")); }

/// Henon and Heiles' system with c = 2, which is integrable, on the level s = 0 of a Casimir
/// function; on the level s = 1 it has c = 3 and is not.
TEST(Obstruct, ACurveOutsideOfTheConstraintsSaysNothing) {
  const std::string begin =
      "title = \"t\"\nhamiltonian = \"(px^2 + py^2)/2 + x*y^2 + (2 + s)*x^3\"\n[phase_space]\n"
      "variables = [\"x\", \"y\", \"px\", \"py\", \"s\"]\n"
      "brackets = { \"x,px\" = \"1\", \"y,py\" = \"1\" }\n";
  const std::string end = "[casimirs]\ns = \"s\"\n";
  EXPECT_FALSE(refuted(written(begin + "constraints = [\"s\"]\n" + end)));
  EXPECT_TRUE(refuted(written(begin + "constraints = [\"s - 1\"]\n" + end)));
  EXPECT_TRUE(refuted(written(begin + end)));
}

TEST(Obstruct, ADiracBracketHasTheLevelOfItsConstraints) {
  const auto in_plane = [](const std::string& factor) {
    return written(
        "title = \"t\"\nhamiltonian = \"(px^2 + py^2 + pz^2)/2 + x*y^2 + (" + factor +
        ")*x^3\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\", \"px\", \"py\", \"pz\"]\n"
        "canonical = true\nconstraints = [\"z\", \"pz\"]\ndirac = true\n");
  };
  EXPECT_FALSE(refuted(in_plane("2 + z")));
  EXPECT_TRUE(refuted(in_plane("3 + z")));
}

/// Constraints that are no Casimir functions: integrals may be there on them alone.
TEST(Obstruct, IsAboutLeavesOfTheBracket) {
  const Model model = written(
      "title = \"t\"\nhamiltonian = \"(px^2 + py^2 + pz^2)/2 + x*y^2 + 3*x^3\"\n[phase_space]\n"
      "variables = [\"x\", \"y\", \"z\", \"px\", \"py\", \"pz\"]\ncanonical = true\n"
      "constraints = [\"pz\"]\n");
  EXPECT_FALSE(refuted(model));
}

/// On x < 0 this is the integrable system with c = 2, on x > 0 that with c = 1.
TEST(Obstruct, ARootHasTheBranchOfTheDomain) {
  const auto on = [](const std::string& domain) {
    return written(
        "title = \"t\"\nhamiltonian = \"(px^2 + py^2)/2 + x*y^2 + 3/2*x^3 - "
        "1/2*x^2*sqrt(x^2)\"\n[phase_space]\nvariables = [\"x\", \"y\", \"px\", \"py\"]\n"
        "canonical = true\ndomain = [\"" +
        domain + "\"]\n");
  };
  EXPECT_FALSE(refuted(on("x < 0")));
  EXPECT_TRUE(refuted(on("x > 0")));
  EXPECT_FALSE(refuted(on("x^2 > 4"))) << "on x < -2 it is another function";
  EXPECT_FALSE(refuted(on("y > 0"))) << "nothing is known of points of the surface y = 0";
}

/// |1 + u^2|/(1 + u^2) is 1: two oscillators. On the complex curve of an energy u^2 is 2*E - 2*z^4,
/// less than -1 for large z, where another branch would be taken.
TEST(Obstruct, ARootOfAVelocityHasNoBranchOfLargePlaces) {
  for (const char* one : {"(px^2+py^2)/2 + x^4 + y^2 + 2*x^2*y^2*(abs(1+px^2)/(1+px^2) - 1)",
                          "(px^2+py^2)/2 + x^4 + 2*y^2*(abs(1+px^2) - px^2)",
                          "(px^2+py^2)/2 + x^4 + 2*y^2*(sqrt((1+px^2)^2) - px^2)"})
    EXPECT_FALSE(refuted(planar(one))) << one;
}

/// On |x| < 1, where its motions of energy 1 are, it is separable.
TEST(Obstruct, ARootThatIsAnotherFunctionBesideASurfaceHasNoBranch) {
  EXPECT_FALSE(refuted(planar("(px^2+py^2)/2 + x^4 + 2*y^2*abs(1-x^2) + 2*x^2*y^2")));
  EXPECT_FALSE(
      refuted(planar("(px^2+py^2)/2 + x^4 + 2*y^2*sqrt((1-x^2)^2) + 2*x^2*y^2 + 0*asin(x)")));
}

}  // namespace
}  // namespace casimir::obstruction
