// Whether a run gets anywhere.
#include <gtest/gtest.h>

#include "runtime/kernels/one_step/control.hpp"

namespace casimir::test {
namespace {

using casimir_kernel::Pace;

/// Whether a run is called hopeless that asks after so many trials each time, within ten million of
/// them, and moves the time by so much in each.
bool is_hopeless(unsigned long long every, double move, double end) {
  Pace pace(0);
  for (unsigned long long trials = every; trials < 10'000'000; trials += every)
    if (pace.hopeless(trials, move * static_cast<double>(trials), end)) return true;
  return false;
}

TEST(Pace, ARunThatCreepsIsNoticedWhateverTrialsItIsAskedAt) {
  // A million is 2^20 trials: multiples of 6 pass over all of its own.
  for (const unsigned long long every : {1ULL, 2ULL, 6ULL, 7ULL, 1'500'000ULL})
    EXPECT_TRUE(is_hopeless(every, 1e-12, 1)) << every;
}

TEST(Pace, ARunThatTakesLongIsNotHopeless) {
  for (const unsigned long long every : {1ULL, 6ULL, 1'500'000ULL})
    EXPECT_FALSE(is_hopeless(every, 1e-10, 1)) << every;
}

}  // namespace
}  // namespace casimir::test
