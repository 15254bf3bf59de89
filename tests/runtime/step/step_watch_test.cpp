#include "runtime/step/step_watch.hpp"

#include <cln/dfloat.h>
#include <cln/integer.h>
#include <cln/rational.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/integrate.hpp"
#include "runtime/methods.hpp"
#include "runtime/step/step_look.hpp"
#include "runtime/uncompiled.hpp"
#include "tests/runtime/programs.hpp"

namespace casimir::test {
namespace {

Trajectory watched_run(const Program& rhs, std::vector<double> start, double duration,
                       bool looks = true, double begin = 0) {
  Module module = uncompiled_module(rhs, {}, std::nullopt, {});
  if (!looks) module = Module::from_functions(module.functions());
  Settings settings;
  settings.begin = begin;
  settings.duration = duration;
  settings.rtol = 1e-15;
  settings.atol = 1e-18;
  return integrate(module, *find_method("taylor"), settings, start);
}

/// x' = |t - c|
Program modulus(const cln::cl_RA& corner) {
  Builder lines({"x"});
  const int t = lines.time();
  lines.output(lines.op(Op::abs, lines.op(Op::sub, t, lines.number(corner))));
  return lines.program();
}

/// x' = exp(-((t - 3)/w)^2)/w, of which the integral is sqrt(Pi).
Program pulse(const cln::cl_RA& width) {
  Builder lines({"x"});
  const int w = lines.number(width);
  const int z = lines.op(Op::div, lines.op(Op::sub, lines.time(), lines.number(3)), w);
  const int u = lines.op(Op::neg, lines.op(Op::mul, z, z));
  lines.output(lines.op(Op::div, lines.op(Op::exp, u), w));
  return lines.program();
}

/// x' = (1 - tanh((t - 3)/w)^2)/(2 w), of which the integral is 1; or the same as 1/(2 w cosh^2).
Program front(const cln::cl_RA& width, bool by_cosh) {
  Builder lines({"x"});
  const int w = lines.number(width);
  const int z = lines.op(Op::div, lines.op(Op::sub, lines.time(), lines.number(3)), w);
  const int f = lines.op(by_cosh ? Op::cosh : Op::tanh, z), square = lines.op(Op::mul, f, f);
  const int slope = by_cosh ? lines.op(Op::div, lines.number(1), square)
                            : lines.op(Op::sub, lines.number(1), square);
  lines.output(lines.op(Op::div, slope, lines.op(Op::mul, lines.number(2), w)));
  return lines.program();
}

TEST(StepWatch, FrontsOfHyperbolicFunctionsAreNotSteppedOver) {
  const cln::cl_RA width = cln::cl_RA(1) / 100;  // 300 before the front: cosh^2 is a number still
  for (const bool by_cosh : {false, true}) {
    const Trajectory seen = watched_run(front(width, by_cosh), {0}, 4);
    ASSERT_EQ(seen.status, Status::ok) << seen.reason;
    EXPECT_NEAR(seen.state[0], 1, 1e-12) << by_cosh;
  }
  // The twin: without looking, the front is not met.
  const Trajectory blind = watched_run(front(width, false), {0}, 4, false);
  EXPECT_EQ(blind.state[0], 0);
}

TEST(StepWatch, PolynomialsOfLowDegreeHaveNothingToWatch) {
  Builder lines({"x"});
  const int x = 0;
  lines.output(lines.op(Op::mul, x, x));
  const Program square = lines.program();
  EXPECT_TRUE(StepWatch(square).empty());
  EXPECT_EQ(uncompiled_module(square, {}, std::nullopt, {}).watch(), nullptr);
}

TEST(StepWatch, HighPowersAreWatchedOnceEach) {
  Builder lines({"x"});
  int power = 0;
  for (int i = 0; i < 4; ++i) power = lines.op(Op::mul, power, power);
  lines.output(power);
  const StepWatch watch(lines.program());
  ASSERT_EQ(watch.watched().size(), 1U);
  EXPECT_EQ(watch.watched()[0].kind, StepWatch::Kind::power);
  EXPECT_EQ(watch.watched()[0].exponent, 16);
}

TEST(StepWatch, QuotientsAreWatchedThatNoTailAnnounces) {
  const auto watched = [](int sum_of_squares, int power, bool root) {
    Builder lines({"x", "y"});
    int below = lines.op(Op::mul, 0, 0);
    if (sum_of_squares) below = lines.op(Op::add, below, lines.op(Op::mul, 1, 1));
    if (root) below = lines.op(Op::sqrt, below);
    int product = below;
    for (int i = 1; i < power; ++i) product = lines.op(Op::mul, product, below);
    const int rate = lines.op(Op::div, 1, product);
    lines.output(rate);
    lines.output(rate);
    const StepWatch watch(lines.program());
    return watch.looks(nullptr, nullptr) ? watch.watched()[0].exponent : 0;
  };
  EXPECT_EQ(watched(true, 3, true), 0);  // of Kepler's problem
  EXPECT_EQ(watched(true, 1, false), 0);
  EXPECT_EQ(watched(true, 2, false), 2);
  EXPECT_EQ(watched(true, 7, true), 3.5);
  EXPECT_EQ(watched(false, 1, false), 0);
  EXPECT_EQ(watched(false, 2, false), 4);  // 1/x^4

  Builder squared({"x"});  // (1/x^2)^2
  const int one = squared.op(Op::div, squared.number(1), squared.op(Op::mul, 0, 0));
  squared.output(squared.op(Op::mul, one, one));
  ASSERT_EQ(StepWatch(squared.program()).watched().size(), 1U);
  EXPECT_EQ(StepWatch(squared.program()).watched()[0].exponent, 4);

  for (const bool fourth : {false, true}) {
    Builder tangent({"x"});  // tan(x)^4: of cos(x)
    const int tan = tangent.op(Op::tan, 0), square = tangent.op(Op::mul, tan, tan);
    tangent.output(fourth ? tangent.op(Op::mul, square, square) : square);
    EXPECT_EQ(StepWatch(tangent.program()).looks(nullptr, nullptr), fourth);
  }
}

/// q' = p, p' = c/q^3
Program repelled(const cln::cl_RA& strength, bool by_parameter) {
  Builder lines = by_parameter ? Builder({"q", "p", "c"}) : Builder({"q", "p"});
  const int c = by_parameter ? 2 : lines.number(strength);
  lines.output(1);
  lines.output(lines.op(Op::div, c, lines.op(Op::mul, 0, lines.op(Op::mul, 0, 0))));
  return lines.program();
}

/// A tail that any method sees is below its tolerance where its factor is next to nothing.
TEST(StepWatch, LowerQuotientsAreWatchedWhereNumbersAreExtreme) {
  const cln::cl_RA small = cln::cl_RA(1) / cln::expt(cln::cl_I(10), 20);
  EXPECT_FALSE(StepWatch(repelled(1, false)).looks(nullptr, nullptr));
  EXPECT_TRUE(StepWatch(repelled(small, false)).looks(nullptr, nullptr));

  const StepWatch by_parameter(repelled(1, true));
  EXPECT_FALSE(by_parameter.empty());
  const double usual = 0.5, tiny = 1e-20, at[] = {1, 2}, far[] = {1e12, 2};
  EXPECT_FALSE(by_parameter.looks(&usual, at));
  EXPECT_TRUE(by_parameter.looks(&tiny, at));
  EXPECT_TRUE(by_parameter.looks(&usual, far));
}

/// q^2 = (3 - t)^2 + c t^2/9: from the wall at 0 it comes back.
TEST(Steps, DoNotPassAWallOverThatNoTailAnnounces) {
  const cln::cl_RA small = cln::cl_RA(1) / cln::expt(cln::cl_I(10), 20);
  const Trajectory orbit = watched_run(repelled(small, false), {3, -1}, 5);
  ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
  EXPECT_NEAR(orbit.state[0], 2, 1e-5);  // the turn is 1e-10 wide
  EXPECT_NEAR(orbit.state[1], 1, 1e-5);
  EXPECT_NEAR(watched_run(repelled(small, false), {3, -1}, 5, false).state[0], -2, 1e-9);
}

/// x' = sqrt((t - 3)^2 + 10^(-24)) and log((t - 3)^2 + 10^(-24)) turn within 1e-12.
TEST(StepWatch, RootsAndLogarithmsAreWatchedWhereTheyTurnLikeKinks) {
  for (const Op op : {Op::sqrt, Op::log}) {
    Builder lines({"x"});
    const int z = lines.op(Op::sub, lines.time(), lines.number(3));
    const int width = lines.number(cln::cl_RA(1) / cln::expt(cln::cl_I(10), 24));
    const int u = lines.op(Op::add, lines.op(Op::mul, z, z), width);
    lines.output(lines.op(op, u));
    const Program rhs = lines.program();
    const StepWatch watch(rhs);
    EXPECT_TRUE(watch.looks(nullptr, nullptr));
    const Trajectory orbit = watched_run(rhs, {0}, 5);
    ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
    // Of |z|, and of 2 log|z|.
    const double truth = op == Op::sqrt ? 6.5 : 2 * (3 * std::log(3.) - 3 + 2 * std::log(2.) - 2);
    EXPECT_NEAR(orbit.state[0], truth, 1e-11);
  }
}

/// x' = 1 + 1/w/(1 + ((t - 3)/w)^2)^4: 5 pi/16 more than the time.
TEST(Steps, DoNotPassAPeakOfAQuotientOver) {
  for (const int inverse_width : {100, 10000, 1000000}) {
    Builder lines({"x"});
    const int w = lines.number(inverse_width);
    const int z = lines.op(Op::mul, lines.op(Op::sub, lines.time(), lines.number(3)), w);
    const int q = lines.op(Op::add, lines.number(1), lines.op(Op::mul, z, z));
    const int q2 = lines.op(Op::mul, q, q);
    const int peak = lines.op(Op::div, w, lines.op(Op::mul, q2, q2));
    lines.output(lines.op(Op::add, lines.number(1), peak));
    const Program rhs = lines.program();
    const Trajectory orbit = watched_run(rhs, {0}, 20);
    ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
    // Next to t = 3 the time rounds by up to 0x1p-52, and x changes by inverse_width in each unit.
    const double rounding = 2 * 0x1p-52 * inverse_width;
    EXPECT_NEAR(orbit.state[0], 20 + 5 * std::acos(-1) / 16, std::max(1e-10, rounding))
        << inverse_width;
    EXPECT_LT(orbit.steps, 300U) << inverse_width;
    if (inverse_width >= 10000) {
      EXPECT_LT(watched_run(rhs, {0}, 20, false).state[0], 20.1);
    }
  }
}

/// x' = (1 + sign(sin(t) - c))/2 is 1 for a short while in each turn, and all that moves.
TEST(Steps, DoNotPassAShortSignOver) {
  Builder lines({"x"});
  const cln::cl_RA threshold = cln::cl_RA(99) / 100;
  const int u = lines.op(Op::sub, lines.op(Op::sin, lines.time()), lines.number(threshold));
  const int sum = lines.op(Op::add, lines.number(1), lines.op(Op::sign, u));
  lines.output(lines.op(Op::div, sum, lines.number(2)));
  const Program rhs = lines.program();
  const Trajectory orbit = watched_run(rhs, {0}, 60);
  ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
  EXPECT_NEAR(orbit.state[0], 10 * 2 * std::acos(0.99), 1e-11);  // ten times
  EXPECT_EQ(watched_run(rhs, {0}, 60, false).state[0], 0);
}

/// x' = 10^60 exp(-130 - (100 (t - 3))^2), whose exponential is never above e^-130.
TEST(Steps, DoNotPassAPulseOverThatALargeFactorMakes) {
  Builder lines({"x"});
  const int z =
      lines.op(Op::mul, lines.op(Op::sub, lines.time(), lines.number(3)), lines.number(100));
  const int u = lines.op(Op::neg, lines.op(Op::add, lines.number(130), lines.op(Op::mul, z, z)));
  const cln::cl_RA factor = cln::expt(cln::cl_I(10), 60);
  lines.output(lines.op(Op::mul, lines.number(factor), lines.op(Op::exp, u)));
  const Trajectory orbit = watched_run(lines.program(), {0}, 20);
  ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
  const double truth = std::sqrt(std::acos(-1)) / 100 * 1e60 * std::exp(-130);
  EXPECT_NEAR(orbit.state[0] / truth, 1, 1e-12);
}

TEST(Steps, EndWhereAModulusTurns) {
  for (const double c : {0.5, 1.0, 2.25}) {
    const Trajectory orbit = watched_run(modulus(cln::rational(cln::cl_DF(c))), {0}, 5);
    ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
    EXPECT_NEAR(orbit.state[0], (c * c + (5 - c) * (5 - c)) / 2, 1e-13) << c;
    EXPECT_LT(orbit.steps, 30U);
  }
}

/// At exactly zero the first term that is not zero says on which side the series begins.
TEST(Steps, BeginAtTheCornerOfAModulusInBothDirections) {
  for (const double way : {1., -1.}) {
    const Trajectory orbit = watched_run(modulus(0), {0}, 2 * way);
    ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
    EXPECT_NEAR(orbit.state[0], 2 * way, 1e-14);
  }
}

/// x' = |t^2 - 1/1000 - 2 t + 1|: below zero between 1 - 0.0316 and 1 + 0.0316.
TEST(Steps, SeeADipOfAModulusBetweenTheirEnds) {
  Builder lines({"x"});
  const int z = lines.op(Op::sub, lines.time(), lines.number(1));
  const int u = lines.op(Op::sub, lines.op(Op::mul, z, z), lines.number(cln::cl_RA(1) / 1000));
  lines.output(lines.op(Op::abs, u));
  const Program dip = lines.program();
  const double d = std::sqrt(1e-3), whole = 2. / 3 - 2e-3;
  const Trajectory orbit = watched_run(dip, {0}, 2);
  ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
  EXPECT_NEAR(orbit.state[0], whole + 2 * (2 * d * d * d - 2 * d * d * d / 3), 1e-13);
}

/// A step along which the clock goes on: x' = 1.
casimir_step step_of_clock(const double* from, const double* to) {
  return {.t0 = *from,
          .t1 = *to,
          .x0 = from,
          .x1 = to,
          .dense = [](const casimir_step*, double t, double* x) { *x = t; },
          .data = nullptr,
          .f0 = nullptr,
          .f1 = nullptr};
}

/// 1/(1 + exp(10^7 ((x - 3)^2 - 1/100))) is nothing far from 3, where the exponential is infinity
/// in double and changes by e^(10^7) in a step: but not where numbers have no largest one.
TEST(Steps, DoNotResolveExponentialsBeyondAllDoubles) {
  Builder lines({"x"});
  const int u = lines.op(Op::sub, 0, lines.number(3));
  const int gap = lines.op(Op::sub, lines.op(Op::mul, u, u), lines.number(cln::cl_RA(1) / 100));
  const int e = lines.op(Op::exp, lines.op(Op::mul, lines.number(10000000), gap));
  lines.output(lines.op(Op::div, lines.number(1), lines.op(Op::add, lines.number(1), e)));
  const Program rhs = lines.program();
  const StepWatch watch(rhs);
  const double zero = 0, one = 1, two = 2, four = 4;
  StepLook look(watch, 1, nullptr, &zero);
  EXPECT_EQ(look(step_of_clock(&zero, &one)), 1);
  EXPECT_LT(look(step_of_clock(&two, &four)), 1) << "the box lies in it";
  StepLook many(watch, 1, nullptr, &zero);
  many.no_largest_number();
  EXPECT_LT(many(step_of_clock(&zero, &one)), 1);
}

/// 100 e^u/(1 + e^u)^2 where its square is beyond all doubles: only in tiny units are the
/// coefficients numbers, and a run in steps of their size would not end.
TEST(Steps, DoNotCreepWhereCoefficientsAreBeyondAllDoubles) {
  Builder lines({"x"});
  const int u = lines.op(Op::mul, lines.number(100), lines.time());
  const int e = lines.op(Op::exp, u), one = lines.op(Op::add, lines.number(1), e);
  const int above = lines.op(Op::mul, lines.number(100), e);
  lines.output(lines.op(Op::div, above, lines.op(Op::mul, one, one)));
  const Trajectory orbit = watched_run(lines.program(), {0}, 6, true, -1);
  EXPECT_EQ(orbit.status, Status::non_finite);
  EXPECT_LT(orbit.steps, 200000U);
}

/// x' = -sign(x) sqrt|x| stays at 0 from t = 2 on, between two fields that point at each other,
/// where the equations have a jump for doubles: steps end behind it for ever.
TEST(Steps, DoNotChatterForLong) {
  Builder lines({"x"});
  const int root = lines.op(Op::sqrt, lines.op(Op::abs, 0));
  lines.output(lines.op(Op::neg, lines.op(Op::mul, lines.op(Op::sign, 0), root)));
  const Trajectory orbit = watched_run(lines.program(), {1}, 5);
  EXPECT_NE(orbit.status, Status::ok);
  EXPECT_GE(orbit.time, 2 - 1e-9);
  EXPECT_LT(orbit.steps + orbit.rejected, 500000U);
}

TEST(Steps, DoNotPassAPulseOver) {
  const double area = std::sqrt(std::acos(-1));
  for (const int inverse_width : {10, 100, 1000, 10000}) {
    const Program rhs = pulse(cln::cl_RA(1) / inverse_width);
    const Trajectory orbit = watched_run(rhs, {0}, 20);
    ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
    // Rounding the time moves a pulse by 1e-15, a ten billionth of the narrowest one.
    EXPECT_NEAR(orbit.state[0], area, inverse_width > 1000 ? 1e-11 : 1e-12) << inverse_width;
    EXPECT_LT(orbit.steps, 300U) << inverse_width;
  }
  // Without the look it is gone.
  EXPECT_LT(watched_run(pulse(cln::cl_RA(1) / 1000), {0}, 20, false).state[0], 1e-3);
}

/// Two peaks, between which the exponent is at the beginning, within and at the end of a step what
/// it is on the other side of one: exp(-10^5 (x - 0.3)^2 (x + 0.7)^2) along an oscillator.
TEST(Steps, DoNotPassOneOfTwoPeaksOver) {
  Builder lines({"x", "v", "y"});
  const int a = lines.op(Op::sub, 0, lines.number(cln::cl_RA(3) / 10));
  const int b = lines.op(Op::add, 0, lines.number(cln::cl_RA(7) / 10));
  const int product = lines.op(Op::mul, a, b), square = lines.op(Op::mul, product, product);
  const int u = lines.op(Op::mul, lines.number(-100000), square);
  lines.output(1);
  lines.output(lines.op(Op::neg, 0));
  lines.output(lines.op(Op::exp, u));
  const Program rhs = lines.program();
  for (const auto& [v, truth] : {std::pair{0., 0.17057071128447514}, {0.1, 0.16924439278900793}}) {
    const Trajectory orbit = watched_run(rhs, {1, v, 0}, 40);
    ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
    EXPECT_NEAR(orbit.state[2], truth, 1e-12) << v;
  }
}

/// x' = sqrt(1 - t) ends at t = 1.
/// A motion that sets out slowly, cos(t), is about as far from the pulse at c at the beginning of a
/// step, a third on its way and at its end, on the other side: none of the three shows it.
TEST(Steps, DoNotPassAPulseOverThatIsReachedFromRest) {
  Builder lines({"q", "p"});
  const int w = lines.number(cln::cl_RA(1) / 1000), c = lines.number(cln::cl_RA(14) / 25);
  const int z = lines.op(Op::div, lines.op(Op::sub, 0, c), w);
  const int force = lines.op(Op::exp, lines.op(Op::neg, lines.op(Op::mul, z, z)));
  lines.output(1);
  lines.output(lines.op(Op::sub, force, 0));
  const StepWatch watch(lines.program());
  const auto dense = [](const casimir_step*, double t, double* x) {
    x[0] = std::cos(t);
    x[1] = -std::sin(t);
  };
  const double x0[] = {1, 0};
  for (double h = 1.2; h < 1.5; h += 0.01) {
    const double x1[] = {std::cos(h), -std::sin(h)};
    const casimir_step trial = {0, h, x0, x1, dense, nullptr, nullptr, nullptr};
    StepLook look(watch, 2, nullptr, x0);
    EXPECT_LT(look(trial), 1) << h;
  }
}

TEST(Steps, EndWhereARootLosesItsRealValue) {
  Builder lines({"x"});
  const int u = lines.op(Op::sub, lines.number(1), lines.time());
  lines.output(lines.op(Op::sqrt, u));
  const Trajectory orbit = watched_run(lines.program(), {0}, 2);
  EXPECT_NE(orbit.status, Status::ok);
  EXPECT_NEAR(orbit.time, 1, 1e-6);
}

TEST(Settings, ARunBeginsAtAnyTime) {
  const Trajectory orbit = watched_run(modulus(0), {0}, 2, true, 3);
  ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
  EXPECT_NEAR(orbit.state[0], 8, 1e-13);
  EXPECT_EQ(orbit.time, 5);
}

}  // namespace
}  // namespace casimir::test
