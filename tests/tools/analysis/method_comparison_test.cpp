// What `bench` makes of a method whose error nothing explains. No method of ours has one where
// anybody knows of it, so a kernel is spoilt for it.
#include "tools/analysis/benchmark/method_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir::test {
namespace {

/// An oscillator over ten units of time by our own Taylor series, and what is known of it.
struct Measured {
  Oscillator oscillator;
  Scene scene = oscillator.scene(10);
  PreparedScene run = prepare(oscillator.model, scene);
  const Method& method = method_named("taylor");
  CompiledModule compiled = compile_for(run, method);
  ReferenceState truth = *reference_state_of(scene, run, {}).truth;

  /// The row of a run whose end state is `off` too large in each state, and which is not warned of.
  Row row(double off, bool own) const {
    ModuleFunctions functions = compiled.module.functions();
    functions.integrate = [whole = functions.integrate, off](const casimir_run* asked, double* x,
                                                             casimir_outcome* outcome) {
      whole(asked, x, outcome);
      for (int i = 0; i < 2; ++i) x[i] += off;
    };
    const Module spoilt = Module::from_functions(functions);
    Settings settings;
    settings.duration = 10;
    const Entrant entrant{&spoilt, &method, settings, run.initial, run.parameters, {}};
    const std::vector<Sample> samples = measure({&entrant, 1}, truth, {.rounds = 1});
    Row row;
    judge_row(row, samples.at(0), explained_error(entrant, samples.at(0), truth, 1), own);
    return row;
  }
};

TEST(MethodComparison, AnErrorOfOurOwnMethodThatNothingExplainsIsAFailure) {
  const Measured measured;
  const Row right = measured.row(0, true);
  EXPECT_TRUE(right.ok()) << right.reason;
  EXPECT_FALSE(right.failed);
  const Row wrong = measured.row(1e-3, true);
  EXPECT_EQ(wrong.end, RowEnd::wrong);
  EXPECT_TRUE(wrong.failed);
  EXPECT_NE(wrong.reason.find("explain an error of"), std::string::npos) << wrong.reason;
  EXPECT_TRUE(measured.row(NAN, true).failed);
}

TEST(MethodComparison, TheSameOfAnotherLibraryIsWrongAndNoFailure) {
  const Row row = Measured().row(1e-3, false);
  EXPECT_EQ(row.end, RowEnd::wrong);
  EXPECT_FALSE(row.failed);
}

TEST(MethodComparison, AnErrorThatIsExplainedIsWrongAtATenthOfTheStateOnly) {
  Row coarse, other;
  judge_row(coarse, {.error = 0.05}, 1, true);
  EXPECT_TRUE(coarse.ok()) << coarse.reason;
  judge_row(other, {.error = 0.2}, 1, true);
  EXPECT_EQ(other.end, RowEnd::wrong);
  EXPECT_FALSE(other.failed);
}

TEST(MethodComparison, WhatDidNotReachTheEndHasNoErrorToBeBlamedFor) {
  Row refused, slow, stopped;
  judge_row(refused, {.refused = "a tolerance below 1e-15", .error = NAN}, 1, true);
  EXPECT_EQ(refused.end, RowEnd::refused);
  judge_row(slow, {.too_slow = true, .error = NAN}, 1, true);
  EXPECT_EQ(slow.end, RowEnd::too_slow);
  judge_row(stopped, {.status = Status::singularity, .error = NAN}, 1, true);
  EXPECT_EQ(stopped.end, RowEnd::ran);
  EXPECT_FALSE(refused.failed || slow.failed || stopped.failed);
}

}  // namespace
}  // namespace casimir::test
