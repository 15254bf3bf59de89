// The precompiled kernels for quadratic systems of every size, against Boost.Odeint.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <random>

#include "runtime/taylor/quadratic_targets.hpp"

namespace casimir::test {
namespace {

using State = std::vector<double>;

/// A system whose coefficients follow from its size: constants, linear terms and, for every rate,
/// some of the products, or each product there is.
QuadraticForm some_form(int states, bool every_product) {
  std::mt19937 random(static_cast<unsigned>(states));
  const auto small = [&] { return (static_cast<double>(random() % 17) - 8) / (32. + states); };
  const auto n = static_cast<std::size_t>(states);
  QuadraticForm form;
  form.states = states;
  for (std::size_t i = 0; i < n; ++i) {
    form.constant.push_back(small());
    form.linear.emplace_back(n);
    for (std::size_t j = 0; j < n; j += 1 + random() % 4) form.linear[i][j] = small();
  }
  for (int i = 0; i < states; ++i) {
    for (int j = i; j < states; ++j) {
      if (!every_product && random() % 4 != 0) continue;
      form.products.push_back({i, j, State(n)});
      for (std::size_t k = 0; k < 3; ++k) form.products.back().factor[random() % n] = small();
    }
  }
  return form;
}

State rates(const QuadraticForm& form, const State& x) {
  State dx = form.constant;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j) dx[i] += form.linear[i][j] * x[j];
  for (const QuadraticForm::Product& p : form.products) {
    const double product =
        x[static_cast<std::size_t>(p.first)] * x[static_cast<std::size_t>(p.second)];
    for (std::size_t i = 0; i < x.size(); ++i) dx[i] += p.factor[i] * product;
  }
  return dx;
}

State start_of(const QuadraticForm& form) {
  State x;
  for (int i = 0; i < form.states; ++i) x.push_back(std::cos(i));
  return x;
}

State truth(const QuadraticForm& form, double duration) {
  namespace odeint = boost::numeric::odeint;
  State x = start_of(form);
  odeint::integrate_adaptive(
      odeint::make_controlled(1e-15, 1e-15, odeint::runge_kutta_fehlberg78<State>()),
      [&](const State& at, State& dx, double) { dx = rates(form, at); }, x, 0., duration, 0.01);
  return x;
}

double largest_gap(const State& a, const State& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]) / std::max(1., std::abs(b[i])));
  return std::isnan(largest) ? 1 : largest;
}

casimir_run run_for(double duration, double tolerance) {
  casimir_run run = {};
  run.t_end = duration;
  run.rtol = run.atol = tolerance;
  return run;
}

TEST(QuadraticKernel, EverySizeOnEveryInstructionSetAgreesWithOdeint) {
  for (int states = 1; states <= 24; ++states) {
    for (const bool every_product : {false, true}) {
      const QuadraticForm form = some_form(states, every_product);
      ASSERT_TRUE(has_quadratic_kernel(form));
      const State end = truth(form, 3);
      for (const std::string& target : quadratic_targets()) {
        const QuadraticKernel kernel(form, target);
        for (const double tolerance : {1e-4, 1e-7, 1e-15}) {  // the orders 8, 16 and 24
          State x = start_of(form);
          casimir_outcome out = {};
          const casimir_run run = run_for(3, tolerance);
          kernel.integrate(&run, x.data(), &out);
          ASSERT_EQ(out.status, CASIMIR_OK) << states << target;
          EXPECT_LT(largest_gap(x, end), 20 * tolerance + 2e-12) << states << target << tolerance;
          EXPECT_GT(largest_gap(start_of(form), end), 1e-3) << states;  // there is something to see
        }
      }
    }
  }
}

TEST(QuadraticKernel, OneFactorThatIsWrongIsSeen) {
  for (const int states : {6, 11, 19, 24}) {
    QuadraticForm form = some_form(states, true);
    const State end = truth(form, 3);
    for (double& factor : form.products.back().factor) factor *= 1 + 1e-6;
    for (const std::string& target : quadratic_targets()) {
      State x = start_of(form);
      casimir_outcome out = {};
      const casimir_run run = run_for(3, 1e-15);
      QuadraticKernel(form, target).integrate(&run, x.data(), &out);
      EXPECT_GT(largest_gap(x, end), 1e-11) << states << target;
    }
  }
}

TEST(QuadraticKernel, NoToleranceTakesManyMoreStepsThanTheOneBefore) {
  // A free rigid body. What millions of steps would show goes out of sight by degrees.
  const QuadraticForm form{
      .states = 3,
      .constant = State(3),
      .linear = {State(3), State(3), State(3)},
      .products = {{0, 1, {0, 0, -0.5}}, {0, 2, {0, 0.75, 0}}, {1, 2, {-0.25, 0, 0}}},
      .constant_rest = {},
      .linear_rest = {}};
  for (const std::string& target : quadratic_targets()) {
    const QuadraticKernel kernel(form, target);
    double before = 0, first = 0;
    for (int i = 0; i <= 12; ++i) {
      State x = {0.75, 0.5, 1};
      casimir_outcome out = {};
      const casimir_run run = run_for(500, 1e-12 * std::pow(10, -0.25 * i));
      kernel.integrate(&run, x.data(), &out);
      ASSERT_EQ(out.status, CASIMIR_OK);
      const auto steps = static_cast<double>(out.steps);
      if (i > 0) {
        EXPECT_LT(steps, 1.3 * before) << target << i;
      }
      if (i == 0) first = steps;
      before = steps;
    }
    EXPECT_GT(before, 1.5 * first) << target;  // 1e-15 aims at far less than it
  }
}

TEST(QuadraticKernel, MoreStatesThanItHasRoomForAreRefused) {
  const QuadraticForm form = some_form(25, false);
  EXPECT_FALSE(has_quadratic_kernel(form));
  for (const std::string& target : quadratic_targets())
    EXPECT_THROW(QuadraticKernel(form, target), std::invalid_argument);
  EXPECT_THROW(QuadraticKernel(some_form(3, true), "avx1024"), std::invalid_argument);
}

}  // namespace
}  // namespace casimir::test
