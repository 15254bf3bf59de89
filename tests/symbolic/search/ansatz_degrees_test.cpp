// Searches as the literature states results: by degrees in momenta and in the rest, by weights that
// the equations have, and with the denominators of the equations.
#include "symbolic/search/ansatz_degrees.hpp"

#include <gtest/gtest.h>

#include "symbolic/search/own_weights.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/search/search_cases.hpp"

namespace casimir::test {
namespace {

std::string of_two_coordinates(const std::string& hamiltonian, const std::string& parameters = "") {
  return "hamiltonian = \"" + hamiltonian +
         "\"\n[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", \"p2\"]\ncanonical = true\n"
         "[parameters]\n" +
         parameters;
}

std::string equations(const std::string& variables, const std::string& rates) {
  return "[phase_space]\nvariables = [" + variables + "]\n[equations]\n" + rates;
}

search::DegreeIn in(std::vector<std::string> names, int degree) {
  search::DegreeIn result{{}, text(std::to_string(degree))};
  for (const std::string& name : names) result.names.push_back(text(name));
  return result;
}

search::Request within(std::vector<search::DegreeIn> limits, int degree = -1) {
  search::Request request = up_to(degree);
  request.degree_in = std::move(limits);
  return request;
}

std::vector<std::string> texts_of(const search::Report& report) {
  std::vector<std::string> result;
  for (const search::Found& found : report.found) {
    EXPECT_EQ(found.verdict, Verdict::proved) << found.text;
    result.push_back(found.text);
  }
  return result;
}

const char* const kCubic = "(p1^2 + p2^2)/2 + a*q1^2*q2 + b*q2^3";

/// Of the cubic potentials of Henon and Heiles three have a further integral, up to the fourth
/// degree in the momenta: a/b = 3 has one of the second degree, 1/2 of the second, 3/16 of the
/// fourth; a = 0 separates (Hietarinta 1987, 3.2.1).
TEST(AnsatzDegrees, IntegralsOfTheFourthDegreeInTheMomentaHaveTheirConditions) {
  const Model model = model_of(of_two_coordinates(kCubic, "a = {}\nb = {}\n"));
  const auto conditions_of = [&](int momenta) {
    const search::Request request = within({in({"momenta"}, momenta), in({"coordinates"}, 6)});
    std::vector<std::string> result;
    for (const search::Condition& condition :
         search::find_conditions(model, request, {text("b"), text("a")}).conditions) {
      EXPECT_EQ(condition.verdict, Verdict::proved);
      // A parameter that is 0 needs no relation.
      result.push_back(condition.relation.empty() ? "a" : condition.relation);
    }
    std::ranges::sort(result);
    return result;
  };
  EXPECT_EQ(conditions_of(3), (std::vector<std::string>{"2*a - b", "a", "a - 3*b"}));
  EXPECT_EQ(conditions_of(4), (std::vector<std::string>{"16*a - 3*b", "2*a - b", "a", "a - 3*b"}));
}

TEST(AnsatzDegrees, ALimitLeavesOutWhatIsBeyondIt) {
  const Model model = model_of(of_two_coordinates("(p1^2 + p2^2)/2 + q1^2*q2 + 16/3*q2^3"));
  EXPECT_EQ(
      search::find_integrals(model, within({in({"momenta"}, 4), in({"rest"}, 6)})).found.size(),
      1U);
  for (const auto& [momenta, rest] : {std::pair{3, 9}, {4, 5}}) {
    const auto report =
        search::find_integrals(model, within({in({"momenta"}, momenta), in({"rest"}, rest)}));
    EXPECT_TRUE(report.complete) << report.reason;
    EXPECT_TRUE(report.found.empty());
  }
  // What the energy generates is counted within the limits: 1, H and H^2, for momenta 4 and rest 6.
  EXPECT_EQ(search::find_integrals(model, within({in({"momenta"}, 4), in({"rest"}, 6)})).trivial,
            3U);
}

/// y^2 is beyond the limits and is y*w^2 here, which is a multiple of w^2 = y and not left out.
TEST(AnsatzDegrees, WhatARelationTakesBeyondALimitStaysInTheAnsatz) {
  const Model model = model_of(equations("\"x\", \"y\"", "x = \"2*y\"\ny = \"1\"\n"));
  search::Request request = within({in({"x", "y"}, 1), in({"sqrt(y)"}, 4)});
  request.functions = {text("sqrt(y)")};
  const auto report = search::find_integrals(model, request);
  EXPECT_TRUE(report.complete) << report.reason;
  EXPECT_EQ(report.found.size(), 1U);
  request.degree_in[1] = in({"sqrt(y)"}, 1);
  EXPECT_TRUE(search::find_integrals(model, request).found.empty());
}

/// On y^2 = x the monomial y^2 is x, which the limits exclude: y^2 is there and was not looked at.
TEST(AnsatzDegrees, ALevelThatLeadsBeyondALimitLeavesTheQuestionOpen) {
  const Model model = model_of(
      equations("\"x\", \"y\", \"z\"", "x = \"2*y*(x - y^2)\"\ny = \"x - y^2\"\nz = \"0\"\n"));
  const auto on_level = [&](std::vector<search::DegreeIn> limits) {
    search::Request request = within(std::move(limits));
    request.on = {text("x - y^2")};
    return search::find_integrals(model, request);
  };
  const auto open = on_level({in({"x"}, 0), in({"rest"}, 2)});
  EXPECT_FALSE(open.complete);
  EXPECT_NE(open.reason.find("beyond a limit"), std::string::npos) << open.reason;
  EXPECT_EQ(on_level({in({"x", "y"}, 2), in({"z"}, 1)}).reason.find("beyond a limit"),
            std::string::npos);
}

TEST(AnsatzDegrees, EquationsHaveTheirOwnWeights) {
  const auto weights_of = [](const std::string& toml, bool denominators = false) {
    search::Request request = up_to(4);
    request.own_weights = true;
    request.denominators = denominators;
    return search::find_integrals(model_of(toml), request).weights;
  };
  using Named = std::vector<std::pair<std::string, int>>;
  EXPECT_EQ(weights_of(euler_poisson("(M1^2 + M2^2 + 2*M3^2)/2 - r*g1", "r = {}\n")),
            (Named{{"M1", 1}, {"M2", 1}, {"M3", 1}, {"g1", 2}, {"g2", 2}, {"g3", 2}}));
  EXPECT_EQ(weights_of(of_two_coordinates("(p1^2 + p2^2)/2 + q1^2*q2 + q2^3")),
            (Named{{"q1", 2}, {"q2", 2}, {"p1", 3}, {"p2", 3}}));
  EXPECT_THROW(weights_of(of_two_coordinates("(p1^2 + p2^2)/2 + q1^2/2 + q1^2*q2 + q2^3")),
               ModelError);
  EXPECT_THROW(weights_of(equations("\"x\", \"y\"", "x = \"x + y + x^2*y\"\ny = \"x^3 + y\"\n")),
               ModelError);
}

/// By the weights of the problem of Kepler the momenta and 1/r weigh less than nothing.
TEST(AnsatzDegrees, WeightsThatAreNotPositiveNeedLimits) {
  const Model model = model_of(of_two_coordinates("(p1^2 + p2^2)/2 - 1/sqrt(q1^2 + q2^2)"));
  search::Request request = up_to(0);
  request.denominators = true;
  request.own_weights = true;
  EXPECT_THROW(search::find_integrals(model, request), ModelError);
  request.degree_in = {in({"momenta"}, 2), in({"rest"}, 3)};
  const auto report = search::find_integrals(model, request);
  EXPECT_TRUE(report.complete) << report.reason;
  ASSERT_EQ(report.weights.size(), report.functions.size() + 4);
  EXPECT_TRUE(std::ranges::any_of(report.weights, [](const auto& w) { return w.second < 0; }));
  // The two of Laplace, of weight 0; the momentum has weight 1 and is beyond.
  EXPECT_EQ(texts_of(report).size(), 2U);
  for (const search::Found& found : report.found) EXPECT_EQ(found.degree, 0) << found.text;
  request.degree = 1;
  EXPECT_EQ(texts_of(search::find_integrals(model, request)).size(), 3U);
}

TEST(AnsatzDegrees, DenominatorsOfTheEquationsAreFunctionsOfTheAnsatz) {
  const Model model = model_of(of_two_coordinates("(p1^2 + p2^2)/2 + 1/q1^2 + 3/q2^2"));
  search::Request request = up_to(2);
  EXPECT_TRUE(search::find_integrals(model, request).found.empty());
  request.denominators = true;
  const auto report = search::find_integrals(model, request);
  EXPECT_TRUE(report.hamiltonian);
  EXPECT_TRUE(report.complete) << report.reason;
  EXPECT_EQ(report.functions, (std::vector<std::string>{"(1/q1)", "(1/q2)"}));
  EXPECT_EQ(texts_of(report).size(), 1U);
  // Of parameters alone there are none.
  const Model other = model_of(of_two_coordinates("p1^2/(2*a) + p2^2/2 + q1^2", "a = {}\n"));
  EXPECT_TRUE(search::find_integrals(other, request).functions.empty());
}

/// Three of Ruijsenaars' particles: of the second degree in the exponentials there are the second
/// symmetric function, and one more, which the particles have as they are superintegrable.
TEST(AnsatzDegrees, RuijsenaarsParticlesHaveTheirIntegralsAndNoOthers) {
  const Model model = model_of(
      "hamiltonian = \"exp(p1)*w12*w13 + exp(p2)*w12*w23 + exp(p3)*w13*w23\"\n[phase_space]\n"
      "variables = [\"q1\", \"q2\", \"q3\", \"p1\", \"p2\", \"p3\"]\ncanonical = true\ndomain = "
      "[\"q1 - q2 > 0\", \"q2 - q3 > 0\", \"q1 - q3 > 0\"]\n[definitions]\nw12 = \"sqrt(1 + "
      "4/(q1 - q2)^2)\"\nw13 = \"sqrt(1 + 4/(q1 - q3)^2)\"\nw23 = \"sqrt(1 + 4/(q2 - q3)^2)\"\n");
  search::Request request = within(
      {in({"q1", "q2", "q3", "p1", "p2", "p3"}, 0), in({"exp(p1)", "exp(p2)", "exp(p3)"}, 2)}, 6);
  request.denominators = true;
  const auto report = search::find_integrals(model, request);
  EXPECT_TRUE(report.hamiltonian);
  EXPECT_TRUE(report.complete) << report.reason;
  EXPECT_TRUE(std::ranges::all_of(report.found, &search::Found::independent));
  EXPECT_EQ(texts_of(report).size(), 2U);
}

TEST(AnsatzDegrees, WhatCannotBeReadIsRefused) {
  const Model model = model_of(of_two_coordinates("(p1^2 + p2^2)/2 + q1^2*q2"));
  const auto refused = [&](const search::Request& request) {
    EXPECT_THROW(search::find_integrals(model, request), CaseError);
  };
  refused(within({in({"momenta"}, 4), in({"q3"}, 4)}));
  refused(within({in({"momenta"}, -1), in({"rest"}, 4)}));
  refused(within({in({"rest"}, 1), in({"rest"}, 4)}));
  EXPECT_THROW(search::find_integrals(model, within({in({"momenta"}, 4)})), ModelError);
  EXPECT_THROW(search::find_integrals(model, within({in({"momenta"}, 200), in({"rest"}, 200)})),
               ModelError);
  const Model body = model_of(euler_poisson("(M1^2 + M2^2 + 2*M3^2)/2 - g1"));
  EXPECT_THROW(search::find_integrals(body, within({in({"momenta"}, 4), in({"rest"}, 4)})),
               CaseError);
  search::Request request = up_to(4);
  request.weights = {{text("q1"), text("-1")}};
  refused(request);
  request.weights = {{text("q1"), text("1001")}};
  refused(request);
}

}  // namespace
}  // namespace casimir::test
