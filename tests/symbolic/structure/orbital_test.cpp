// Fields that take orbits to orbits: [X, Y] = g X.
#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/error.hpp"
#include "symbolic/structure/orbital.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

using structure::OrbitalReport;

Model in_plane(const std::string& x, const std::string& y, const std::string& parameters = {}) {
  return model_of("[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\n" + parameters +
                  "[equations]\nx = \"" + x + "\"\ny = \"" + y + "\"\n");
}

/// Complete, proved, and [X, Y] - g X is zero by GiNaC.
OrbitalReport found(const Model& model, int degree) {
  OrbitalReport report = structure::find_orbital_symmetries(model, degree);
  EXPECT_TRUE(report.complete) << report.reason;
  for (const auto& own : report.found) {
    EXPECT_EQ(own.verdict, Verdict::proved);
    for (std::size_t k = 0; k < model.variables.size(); ++k) {
      GiNaC::ex rest = model.rate(own.components[k]) - own.factor * model.field[k];
      for (std::size_t i = 0; i < model.variables.size(); ++i)
        rest -= own.components[i] * model.field[k].diff(model.variables[i]);
      EXPECT_TRUE(rest.expand().is_zero()) << own.factor_text;
    }
  }
  return report;
}

/// Euler's field of a quadratic motion: [X, E] = -X.
TEST(OrbitalSymmetries, OfAQuadraticMotionAreItsHomotheties) {
  const auto report = found(in_plane("x*(a*x + y)", "y*(x + b*y)", "a = {}\nb = {}\n"), 2);
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].texts,
            (std::vector<std::pair<std::string, std::string>>{{"x", "x"}, {"y", "y"}}));
  EXPECT_EQ(report.found[0].factor_text, "-1");
  EXPECT_EQ(report.trivial, 1U);
}

TEST(OrbitalSymmetries, OfKovalevskayasTopHaveItsWeights) {
  const auto report = found(bundled("kovalevskaya"), 1);
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].texts[0].second, "M1");
  EXPECT_EQ(report.found[0].texts[3].second, "2*g1");
}

/// Of higher degree than the motion: multiples h*X are left out, with their factors X(h).
TEST(OrbitalSymmetries, AreModuloMultiplesOfTheMotion) {
  const Model model = in_plane("x*(1 + a*x + b*y)", "y*(c + x + y)", "a = {}\nb = {}\nc = {}\n");
  for (const int degree : {1, 2, 3}) EXPECT_TRUE(found(model, degree).found.empty()) << degree;
  EXPECT_EQ(found(model, 3).trivial, 3U);
}

/// X = d/dx: Y = (f(x, y), g(y)), modulo multiples those of d/dy: 1, y, y^2.
TEST(OrbitalSymmetries, OfAConstantMotionAreAllFieldsOfTheOrbits) {
  const auto report = found(in_plane("1", "0"), 2);
  EXPECT_EQ(report.found.size(), 3U);
  EXPECT_EQ(report.trivial, 6U);
}

/// x*E with E = x d/dx + y d/dy: y d/dx takes orbits to orbits too, and its g is -y/x.
TEST(OrbitalSymmetries, HaveFactorsThatArePolynomials) {
  const auto report = found(in_plane("x^2", "x*y"), 1);
  EXPECT_EQ(report.found.size(), 3U);
  for (const auto& own : report.found) {
    for (const auto& [variable, text] : own.texts)
      EXPECT_TRUE(variable == "y" || text == "x") << text;
  }
}

/// At a = 0 there would be more: what is said is about generic values.
TEST(OrbitalSymmetries, AreAboutGenericParameters) {
  const auto generic = found(in_plane("a*x^2 + x", "y", "a = {}\n"), 1);
  const auto special = found(in_plane("x", "y"), 1);
  EXPECT_EQ(generic.generic, std::vector<std::string>{"a"});
  EXPECT_LT(generic.found.size(), special.found.size());
}

TEST(OrbitalSymmetries, NeedPolynomials) {
  EXPECT_THROW(structure::find_orbital_symmetries(in_plane("1/x", "y"), 1), ModelError);
  EXPECT_THROW(structure::find_orbital_symmetries(in_plane("sin(x)", "y"), 1), ModelError);
  EXPECT_THROW(structure::find_orbital_symmetries(in_plane("0", "0"), 1), ModelError);
  EXPECT_THROW(structure::find_orbital_symmetries(in_plane("x", "y"), 60), ModelError);
}

}  // namespace
}  // namespace casimir::test
