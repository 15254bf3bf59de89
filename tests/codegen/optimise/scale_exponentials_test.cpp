#include "codegen/optimise/scale_exponentials.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/evaluate.hpp"
#include "tests/codegen/support.hpp"

namespace casimir {
namespace {

Program rate_of(const std::string& rate) {
  return testing::specialised(testing::equations({{"x", rate}})).rhs;
}

double value_at(const Program& rhs, double x) {
  return evaluate(rhs, std::vector<double>{x, 0}).front();
}

struct Known {
  const char* rate;
  double (*value)(double x);
};

double softplus(double u) { return std::max(u, 0.) + std::log1p(std::exp(-std::abs(u))); }

/// With values that doubles hold however large the exponent is.
const Known kKnown[] = {
    {"log(1 + exp(1000*x))", [](double x) { return softplus(1000 * x); }},
    {"log(3*exp(700*x) + 2*exp(-900*x) + 5)",
     [](double x) {
       const double m = std::max({700 * x, -900 * x, 0.});
       return m +
              std::log(3 * std::exp(700 * x - m) + 2 * std::exp(-900 * x - m) + 5 * std::exp(-m));
     }},
    {"1/(1 + exp(100000*x))", [](double x) { return std::exp(-softplus(1e5 * x)); }},
    {"1/cosh(800*x)^2",
     [](double x) {
       const double e = std::exp(-1600 * std::abs(x));
       return 4 * e / ((1 + e) * (1 + e));
     }},
    {"sinh(900*x)/cosh(900*x)", [](double x) { return std::tanh(900 * x); }},
    {"(exp(2000*x) - 1)/(exp(2000*x) + 1)", [](double x) { return std::tanh(1000 * x); }},
    {"sqrt(1 + exp(1600*x))*exp(-800*x)",
     [](double x) {
       return std::sqrt(1 + std::exp(-1600 * std::abs(x))) * (x < 0 ? std::exp(800 * -x) : 1.);
     }},
    {"log(exp(1000*x)*(2 + exp(-500*x)))",
     [](double x) { return 1000 * x + std::log(2.) + softplus(-500 * x - std::log(2.)); }},
};

TEST(ScaledExponentials, AreTheSameFunctionWhereDoublesHoldAll) {
  for (const Known& known : kKnown) {
    const auto scaled = codegen::with_scaled_exponentials(rate_of(known.rate), 1);
    ASSERT_TRUE(scaled) << known.rate;
    for (const double x : {-0.2, -0.01, -1e-4, 0., 3e-5, 0.002, 0.1, 0.3}) {
      const double expected = known.value(x);
      EXPECT_NEAR(value_at(*scaled, x), expected, 1e-12 * std::max(1., std::abs(expected)))
          << known.rate << " at " << x;
    }
  }
}

TEST(ScaledExponentials, HaveValuesWhereExponentialsHaveNone) {
  for (const Known& known : kKnown) {
    const auto scaled = codegen::with_scaled_exponentials(rate_of(known.rate), 1);
    ASSERT_TRUE(scaled) << known.rate;
    for (const double x : {3., 40., 1e3}) {
      const double expected = known.value(x);
      EXPECT_NEAR(value_at(*scaled, x), expected, 1e-12 * std::max(1., std::abs(expected)))
          << known.rate << " at " << x;
    }
  }
  EXPECT_TRUE(std::isinf(value_at(rate_of("log(1 + exp(1000*x))"), 3)));
}

TEST(ScaledExponentials, AreNotMadeWhereNoneStandsInAnything) {
  for (const char* rate : {"exp(1000*x)", "x^2", "log(1 + x^2)", "1/(1 + tanh(x)^2)", "cosh(x)"})
    EXPECT_FALSE(codegen::with_scaled_exponentials(rate_of(rate), 1)) << rate;
}

}  // namespace
}  // namespace casimir
