#include "runtime/judgement.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace casimir::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Judgement, ErrorThatToleranceExplainsIsRight) {
  EXPECT_EQ(judge({.error = 1e-9, .explained = 1e-7, .tolerance = 1e-10}), Judgement::right);
  EXPECT_EQ(judge({.error = 0, .explained = 0}), Judgement::right);
  EXPECT_EQ(judge({.error = 2e-3, .explained = 1, .tolerance = 1e-3}), Judgement::right);
}

TEST(Judgement, ErrorBeyondWhatToleranceExplainsIsWrong) {
  EXPECT_EQ(judge({.error = 1e-6, .explained = 1e-7, .tolerance = 1e-10}), Judgement::wrong);
}

TEST(Judgement, AnotherStateIsWrongWhateverExplainsIt) {
  for (const double explained : {1., kInfinity})
    EXPECT_EQ(judge({.error = 0.2, .explained = explained}), Judgement::wrong);
  EXPECT_EQ(judge({.error = kInfinity, .explained = kInfinity}), Judgement::wrong);
}

TEST(Judgement, FewDigitsAreInaccurate) {
  EXPECT_EQ(judge({.error = 1e-2, .explained = 1, .tolerance = 1e-8}), Judgement::inaccurate);
}

TEST(Judgement, WarningExcusesAnErrorAndSpoilsNoRightAnswer) {
  EXPECT_EQ(judge({.warned = true, .error = 1, .explained = 1e-7}), Judgement::warned);
  EXPECT_EQ(judge({.warned = true, .error = 1e-9, .explained = 1e-7}), Judgement::right);
}

TEST(Judgement, OkPastTheEndOfTheMotionIsWrongThoughItWarns) {
  EXPECT_EQ(judge({.has_end = false, .error = kNaN}), Judgement::wrong);
  EXPECT_EQ(judge({.warned = true, .has_end = false, .error = kNaN}), Judgement::wrong);
  EXPECT_EQ(judge({.meets_pole = true, .error = kNaN}), Judgement::wrong);
  EXPECT_EQ(judge({.warned = true, .meets_pole = true, .error = kNaN}), Judgement::warned);
}

TEST(Judgement, OkWithANumberThatIsNotFiniteIsWrong) {
  EXPECT_EQ(judge({.finite = false, .error = 0, .explained = 1}), Judgement::wrong);
}

TEST(Judgement, WhoeverSaysThatItFailedIsRefused) {
  EXPECT_EQ(judge({.ok = false, .finite = false, .has_end = false, .error = kNaN}),
            Judgement::refused);
  EXPECT_EQ(judge({.ok = false, .error = 1, .explained = 0}), Judgement::refused);
}

TEST(Judgement, WithoutATruthNothingIsKnown) {
  EXPECT_EQ(judge({.error = kNaN, .explained = 1}), Judgement::unknown);
}

}  // namespace
}  // namespace casimir::test
