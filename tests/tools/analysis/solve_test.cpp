// solve: the method, the motion at any time, and what is refused.
#include "tools/analysis/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/error.hpp"

namespace casimir::test {
namespace {

SolveOptions dense(const std::string& method = "auto") {
  SolveOptions options;
  options.method = method;
  options.dense = true;
  return options;
}

TEST(Solve, TheStateAtAnyTimeIsThatOfTheMotion) {
  const Oscillator oscillator;
  for (const char* method : {"auto", "cvode-adams"}) {
    const Solution motion = solve(oscillator.model, oscillator.scene(20), dense(method));
    ASSERT_TRUE(motion.ok()) << motion.trajectory().reason;
    const double bound = motion.run().settings.rtol * 1e4;
    for (const double t : {0., 1e-3, 0.5, 3.3, 7., 19.999, 20.}) {
      EXPECT_NEAR(motion(t)[0], std::cos(t), bound) << method << " " << t;
      EXPECT_NEAR(motion(t)[1], -std::sin(t), bound) << method << " " << t;
    }
    EXPECT_EQ(motion(20), motion.trajectory().state);
  }
}

TEST(Solve, BackwardsInTimeIsTheSame) {
  const Oscillator oscillator;
  SolveOptions options = dense();
  options.run.duration = -5;
  const Solution motion = solve(oscillator.model, oscillator.scene(20), options);
  ASSERT_TRUE(motion.ok());
  for (const double t : {0., -0.1, -2.5, -5.}) EXPECT_NEAR(motion(t)[1], -std::sin(t), 1e-12) << t;
  EXPECT_THROW(motion(0.1), RequestError);
}

TEST(Solve, EquationsThatDependOnTheTimeAreFollowedFromTheirOwnTime) {
  const Model model = driven_equation("2*t");
  const Solution motion = solve(model, model.scene("default"), dense());
  ASSERT_TRUE(motion.ok());
  for (const double t : {0.5, 1.7, 3.9}) EXPECT_NEAR(motion(t)[0], t * t, 1e-12) << t;
  const Solution outside = solve(model, model.scene("default"), dense("cvode-adams"));
  ASSERT_TRUE(outside.ok());
  EXPECT_THROW(outside(1.23456), RequestError);
}

// At t = 1 the argument is 1e6, of which rounding alone changes the right-hand side by 1e-10: no
// defect of a step.
TEST(Solve, TheRoundingOfALargeArgumentIsNoDefect) {
  const Model model = driven_equation("1e6*sin(1e6*t)");
  SolveOptions options = dense();
  options.run.duration = 0.05;
  const Solution motion = solve(model, model.scene("default"), options);
  ASSERT_TRUE(motion.ok()) << motion.trajectory().reason;
  EXPECT_NEAR(motion.trajectory().state[0], 1 - std::cos(5e4), 1e-7);
  EXPECT_LT(motion.trajectory().rejected, motion.trajectory().steps / 20);
}

// No step of it is short: it is only that there are too many.
TEST(Solve, AMotionThatOscillatesForTooLongHasNoSingularity) {
  const Model model = driven_equation("cos(t)");
  SolveOptions options;
  options.run.duration = 1e300;
  const Solution motion = solve(model, model.scene("default"), options);
  EXPECT_EQ(motion.trajectory().status, Status::step_underflow) << motion.trajectory().reason;
}

TEST(Solve, WhatTheRunDidNotReachOrKeepIsRefused) {
  const Oscillator oscillator;
  const Solution kept = solve(oscillator.model, oscillator.scene(2), dense());
  EXPECT_THROW(kept(2.1), RequestError);
  EXPECT_THROW(kept(-0.1), RequestError);
  EXPECT_THROW(kept(std::nan("")), RequestError);
  const Solution not_kept = solve(oscillator.model, oscillator.scene(2));
  EXPECT_THROW(not_kept(1), RequestError);
  SolveOptions options;
  options.method = "taylr";
  EXPECT_THROW(solve(oscillator.model, oscillator.scene(2), options), RequestError);
  options.method = "dop853";
  options.run.rtol = -1;
  EXPECT_THROW(solve(oscillator.model, oscillator.scene(2), options), RequestError);
}

TEST(Solve, StiffEquationsAreGivenToAMethodForThem) {
  const Model model = one_equation("-1000000*(x - 1/2)", "10");
  const Solution motion = solve(model, model.scene("default"), dense());
  ASSERT_TRUE(motion.ok()) << motion.trajectory().reason;
  EXPECT_EQ(motion.run().method->name, kStiffMethod);
  EXPECT_NE(motion.run().chosen.find("stiff"), std::string::npos);
  EXPECT_NEAR(motion(10)[0], 0.5, 1e-9);
  EXPECT_NEAR(motion(1)[0], 0.5, 1e-9);
  // The steps of the first method are not kept beside those of the second.
  const Oscillator oscillator;
  EXPECT_EQ(solve(oscillator.model, oscillator.scene(2)).run().method->name, "taylor");
}

TEST(Solve, AMotionThatEndsSaysWhereAndIsKnownUpToThere) {
  const Model model = one_equation("x^2", "2");
  const Solution motion = solve(model, model.scene("default"), dense());
  EXPECT_FALSE(motion.ok());
  EXPECT_NEAR(motion.trajectory().time, 1, 1e-3);
  EXPECT_NEAR(motion(0.5)[0], 2, 1e-11);
  EXPECT_THROW(motion(1.5), RequestError);
}

TEST(Solve, TolerancesFollowTheSizeOfTheStart) {
  const Oscillator oscillator;
  const PreparedScene large = prepare(oscillator.model, oscillator.scene(1));
  const PreparedScene small =
      prepare(oscillator.model, scene_from(oscillator.model, {GiNaC::numeric(1, 1024), 0}, 1));
  RunRequest request;
  request.tolerance = 1e-8;
  EXPECT_EQ(settings_for(request, large).atol, 1e-8);
  EXPECT_EQ(settings_for(request, small).atol, 1e-8 / 1024);
  request.atol = 1e-5;
  EXPECT_EQ(settings_for(request, small).atol, 1e-5);
  EXPECT_EQ(settings_for(request, small).rtol, 1e-8);
  request.duration = 3;
  EXPECT_EQ(settings_for(request, small).duration, 3);
}

}  // namespace
}  // namespace casimir::test
