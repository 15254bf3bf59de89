// Reference states.
#include "tools/analysis/estimate/reference_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/analysis/systems.hpp"

namespace casimir::test {
namespace {

ReferenceStateOrReason truth(const Model& model, const ReferenceOptions& options = {}) {
  const Scene& scene = model.scene("default");
  return reference_state_of(scene, prepare(model, scene), options);
}

TEST(ReferenceState, AnOwnRunHasTheExactStateToItsBound) {
  const Oscillator oscillator;
  const Scene scene = oscillator.scene(10);
  const ReferenceStateOrReason known =
      reference_state_of(scene, prepare(oscillator.model, scene), {});
  ASSERT_TRUE(known.truth) << known.reason;
  EXPECT_EQ(known.failure, NoReference::none);
  EXPECT_EQ(known.truth->state[0], std::cos(10.));
  EXPECT_EQ(known.truth->state[1], -std::sin(10.));
  EXPECT_LT(known.error_bound, 1e-25);
  // What double leaves out: cos 10 = -0.83907152907645245225886..
  EXPECT_NE(known.truth->rest[0], 0);
  EXPECT_LT(std::abs(known.truth->rest[0]), 1e-16);
}

/// A run of our own may take minutes and gigabytes for states that nobody asked for.
TEST(ReferenceState, WhatTheFileDoesNotHaveIsNotRunForWhereOnlyTheFileCounts) {
  const Model without = one_equation("x", "1");
  const ReferenceStateOrReason none = truth(without, {.only_the_file = true});
  EXPECT_FALSE(none.truth);
  EXPECT_EQ(none.digits, 0);
  EXPECT_NE(none.reason.find("the case file has no reference state"), std::string::npos);
  EXPECT_TRUE(truth(without).truth) << "the twin";
  const Model with = one_equation("x", "1", "reference = { x = \"2.718281828459045235360287\" }\n");
  EXPECT_TRUE(truth(with, {.only_the_file = true}).truth);
}

TEST(ReferenceState, AStateInTheFileIsCheckedAndAWrongOneIsNone) {
  // x = e^t at t = 1.
  const auto with = [](const std::string& value) {
    return one_equation("x", "1", "reference = { x = \"" + value + "\" }\n");
  };
  const ReferenceStateOrReason right =
      truth(with("2.718281828459045235360287"), {.check_the_file = true});
  ASSERT_TRUE(right.truth) << right.reason;
  EXPECT_EQ(right.digits, 25);
  const ReferenceStateOrReason wrong =
      truth(with("2.718281828459045335360287"), {.check_the_file = true});
  EXPECT_FALSE(wrong.truth);
  EXPECT_EQ(wrong.failure, NoReference::contradicted);
  EXPECT_FALSE(wrong.reason.empty());
}

TEST(ReferenceState, AMotionThatHasNoEndHasNone) {
  const ReferenceStateOrReason none = truth(one_equation("x^2", "2"));
  EXPECT_FALSE(none.truth);
  EXPECT_EQ(none.failure, NoReference::not_reached);
  ASSERT_TRUE(none.singular_time);
  EXPECT_NEAR(*none.singular_time, 1, 1e-6);
}

TEST(ReferenceState, ARunThatIsGivenUpSaysSo) {
  const ReferenceStateOrReason none =
      truth(one_equation("x", "1"), {.give_up = [] { return true; }});
  EXPECT_FALSE(none.truth);
  EXPECT_EQ(none.failure, NoReference::took_too_long);
}

TEST(ReferenceState, WhereHighPrecisionTakesTooLongItIsTheMiddleOfABox) {
  const Oscillator oscillator;
  const Scene scene = oscillator.scene(10);
  const ReferenceStateOrReason known =
      reference_state_of(scene, prepare(oscillator.model, scene), {.longest = 0});
  ASSERT_TRUE(known.truth) << known.reason;
  EXPECT_NE(known.source.find("box"), std::string::npos);
  EXPECT_NEAR(known.truth->state[0], std::cos(10.), known.error_bound);
  EXPECT_GT(known.error_bound, 1e-17);
  EXPECT_LT(known.error_bound, 1e-12);
}

TEST(ReferenceState, SizesAreTheLargestAlongTheRun) {
  const Oscillator oscillator;
  const Scene scene = scene_from(oscillator.model, {3, 0}, 10);
  const std::vector<double> sizes = state_sizes(prepare(oscillator.model, scene));
  EXPECT_NEAR(sizes[0], 3, 1e-6);
  EXPECT_NEAR(sizes[1], 3, 1e-2);
}

TEST(ReferenceState, GrowthIsThatOfTheFlow) {
  const Model model = one_equation("x - 1", "10");
  const PreparedScene run = prepare(model, model.scene("default"));
  const ReferenceStateOrReason known = reference_state_of(model.scene("default"), run, {});
  ASSERT_TRUE(known.truth) << known.reason;
  EXPECT_NEAR(growth_of(run, *known.truth) / std::exp(10), 1, 0.05);
}

}  // namespace
}  // namespace casimir::test
