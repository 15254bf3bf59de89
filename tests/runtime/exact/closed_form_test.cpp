// Closed forms against runs with many digits and against Boost's elliptic functions with fifty, and
// what is refused.
#include "runtime/exact/closed_form.hpp"

#include <cln/rational_io.h>
#include <cln/real.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "runtime/uncompiled.hpp"
#include "tests/runtime/exact/forms.hpp"
#include "tests/runtime/programs.hpp"

namespace casimir::test {
namespace {

/// x_i' = c_i x_j x_k.
Program body(const Start& c) {
  Builder b({"x", "y", "z"});
  for (int i = 0; i < 3; ++i)
    b.output(b.op(Op::mul, b.number(c[static_cast<std::size_t>(i)]),
                  b.op(Op::mul, (i + 1) % 3, (i + 2) % 3)));
  return b.program();
}

/// q' = a p, p' = b sin q + c cos q.
Program pendulum(const Rational& a, const Rational& b_, const Rational& c) {
  Builder b({"q", "p"});
  const auto times = [&](const Rational& factor, int line) {
    return b.op(Op::mul, b.number(factor), line);
  };
  b.output(times(a, 1));
  const int sine = times(b_, b.op(Op::sin, 0));
  b.output(c == 0 ? sine : b.op(Op::add, sine, times(c, b.op(Op::cos, 0))));
  return b.program();
}

/// q' = a p, p' = f0 + f1 q + f2 q^2 + ..
Program force(const Rational& a, const Start& f) {
  Builder b({"q", "p"});
  b.output(b.op(Op::mul, b.number(a), 1));
  int sum = b.number(f.back());
  for (std::size_t k = f.size() - 1; k-- > 0;)
    sum = b.op(Op::add, b.op(Op::mul, sum, 0), b.number(f[k]));
  b.output(sum);
  return b.program();
}

/// Of what is evaluated in double precision.
constexpr double kRounded = 2e-14;

TEST(ClosedForm, FreeBodiesOfEveryKind) {
  const Rational half = Rational(1) / 2, third = Rational(1) / 3;
  // Signs of all kinds that stay bounded, each axis as the middle one, around both other axes.
  for (const Start& c : {Start{1, -2, 1}, Start{-1, 3, -half}, Start{-2, third, 5},
                         Start{1, 1, -third}, Start{third, -half, -1}})
    for (const Start& x :
         {Start{1, half, third}, Start{-1, half, third}, Start{third, -1, 1},
          Start{third, half, -1}, Start{0, 1, -half}, Start{1, 0, half}, Start{-half, 1, 0}})
      for (const Rational& t : {Rational(1) / 10, Rational(7), Rational(-100) / 3})
        EXPECT_LT(error(body(c), x, t), kRounded) << c[0] << ' ' << c[1] << ' ' << x[0] << ' ' << t;
}

TEST(ClosedForm, EqualMoments) {
  EXPECT_LT(error(body({1, -1, 0}), {1, 2, 3}, 50), kRounded);
  EXPECT_LT(error(body({0, 2, -2}), {-1, 2, 3}, 50), kRounded);
  EXPECT_EQ(error(body({0, 0, 0}), {1, 2, 3}, 50), 0);
}

// y^2 = A^2 m with m = 1: (1, 0, 1) of (1, -2, 1) is on the separatrix.
TEST(ClosedForm, SeparatricesOfTheFreeBody) {
  for (const Start& x : {Start{1, 0, 1}, Start{-1, 0, 1}, Start{1, 0, -1}, Start{-1, 0, -1}})
    for (const int t : {3, -10}) EXPECT_LT(error(body({1, -2, 1}), x, t), kRounded);
  EXPECT_LT(error(body({1, -2, 1}), {-3, 2, 3}, 3), kRounded);
  const Recognised found = closed_form(body({1, -2, 1}), exact({1, 0, 1}));
  EXPECT_TRUE(std::isfinite(found.form->horizon()));
}

TEST(ClosedForm, NextToASeparatrix) {
  const Rational tiny = Rational(1) / cln::expt(cln::cl_I(10), 25);
  EXPECT_LT(error(body({1, -2, 1}), {1, 0, 1 + tiny}, 200), 1e-12);
  EXPECT_LT(error(body({1, -2, 1}), {1, 0, 1 - tiny}, 200), 1e-12);
  EXPECT_LT(error(pendulum(1, -1, 0), {0, 2 - tiny}, 200), 1e-12);
  EXPECT_LT(error(pendulum(1, -1, 0), {0, 2 + tiny}, 200), 1e-12);
}

/// Three hundred digits do not tell where on the way along a separatrix these begin.
TEST(ClosedForm, OfSizesThatAreTooDifferentNothingIsSaid) {
  const auto part = [](int digits) { return Rational(1) / cln::expt(cln::cl_I(10), digits); };
  for (const int digits : {160, 200}) {
    const Start start{part(digits), 1, part(digits)};
    for (const Program& program : {body({-1, 1, -1}), body({1, -1, part(20)})}) {
      const Recognised found = closed_form(program, exact(start));
      if (found.form) EXPECT_LT(found.form->horizon(), 0) << digits;
    }
  }
}

TEST(ClosedForm, EquilibriaStayWhereTheyAre) {
  for (const Start& x : {Start{0, 5, 0}, Start{1, 0, 0}, Start{0, 0, 0}})
    EXPECT_EQ(error(body({1, -2, 1}), x, 1000), 0);
  EXPECT_EQ(error(pendulum(1, -1, 0), {0, 0}, 1000), 0);
  EXPECT_EQ(error(force(1, {0, 1, 0, -1}), {1, 0}, 1000), 0);
  EXPECT_EQ(error(force(1, {0, 1, 0, -1}), {0, 0}, 1000), 0);
  EXPECT_EQ(error(force(1, {15, -23, 9, -1}), {3, 0}, 20), 0);
}

TEST(ClosedForm, Pendulums) {
  const Rational half = Rational(1) / 2;
  for (const Start& x : {Start{half, 0}, Start{-3, half}, Start{1, 2}, Start{0, -3}, Start{7, 1},
                         Start{0, 2}, Start{0, -2}, Start{20, -5}})
    for (const Rational& t : {Rational(1) / 10, Rational(9), Rational(-40)}) {
      if (x[0] == 0 && cln::abs(x[1]) == 2 && cln::abs(t) > 10) continue;  // the separatrix
      EXPECT_LT(error(pendulum(1, -1, 0), x, t), kRounded) << x[0] << ' ' << x[1] << ' ' << t;
      EXPECT_LT(error(pendulum(-2, Rational(1) / 3, half), x, t), 4 * kRounded)
          << x[0] << ' ' << x[1];
    }
}

TEST(ClosedForm, PolynomialForces) {
  const Rational half = Rational(1) / 2;
  struct Case {
    Start f, x;
  };
  for (const auto& [f, x] : {
           Case{{0, -1}, {1, half}},         // harmonic
           Case{{half, -4}, {1, 0}},         // and displaced
           Case{{0, -1, 0, -1}, {1, half}},  // Duffing, one well
           Case{{0, -1, 0, -1}, {2, 0}},     // from a turning point
           Case{{0, 1, 0, -1}, {1, half}},   // two wells, inside
           Case{{0, 1, 0, -1}, {1, 1}},      // and around both
           Case{{0, 1, 0, -1}, {-1, -half}},
           Case{{0, -1, 0, Rational(1) / 6}, {1, 0}},   // soft
           Case{{0, -1, 1}, {half, Rational(1) / 10}},  // cubic potential
           Case{{Rational(1) / 10, -1, half, -half}, {half, 1}},
       })
    for (const Rational& t : {Rational(1) / 1000, Rational(1), Rational(-30)})
      EXPECT_LT(error(force(1, f), x, t), 10 * kRounded) << f.size() << ' ' << x[0] << ' ' << t;
  EXPECT_LT(error(force(-3, {0, half, 0, 2}), {1, 1}, 9), 10 * kRounded);
  // So soon after the start that the function has its pole there.
  EXPECT_LT(error(force(1, {0, -1}), {0, 1}, Rational(19) / 100000000), 1e-16);
  // Separatrices: of two wells q = sqrt(2) sech t, and of the cubic potential.
  EXPECT_LT(error(force(1, {0, -1, 1}), {0, 0}, 3), kRounded);
  EXPECT_LT(error(force(1, {0, 1, 0, -2}), {1, 0}, 5), 10 * kRounded);
}

// The whole turns are taken off exactly: a million periods later nothing is lost.
TEST(ClosedForm, AMillionPeriods) {
  using Big = boost::multiprecision::cpp_bin_float_100;
  // x' = y z, y' = -2 z x, z' = x y / 2 from (1, 0, 2): x = cn, y = -sqrt(2) .. as in
  // free_body.cpp.
  const Program program = body({1, -2, Rational(1) / 2});
  const Recognised found = closed_form(program, exact({1, 0, 2}));
  ASSERT_TRUE(found.form);
  const Big A = 1, D = 2, w = sqrt(Big(2)) * D, B = -2 * A * D / w, m = A * A / (2 * D * D);
  const Big k = sqrt(m), period = 4 * boost::math::ellint_1(k) / w;
  for (const double t : {1., 1e3, 2.5e6 + 1. / 3, 2.2e6}) {
    ASSERT_LT(Big(t) / period, 2e6);
    Big cn, dn;
    const Big u = fmod(w * Big(t), w * period), sn = boost::math::jacobi_elliptic(k, u, &cn, &dn);
    double x[3];
    found.form->at({t, 0}, x);
    EXPECT_NEAR(x[0], static_cast<double>(A * cn), 1e-14) << t;
    EXPECT_NEAR(x[1], static_cast<double>(B * sn), 1e-14) << t;
    EXPECT_NEAR(x[2], static_cast<double>(D * dn), 1e-14) << t;
  }
}

// Each hypothesis left out: a term more, signs by which there are poles, an unbounded start, the
// time, a parameter without a value, another degree.
TEST(ClosedForm, RefusesAllElse) {
  const auto refused = [](const Program& program, const Start& start) {
    const Recognised found = closed_form(program, exact(start));
    EXPECT_NE(found.form != nullptr, !found.reason.empty());
    return found.form == nullptr;
  };
  EXPECT_TRUE(refused(body({1, 2, 3}), {1, 1, 1}));
  EXPECT_TRUE(refused(body({1, 2, 0}), {1, 1, 1}));
  EXPECT_FALSE(refused(body({1, -2, 3}), {1, 1, 1}));
  Program bent = body({1, -2, 3});
  bent.code.push_back({Op::add, bent.outputs[0], 0});
  bent.outputs[0] = static_cast<int>(bent.code.size()) - 1;
  EXPECT_TRUE(refused(bent, {1, 1, 1}));
  Builder b({"q", "p"});
  b.output(1);
  b.output(b.op(Op::neg, b.op(Op::sin, 1)));  // of the momentum
  EXPECT_TRUE(refused(b.program(), {1, 1}));
  Builder driven({"q", "p"});
  driven.output(1);
  driven.output(driven.op(Op::sub, driven.time(), 0));
  EXPECT_TRUE(refused(driven.program(), {1, 1}));
  EXPECT_TRUE(refused(force(1, {0, 1}), {1, 0}));        // runs away
  EXPECT_TRUE(refused(force(1, {0, 0, 0, 1}), {1, 0}));  // in a finite time
  EXPECT_TRUE(refused(force(1, {0, -1, 1}), {2, 0}));    // beyond the barrier
  EXPECT_FALSE(refused(force(1, {0, -1, 1}), {Rational(1) / 2, 0}));
  EXPECT_TRUE(refused(force(1, {0, -1, 0, 0, 1}), {Rational(1) / 2, 0}));  // degree four
  EXPECT_TRUE(refused(force(1, {1}), {0, 0}));                             // free fall
  // Beside an unstable rest the difference of p and c loses the digits: 2e-6 of q were wrong.
  const Rational tiny = Rational(1) / 1000000000000;
  EXPECT_TRUE(refused(force(1, {0, 1, 0, -1}), {tiny, 0}));
  EXPECT_TRUE(refused(force(1, {0, 1, 0, -1}), {tiny * tiny, 0}));
  EXPECT_FALSE(refused(force(1, {0, 1, 0, -1}), {Rational(1) / 10, 0}));
}

TEST(ClosedForm, RunsFromTheStartAndFromElsewhere) {
  const Program program = body({1, -2, 1});
  const Start start{1, Rational(1) / 2, Rational(1) / 3};
  const std::vector<double> x0{1, 0.5, 1. / 3};
  ModuleFunctions functions = uncompiled_module(program, {}, {}, {}).functions();
  functions.integrate =
      exact_integration(program, exact(start), x0, closed_form(program, exact(start)).form);
  const Module module = Module::from_functions(functions);
  Settings settings;
  settings.duration = 10;
  settings.sample_every = 2.5;
  const Trajectory whole = integrate(module, *find_method("exact"), settings, x0);
  ASSERT_EQ(whole.status, Status::ok);
  ASSERT_EQ(whole.samples.size(), 5u);
  settings.duration = 7.5;
  const Trajectory rest = integrate(module, *find_method("exact"), settings, whole.samples[1]);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(rest.state[i], whole.state[i], kRounded);
}

}  // namespace
}  // namespace casimir::test
