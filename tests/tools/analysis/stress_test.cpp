// What the answer of a run is worth.
#include <gtest/gtest.h>

#include "tools/analysis/stress/cell.hpp"

namespace casimir::test {
namespace {

SceneReference truth_of_the_scene() {
  SceneReference known{.states = {"x"}};
  known.truth = ReferenceState{{1}, {0}, {1}};
  known.growth = 1;
  return known;
}

StressAnswer answer(double x) {
  StressAnswer result;
  result.says_done = true;
  result.tolerance = result.rtol = result.atol = 1e-10;
  result.steps = 100;
  result.state = {{"x", x}};
  return result;
}

TEST(Stress, AnErrorThatTheToleranceExplainsIsRightAndALargerOneWrong) {
  const StressCell right = cell_of({}, false, truth_of_the_scene(), answer(1 + 1e-9));
  EXPECT_EQ(right.verdict, Judgement::right);
  EXPECT_FALSE(right.row.failed);
  EXPECT_NEAR(right.row.error, 1e-9, 1e-12);
  const StressCell wrong = cell_of({}, false, truth_of_the_scene(), answer(1.2));
  EXPECT_EQ(wrong.verdict, Judgement::wrong);
  EXPECT_TRUE(wrong.row.failed);
  EXPECT_FALSE(cell_of({}, true, truth_of_the_scene(), answer(1.2)).row.failed)
      << "of another library";
}

TEST(Stress, AStateThatIsMissingIsNoNumber) {
  StressAnswer nothing = answer(1);
  nothing.state.clear();
  EXPECT_EQ(cell_of({}, false, truth_of_the_scene(), nothing).verdict, Judgement::wrong);
}

TEST(Stress, ARefusalNeedsAReason) {
  StressAnswer refused;
  refused.kind = StressAnswer::Kind::refused;
  refused.complaint = "why";
  const StressCell cell = cell_of({}, false, truth_of_the_scene(), refused);
  EXPECT_EQ(cell.verdict, Judgement::refused);
  EXPECT_EQ(cell.row.end, RowEnd::refused);
  EXPECT_EQ(cell.refusal, Refusal::failed);
  refused.unsuitable = true;
  EXPECT_EQ(cell_of({}, false, truth_of_the_scene(), refused).refusal, Refusal::not_applicable);
  EXPECT_EQ(cell.row.reason, "why");
  refused.complaint.clear();
  EXPECT_EQ(cell_of({}, false, truth_of_the_scene(), refused).verdict, Judgement::wrong);
  StressAnswer crashed;
  crashed.kind = StressAnswer::Kind::crashed;
  EXPECT_EQ(cell_of({}, false, truth_of_the_scene(), crashed).verdict, Judgement::wrong);
  StressAnswer killed;
  killed.kind = StressAnswer::Kind::killed;
  EXPECT_EQ(cell_of({}, false, truth_of_the_scene(), killed).verdict, Judgement::refused);
}

TEST(Stress, TheTimeOfASingularityIsCompared) {
  SceneReference known = truth_of_the_scene();
  known.truth.reset();
  known.singular_time = 2;
  StressAnswer stopped = answer(1);
  stopped.status = Status::singularity;
  stopped.says_done = false;
  stopped.stopped_at = 1.98;
  const StressCell cell = cell_of({}, false, known, stopped);
  EXPECT_EQ(cell.verdict, Judgement::refused);
  ASSERT_TRUE(cell.time_error);
  EXPECT_NEAR(*cell.time_error, 0.01, 1e-12);
}

}  // namespace
}  // namespace casimir::test
