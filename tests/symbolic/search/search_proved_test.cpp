// "No other" is said where it is proved: each of these was once said falsely, or would be if one
// hypothesis of the theorem were not checked.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "symbolic/search/conditions/real_ideal.hpp"
#include "symbolic/search/darboux.hpp"
#include "symbolic/search/search.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/search/search_cases.hpp"

namespace casimir::test {
namespace {

std::string canonical(const std::string& hamiltonian, const std::string& parameters = {}) {
  return "hamiltonian = \"" + hamiltonian +
         "\"\n[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", \"p2\"]\ncanonical = true\n"
         "[parameters]\n" +
         parameters;
}

/// dx/dt = 1, dy/dt = rate, with the parameter n.
std::string along_x(const std::string& rate) {
  return "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\nn = {}\n[equations]\nx = \"1\"\n"
         "y = \"" +
         rate + "\"\n";
}

std::string bracket(const std::string& hamiltonian, const std::string& d) {
  return "hamiltonian = \"" + hamiltonian +
         "\"\n[phase_space]\nvariables = [\"a\", \"b\", \"c\", \"e\"]\n[phase_space.brackets]\n"
         "\"a,e\" = \"a\"\n\"b,e\" = \"" +
         d + "\"\n\"c,e\" = \"c\"\n[parameters]\nd = {}\n";
}

std::set<std::string> places_of(const search::ConditionReport& report) {
  std::set<std::string> result;
  for (const search::Condition& condition : report.conditions) {
    std::set<std::string> parts;
    for (const auto& [name, value] : condition.parameters) parts.insert(name + " = " + value);
    std::string line;
    for (const std::string& part : parts) line += (line.empty() ? "" : ", ") + part;
    result.insert(line);
  }
  return result;
}

search::ConditionReport conditions(const std::string& toml, int degree,
                                   const std::vector<std::string>& free) {
  std::vector<Text> names;
  for (const std::string& name : free) names.push_back(text(name));
  return search::find_conditions(model_of(toml), up_to(degree), names);
}

/// The values are found, and nothing is said of others.
void expect_found_and_open(const std::string& toml, int degree, const std::string& free,
                           const std::vector<std::string>& wanted) {
  const auto report = conditions(toml, degree, {free});
  EXPECT_FALSE(report.complete) << toml;
  EXPECT_FALSE(report.reason.empty());
  for (const std::string& place : wanted) EXPECT_TRUE(places_of(report).contains(place)) << place;
}

TEST(Proved, AParameterInAnExponentHasSpecialValuesThatNoMinorSees) {
  expect_found_and_open(canonical("(p1^2 + p2^2)/2 + (q1^2 + q2^2)^n", "n = {}\n"), 2, "n",
                        {"n = 1"});
  expect_found_and_open(canonical("(p1^2 + p2^2)/2 + (q1^2 + 4*q2^2)^n", "n = {}\n"), 2, "n",
                        {"n = 1"});
}

TEST(Proved, AParameterInsideAFunctionToo) {
  expect_found_and_open(along_x("exp(n*x) - exp(2*x)"), 1, "n", {"n = 2"});
  expect_found_and_open(along_x("cos(n*x) - cos(2*x)"), 1, "n", {"n = 2", "n = -2"});
  expect_found_and_open(along_x("exp(n*x) - exp(7*x/3)"), 1, "n", {"n = 7/3"});
  expect_found_and_open(along_x("sqrt(x^2 + n) - sqrt(x^2 + 4)"), 1, "n", {"n = 4"});
}

TEST(Proved, WhatIsFoundIsNotConstant) {
  const auto report = conditions(along_x("atan(n*x) - atan(x)"), 1, {"n"});
  EXPECT_FALSE(report.complete);
  EXPECT_EQ(places_of(report), (std::set<std::string>{"n = 1"}));
  for (const search::Condition& condition : report.conditions)
    for (const search::Found& found : condition.found) EXPECT_EQ(found.text, "y");
  // asin + acos is Pi/2, which the ring knows: what is left is a constant flow.
  const Model model = model_of(along_x("asin(x/3) + acos(x/3) + n"));
  const search::Report constant = search::find_integrals(model, up_to(1));
  for (const search::Found& found : constant.found)
    EXPECT_NE(found.text.find('y'), std::string::npos);
  EXPECT_TRUE(constant.complete) << constant.reason;
}

TEST(Proved, NewCasimirFunctionsAreAdditional) {
  const auto report = conditions(bracket("a + e", "d*b"), 2, {"d"});
  EXPECT_TRUE(places_of(report).contains("d = -1"));
  const auto powers = conditions(bracket("a*b + e", "d*b"), 4, {"d"});
  bool seen = false;
  for (const search::Condition& condition : powers.conditions) {
    if (condition.parameters[0].second != "-1") continue;
    seen = true;
    // Of H - a*b all powers are integrals, and e is the one to name.
    for (const search::Found& found : condition.found)
      EXPECT_EQ(found.text.find("e^"), std::string::npos) << found.text;
  }
  EXPECT_TRUE(seen);
}

TEST(Proved, TheRattlebackAsABracketHasTheValuesThatItHasAsEquations) {
  const std::string equations =
      "[phase_space]\nvariables = [\"P\", \"R\", \"S\"]\n[parameters]\nlam = {}\n[equations]\n"
      "P = \"lam*P*S\"\nR = \"-R*S\"\nS = \"R^2 - lam*P^2\"\n";
  const std::string with_bracket =
      "hamiltonian = \"(a*P^2 + b*R^2 + c*S^2)/2\"\n[phase_space]\n"
      "variables = [\"P\", \"R\", \"S\"]\n[parameters]\nlam = {}\na = {}\nb = {}\nc = {}\n"
      "[phase_space.structure_constants]\n\"P,S\" = \"lam*P\"\n\"R,S\" = \"-R\"\n";
  for (const std::string& toml : {equations, with_bracket}) {
    const std::set<std::string> places = places_of(conditions(toml, 3, {"lam"}));
    for (const char* value : {"lam = 1", "lam = 2", "lam = 1/2"})
      EXPECT_TRUE(places.contains(value)) << value;
  }
}

TEST(Proved, SetsOfTwoConditionsAreFoundOrLeftOpen) {
  const std::string henon = canonical("(p1^2 + p2^2)/2 + (A*q1^2 + B*q2^2)/2 + q1^2*q2 + d*q2^3/3",
                                      "A = {}\nB = {}\nd = {}\n");
  const auto report = conditions(henon, 3, {"A", "B", "d"});
  EXPECT_FALSE(report.complete);
  EXPECT_FALSE(report.reason.empty());
  EXPECT_TRUE(places_of(report).contains("A = B, d = 1") ||
              places_of(report).contains("B = A, d = 1"));
  // Lagrange's top: two moments equal and the centre of mass on the third axis.
  const auto top = conditions(euler_poisson("(a1*M1^2 + M2^2 + a3*M3^2)/2 + r1*g1 + r2*g2 + r3*g3",
                                            "a1 = {}\na3 = {}\nr1 = {}\nr2 = {}\nr3 = {}\n"),
                              1, {"a1", "r1", "r2"});
  EXPECT_FALSE(top.complete);
  EXPECT_TRUE(places_of(top).contains("a1 = 1, r1 = 0, r2 = 0"));
}

TEST(Proved, AFactorWithoutRealRootsIsNoValueAndAnIrrationalRootIsConfirmedOrLeftOpen) {
  const auto system = [](const std::string& factor) {
    return "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\nn = {}\n[equations]\nx = "
           "\"1\"\n"
           "y = \"(" +
           factor + ")*x*y + y^2 + 1\"\n";
  };
  const auto none = conditions(system("n^2 + 1"), 2, {"n"});
  EXPECT_TRUE(none.complete) << none.reason;
  // With dy/dt = (n^2 - 2)*y^2 + .. there is an integral where the factor vanishes.
  const auto real = conditions(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\nn = {}\n[equations]\nx = \"1\"\n"
      "y = \"(n^2 - 2)*(y^2 + x)\"\n",
      2, {"n"});
  EXPECT_TRUE(real.complete) << real.reason;
  EXPECT_EQ(places_of(real), (std::set<std::string>{"n = sqrt(2)", "n = -sqrt(2)"}));
  const auto cubic = conditions(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\nn = {}\n[equations]\nx = \"1\"\n"
      "y = \"(n^3 - 2)*(y^2 + x)\"\n",
      2, {"n"});
  EXPECT_FALSE(cubic.complete);
  const auto imaginary = conditions(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\nn = {}\n[equations]\nx = \"1\"\n"
      "y = \"(n^2 + 2)*(y^2 + x)\"\n",
      2, {"n"});
  EXPECT_TRUE(imaginary.complete) << imaginary.reason;
  EXPECT_TRUE(imaginary.conditions.empty());
}

TEST(Proved, ANegativeDegreeIsRefused) {
  const Model model = model_of(along_x("n*x"));
  EXPECT_THROW(search::find_integrals(model, up_to(-1)), ModelError);
  EXPECT_THROW(conditions(along_x("n*x"), -1, {"n"}), ModelError);
}

/// Equations that are real at one value of a alone: an oscillator.
std::string real_at_zero_alone(const std::string& rest) {
  return "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\na = {}\n[equations]\nx = \"y\"\n"
         "y = \"-x + a*x^2*y" +
         rest + "\"\n";
}

TEST(Proved, NothingIsSaidOfGenericValuesWhereThereAreNone) {
  EXPECT_TRUE(search::find_integrals(model_of(real_at_zero_alone("")), up_to(2)).complete);
  EXPECT_TRUE(search::find_darboux(model_of(real_at_zero_alone("")), 1).complete);
  for (const char* rest : {" + 0*acos(1 + a^2)", " + acos(1 + a^2)*x", " + 0*sqrt(-a^2)*y"}) {
    const Model model = model_of(real_at_zero_alone(rest));
    const search::Report report = search::find_integrals(model, up_to(2));
    EXPECT_FALSE(report.complete) << rest;
    EXPECT_NE(report.reason.find("special values"), std::string::npos) << report.reason;
    EXPECT_FALSE(search::find_darboux(model, 1).complete) << rest;
  }
}

TEST(Proved, FunctionsThatAreRealFarFromZeroOrCloseToItAloneHideNothing) {
  for (const char* rest : {" + 0*log(x - 3000)", " + 0*sqrt(1/1000000 - (x - 17/1000)^2)"})
    EXPECT_TRUE(search::find_integrals(model_of(real_at_zero_alone(rest)), up_to(2)).complete)
        << rest;
}

/// dx/dt = a*x, dy/dt = b*y, with these assumptions: x^m*y^n is an integral where m*a + n*b = 0.
std::string resonance(const std::string& a, const std::string& b) {
  return "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\n" + a + "\n" + b +
         "\n[equations]\nx = \"a*x\"\ny = \"b*y\"\n";
}

TEST(Proved, ValuesAgainstTheAssumptionsAreNone) {
  const std::string a = "a = { assume = \"a > 0\" }", b = "b = { assume = \"b > 0\" }";
  const auto none = conditions(resonance(a, b), 3, {"a", "b"});
  EXPECT_TRUE(none.complete) << none.reason;
  EXPECT_TRUE(none.conditions.empty());
  const auto product =
      conditions(resonance("a = {}", "b = { assume = \"a*b > 0\" }"), 2, {"a", "b"});
  EXPECT_FALSE(places_of(product).contains("b = -a"));
  // Without one of them, with the other sign, or with >= they are some.
  for (const char* other :
       {"b = {}", "b = { assume = \"b < 0\" }", "b = { assume = \"a*b < 0\" }"}) {
    const auto some = conditions(resonance(a, other), 2, {"b"});
    EXPECT_TRUE(some.complete) << some.reason;
    EXPECT_EQ(places_of(some).count("b = -a"), 1) << other;
  }
  const auto edge =
      conditions(resonance("a = { assume = \"a >= 0\" }", "b = { assume = \"b >= 0\" }"), 2, {"b"});
  EXPECT_TRUE(places_of(edge).contains("b = 0"));
}

TEST(Proved, NorAreIrrationalOnesAgainstThem) {
  const auto report = conditions(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\nn = { assume = \"n < 0\" }\n"
      "[equations]\nx = \"1\"\ny = \"(n^2 - 2)*(y^2 + x)\"\n",
      2, {"n"});
  EXPECT_TRUE(report.complete) << report.reason;
  EXPECT_EQ(places_of(report), (std::set<std::string>{"n = -sqrt(2)"}));
}

TEST(Proved, WhatIsThereForAllValuesIsNotAdditionalAtOne) {
  // At a = 1/2 the generic integral is 7*y/2 + exp(7*x)/2 - 7*exp(x/2), which exp(7*x) hides.
  search::Request request = up_to(1);
  request.functions = {text("exp(7*x)")};
  const auto report =
      search::find_conditions(model_of(along_x("exp(n*x) - exp(7*x)")), request, {text("n")});
  EXPECT_EQ(places_of(report), (std::set<std::string>{"n = 0"}));
}

search::Report on_level(const std::string& toml, int degree, const std::vector<std::string>& on) {
  search::Request request = up_to(degree);
  for (const std::string& f : on) request.on.push_back(text(f));
  return search::find_integrals(model_of(toml), request);
}

TEST(Proved, OnALevelOnlyWhereItsFunctionsGenerateARealIdeal) {
  const std::string toml = canonical("(p1^2 + p2^2)/2 + q1^2*q2");
  for (const char* level : {"q1^2 + p1^2", "2*q1^2 + 3*p1^2", "q1^2 + p1^4"})
    EXPECT_FALSE(on_level(toml, 1, {level}).complete) << level;
  const search::Report graph = on_level(toml, 1, {"q1", "p1"});
  EXPECT_TRUE(graph.complete) << graph.reason;
  EXPECT_EQ(graph.found.size(), 1U);
  // A cone over a point, and a sphere, which is real.
  EXPECT_FALSE(
      on_level(euler_poisson("(M1^2 + M2^2 + 2*M3^2)/2 - g1"), 2, {"g1^2 + g2^2 + g3^2"}).complete);
  const search::Report sphere =
      on_level(euler_poisson("(M1^2 + M2^2 + 2*M3^2)/2 - g1"), 2, {"g1^2 + g2^2 + g3^2 - 1"});
  EXPECT_TRUE(sphere.complete) << sphere.reason;
}

TEST(Proved, AnIdealIsRealAndPrimeOnlyByARuleWhoseHypothesesHold) {
  const PolynomialRing ring(5);
  const std::vector<std::size_t> variables{0, 1, 2, 3};  // the last is a parameter
  const Polynomial x = ring.variable(0), y = ring.variable(1), z = ring.variable(2),
                   w = ring.variable(3), c = ring.variable(4), one = ring.constant(1);
  const auto shown = [&](std::vector<Polynomial> list) {
    return search::is_shown_real_and_prime(std::move(list), variables);
  };
  // Graphs, also one after the other, and with a parameter before the variable.
  EXPECT_TRUE(shown({x, y - x * x}));
  EXPECT_TRUE(shown({c * x - y * z}));
  // Linear in a variable, and a cone; a sphere.
  EXPECT_TRUE(shown({x * y - z * z}));
  EXPECT_TRUE(shown({x * x - y * y * y}));
  EXPECT_TRUE(shown({x * x + y * y + z * z - one}));
  // A bundle of lines over the sphere.
  EXPECT_TRUE(shown({x * x + y * y - one, x * z + y * w}));
  // Without a smooth real point, or without a real point, or with unknown signs of a parameter.
  EXPECT_FALSE(shown({x * x + y * y}));
  EXPECT_FALSE(shown({x * x + y * y + z * z}));
  EXPECT_FALSE(shown({x * x + one}));
  EXPECT_FALSE(shown({x * x + y * y - c}));
  EXPECT_FALSE(shown({one}));
  // Reducible over Q, or over R: of x^3 = 2*y^3 only one factor has more than one real point.
  EXPECT_FALSE(shown({x * y}));
  EXPECT_FALSE(shown({x * x}));
  EXPECT_FALSE(shown({x * x * x - (y * y * y).scaled(2)}));
  // Over a cone the coefficients x, y vanish at the vertex: the line over it is a component.
  EXPECT_FALSE(shown({x * y, x * z + y * w}));
  // After the graph is put in, the second one is a sum of squares.
  EXPECT_FALSE(shown({x - y, x * y + z * z}));
}

TEST(Proved, NotWhereTheFunctionsMayObeyRelations) {
  const auto report = [](const std::string& hamiltonian) {
    return search::find_integrals(model_of(canonical(hamiltonian)), up_to(2));
  };
  EXPECT_FALSE(report("(p1^2 + p2^2)/2 + sin(atan2(q2, q1)/2)").complete);
  EXPECT_FALSE(report("(p1^2 + p2^2)/2 + cos(atan(q1)/2)").complete);
  // This is q1.
  EXPECT_TRUE(
      report("(p1^2 + p2^2)/2 + sqrt(q1^2 + q2^2)*(2*cos(atan2(q2, q1)/2)^2 - 1)").complete);
  // 4 cos(v)^3 - 3 cos(v) = q1 for v = acos(q1)/3.
  EXPECT_FALSE(report("(p1^2 + p2^2)/2 + cos(acos(q1)/3)").complete);
  EXPECT_FALSE(report("(p1^2 + p2^2)/2 + sqrt(q1 + sqrt(q1^2 + 1))").complete);
  // sqrt(q1 + sqrt(q1^2 - 1)) is (sqrt(q1 + 1) + sqrt(q1 - 1))/sqrt(2), and sqrt(q1) is a square.
  EXPECT_TRUE(
      report("(p1^2 + p2^2)/2 + sqrt(q1 + sqrt(q1^2 - 1)) + sqrt(q1 + 1) + sqrt(q1 - 1)").complete);
  EXPECT_FALSE(report("(p1^2 + p2^2)/2 + exp(q1/(q1 + 1)) + exp(1/(q1 + 1))").complete);
  EXPECT_TRUE(report("(p1^2 + p2^2)/2 + sqrt(q1) + q1^(1/4)").complete);
  // Where they do not, it is said.
  for (const char* hamiltonian :
       {"(p1^2 + p2^2)/2 + 1/sqrt(q1^2 + q2^2)", "(p1^2 + p2^2)/2 + cos(q1) + cos(q1 - q2)",
        "(p1^2 + p2^2)/2 + exp(q1 - q2) + exp(q2)", "(p1^2 + p2^2)/2 + log(q1^2 + 3*q2^2)"}) {
    const search::Report plain = report(hamiltonian);
    EXPECT_TRUE(plain.complete) << hamiltonian << ": " << plain.reason;
  }
}

search::Report with_functions(const std::string& toml, int degree,
                              const std::vector<std::string>& functions) {
  search::Request request = up_to(degree);
  for (const std::string& f : functions) request.functions.push_back(text(f));
  const Model model = model_of(toml);
  search::Report report = search::find_integrals(model, request);
  for (const search::Found& found : report.found)
    EXPECT_EQ(found.verdict, Verdict::proved) << found.text;
  return report;
}

bool has(const search::Report& report, const std::string& toml, const std::string& wanted) {
  const Model model = model_of(toml);
  const GiNaC::ex e = model.parse(text(wanted));
  return std::any_of(report.found.begin(), report.found.end(), [&](const search::Found& found) {
    const GiNaC::ex own = model.parse(text(found.text));
    return (own - e).expand().is_zero() || (own + e).expand().is_zero();
  });
}

TEST(Proved, ADeclaredFunctionItselfIsTheUnknown) {
  const std::string decay =
      "[phase_space]\nvariables = [\"x\", \"y\"]\ntime = \"t\"\n[equations]\nx = \"-4*x\"\n"
      "y = \"x\"\n";
  const search::Report four = with_functions(decay, 2, {"exp(4*t)"});
  EXPECT_TRUE(has(four, decay, "x*exp(4*t)"));
  EXPECT_TRUE(four.complete) << four.reason;
  const std::string cube =
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"1\"\ny = \"-2/(3*x)*y\"\n";
  const search::Report two = with_functions(cube, 2, {"x^(2/3)"});
  EXPECT_TRUE(has(two, cube, "y*x^(2/3)"));
  EXPECT_TRUE(has(with_functions(cube, 3, {"x^(2/3)"}), cube, "y*x^(2/3)"));
  EXPECT_TRUE(has(with_functions(cube, 3, {"x^(1/3)"}), cube, "y*x^(2/3)"));
  // In a finer unit there would be no integral of this degree.
  EXPECT_TRUE(with_functions(cube, 2, {"x^(1/3)"}).found.empty());
  // A polynomial moves as well.
  const std::string plane =
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"x\"\ny = \"-2*y\"\n";
  EXPECT_TRUE(with_functions(plane, 2, {"x + y^2"}).found.empty());
  EXPECT_TRUE(has(with_functions(plane, 2, {"x^2"}), plane, "x^2*y"));
  EXPECT_TRUE(has(with_functions(plane, 2, {"sqrt(y)"}), plane, "x*sqrt(y)"));
  // Runge's vector is of degree two in p and one in 1/r.
  const std::string kepler =
      "hamiltonian = \"(px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)\"\n[phase_space]\n"
      "variables = [\"x\", \"y\", \"px\", \"py\"]\ncanonical = true\n";
  const search::Report runge = with_functions(kepler, 3, {"1/sqrt(x^2 + y^2)"});
  EXPECT_GE(runge.found.size(), 3U);
  EXPECT_TRUE(runge.complete) << runge.reason;
}

// x and y have the weights 1 and 2, and y - c*x^2 has the cofactor of both parts.
TEST(Proved, NoOtherDarbouxPolynomialOnlyWhereSumsOfDifferentWeightsAreNone) {
  const auto report_of = [](const std::string& x, const std::string& y) {
    return search::find_darboux(
        model_of("[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"" + x +
                 "\"\ny = \"" + y + "\"\n"),
        2);
  };
  EXPECT_FALSE(report_of("x*(x + y)", "2*y*(x + y)").complete);
  EXPECT_FALSE(report_of("x*(x + 3*y)", "2*y*(x + 3*y)").complete);
  const auto lotka = report_of("x*(x + y)", "y*(3*y - 2*x)");
  EXPECT_TRUE(lotka.complete) << lotka.reason;
  EXPECT_FALSE(report_of("sqrt(2)*x*y", "x^2 + y^2").complete);
}

/// 536870909 is the first prime of the search; the other number is its product with the second.
TEST(Proved, NoOtherValueThoughALeadingCoefficientVanishesModuloThePrimes) {
  for (const char* number : {"536870909", "288229794183646379"}) {
    const auto report = conditions(along_x("(" + std::string(number) + "*n - 1)*x*y"), 1, {"n"});
    EXPECT_TRUE(!report.complete || places_of(report).contains("n = 1/" + std::string(number)))
        << number;
  }
}

TEST(Proved, NothingOfGenericValuesWhereTheAssumptionsLeaveNone) {
  const auto is_complete = [](const std::string& assume) {
    const Model model =
        model_of("[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\nn = { assume = [" +
                 assume + "] }\n[equations]\nx = \"1\"\ny = \"(n - 1)*x\"\n");
    return search::find_integrals(model, up_to(1)).complete;
  };
  EXPECT_TRUE(is_complete("'n >= 1'"));
  EXPECT_FALSE(is_complete("'n >= 1', 'n <= 1'"));
  EXPECT_FALSE(is_complete("'(n - 1)^2 <= 0'"));
}

TEST(Darboux, TheDegreeIsThatOfThePolynomial) {
  const auto report = search::find_darboux(
      model_of("[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"x*(1 - x - 2*y)\"\n"
               "y = \"y*(2 - 3*x + y)\"\n"),
      2);
  ASSERT_EQ(report.found.size(), 2U);
  for (const auto& found : report.found) EXPECT_EQ(found.degree, 1) << found.text;
}

// With I taken for -1, or for any number, x + I*y is no integral, and x*y of the second is one.
TEST(Proved, TheImaginaryUnitObeysItsEquation) {
  const auto plane = [](const std::string& equations) {
    return search::find_integrals(
        model_of("[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\n" + equations), up_to(2));
  };
  const search::Report rotated = plane("x = \"I*x + y\"\ny = \"-x + I*y\"\n");
  EXPECT_TRUE(rotated.complete) << rotated.reason;
  EXPECT_TRUE(rotated.generic.empty());
  ASSERT_EQ(rotated.found.size(), 1U);
  EXPECT_EQ(rotated.found[0].text, "x*I - y");
  EXPECT_EQ(rotated.found[0].verdict, Verdict::proved);
  const search::Report none = plane("x = \"I*x\"\ny = \"y\"\n");
  EXPECT_TRUE(none.complete) << none.reason;
  EXPECT_TRUE(none.found.empty());
}

// At a = 1 there is x + I*y: the minors I^2 + a, I^2*a + 1 and I*(a^2 - 1) have no common factor
// unless I^2 = -1.
TEST(Proved, AValueThatOnlyTheEquationOfANumberGivesIsLeftOpen) {
  const auto report = conditions(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\na = {}\n[equations]\n"
      "x = \"I*x + a*y + x^2\"\ny = \"-x + I*y + a*I*x^2\"\n",
      1, {"a"});
  EXPECT_FALSE(report.complete);
  EXPECT_FALSE(report.reason.empty());
}

}  // namespace
}  // namespace casimir::test
