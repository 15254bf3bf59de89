#include "runtime/work_precision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "runtime/equal_error.hpp"
#include "tests/runtime/systems.hpp"

namespace casimir::test {
namespace {

/// The oscillator until t = 50 by dop853.
struct OscillatorRuns {
  Module module = module_of<Oscillator>(dop853<Oscillator>, 0, 1);
  ReferenceState truth = {{std::cos(50.), -std::sin(50.)}, {0, 0}, {1, 1}};

  Entrant entrant(double tolerance, unsigned long long max_steps = 0) const {
    Settings settings;
    settings.duration = 50;
    settings.rtol = settings.atol = tolerance;
    settings.max_steps = max_steps;
    return {&module, find_method("dop853"), settings, {1, 0}, {}, {}};
  }
};

TEST(WorkPrecision, TimeComesWithItsError) {
  const OscillatorRuns runs;
  const std::vector<Entrant> entrants = {runs.entrant(1e-6), runs.entrant(1e-10)};
  const std::vector<Sample> samples = measure(entrants, runs.truth, {.rounds = 3});
  const Sample& coarse = samples.at(0);
  const Sample& fine = samples.at(1);
  EXPECT_EQ(coarse.status, Status::ok);
  EXPECT_LT(fine.error, 1e-2 * coarse.error);
  EXPECT_GT(fine.error, 0);
  EXPECT_LT(fine.drift, 1e-2 * coarse.drift);
  EXPECT_GT(fine.steps, coarse.steps);
  for (const Sample& sample : samples) {
    EXPECT_GT(sample.seconds, 0);
    EXPECT_GE(sample.spread, 0);
    EXPECT_EQ(sample.rounds, 3);
    EXPECT_FALSE(sample.too_slow);
  }
}

TEST(WorkPrecision, RunThatFailedHasNoErrorAndARefusedOneItsReason) {
  const OscillatorRuns runs;
  const std::vector<Entrant> entrants = {runs.entrant(1e-10, 5), runs.entrant(1e-17)};
  const std::vector<Sample> samples = measure(entrants, runs.truth, {.rounds = 1});
  EXPECT_EQ(samples.at(0).status, Status::max_steps);
  EXPECT_TRUE(std::isnan(samples.at(0).error));
  EXPECT_NE(samples.at(1).refused.find("1e-15"), std::string::npos) << samples.at(1).refused;
  EXPECT_TRUE(std::isnan(samples.at(1).error));
  EXPECT_EQ(samples.at(0).rounds + samples.at(1).rounds, 0);
}

TEST(WorkPrecision, ErrorIsTheLargestOverItsScale) {
  EXPECT_EQ(error_of({1, 2}, {{1, 1}, {0, 0}, {1, 4}}), 0.25);
  EXPECT_EQ(error_of({1, 2}, {{1, 2}, {0, -0.5}, {1, 1}}), 0.5);  // what rounding left out counts
  EXPECT_EQ(error_of({1, NAN}, {{1, 1}, {0, 0}, {1, 1}}), INFINITY);
}

TEST(WorkPrecision, ErrorIsOnTheStatesThatTheTruthHas) {
  const std::vector<int> which = {2, 0};
  EXPECT_EQ(error_of({1, NAN, 3}, {{3, 1}, {0, 0}, {1, 1}}, which), 0);
  EXPECT_EQ(error_of({1, NAN, 3}, {{1, 3}, {0, 0}, {1, 1}}, which), 2);
}

// What a kernel was asked to do: each run by the time at which it was to end.
std::vector<double> asked;
unsigned long long watched = 0;

void recording_kernel(const casimir_run* run, double*, casimir_outcome* out) {
  asked.push_back(run->t_end);
  watched += run->observe != nullptr ? 1 : 0;
  *out = casimir_outcome{};
  out->t = run->t_end;
}

/// Entrants that cannot be told apart but by their duration.
std::vector<Entrant> recorded_entrants(const Module& module, int count) {
  asked.clear();
  watched = 0;
  std::vector<Entrant> entrants;
  for (int i = 0; i < count; ++i) {
    Settings settings;
    settings.duration = i + 1;
    entrants.push_back({&module, find_method("dop853"), settings, {1, 0}, {}, {}});
  }
  return entrants;
}

TEST(WorkPrecision, RoundsAreInterleavedInChangingOrder) {
  const Module module = module_of<Oscillator>(recording_kernel);
  const int count = 5, rounds = 6;
  const ReferenceState truth = {{1, 0}, {0, 0}, {1, 1}};
  const auto samples = measure(recorded_entrants(module, count), truth, {.rounds = rounds});
  for (const Sample& sample : samples) EXPECT_EQ(sample.rounds, rounds);
  EXPECT_EQ(watched, 5U) << "only the first run of each is watched";
  // The turns, without the first two runs of each and with a batch counted once.
  std::vector<double> turns;
  for (std::size_t i = 2 * count; i < asked.size(); ++i)
    if (turns.empty() || turns.back() != asked[i]) turns.push_back(asked[i]);
  // Two turns of one entrant that meet at the end of a round look like one: at most once a round.
  EXPECT_GE(turns.size(), static_cast<std::size_t>(count * rounds - rounds));
  std::set<std::vector<double>> orders;
  for (std::size_t i = 0; i + count <= turns.size(); i += count)
    orders.insert(std::vector<double>(turns.begin() + static_cast<long>(i),
                                      turns.begin() + static_cast<long>(i) + count));
  EXPECT_GT(orders.size(), 1U);
}

TEST(WorkPrecision, RunThatEndsElsewhereWhenTimedIsNotExcused) {
  // Right when it is watched, off by 1 when only the time is taken.
  const auto two_faced = [](const casimir_run* run, double* x, casimir_outcome* out) {
    *out = casimir_outcome{};
    out->t = run->t_end;
    if (run->observe == nullptr) x[0] += 1;
  };
  const Module module = module_of<Oscillator>(two_faced);
  const ReferenceState truth = {{1, 0}, {0, 0}, {1, 1}};
  const auto samples = measure(recorded_entrants(module, 1), truth, {.rounds = 1});
  EXPECT_EQ(samples.at(0).error, 1);
}

TEST(WorkPrecision, SlowRunsAreGivenUpAndNotRepeatedAtFinerTolerances) {
  const OscillatorRuns runs;
  std::vector<Entrant> entrants = {runs.entrant(1e-3), runs.entrant(1e-9), runs.entrant(1e-12)};
  entrants[1].settings.duration = entrants[2].settings.duration = 1e9;
  const auto samples = measure(entrants, runs.truth, {.rounds = 1, .longest_run = 0.05});
  EXPECT_EQ(samples.at(0).status, Status::ok);
  EXPECT_TRUE(samples.at(1).too_slow);
  EXPECT_GT(samples.at(1).steps, 0U);
  EXPECT_TRUE(samples.at(2).too_slow);
  EXPECT_EQ(samples.at(2).steps, 0U) << "was not even begun";
  EXPECT_TRUE(std::isnan(samples.at(2).error));
}

TEST(WorkPrecision, StopsWhenAsked) {
  const OscillatorRuns runs;
  const std::vector<Entrant> entrants(3, runs.entrant(1e-6));
  Plan plan{.rounds = 1000000};
  int times = 0;
  plan.give_up = [&] { return ++times > 20; };
  EXPECT_THROW(measure(entrants, runs.truth, plan), Abandoned);
}

TEST(WorkPrecision, ProgressRisesToTheEnd) {
  const OscillatorRuns runs;
  const std::vector<Entrant> entrants(3, runs.entrant(1e-6));
  Plan plan{.rounds = 4};
  double last = 0;
  plan.progress = [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  };
  measure(entrants, runs.truth, plan);
  EXPECT_NEAR(last, 1, 1e-9);
}

// x'' = x from its unstable equilibrium: changes grow by e^T, most of all from the start on.
struct Saddle {
  static constexpr int n = 2;
  static void rhs(double, const double* x, const double*, double* d) {
    d[0] = x[1];
    d[1] = x[0];
  }
};

// x' = -x until 5, then x' = x, smoothly: a change at the start has its old size again at the end,
// one in the middle has grown by e^2.5. The time is a state here.
struct Turn {
  static constexpr int n = 2;
  static void rhs(double, const double* x, const double*, double* d) {
    d[0] = (x[1] - 5) / 5 * x[0];
    d[1] = 1;
  }
};

TEST(Conditioning, IsTheGrowthOfChanges) {
  const Module module = module_of<Saddle>(dop853<Saddle>);
  Settings settings;
  settings.duration = 10;
  const Entrant entrant = {&module, find_method("dop853"), settings, {0, 0}, {}, {}};
  const ReferenceState truth = {{0, 0}, {0, 0}, {1, 1}};
  EXPECT_NEAR(conditioning(entrant, truth) / std::cosh(10.), 1, 1e-3);
  // The larger scale of the second state lets the same change of it move the first more.
  EXPECT_NEAR(conditioning(entrant, {{0, 0}, {0, 0}, {1, 4}}) / (4 * std::sinh(10.)), 1, 1e-3);
}

TEST(Conditioning, FindsGrowthThatBeginsLate) {
  const Module module = module_of<Turn>(dop853<Turn>);
  Settings settings;
  settings.duration = 10;
  const Entrant entrant = {&module, find_method("dop853"), settings, {0, 0}, {}, {}};
  const ReferenceState truth = {{0, 0}, {0, 0}, {1, 10}};
  EXPECT_NEAR(conditioning(entrant, truth, 1), 1, 1e-2);
  EXPECT_NEAR(conditioning(entrant, truth) / std::exp(2.5), 1, 1e-2);
}

TEST(WorkPrecision, ToleranceExplainsOnlySoMuch) {
  const OscillatorRuns runs;
  const Entrant entrant = runs.entrant(1e-8);
  const auto samples = measure(std::vector{entrant}, runs.truth, {.rounds = 1});
  const double growth = conditioning(entrant, runs.truth);
  EXPECT_NEAR(growth, std::sqrt(2.), 0.5);
  const double explained = explained_error(entrant, samples.at(0), runs.truth, growth);
  EXPECT_LT(samples.at(0).error, explained / 100);
  EXPECT_LT(explained, 0.1) << "an error far above the tolerance is not excused";
  // States that are small beside the absolute tolerance may be off by more.
  const ReferenceState small = {{0, 0}, {0, 0}, {1, 1e-3}};
  EXPECT_GT(explained_error(entrant, samples.at(0), small, growth), 100 * explained);
  Entrant fixed = entrant;
  fixed.settings.fixed_step = 0.1;
  EXPECT_EQ(explained_error(fixed, samples.at(0), runs.truth, growth), INFINITY);
}

TEST(EqualError, InterpolatesInLogarithms) {
  const WorkPrecision curve({{1e-4, 1}, {1e-8, 4}});
  EXPECT_NEAR(curve.seconds_at(1e-6), 2, 1e-12);
  EXPECT_NEAR(curve.seconds_at(1e-5), std::sqrt(2.), 1e-12);
  EXPECT_EQ(curve.seconds_at(1e-8), 4);
  EXPECT_EQ(curve.seconds_at(1e-2), 1) << "a larger error costs no more";
  EXPECT_TRUE(std::isnan(curve.seconds_at(0.9e-8))) << "out of reach";
  EXPECT_EQ(curve.best_error(), 1e-8);
}

TEST(EqualError, RunsThatAreBeatenDoNotCount) {
  // The third is slower than the fourth and less exact; the last is exact by luck at a coarse
  // tolerance, and beats both neighbours.
  const WorkPrecision curve({{1e-2, 1}, {1e-4, 2}, {1e-5, 9}, {1e-6, 3}, {1e-4, 1.5}});
  ASSERT_EQ(curve.envelope().size(), 3U);
  EXPECT_EQ(curve.envelope()[1].seconds, 1.5);
  EXPECT_LT(curve.seconds_at(1e-5), 3);
  double before = 0;
  for (double e = 1; e > 1e-6; e /= 1.7) {
    EXPECT_GE(curve.seconds_at(e), before) << e;
    before = curve.seconds_at(e);
  }
}

TEST(EqualError, NothingMeasuredIsOutOfReach) {
  EXPECT_TRUE(std::isnan(WorkPrecision({}).seconds_at(1)));
  EXPECT_EQ(WorkPrecision({}).best_error(), INFINITY);
  EXPECT_EQ(WorkPrecision({{0, 1}}).seconds_at(1e-300), 1) << "no error at all";
  EXPECT_NEAR(geometric_mean({2, 8}), 4, 1e-12);
  EXPECT_TRUE(std::isnan(geometric_mean({})));
}

}  // namespace
}  // namespace casimir::test
