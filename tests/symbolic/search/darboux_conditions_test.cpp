// Values of parameters with additional Darboux polynomials.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/error.hpp"
#include "symbolic/search/conditions/darboux_conditions.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

using search::DarbouxConditionReport;
using Texts = std::vector<std::string>;

Model with_equations(const std::string& variables, const std::string& parameters,
                     const std::string& equations) {
  return model_of("[phase_space]\nvariables = " + variables + "\n[parameters]\n" + parameters +
                  "[equations]\n" + equations);
}

Model lorenz(const std::string& s = "s = {}\n") {
  return with_equations(R"(["x", "y", "z"])", s + "r = {}\nb = {}\n",
                        "x = \"s*(y - x)\"\ny = \"r*x - y - x*z\"\nz = \"x*y - b*z\"\n");
}

std::vector<Text> names(const Texts& list) {
  std::vector<Text> result;
  for (const std::string& name : list) result.push_back({name, {}, name});
  return result;
}

/// "NAME = VALUE, ..: F; F" of each, after a test by GiNaC of dF/dt = K F where they hold.
Texts lines(const Model& model, const DarbouxConditionReport& report) {
  Texts result;
  for (const auto& condition : report.conditions) {
    std::string line;
    GiNaC::exmap here;
    for (std::size_t k = 0; k < condition.parameters.size(); ++k) {
      const auto& [name, value] = condition.parameters[k];
      line += (k == 0 ? "" : ", ") + name + " = " + value;
      here.emplace(model.parse({name, {}, name}), condition.values[k]);
    }
    for (const auto& f : condition.found) {
      line += (&f == condition.found.data() ? ": " : "; ") + f.text;
      const GiNaC::ex rest = model.rate(f.value).subs(here) - f.cofactor_value * f.value;
      EXPECT_TRUE(rest.normal().is_zero()) << line;
      EXPECT_EQ(f.verdict, Verdict::proved) << line;
    }
    result.push_back(line);
  }
  return result;
}

DarbouxConditionReport found(const Model& model, int degree, const Texts& free) {
  return search::find_darboux_conditions(model, degree, names(free));
}

/// J. Llibre and X. Zhang, Invariant algebraic surfaces of the Lorenz system, J. Math. Phys. 43
/// (2002): these three of degree 2, for s > 0.
TEST(DarbouxConditions, OfLorenz) {
  const Model model = lorenz("s = { assume = \"s > 0\" }\n");
  const auto report = found(model, 2, {"b", "r", "s"});
  EXPECT_EQ(lines(model, report), (Texts{"b = 2*s: x^2 - 2*z*s", "r = 0, b = 1: y^2 + z^2",
                                         "b = 1, s = 1: x^2*r - y^2 - z^2"}));
  EXPECT_TRUE(report.complete) << report.reason;
  for (const auto& condition : report.conditions) EXPECT_EQ(condition.verdict, Verdict::proved);
}

TEST(DarbouxConditions, OfOneParameterAreOverTheOthers) {
  const Model model = lorenz();
  const auto report = found(model, 2, {"s"});
  EXPECT_EQ(lines(model, report), Texts{"s = 1/2*b: x^2 - z*b"});
  EXPECT_TRUE(report.complete) << report.reason;
  EXPECT_TRUE(found(model, 2, {"r"}).conditions.empty());
}

TEST(DarbouxConditions, HessIsWhereATopHasACircularSection) {
  const Model model = model_of(
      "hamiltonian = \"(a1*M1^2 + a2*M2^2 + a3*M3^2 + 2*b*M1*M3)/2 + r*g3\"\n[phase_space]\n"
      "variables = [\"M1\", \"M2\", \"M3\", \"g1\", \"g2\", \"g3\"]\nalgebra = \"e(3)\"\n"
      "[parameters]\na1 = {}\na2 = {}\na3 = {}\nb = {}\nr = {}\n");
  const auto report = found(model, 1, {"a2"});
  EXPECT_EQ(lines(model, report), Texts{"a2 = a1: M3"});
  EXPECT_TRUE(report.complete) << report.reason;
}

/// In principal axes: both of Hess's conditions together, as a set.
TEST(DarbouxConditions, HessInPrincipalAxesIsASetOfTwoConditions) {
  const auto report = found(bundled("euler-poisson"), 1, {"a2", "r2"});
  ASSERT_EQ(report.conditions.size(), 1U);
  EXPECT_EQ(report.conditions[0].parameters.size(), 2U);
  EXPECT_EQ(report.conditions[0].found[0].text, "M1*r1 + M3*r3");
  EXPECT_TRUE(report.complete) << report.reason;
}

/// A factor of the value of what there is in general: at a = 0, x is no limit of x*y - a.
TEST(DarbouxConditions, FactorsOfAValueAreAdditional) {
  const Model model =
      with_equations(R"(["x", "y"])", "a = {}\n", "x = \"x + x*y - a\"\ny = \"-y + x*y - a\"\n");
  const auto report = found(model, 2, {"a"});
  ASSERT_EQ(report.generic.found.size(), 1U);
  EXPECT_EQ(lines(model, report), Texts{"a = 0: x; y"});
  EXPECT_TRUE(report.complete) << report.reason;
}

/// x - 2 at a = 4 is the limit of x - sqrt(a): no value is special, but these are not shown.
TEST(DarbouxConditions, LimitsOfRootsAreNotAdditional) {
  const Model root =
      with_equations(R"(["x", "y"])", "a = {}\n", "x = \"x^2 - a\"\ny = \"1 + x*y\"\n");
  const Model line = with_equations(R"(["x", "y"])", "a = {}\n", "x = \"y\"\ny = \"a*x\"\n");
  for (const Model* model : {&root, &line}) {
    for (const int degree : {1, 2}) {
      const auto report = found(*model, degree, {"a"});
      EXPECT_TRUE(report.conditions.empty());
      EXPECT_FALSE(report.complete);
      EXPECT_FALSE(report.reason.empty());
    }
  }
}

/// a*x + b*y has no value at a = b = 0, and is no new one where only a or b is 0.
TEST(DarbouxConditions, ValuesOfKnownOnesAreNotAdditional) {
  const Model model = with_equations(R"(["x", "y"])", "a = {}\nb = {}\n",
                                     "x = \"b*x*y\"\ny = \"-a*x*y + a*x + b*y\"\n");
  const auto report = found(model, 1, {"a", "b"});
  EXPECT_EQ(lines(model, report), Texts{"b = 0: y - 1"});
  EXPECT_TRUE(report.complete) << report.reason;
}

/// A relation without rational roots is shown, and what it leads to stays open; one without real
/// roots is none.
TEST(DarbouxConditions, RootsThatAreNotRational) {
  const auto of = [](const std::string& coefficient) {
    return with_equations(R"(["x", "y"])", "a = {}\n",
                          "x = \"x*y + " + coefficient + "\"\ny = \"x + y^3\"\n");
  };
  const auto real = found(of("a^2 - 3"), 1, {"a"});
  ASSERT_EQ(real.conditions.size(), 1U);
  EXPECT_EQ(real.conditions[0].relations, Texts{"a^2 - 3"});
  EXPECT_EQ(real.conditions[0].verdict, Verdict::undecided);
  EXPECT_FALSE(real.complete);
  const auto none = found(of("a^2 + 3"), 1, {"a"});
  EXPECT_TRUE(none.conditions.empty());
  EXPECT_TRUE(none.complete) << none.reason;
}

TEST(DarbouxConditions, OutsideTheAssumptionsThereAreNone) {
  const Model model = with_equations(R"(["x", "y"])", "a = { assume = \"a > 0\" }\n",
                                     "x = \"x + x*y - a\"\ny = \"-y + x*y - a\"\n");
  const auto report = found(model, 1, {"a"});
  EXPECT_TRUE(report.conditions.empty());
  EXPECT_TRUE(report.complete) << report.reason;
}

TEST(DarbouxConditions, EndAtTheLimitOfWork) {
  Limits small;
  small.work = 100;
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\na = {}\n[equations]\n"
      "x = \"x + x*y - a\"\ny = \"-y + x*y - a\"\n",
      small);
  const auto report = found(model, 3, {"a"});
  EXPECT_FALSE(report.complete);
  EXPECT_NE(report.reason.find("'work'"), std::string::npos) << report.reason;
}

TEST(DarbouxConditions, NamesAreThoseOfParameters) {
  EXPECT_THROW(found(lorenz(), 1, {"q"}), CaseError);
  EXPECT_THROW(found(lorenz(), 1, {"x"}), CaseError);
  EXPECT_THROW(found(lorenz(), 1, {"s", "s"}), CaseError);
}

/// Over the rational numbers: y^2 + z^2 is irreducible, and that it has the factors y + i*z leaves
/// nothing open.
TEST(Darboux, ConjugateFactorsAreNoOthers) {
  const Model model = with_equations(R"(["x", "y", "z"])", "s = {}\n",
                                     "x = \"s*(y - x)\"\ny = \"-y - x*z\"\nz = \"x*y - z\"\n");
  const auto report = search::find_darboux(model, 2);
  EXPECT_TRUE(report.complete) << report.reason;
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].text, "y^2 + z^2");
  // Quotients of such factors were not looked for.
  EXPECT_FALSE(search::find_rational(model, 2).complete);
  // y + i*z alone, whose product with its conjugate is beyond the degree.
  EXPECT_FALSE(search::find_darboux(model, 1).complete);
}

/// x^2 - 2*y^2 is an integral, and is not listed: its factors x - sqrt(2)*y are none.
TEST(Darboux, RealFactorsOfAnIntegralLeaveTheAnswerOpen) {
  const std::string plane = R"(["x", "y"])", space = R"(["x", "y", "z"])";
  for (const auto& [variables, equations] :
       {std::pair(plane, "x = \"2*y\"\ny = \"x\"\n"), std::pair(plane, "x = \"a*y\"\ny = \"x\"\n"),
        std::pair(space, "x = \"2*y + 1\"\ny = \"x + 1\"\nz = \"x*z + y\"\n")}) {
    const Model model = with_equations(variables, "a = {}\n", equations);
    for (const int degree : {1, 2})
      EXPECT_FALSE(search::find_darboux(model, degree).complete) << equations << degree;
  }
  // At a = 0 they are there.
  const Model line =
      with_equations(space, "a = {}\n", "x = \"2*y + a*z\"\ny = \"x\"\nz = \"z^2 + x\"\n");
  EXPECT_FALSE(found(line, 2, {"a"}).complete);
  // Those of x^2 + y^2 are not real.
  const auto circle =
      search::find_darboux(with_equations(plane, "a = {}\n", "x = \"-y\"\ny = \"x\"\n"), 2);
  EXPECT_TRUE(circle.complete) << circle.reason;
  EXPECT_TRUE(circle.has_conjugates);
}

/// (x + c)*y for every c, as x is an integral.
TEST(Darboux, ProductsWithIntegralsAreNoOthers) {
  const auto report = search::find_darboux(
      with_equations(R"(["x", "y"])", "a = {}\n", "x = \"0\"\ny = \"y*(a*x + y)\"\n"), 2);
  EXPECT_TRUE(report.complete) << report.reason;
  // x + c*y for every c is a family.
  const auto pencil = search::find_darboux(
      with_equations(R"(["x", "y"])", "a = {}\n", "x = \"x*(x + 1)\"\ny = \"y*(x + 1)\"\n"), 1);
  EXPECT_FALSE(pencil.complete);
}

/// c is zero at every value that is allowed: then F = x for every a.
TEST(DarbouxConditions, OfAssumptionsThatLeaveSingleValuesNothingIsSaid) {
  for (const char* assumed :
       {"assume = \"c = 0\"", "assume = \"-c^2 >= 0\"", "assume = [\"c >= 0\", \"c <= 0\"]"}) {
    const Model model =
        with_equations(R"(["x", "y"])", "a = {}\nc = { " + std::string(assumed) + " }\n",
                       "x = \"x*y + c + c*a\"\ny = \"x + y^3 + a\"\n");
    EXPECT_FALSE(search::find_darboux_polynomials(model, 1, {}).complete) << assumed;
    EXPECT_FALSE(search::find_rational(model, 1, {}).complete) << assumed;
    EXPECT_FALSE(search::find_darboux_conditions(model, 1, names({"a"}), {}).complete) << assumed;
  }
}

}  // namespace
}  // namespace casimir::test
