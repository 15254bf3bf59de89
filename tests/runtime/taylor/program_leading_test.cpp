// The leading terms of Taylor steps in more digits than doubles have, from a program.
#include "runtime/taylor/program_leading.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/integrate.hpp"
#include "runtime/methods.hpp"
#include "runtime/uncompiled.hpp"
#include "tests/runtime/programs.hpp"

namespace casimir::test {
namespace {

/// A pendulum whose length is a parameter, pulled by exp(-t).
Program pendulum(bool pulled) {
  Builder b({"q", "p", "w"});
  const int force = b.op(Op::neg, b.op(Op::mul, 2, b.op(Op::sin, 0)));
  const int pull = b.op(Op::exp, b.op(Op::neg, b.time()));
  b.output(1);
  b.output(pulled ? b.op(Op::add, force, pull) : force);
  return b.program();
}

/// x + carry + c1 s + c2 s^2 + tail s^3 with 60 digits.
std::vector<cln::cl_F> exact_step(const Program& rhs, double w, double t, double unit, double s,
                                  const double* x, const double* carry, const double* tail) {
  const Arithmetic<cln::cl_F> m(60);
  const auto number = [&](double v) { return m.from(cln::rational(cln::cl_DF(v))); };
  TaylorJet<cln::cl_F> jet(rhs, m, {number(w)}, CASIMIR_LEADING);
  std::vector<cln::cl_F> state;
  for (std::size_t i = 0; i < rhs.outputs.size(); ++i)
    state.push_back(number(x[i]) + number(carry[i]));
  const auto series = jet.expand(number(t), state, number(unit));
  for (std::size_t i = 0; i < state.size(); ++i)
    state[i] =
        series[i][0] +
        number(s) * (series[i][1] + number(s) * (series[i][2] + number(s) * number(tail[i])));
  return state;
}

TEST(ProgramLeading, StepsAreExactBeyondDoubles) {
  const Program rhs = pendulum(true);
  const double w = 1.7, t = 0.3, unit = 0.25;
  const ProgramLeading leading(rhs, &w);
  const casimir_leading view = leading.view();
  const Arithmetic<cln::cl_F> m(60);
  double worst = 0, seen = 0;
  for (const double s : {0.1, 0.7, 1.3}) {
    for (const double q : {0.4, -2.9, 3.7}) {
      double x[8] = {q, 1 / q}, carry[8] = {1e-17 * q, -3e-18}, tail[8] = {0.013, -0.21};
      const auto exact = exact_step(rhs, w, t, unit, s, x, carry, tail);
      view.add(view.object, t, unit, s, x, carry, tail);
      for (int i = 0; i < 2; ++i) {
        const cln::cl_F error = m.from(cln::rational(cln::cl_DF(x[i]))) +
                                m.from(cln::rational(cln::cl_DF(carry[i]))) -
                                exact[static_cast<std::size_t>(i)];
        worst = std::max(worst, std::abs(cln::double_approx(error)));
        seen = std::max(seen, std::abs(carry[i]));
      }
    }
  }
  EXPECT_LT(worst, 1e-18);
  EXPECT_GT(worst, 0);
  EXPECT_GT(seen, 1e-17);  // a double alone would have lost this
}

TEST(ProgramLeading, DoesNotServeProgramsThatBranch) {
  EXPECT_TRUE(ProgramLeading::serves(pendulum(true)));
  for (const Op branch : {Op::abs, Op::sign, Op::asin, Op::acos}) {
    Builder b({"q"});
    b.output(b.op(branch, 0));
    EXPECT_FALSE(ProgramLeading::serves(b.program()));
  }
}

/// The largest change of energy of the pendulum in a run of some 30,000 periods.
double drift_of(const Module& module) {
  const auto energy = [](double q, double p) {
    const long double half = std::sin(static_cast<long double>(q) / 2);
    return static_cast<long double>(p) * p / 2 + 2 * half * half;
  };
  Settings settings;
  settings.duration = 2e5;
  settings.rtol = settings.atol = 1e-15;
  long double drift = 0;
  settings.watch = [&](double, const double* x) {
    drift = std::max(drift, std::abs(energy(x[0], x[1]) - energy(0.1, 1.2)));
  };
  const Trajectory run = integrate(module, *find_method("taylor"), settings, {0.1, 1.2}, {1});
  EXPECT_EQ(run.status, Status::ok);
  return static_cast<double>(drift);
}

TEST(ProgramLeading, LongRunsAreRoundedLess) {
  const Program rhs = pendulum(false);
  Module module = uncompiled_module(rhs, {}, std::nullopt, {1});
  ASSERT_NE(module.exact_rates(), nullptr);
  const double careful = drift_of(module);
  const double plain = drift_of(Module::from_functions(module.functions()));
  EXPECT_GT(careful, 0);
  EXPECT_LT(careful, 1e-15);
  // By 2.2 (SSE2) to 3.9 (AVX-512): what is left is the rounding of the states that are shown.
  EXPECT_LT(careful, plain / 2);
}

TEST(ProgramLeading, TermsThatAreNoNumbersAreLeftOut) {
  const Module module = uncompiled_module(pendulum(false), {}, std::nullopt, {1});
  const casimir_leading none = {
      nullptr, 0,
      [](const void*, double, double, double, double* x, double*, const double*) { x[0] = NAN; }};
  const double length = 1;
  double end[2][2] = {{0.1, 1.2}, {0.1, 1.2}};
  for (int k = 0; k < 2; ++k) {
    casimir_run run = {};
    run.t_end = 10;
    run.parameters = &length;
    run.rtol = run.atol = 1e-15;
    run.leading = k == 0 ? nullptr : &none;
    casimir_outcome out = {};
    module.functions().integrate(&run, end[k], &out);
    EXPECT_EQ(out.status, CASIMIR_OK);
  }
  EXPECT_NEAR(end[0][0], end[1][0], 1e-13);
  EXPECT_NEAR(end[0][1], end[1][1], 1e-13);
}

}  // namespace
}  // namespace casimir::test
