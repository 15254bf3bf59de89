// Programs of systems that have closed forms, and how far those are from runs with many digits.
#pragma once

#include <cln/rational_io.h>
#include <cln/real.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/digits/agreed_run.hpp"
#include "runtime/exact/closed_form.hpp"
#include "runtime/exact/polynomial_field.hpp"
#include "tests/runtime/programs.hpp"

namespace casimir::test {

using Rational = cln::cl_RA;
using Start = std::vector<Rational>;

inline std::vector<cln::cl_F> exact(const Start& start) {
  std::vector<cln::cl_F> result;
  for (const Rational& x : start)
    result.push_back(cln::cl_float(x, cln::float_format(kExactDigits)));
  return result;
}

/// The state after that time, by a run with many digits.
inline std::vector<double> run_state(const Program& program, const Start& start,
                                     const Rational& duration, int digits = 20) {
  PreciseProblem problem;
  problem.rhs = &program;
  problem.start = [&](int) {
    std::vector<cln::cl_R> all(start.begin(), start.end());
    all.push_back(duration);
    return all;
  };
  const AgreedRun truth = agreed_run(problem, digits);
  EXPECT_EQ(truth.run.status, Status::ok) << truth.run.reason;
  std::vector<double> state;
  for (const cln::cl_F& at : truth.run.state) state.push_back(cln::double_approx(at));
  return state;
}

/// The state after that time, by the closed form; empty where there is none.
inline std::vector<double> closed_state(const Program& program, const Start& start,
                                        const Rational& duration) {
  const Recognised found = closed_form(program, exact(start));
  EXPECT_TRUE(found.form) << found.reason;
  if (!found.form) return {};
  std::vector<double> x(start.size());
  const double t = cln::double_approx(duration);
  found.form->at({t, cln::double_approx(duration - cln::rational(cln::cl_DF(t)))}, x.data());
  return x;
}

/// The error of the closed form after that time, against a run with twenty digits.
inline double error(const Program& program, const Start& start, const Rational& duration) {
  const std::vector<double> x = closed_state(program, start, duration);
  const std::vector<double> truth = run_state(program, start, duration);
  double size = 1, worst = x.empty() ? 1 : 0;
  for (const double at : truth) size = std::max(size, std::abs(at));
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double off = std::abs(x[i] - truth[i]) / size;
    if (!(off <= worst)) worst = off;  // also what is no number
  }
  return worst;
}

/// Sums of products of states, written as factor, state, state (or -1).
struct Monomial {
  Rational factor;
  int a, b = -1;
};
inline void add_rate(Builder& b, const std::vector<Monomial>& terms) {
  int sum = b.number(0);
  for (const auto& [factor, x, y] : terms) {
    if (factor == 0) continue;
    int term = b.op(Op::mul, b.number(factor), x);
    if (y >= 0) term = b.op(Op::mul, term, y);
    sum = b.op(Op::add, sum, term);
  }
  b.output(sum);
}

}  // namespace casimir::test
