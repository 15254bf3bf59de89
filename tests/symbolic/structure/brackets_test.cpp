// Poisson brackets of bare equations of motion, and second ones, against what is known of them.
#include "symbolic/structure/brackets.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/bundled_cases.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

using structure::Bracket;
using structure::BracketReport;

bool is_proved(const Bracket& bracket) {
  return bracket.jacobi == Verdict::proved && bracket.motion == Verdict::proved;
}

/// The equations of a case with the numbers of its first scene for the parameters, in variables y
/// with x = A y, A drawn; empty where something is no polynomial with rational numbers.
std::optional<Model> changed(const Model& model, std::mt19937_64& random) {
  const std::size_t n = model.variables.size();
  GiNaC::exmap numbers;
  for (std::size_t k = 0; k < model.parameters.size(); ++k) {
    const GiNaC::ex value = model.scenes.front().parameters[k];
    if (!value.info(GiNaC::info_flags::rational)) return std::nullopt;
    numbers[model.parameters[k]] = value;
  }
  GiNaC::lst variables;
  for (const GiNaC::symbol& x : model.variables) variables.append(x);
  const unsigned size = static_cast<unsigned>(n);
  GiNaC::matrix a(size, size), x(size, 1), rates(size, 1);
  do {
    for (unsigned i = 0; i < size; ++i)
      for (unsigned j = 0; j < size; ++j)
        a(i, j) = GiNaC::numeric(static_cast<long>(random() % 7) - 3,
                                 static_cast<long>(random() % 2) + 1);
  } while (a.determinant().is_zero());
  GiNaC::exmap old;
  for (unsigned i = 0; i < size; ++i) {
    x(i, 0) = model.variables[i];
    const GiNaC::ex rate = model.field[i].subs(numbers).normal().expand();
    if (!rate.is_polynomial(variables)) return std::nullopt;
    rates(i, 0) = rate;
  }
  const GiNaC::matrix image = a.mul(x);
  for (unsigned i = 0; i < size; ++i) old[model.variables[i]] = image(i, 0);
  const GiNaC::matrix inverse = a.inverse();
  Model result;
  result.name = model.name;
  result.phase_space = "equations";
  result.variables = model.variables;
  for (unsigned i = 0; i < size; ++i) {
    GiNaC::ex rate = 0;
    for (unsigned j = 0; j < size; ++j) rate += inverse(i, j) * rates(j, 0).subs(old);
    result.field.push_back(rate.expand());
  }
  return result;
}

/// The degree of a bracket with polynomial entries; empty for others.
std::optional<int> bracket_degree(const Model& model) {
  int highest = 0;
  GiNaC::lst variables;
  for (const GiNaC::symbol& x : model.variables) variables.append(x);
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const GiNaC::ex own = (*model.poisson)(i, j).expand();
      if (!own.is_polynomial(variables)) return std::nullopt;
      GiNaC::exmap scaled;
      const GiNaC::symbol t;
      for (const GiNaC::symbol& x : model.variables) scaled[x] = t * x;
      highest = std::max(highest, own.subs(scaled).expand().degree(t));
    }
  }
  return highest;
}

TEST(EveryCase, GivenAsBareEquationsInOtherVariablesHasItsBracketFound) {
  std::mt19937_64 random(24);
  const int most = wants_every_case() ? 45 : 12;  // the others take as long as these
  int cases = 0;
  for (const std::filesystem::path& path : bundled_cases()) {
    const Model model = build_model(read_case(path));
    if (cases == most) break;
    if (!model.poisson || !model.hamiltonian || model.time || model.scenes.empty()) continue;
    if (model.variables.size() > 7) continue;
    const std::optional<int> degree = bracket_degree(model);
    if (!degree || *degree > 1) continue;
    const std::optional<Model> own = changed(model, random);
    if (!own) continue;
    const BracketReport report = structure::find_brackets(*own, *degree);
    ASSERT_FALSE(report.found.empty()) << model.name << ": " << report.reason;
    EXPECT_TRUE(is_proved(report.found.front())) << model.name;
    ++cases;
  }
  EXPECT_EQ(cases, most);
}

TEST(Brackets, OfADampedBodyAreProvedNotToBeThere) {
  const BracketReport report = structure::find_brackets(bundled("damped-body"), 2);
  EXPECT_TRUE(report.found.empty());
  EXPECT_TRUE(report.complete) << report.reason;
  EXPECT_TRUE(report.whatever_hamiltonian);
}

TEST(Brackets, OfEulersTopAreAPencil) {
  const BracketReport report = structure::find_brackets(bundled("euler"), 1);
  ASSERT_EQ(report.found.size(), 2U);
  EXPECT_TRUE(is_proved(report.found[0]) && is_proved(report.found[1]));
  EXPECT_TRUE(report.complete && report.spanned) << report.reason;
  ASSERT_EQ(report.found[0].casimirs.size(), 1U);
  EXPECT_EQ(report.found[0].casimirs[0], "M1^2 + M2^2 + M3^2");
}

/// The motion keeps x*y d/dx^d/dy and has the integral x^d*y^a*exp(-y*b - x*c), no polynomial one:
/// a bivector is there, and still "whatever the Hamiltonian" must not be said, as H = d*log(x) +
/// a*log(y) - c*x - b*y has that bracket.
TEST(Brackets, AreNotExcludedForAllHamiltoniansWhereABivectorIsInvariant) {
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\na = {}\nb = {}\nc = {}\nd = "
      "{}\n[equations]\nx = \"x*(a - b*y)\"\ny = \"y*(c*x - d)\"\n");
  const BracketReport report = structure::find_brackets(model, 2);
  EXPECT_TRUE(report.found.empty());
  EXPECT_TRUE(report.complete) << report.reason;
  EXPECT_EQ(report.invariant, 1U);
  EXPECT_FALSE(report.whatever_hamiltonian);
  // Without a first bracket there is no second one; the bivector is there all the same.
  EXPECT_EQ(structure::find_second_brackets(model, 2).invariant, 1U);
}

/// A bracket without the Jacobi identity is not kept by its Hamiltonian flows.
TEST(Brackets, WithoutTheJacobiIdentityAreNotTakenForPoissonBrackets) {
  const Model model = model_of(
      "hamiltonian = \"(x^2 + y^2 + z^2)/2\"\n[phase_space]\nvariables = [\"x\", \"y\", "
      "\"z\"]\n[phase_space.brackets]\n\"x,y\" = \"1\"\n\"y,z\" = \"x*y\"\n");
  const BracketReport report = structure::find_second_brackets(model, 1);
  EXPECT_FALSE(report.complete);
  EXPECT_TRUE(report.found.empty());
}

TEST(SecondBrackets, OfClebschMakeOnePencilWithItsChain) {
  const BracketReport report = structure::find_second_brackets(bundled("clebsch"), 1);
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_TRUE(is_proved(report.found[0]));
  EXPECT_TRUE(report.complete && report.spanned) << report.reason;
  // M*p is a Casimir function of both, and the other three integrals are one chain.
  ASSERT_EQ(report.found[0].chains.size(), 2U);
  EXPECT_EQ(report.found[0].chains[0].size(), 1U);
  EXPECT_EQ(report.found[0].chains[1].size(), 3U);
}

TEST(SecondBrackets, OfLyapunovAndLagrangeAreTwo) {
  for (const char* name : {"lyapunov", "lagrange"}) {
    const BracketReport report = structure::find_second_brackets(bundled(name), 1);
    ASSERT_EQ(report.found.size(), 2U) << name;
    EXPECT_TRUE(is_proved(report.found[0]) && is_proved(report.found[1])) << name;
    EXPECT_TRUE(report.complete && report.spanned) << name << report.reason;
    EXPECT_EQ(report.found[0].compatible, std::vector<std::size_t>{1}) << name;
  }
}

TEST(SecondBrackets, OfKovalevskayaAreNotLinear) {
  const BracketReport report = structure::find_second_brackets(bundled("kovalevskaya"), 2);
  EXPECT_TRUE(report.found.empty());
  EXPECT_TRUE(report.complete) << report.reason;
}

}  // namespace
}  // namespace casimir::test
