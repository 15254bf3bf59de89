// Searches whose functions obey relations: inverse distances, roots, sines and cosines.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/search/independent_monomials.hpp"
#include "symbolic/search/search.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/search/search_cases.hpp"

namespace casimir::test {
namespace {

/// Bodies on a line that repel each other with the inverse cube of their distances.
Model on_a_line(int n, const std::string& couplings = "g = {}\n") {
  const bool one = couplings == "g = {}\n";
  std::string energy;
  for (int i = 1; i <= n; ++i) energy += fmt::format("{}p{}^2/2", i > 1 ? " + " : "", i);
  for (int i = 1; i <= n; ++i)
    for (int j = i + 1; j <= n; ++j)
      energy += fmt::format(" + {}/(q{} - q{})^2", one ? "g" : fmt::format("g{}{}", i, j), i, j);
  return model_of(
      fmt::format("hamiltonian = \"{}\"\n[phase_space]\nvariables = [\"q[1..{}]\", "
                  "\"p[1..{}]\"]\ncanonical = true\n[parameters]\n{}",
                  energy, n, n, couplings));
}

search::Request with_inverse_distances(int n, int degree) {
  search::Request request = up_to(degree);
  for (int i = 1; i <= n; ++i)
    for (int j = i + 1; j <= n; ++j)
      request.functions.push_back(text(fmt::format("1/(q{} - q{})", i, j)));
  return request;
}

std::vector<int> degrees_of(const search::Report& report) {
  std::vector<int> result;
  for (const search::Found& own : report.found) {
    EXPECT_EQ(own.verdict, Verdict::proved) << own.text;
    result.push_back(own.degree);
  }
  return result;
}

TEST(FunctionsWithRelations, CalogerosAndMosersIntegralsAreAllThatThereAre) {
  const auto three = search::find_integrals(on_a_line(3), with_inverse_distances(3, 3));
  EXPECT_TRUE(three.complete) << three.reason;
  EXPECT_EQ(degrees_of(three), (std::vector<int>{1, 3, 3}));
  const auto four = search::find_integrals(on_a_line(4), with_inverse_distances(4, 3));
  EXPECT_TRUE(four.complete) << four.reason;
  EXPECT_EQ(degrees_of(four), (std::vector<int>{1, 3, 3}));
}

/// (sqrt(x) - sqrt(y))^3 has the degree 2: it is made of what was found.
TEST(FunctionsWithRelations, PowersThatAreOfALowDegreeAreNotFoundAgain) {
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\ndomain = [\"x > 0\", \"y > "
      "0\"]\n[equations]\nx = \"sqrt(x)\"\ny = \"sqrt(y)\"\n");
  const auto report = search::find_integrals(model, up_to(3));
  EXPECT_TRUE(report.complete) << report.reason;
  EXPECT_EQ(degrees_of(report), std::vector<int>{1});
}

/// The ring makes sqrt(x^2 - 1) of sqrt(x + 1) and sqrt(x - 1), cos(x) of cos(x/2): what the
/// equations have stays in the ansatz.
TEST(FunctionsWithRelations, MoreFunctionsTakeNoneAway) {
  for (const auto& [rate, more, integral] :
       {std::tuple{"x/sqrt(x^2 - 1)", "sqrt(x + 1)", "y - sqrt(x^2 - 1)"},
        {"1/(2*sqrt(x))", "x^(1/4)", "y - sqrt(x)"},
        {"cos(x)", "cos(x/2)", "y - sin(x)"},
        {"exp(x)", "exp(x/2)", "y - exp(x)"}}) {
    const Model model = model_of(fmt::format(
        "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"1\"\ny = \"{}\"\n", rate));
    search::Request request = up_to(1);
    const auto without = search::find_integrals(model, request);
    request.functions.push_back(text(more));
    const auto with = search::find_integrals(model, request);
    ASSERT_EQ(with.found.size(), 1U) << rate;
    EXPECT_EQ(with.found[0].text, integral);
    ASSERT_EQ(without.found.size(), 1U) << rate;
    EXPECT_GT(with.functions.size(), without.functions.size()) << rate;
    EXPECT_TRUE(with.complete) << with.reason;
  }
}

/// "No other" is about polynomials in functions that are named: y + exp(-x) is an integral.
TEST(FunctionsWithRelations, AreNamed) {
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"1\"\ny = \"exp(-x)\"\n");
  search::Request request = up_to(1);
  const auto plain = search::find_integrals(model, request);
  EXPECT_TRUE(plain.found.empty());
  EXPECT_EQ(plain.functions, std::vector<std::string>{"exp(x)"});
  request.functions.push_back(text("exp(-x)"));
  EXPECT_EQ(search::find_integrals(model, request).found.size(), 1U);
  const Model polynomial =
      model_of("[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"y\"\ny = \"x\"\n");
  EXPECT_TRUE(search::find_integrals(polynomial, up_to(1)).functions.empty());
}

/// With three couplings only the integrals that all homogeneous potentials of this degree have.
TEST(FunctionsWithRelations, JacobisThreeBodiesHaveNoCubicIntegralOfTheMomenta) {
  const Model model = on_a_line(3, "g12 = {}\ng13 = {}\ng23 = {}\n");
  const auto report = search::find_integrals(model, with_inverse_distances(3, 3));
  EXPECT_TRUE(report.complete) << report.reason;
  EXPECT_EQ(degrees_of(report), (std::vector<int>{1, 3}));
}

TEST(FunctionsWithRelations, ThreeBodiesInAPlaneHaveTheirClassicalIntegrals) {
  search::Request request = up_to(2);
  for (const std::string pair : {"12", "23", "31"}) request.functions.push_back(text("1/r" + pair));
  const auto report = search::find_integrals(bundled("three-bodies-plane"), request);
  EXPECT_TRUE(report.complete) << report.reason;
  EXPECT_EQ(report.found.size(), 3U + 1U);
}

/// Several fields at once, and the Casimir functions that contain a root.
TEST(FunctionsWithRelations, CasimirFunctionsAreAllFoundToo) {
  search::Request request = up_to(2);
  request.casimirs = true;
  request.functions = {text("1/z")};
  const Model model = model_of(
      "hamiltonian = \"x\"\n[phase_space]\nvariables = [\"x\", \"y\", "
      "\"z\"]\n[phase_space.brackets]\n"
      "\"x,y\" = \"z\"\n\"x,z\" = \"-x*z\"\n\"y,z\" = \"y*z\"\n");
  const auto report = search::find_integrals(model, request);
  EXPECT_TRUE(report.complete) << report.reason;
  ASSERT_EQ(degrees_of(report), std::vector<int>{2});
  EXPECT_EQ(report.found[0].text, "x*y + z");
}

/// A function of Casimir functions is one, and a coefficient of others.
TEST(FunctionsWithRelations, OfCasimirFunctionsAreCasimirFunctionsAndTheirCoefficients) {
  search::Request request = up_to(2);
  request.casimirs = true;
  const Model model = model_of(
      "hamiltonian = \"y\"\n[phase_space]\nvariables = [\"x\", \"y\", \"w\", \"z\"]\n"
      "[phase_space.brackets]\n\"x,y\" = \"sqrt(z)\"\n\"y,w\" = \"1\"\n\"x,w\" = \"0\"\n");
  const auto report = search::find_integrals(model, request);
  EXPECT_TRUE(report.complete) << report.reason;
  std::vector<std::string> texts;
  for (const auto& own : report.found) texts.push_back(own.text);
  EXPECT_TRUE(std::ranges::find(texts, "w*sqrt(z) + x") != texts.end());
  EXPECT_TRUE(std::ranges::find(texts, "sqrt(z)") != texts.end());
  // x + sin(t)*z: functions of the time are no coefficients that a search writes down.
  const auto moving = search::find_integrals(
      model_of("hamiltonian = \"y\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n"
               "time = \"t\"\n[phase_space.brackets]\n\"x,y\" = \"sin(t)\"\n\"y,z\" = \"1\"\n"
               "\"x,z\" = \"0\"\n"),
      request);
  EXPECT_FALSE(moving.complete);
}

/// What vanishes at points modulo a prime is no proof for functions of which other relations may
/// hold: |x| - x is zero on half of the line.
TEST(FunctionsWithRelations, AbsoluteValuesLeaveTheAnswerOpen) {
  search::Request request = up_to(2);
  const Model model = model_of(
      "hamiltonian = \"p^2/2 + abs(x)\"\n[phase_space]\nvariables = [\"x\", \"p\"]\ncanonical = "
      "true\n");
  request.functions = {text("abs(x)")};
  EXPECT_FALSE(search::find_integrals(model, request).complete);
}

/// Values of parameters are looked for with cofactors, of which some are missing.
TEST(FunctionsWithRelations, OfWhichCofactorsAreMissingLeaveConditionsOpen) {
  search::Request request = up_to(1);
  request.functions = {text("1/(x - y)"), text("1/(x + y)")};
  const Model model = model_of(
      "hamiltonian = \"(px^2 + py^2)/2 + g/(x - y) + 1/(x + y)\"\n[phase_space]\nvariables = "
      "[\"x\", \"y\", \"px\", \"py\"]\ncanonical = true\n[parameters]\ng = {}\n");
  EXPECT_TRUE(search::find_integrals(model, request).complete);
  const auto report = search::find_conditions(model, request, {text("g")});
  EXPECT_FALSE(report.complete);
  EXPECT_NE(report.reason.find("cofactors"), std::string::npos) << report.reason;
}

search::Fields fields_of(const search::System& system) {
  return {system.atoms(), {system.flow()}, {system.plain_flow()}};
}

/// y12*y23 = y13*(y12 + y23), and y12*(q1 - q2) = 1 with two others.
TEST(IndependentMonomials, LeaveOutWhatIsACombinationOfOthers) {
  const Model model = on_a_line(3);
  const std::vector<NamedExpression> functions{{"a", model.parse(text("1/(q1 - q2)")), {}},
                                               {"b", model.parse(text("1/(q2 - q3)")), {}},
                                               {"c", model.parse(text("1/(q1 - q3)")), {}}};
  const search::System system(model, functions, {});
  const search::Fields fields = fields_of(system);
  const search::Modulus modulus = search::usable_modulus(system);
  std::mt19937_64 random(1);
  const search::Point constants = system.random_point(modulus, random).value();
  search::Samples samples(system, fields, modulus, 2);
  const auto list = search::all_monomials(std::vector<int>(system.atoms().size(), 1), 2);
  const auto chosen =
      search::independent_monomials(system, fields, {list, {}}, modulus, constants, samples, {});
  EXPECT_TRUE(chosen.complete);
  EXPECT_EQ(list.size() - chosen.monomials.size(), 3U + 1U);
}

/// A weight, and the parity of p with q at rest.
TEST(Gradings, AreWeightsAndParities) {
  const Model model = model_of(
      "hamiltonian = \"p^2/2 + q^4\"\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = "
      "true\n");
  const search::System system(model, {}, {});
  const search::Grading grading(system, fields_of(system));
  const auto part = [&](std::uint8_t q, std::uint8_t p) {
    const std::vector<std::uint8_t> exponents{q, p};
    return grading.part_of(exponents.data());
  };
  EXPECT_EQ(part(4, 0), part(0, 2));
  EXPECT_NE(part(2, 0), part(0, 1));  // of one weight
  EXPECT_NE(part(4, 0), part(0, 1));
}

}  // namespace
}  // namespace casimir::test
