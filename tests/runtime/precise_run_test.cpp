// Multiprecision runs against closed forms, and what they say where there is no end to reach.
#include <cln/float_io.h>
#include <cln/input.h>
#include <cln/integer_io.h>
#include <cln/real_io.h>
#include <gtest/gtest.h>

#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "runtime/digits/agreed_run.hpp"
#include "runtime/digits/big_float.hpp"
#include "tests/runtime/programs.hpp"

namespace casimir::test {
namespace {

cln::cl_F decimal(const std::string& text) {
  const cln::float_format_t format = cln::float_format(300);
  const cln::cl_read_flags flags = {
      cln::syntax_float, cln::lsyntax_standard, 10, {format, format, false}};
  return cln::cl_float(cln::read_float(flags, text.c_str(), nullptr, nullptr), format);
}

/// The program with exact numbers: initial values, then the duration.
PreciseProblem problem(const Program& program, const std::vector<cln::cl_R>& start) {
  PreciseProblem result;
  result.rhs = &program;
  result.start = [start](int) { return start; };
  return result;
}

/// x' = x^2, whose solution from 1 is 1/(1 - t).
Program riccati() {
  Builder b({"x"});
  b.output(b.op(Op::mul, 0, 0));
  return b.program();
}

Program pendulum() {
  Builder b({"q", "p"});
  b.output(1);
  b.output(b.op(Op::neg, b.op(Op::sin, 0)));
  return b.program();
}

TEST(PreciseRun, SquareReachesOneMillionToAllDigits) {
  const Program program = riccati();
  for (const int digits : {17, 50, 200}) {
    const AgreedRun agreed =
        agreed_run(problem(program, {1, cln::cl_RA("999999/1000000")}), digits);
    ASSERT_EQ(agreed.run.status, Status::ok) << agreed.run.reason;
    EXPECT_EQ(agreed.digits, digits);
    const cln::cl_F truth = cln::cl_float(1000000, cln::float_format(300));
    EXPECT_EQ(agreed_digits(agreed.run.state[0], truth, digits), digits);
  }
}

/// Rounding takes x off 0, and no two runs agree in what it leaves there: they once went on to 280
/// digits. x' = y (z a) - z (y a), with a rounded, and a rotation of y and z.
TEST(PreciseRun, StatesThatStayZeroTakeNoMoreDigits) {
  Builder b({"x", "y", "z"});
  const int a = b.number(cln::cl_RA("1/7"));
  const auto mul = [&](int p, int q) { return b.op(Op::mul, p, q); };
  b.output(b.op(Op::add, b.op(Op::sub, mul(1, mul(2, a)), mul(2, mul(1, a))), 0));
  b.output(b.op(Op::neg, 2));
  b.output(b.op(Op::add, 1, 0));
  const Program program = b.program();
  const AgreedRun agreed = agreed_run(problem(program, {0, 1, cln::cl_RA("1/3"), 20}), 30);
  EXPECT_EQ(agreed.digits, 30);
  EXPECT_EQ(agreed.runs, 2);
  EXPECT_TRUE(cln::zerop(agreed.run.state[0]));
}

/// x' = 10^60 (x - 1)^2 from x = 1 + 10^-60 has its pole at t = 1. To 30 digits x is 1 at the
/// start, where the equation rests: two runs that begin there agree.
TEST(PreciseRun, AStartThatRoundsToARestIsFollowedWithMoreDigits) {
  Builder b({"x"});
  const int one = b.number(1), factor = b.number(cln::expt(cln::cl_RA(10), 60));
  const int away = b.op(Op::sub, 0, one);
  b.output(b.op(Op::mul, factor, b.op(Op::mul, away, away)));
  const Program program = b.program();
  const cln::cl_R start = 1 + cln::expt(cln::cl_RA(10), -60);
  const AgreedRun agreed = agreed_run(problem(program, {start, 2}), 30);
  ASSERT_EQ(agreed.run.status, Status::singularity) << agreed.run.reason;
  ASSERT_TRUE(agreed.run.singular_time);
  EXPECT_NEAR(cln::double_approx(*agreed.run.singular_time), 1, 1e-9);
  // The twin rests.
  const AgreedRun rest = agreed_run(problem(program, {1, 2}), 30);
  EXPECT_EQ(rest.run.status, Status::ok);
  EXPECT_EQ(rest.digits, 30);
}

TEST(PreciseRun, NumbersNextToNothingTakeNoMemory) {
  const Precision precision(128);
  const BigFloat tiny =
      Arithmetic<BigFloat>{}.function(Op::exp, BigFloat(cln::cl_I("-1000000000000000")));
  const cln::cl_F number = to_cln(tiny, cln::float_format(30));
  // e^(-10^15) = 2^(-1.44e15)
  EXPECT_NEAR(static_cast<double>(cln::float_exponent(number)), -1.4426950408889634e15, 2);
}

TEST(PreciseRun, TheMemoryOfARunGrowsWithTheSquareOfItsDigits) {
  const Program program = pendulum();
  const PreciseProblem swing = problem(program, {1, 0, 1});
  const double few = precise_run_bytes(swing, 2000), many = precise_run_bytes(swing, 4000);
  EXPECT_GT(few, 1e6);
  EXPECT_GT(many, 3 * few);
  EXPECT_LT(many, 4.1 * few);
}

TEST(PreciseRun, OneThousandDigits) {
  const Program program = riccati();
  const AgreedRun agreed = agreed_run(problem(program, {1, cln::cl_RA("1/4")}), 1000);
  const cln::cl_F truth = cln::cl_float(cln::cl_RA("4/3"), cln::float_format(1200));
  EXPECT_EQ(agreed_digits(agreed.run.state[0], truth, 1000), 1000);
}

// From the lowest point with the velocity 2k: sin(q/2) = k sn(t, k), q' = 2k cn(t, k).
TEST(PreciseRun, PendulumSwingsLikeTheEllipticSine) {
  using Long = boost::multiprecision::cpp_bin_float_100;
  const Program program = pendulum();
  const Long k = Long(3) / 5, t = 20;
  const AgreedRun agreed = agreed_run(problem(program, {0, cln::cl_RA("6/5"), 20}), 80);
  ASSERT_EQ(agreed.run.status, Status::ok) << agreed.run.reason;
  const Long angle = 2 * asin(k * boost::math::jacobi_sn(k, t));
  const Long velocity = 2 * k * boost::math::jacobi_cn(k, t);
  EXPECT_EQ(agreed_digits(agreed.run.state[0], decimal(angle.str(99, std::ios::scientific)), 80),
            80);
  EXPECT_EQ(agreed_digits(agreed.run.state[1], decimal(velocity.str(99, std::ios::scientific)), 80),
            80);
}

TEST(PreciseRun, BackwardAndNowhere) {
  const Program program = pendulum();
  const AgreedRun there = agreed_run(problem(program, {0, 1, -7}), 60);
  const AgreedRun mirrored = agreed_run(problem(program, {0, -1, 7}), 60);
  EXPECT_EQ(agreed_digits(there.run.state[0], mirrored.run.state[0], 60), 60);
  const AgreedRun nowhere = agreed_run(problem(program, {0, 1, 0}), 60);
  EXPECT_EQ(nowhere.run.status, Status::ok);
  EXPECT_EQ(nowhere.digits, 60);
  EXPECT_TRUE(cln::zerop(nowhere.run.state[0]));
}

TEST(PreciseRun, PoleIsKnownToAllDigits) {
  const Program program = riccati();
  const AgreedRun agreed = agreed_run(problem(program, {3, 2}), 100);
  EXPECT_EQ(agreed.run.status, Status::singularity);
  ASSERT_TRUE(agreed.run.singular_time);
  EXPECT_TRUE(agreed.checked);
  EXPECT_EQ(agreed.digits, 100);
  const cln::cl_F third = cln::cl_float(cln::cl_RA("1/3"), cln::float_format(200));
  EXPECT_GE(agreed_digits(*agreed.run.singular_time, third, 100), 100);
  // The state left is that of a time before it.
  EXPECT_LT(agreed.run.time, third);
  const cln::cl_F truth = cln::cl_float(1, third) / (third - agreed.run.time);
  EXPECT_GE(agreed_digits(agreed.run.state[0], truth, 100), 80);
}

// x' = -1/(2x): x = sqrt(1 - t) comes to an end at 1 with a finite value. x' = exp(x) from 0:
// x = -log(1 - t).
TEST(PreciseRun, EndsThatAreNoPoles) {
  Builder root({"x"});
  root.output(root.op(Op::div, root.number(cln::cl_RA("-1/2")), 0));
  Builder logarithm({"x"});
  logarithm.output(logarithm.op(Op::exp, 0));
  const Program first = root.program(), second = logarithm.program();
  for (const auto& [program, start] : {std::pair(&first, 1), std::pair(&second, 0)}) {
    const AgreedRun agreed = agreed_run(problem(*program, {start, 2}), 40);
    EXPECT_EQ(agreed.run.status, Status::singularity);
    ASSERT_TRUE(agreed.run.singular_time);
    const cln::cl_F one = cln::cl_float(1, cln::float_format(100));
    EXPECT_GE(agreed_digits(*agreed.run.singular_time, one, 40), 40);
  }
}

// Poles beside the real line, at 1 +- 1e-6 i, are passed: x' = 1 / ((t-1)^2 + e^2).
TEST(PreciseRun, PolesBesideTheLineArePassed) {
  Builder b({"x"});
  const int d = b.op(Op::sub, b.time(), b.number(1));
  const int square = b.op(Op::add, b.op(Op::mul, d, d), b.number(cln::cl_RA("1/1000000000000")));
  b.output(b.op(Op::div, b.number(1), square));
  const Program program = b.program();
  const AgreedRun agreed = agreed_run(problem(program, {0, 2}), 40);
  ASSERT_EQ(agreed.run.status, Status::ok) << agreed.run.reason;
  const cln::cl_F million = cln::cl_float(1000000, cln::float_format(100));
  const cln::cl_F truth = million * cln::cl_float(2 * cln::atan(million), million);
  EXPECT_EQ(agreed_digits(agreed.run.state[0], truth, 40), 40);
}

// z = exp(-t)/3, x = 7z/4 is an unstable balance of x' = 3x - 7z: an error of x grows exp(4t) times
// beside it.
TEST(PreciseRun, LostDigitsAreFoundAndMadeUpFor) {
  Builder b({"x", "z"});
  b.output(b.op(Op::sub, b.op(Op::mul, b.number(3), 0), b.op(Op::mul, b.number(7), 1)));
  b.output(b.op(Op::neg, 1));
  const Program program = b.program();
  const cln::cl_RA third("1/3");
  for (const auto& [digits, end] : {std::pair(50, 60), std::pair(17, 200)}) {
    const AgreedRun agreed = agreed_run(problem(program, {third * 7 / 4, third, end}), digits);
    ASSERT_EQ(agreed.run.status, Status::ok) << agreed.run.reason;
    EXPECT_EQ(agreed.digits, digits);
    EXPECT_GT(agreed.lost, 80);
    const cln::cl_F truth = cln::exp(cln::cl_float(-end, cln::float_format(100))) / 12 *
                            cln::cl_float(7, cln::float_format(100));
    EXPECT_EQ(agreed_digits(agreed.run.state[0], truth, digits), digits);
  }
}

// q = sin(t) and x = sin(t) at Pi: a zero has no digits, beside a state that is not zero or alone.
TEST(PreciseRun, ZeroesAreNotWaitedFor) {
  Builder circle({"q", "p"});
  circle.output(1);
  circle.output(circle.op(Op::neg, 0));
  Builder alone({"x"});
  alone.output(alone.op(Op::cos, alone.time()));
  const Program both = circle.program(), one = alone.program();
  for (const Program* program : {&both, &one}) {
    PreciseProblem asked;
    asked.rhs = program;
    asked.start = [&](int digits) {
      std::vector<cln::cl_R> start(program->outputs.size(), 0);
      if (start.size() == 2) start[1] = 1;
      start.push_back(cln::pi(cln::float_format(static_cast<uintE>(digits))));
      return start;
    };
    const AgreedRun agreed = agreed_run(asked, 20);
    EXPECT_EQ(agreed.run.status, Status::ok);
    EXPECT_EQ(agreed.digits, 20);
    EXPECT_LT(cln::abs(agreed.run.state[0]), decimal("1.0e-25"));
  }
}

TEST(PreciseRun, SamplesAreOfTheSolution) {
  const Program program = riccati();
  PreciseProblem asked = problem(program, {1, cln::cl_RA("9/10")});
  asked.sample_every = cln::cl_RA("1/10");
  const AgreedRun agreed = agreed_run(asked, 50);
  ASSERT_EQ(agreed.run.samples.size(), 10U);
  for (int k = 0; k < 10; ++k) {
    const cln::cl_F truth = cln::cl_float(cln::cl_RA(10) / (10 - k), cln::float_format(100));
    EXPECT_EQ(agreed_digits(agreed.run.samples[static_cast<std::size_t>(k)][0], truth, 50), 50)
        << k;
  }
}

TEST(PreciseRun, InvariantsStayToAllDigits) {
  const Program program = pendulum();
  Builder b({"q", "p"});
  const int p2 = b.op(Op::mul, 1, 1);
  b.output(b.op(Op::sub, b.op(Op::div, p2, b.number(2)), b.op(Op::cos, 0)));
  const Program energy = b.program();
  PreciseProblem asked = problem(program, {0, 1, 50});
  asked.invariants = &energy;
  const AgreedRun agreed = agreed_run(asked, 70);
  ASSERT_EQ(agreed.run.invariants.size(), 1U);
  EXPECT_LT(agreed.run.invariants[0].change, decimal("1.0e-70"));
  EXPECT_GT(agreed.run.invariants[0].change, decimal("1.0e-100"));
  EXPECT_EQ(agreed_digits(agreed.run.invariants[0].final, decimal("-0.5"), 70), 70);
}

TEST(PreciseRun, LimitsAreKept) {
  const Program program = pendulum();
  PreciseProblem asked = problem(program, {0, 1, 50});
  asked.max_steps = 3;
  const AgreedRun few = agreed_run(asked, 30);
  EXPECT_EQ(few.run.status, Status::max_steps);
  EXPECT_TRUE(few.checked);
  EXPECT_EQ(few.digits, 30);  // of the state after three steps
  EXPECT_LT(few.run.time, decimal("50.0"));
  asked.max_steps = 0;
  int left = 40;
  asked.give_up = [&](double share) {
    EXPECT_LE(share, 1);
    return --left < 0;
  };
  const AgreedRun stopped = agreed_run(asked, 200);
  EXPECT_EQ(stopped.run.status, Status::stopped);
  // Also before the first step of a run with so many digits is done.
  int asks = 0;
  asked.give_up = [&](double) { return ++asks > 2; };
  EXPECT_EQ(precise_run(asked, 3000).status, Status::stopped);
}

/// x' = |t - 7/3|, from 1/2 to the time 5.
TEST(PreciseRun, CornersAreFoundToAllDigits) {
  Builder b({"x"});
  b.output(b.op(Op::abs, b.op(Op::sub, b.time(), b.number(cln::cl_RA("7/3")))));
  const Program program = b.program();
  const AgreedRun agreed = agreed_run(problem(program, {cln::cl_RA("1/2"), 5}), 60);
  ASSERT_EQ(agreed.run.status, Status::ok) << agreed.run.reason;
  // (49/9 + 64/9)/2 + 1/2
  const cln::cl_F truth = cln::cl_float(cln::cl_RA("61/9"), cln::float_format(80));
  EXPECT_EQ(agreed_digits(agreed.run.state[0], truth, 60), 60);
  EXPECT_LT(agreed.run.steps, 20U);
}

/// The last of so many digits is below every double.
TEST(PreciseRun, CornersAreFoundToMoreDigitsThanAnExponentHas) {
  Builder b({"x"});
  b.output(b.op(Op::abs, b.op(Op::sub, b.time(), b.number(cln::cl_RA("7/3")))));
  const Program program = b.program();
  const AgreedRun agreed = agreed_run(problem(program, {cln::cl_RA("1/2"), 5}), 500);
  ASSERT_EQ(agreed.run.status, Status::ok) << agreed.run.reason;
  const cln::cl_F truth = cln::cl_float(cln::cl_RA("61/9"), cln::float_format(600));
  EXPECT_EQ(agreed_digits(agreed.run.state[0], truth, 500), 500);
}

/// q'' = -sign(q) from height 1: after 20 quarters of sqrt(2) it stands where it began, and 1/2
/// later at 1 - 1/8.
TEST(PreciseRun, JumpsAreFoundToAllDigits) {
  Builder b({"q", "p"});
  b.output(1);
  b.output(b.op(Op::neg, b.op(Op::sign, 0)));
  const Program program = b.program();
  const cln::float_format_t format = cln::float_format(90);
  const cln::cl_R end =
      20 * cln::sqrt(cln::cl_float(2, format)) + cln::cl_float(cln::cl_RA("1/2"), format);
  const AgreedRun agreed = agreed_run(problem(program, {1, 0, end}), 50);
  ASSERT_EQ(agreed.run.status, Status::ok) << agreed.run.reason;
  EXPECT_EQ(agreed_digits(agreed.run.state[0], cln::cl_float(cln::cl_RA("7/8"), format), 50), 50);
  EXPECT_EQ(agreed_digits(agreed.run.state[1], cln::cl_float(cln::cl_RA("-1/2"), format), 50), 50);
}

/// x' = sign(sin(t)): the branches are at multiples of Pi, which no double is. To 10 it is 4 Pi
/// - 10.
TEST(PreciseRun, JumpsBetweenDoublesAreLeftBehind) {
  Builder b({"x"});
  b.output(b.op(Op::sign, b.op(Op::sin, b.time())));
  const Program program = b.program();
  const AgreedRun agreed = agreed_run(problem(program, {0, 10}), 30);
  ASSERT_EQ(agreed.run.status, Status::ok) << agreed.run.reason;
  const cln::float_format_t format = cln::float_format(60);
  const cln::cl_F truth = cln::cl_float(4 * cln::pi(format) - 10, format);
  EXPECT_EQ(agreed_digits(agreed.run.state[0], truth, 30), 30);
}

/// x' = exp(-(1000 (t - 3))^2), of which the integral is sqrt(Pi)/1000.
TEST(PreciseRun, PulsesAreNotPassedOver) {
  Builder b({"x"});
  const int z = b.op(Op::mul, b.op(Op::sub, b.time(), b.number(3)), b.number(1000));
  b.output(b.op(Op::exp, b.op(Op::neg, b.op(Op::mul, z, z))));
  const Program program = b.program();
  const AgreedRun agreed = agreed_run(problem(program, {1, 20}), 40);
  ASSERT_EQ(agreed.run.status, Status::ok) << agreed.run.reason;
  const cln::float_format_t format = cln::float_format(60);
  EXPECT_EQ(agreed_digits(agreed.run.state[0], 1 + cln::sqrt(cln::pi(format)) / 1000, 40), 40);
}

/// x' = -x + t^4 from 0, whose first five terms are zero.
/// Between two places at which cos(t)^8192 is next to nothing it may be 1.
TEST(PreciseRun, PeaksOfPowersAreNotPassedOver) {
  Builder b({"x"});
  int power = b.op(Op::cos, b.time());
  for (int i = 0; i < 13; ++i) power = b.op(Op::mul, power, power);
  b.output(power);
  const Program program = b.program();
  const PreciseRun run = precise_run(problem(program, {0, 10}), 20);
  ASSERT_EQ(run.status, Status::ok) << run.reason;
  const double n = 4096;  // half a peak at 0, and three
  const double area =
      std::sqrt(std::acos(-1)) * std::exp(std::lgamma(n + 0.5) - std::lgamma(n + 1));
  EXPECT_NEAR(cln::double_approx(run.state[0]) / area, 3.5, 1e-9);
}

TEST(PreciseRun, WhatRestsAtZeroBegins) {
  Builder b({"x"});
  const int square = b.op(Op::mul, b.time(), b.time());
  b.output(b.op(Op::sub, b.op(Op::mul, square, square), 0));
  const Program program = b.program();
  const AgreedRun agreed = agreed_run(problem(program, {0, 3}), 40);
  ASSERT_EQ(agreed.run.status, Status::ok) << agreed.run.reason;
  // t^4 - 4 t^3 + 12 t^2 - 24 t + 24 - 24 exp(-t)
  const cln::float_format_t format = cln::float_format(70);
  const cln::cl_F truth = cln::cl_float(33 - 24 * cln::exp(cln::cl_float(-3, format)), format);
  EXPECT_EQ(agreed_digits(agreed.run.state[0], truth, 40), 40);
}

/// x' = ((1 - cos t)(t - sin t))^9 = t^45/6^9/2^9 .. from 0: all terms up to the last are zero.
TEST(PreciseRun, TermsBeyondTheLastAreSeenInTheEquations) {
  Builder b({"x"});
  const int t = b.time();
  const int u = b.op(Op::mul, b.op(Op::sub, b.number(1), b.op(Op::cos, t)),
                     b.op(Op::sub, t, b.op(Op::sin, t)));
  const int third = b.op(Op::mul, b.op(Op::mul, u, u), u);
  b.output(b.op(Op::mul, b.op(Op::mul, third, third), third));
  const Program program = b.program();
  const PreciseRun coarse = precise_run(problem(program, {0, 3}), 17);
  const PreciseRun fine = precise_run(problem(program, {0, 3}), 60);
  ASSERT_EQ(coarse.status, Status::ok) << coarse.reason;
  ASSERT_EQ(fine.status, Status::ok) << fine.reason;
  EXPECT_TRUE(cln::plusp(fine.state[0]));
  EXPECT_GE(agreed_digits(coarse.state[0], fine.state[0], 17), 15);
}

/// sign((t - 1)^2 + a - b + c) with a - b + c > 0, which is below zero in double precision: there
/// is a branch for doubles, and none for more digits.
TEST(PreciseRun, ABranchThatMoreDigitsDoNotShowIsRefused) {
  Builder b({"x"});
  const cln::cl_RA half_unit = cln::expt(cln::cl_RA(2), -53);
  const int z = b.op(Op::sub, b.time(), b.number(1));
  const int little = b.op(Op::sub, b.number(1 + half_unit * cln::cl_RA("99/100")),
                          b.number(1 + half_unit * cln::cl_RA("101/100")));
  const int more = b.op(Op::add, little, b.number(half_unit / 10));
  b.output(b.op(Op::sign, b.op(Op::add, b.op(Op::mul, z, z), more)));
  const Program program = b.program();
  const PreciseRun run = precise_run(problem(program, {0, 3}), 30);
  EXPECT_EQ(run.status, Status::no_convergence);
  EXPECT_NE(run.reason.find("cannot be told"), std::string::npos) << run.reason;
  EXPECT_LT(cln::double_approx(run.time), 1);

  // The twin: it goes below zero for all digits.
  Builder twin({"x"});
  const int y = twin.op(Op::sub, twin.time(), twin.number(1));
  const int u = twin.op(Op::sub, twin.op(Op::mul, y, y), twin.number(cln::cl_RA("1/4")));
  twin.output(twin.op(Op::sign, u));
  const Program crossing = twin.program();
  const AgreedRun agreed = agreed_run(problem(crossing, {0, 3}), 30);
  ASSERT_EQ(agreed.run.status, Status::ok) << agreed.run.reason;
  EXPECT_EQ(agreed_digits(agreed.run.state[0], cln::cl_float(1, cln::float_format(40)), 30), 30);
}

/// The series of (t - 1)^3 has no singularity where the equations are no longer Lipschitz
/// continuous; x = 0 from there on is a solution as well.
TEST(PreciseRun, EndsWhereARootMakesSolutionsPart) {
  const auto run = [](const cln::cl_RA& more, const cln::cl_RA& exponent) {
    Builder b({"x", "y"});
    const int squares = b.op(Op::add, b.op(Op::mul, 0, 0), b.op(Op::mul, 1, 1));
    const int radicand = b.op(Op::add, squares, b.number(more));
    b.output(b.op(Op::mul, b.number(3), b.op(Op::pow, radicand, b.number(exponent))));
    b.output(b.number(0));
    const Program program = b.program();
    return agreed_run(problem(program, {-1, 0, 2}), 30).run;
  };
  const PreciseRun parts = run(0, cln::cl_RA("1/3"));
  EXPECT_EQ(parts.status, Status::singularity);
  EXPECT_NE(parts.reason.find("more than one solution"), std::string::npos) << parts.reason;
  EXPECT_LE(cln::double_approx(parts.time), 1);
  EXPECT_EQ(run(cln::cl_RA("1/1000000"), cln::cl_RA("1/3")).status, Status::ok);
  // As near as that the steps are short; the radicand of x = t - 1 has no zero.
  Builder near({"x", "y"});
  near.output(near.number(1));
  near.output(near.op(
      Op::pow,
      near.op(Op::add, near.op(Op::mul, 0, 0), near.number(1 / cln::expt(cln::cl_RA(10), 30))),
      near.number(cln::cl_RA("1/3"))));
  const Program passes = near.program();
  EXPECT_EQ(agreed_run(problem(passes, {-1, 0, 2}), 40).run.status, Status::ok);
  EXPECT_GT(cln::double_approx(parts.time), 0.999);
  EXPECT_EQ(run(0, cln::cl_RA("2/3")).status, Status::ok);
  // The same as powers of |x|.
  const auto run_of_size = [](const cln::cl_RA& exponent) {
    Builder b({"x"});
    b.output(b.op(Op::mul, b.number(3), b.op(Op::pow, b.op(Op::abs, 0), b.number(exponent))));
    const Program program = b.program();
    return agreed_run(problem(program, {-1, 2}), 30).run.status;
  };
  EXPECT_EQ(run_of_size(cln::cl_RA("2/3")), Status::singularity);
  EXPECT_EQ(run_of_size(cln::cl_RA("4/3")), Status::ok);
}

}  // namespace
}  // namespace casimir::test
