// Tensors that the motion multiplies: L_X T = f T.
#include "symbolic/structure/conformal.hpp"

#include <gtest/gtest.h>

#include "symbolic/error.hpp"
#include "symbolic/structure/lift.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

using structure::ConformalReport;
using structure::TensorType;
using Texts = std::vector<std::pair<std::string, std::string>>;

Model of_rates(const std::vector<std::string>& rates, const std::string& parameters = {}) {
  const std::vector<std::string> names{"x", "y", "z"};
  std::string variables, rest;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    variables += (i > 0 ? ", \"" : "\"") + names[i] + "\"";
    rest += names[i] + " = \"" + rates[i] + "\"\n";
  }
  return model_of("[phase_space]\nvariables = [" + variables + "]\n[parameters]\n" + parameters +
                  "[equations]\n" + rest);
}

/// L_X T by the formula in components, by GiNaC alone.
std::vector<GiNaC::ex> lie_derivative(const Model& model, TensorType type,
                                      const std::vector<GiNaC::ex>& tensor) {
  const std::size_t n = model.variables.size();
  const auto indices = structure::skew_indices(n, type.rank);
  const auto entry = [&](std::vector<std::size_t> list) -> GiNaC::ex {
    int sign = 1;
    for (std::size_t i = 0; i < list.size(); ++i)
      for (std::size_t j = 0; j + 1 < list.size(); ++j)
        if (list[j] > list[j + 1]) {
          std::swap(list[j], list[j + 1]);
          sign = -sign;
        }
    const auto place = std::find(indices.begin(), indices.end(), list);
    return place == indices.end()
               ? GiNaC::ex(0)
               : sign * tensor[static_cast<std::size_t>(place - indices.begin())];
  };
  std::vector<GiNaC::ex> result;
  for (const auto& list : indices) {
    GiNaC::ex sum = model.rate(entry(list));
    for (std::size_t k = 0; k < list.size(); ++k) {
      for (std::size_t a = 0; a < n; ++a) {
        std::vector<std::size_t> replaced = list;
        replaced[k] = a;
        sum += type.form ? entry(replaced) * model.field[a].diff(model.variables[list[k]])
                         : -entry(replaced) * model.field[list[k]].diff(model.variables[a]);
      }
    }
    result.push_back(sum.expand());
  }
  return result;
}

ConformalReport conformal(const Model& model, TensorType type, int degree) {
  ConformalReport report = structure::find_conformal_tensors(model, type, degree);
  EXPECT_TRUE(report.complete_rational) << report.reason;
  for (const auto& own : report.found) {
    EXPECT_EQ(own.verdict, Verdict::proved);
    EXPECT_FALSE(own.factor.is_zero());
    const auto rates = lie_derivative(model, type, own.components);
    for (std::size_t c = 0; c < rates.size(); ++c)
      EXPECT_TRUE((rates[c] - own.factor * own.components[c]).normal().is_zero())
          << own.factor_text;
  }
  return report;
}

constexpr TensorType kField{1, false}, kBivector{2, false}, kTwoForm{2, true};

/// Friction that is proportional to the momenta: the symplectic form shrinks.
TEST(ConformalTensors, OfAMotionWithFrictionAreTheSymplecticFormAndItsBracket) {
  const Model model = of_rates({"y", "-x - a*x^3 - c*y"}, "a = {}\nc = {}\n");
  const auto forms = conformal(model, kTwoForm, 2);
  EXPECT_TRUE(forms.complete) << forms.reason;
  ASSERT_EQ(forms.found.size(), 1U);
  EXPECT_EQ(forms.found[0].texts, (Texts{{"x,y", "1"}}));
  EXPECT_EQ(forms.found[0].factor_text, "-c");
  const auto bivectors = conformal(model, kBivector, 2);
  ASSERT_EQ(bivectors.found.size(), 1U);
  EXPECT_EQ(bivectors.found[0].factor_text, "c");
  EXPECT_TRUE(conformal(model, kField, 2).found.empty());
}

/// Euler's field E has [X, E] = -X, which is no multiple of E; and x*X, a product, is not listed.
TEST(ConformalTensors, AreNoSymmetriesOfOrbits) {
  const Model model = of_rates({"x*(a*x + y)", "y*(x + b*y)"}, "a = {}\nb = {}\n");
  EXPECT_TRUE(conformal(model, kField, 1).found.empty());
  const auto products = conformal(model, kField, 3);
  EXPECT_TRUE(products.found.empty());
  EXPECT_GE(products.trivial, 2U);
}

/// d/dx in other coordinates: X = (x*y + y^2) d/dx + y^2 d/dy with x = u + v, y = v.
TEST(ConformalTensors, WithLinearFactorsAreFound) {
  const Model model = of_rates({"x*y + y^2", "y^2"});
  const auto report = conformal(model, kField, 0);
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].texts, (Texts{{"x", "1"}}));
  EXPECT_EQ(report.found[0].factor_text, "-y");
  const Model moved = of_rates({"x*y + y^2", "y^2", "x*y + y^2 - 3*z"});
  EXPECT_FALSE(conformal(moved, kField, 0).found.empty());
}

/// In one variable the factor at a vertex is D.b less a.D for fields, and more a.D for forms.
TEST(ConformalTensors, AtAVertexOfNewtonsPolytope) {
  const Model model = of_rates({"x^2"});
  const auto fields = conformal(model, kField, 1);
  ASSERT_EQ(fields.found.size(), 1U);
  EXPECT_EQ(fields.found[0].factor_text, "-2*x");
  EXPECT_EQ(fields.trivial, 1U);  // x d/dx, of the factor -x
  const auto forms = conformal(model, {1, true}, 1);
  ASSERT_EQ(forms.found.size(), 1U);
  EXPECT_EQ(forms.found[0].factor_text, "2*x");
}

/// Where X does not vanish at 0 the lowest part of a factor is not bound to it: f = -1 - x.
TEST(ConformalTensors, OfAMotionWithoutARestHaveAnyLowestPart) {
  const auto report = conformal(of_rates({"1", "y + x*y"}), kField, 0);
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].factor_text, "-x - 1");
}

TEST(ConformalTensors, OfHighestRankAreTheVolumeAndDarbouxPolynomials) {
  const Model model = of_rates({"x*(a + y - 2*z)", "y*(b - 3*x + z)", "z*(c + x + 5*y)"},
                               "a = {}\nb = {}\nc = {}\n");
  const auto report = conformal(model, {3, true}, 1);
  EXPECT_TRUE(report.complete) << report.reason;
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].factor_text, "-2*x + 6*y - z + a + b + c");
  EXPECT_EQ(report.trivial, 3U);
  EXPECT_TRUE(conformal(model, kBivector, 2).found.empty());
}

/// x d/dx ^ y d/dy of a plane of prey and a third kind that nobody eats.
TEST(ConformalTensors, OfLotkaAndVolterraAreBivectorsWithLinearFactors) {
  const Model model = of_rates({"x*(a + z)", "y*(b - z)", "z*(c + z)"}, "a = {}\nb = {}\nc = {}\n");
  const auto report = conformal(model, kBivector, 0);
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].texts, (Texts{{"x,y", "1"}}));
  EXPECT_EQ(report.found[0].factor_text, "-a - b");
}

TEST(ConformalTensors, ThatThereAreNoneIsSaid) {
  for (const int rank : {1, 2}) {
    EXPECT_TRUE(conformal(bundled("damped-body"), {rank, false}, 1).found.empty());
    EXPECT_TRUE(conformal(bundled("kovalevskaya"), {rank, false}, 1).found.empty());
  }
  const Model lorenz =
      of_rates({"s*(y - x)", "r*x - y - x*z", "x*y - b*z"}, "s = {}\nr = {}\nb = {}\n");
  EXPECT_TRUE(conformal(lorenz, kBivector, 2).found.empty());
}

/// d/dx + sqrt(2) d/dy has the factor -sqrt(2): it is not looked for, and not excluded.
TEST(ConformalTensors, WithAlgebraicNumbersAreLeftOpen) {
  const auto report = conformal(of_rates({"y", "2*x"}), kField, 0);
  EXPECT_TRUE(report.found.empty());
  EXPECT_FALSE(report.complete);
  EXPECT_EQ(conformal(of_rates({"y", "4*x"}), kField, 0).found.size(), 2U);
}

/// At b = a the field d/dy - d/dx has a factor of its own: what is said is about generic values.
TEST(ConformalTensors, AreAboutGenericParameters) {
  const Model model = of_rates({"x*(a + x)", "y*(b + x)"}, "a = {}\nb = {}\n");
  const auto report = conformal(model, kField, 0);
  EXPECT_EQ(report.generic, (std::vector<std::string>{"a", "b"}));
}

TEST(ConformalTensors, NeedPolynomialEquations) {
  EXPECT_THROW(structure::find_conformal_tensors(of_rates({"1/x", "y"}), kField, 1), ModelError);
  EXPECT_THROW(structure::find_conformal_tensors(of_rates({"0", "0"}), kField, 1), ModelError);
}

}  // namespace
}  // namespace casimir::test
