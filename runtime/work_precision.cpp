#include "runtime/work_precision.hpp"

#include <time.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

namespace casimir {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// A turn lasts at least so long.
constexpr double kTurnSeconds = 2e-4;
constexpr int kLeastRounds = 3;
constexpr int kMostTimings = 31;

/// An entrant on its way through the rounds.
struct TimedRunner {
  const Entrant* entrant;
  Sample* sample;
  Settings bare;  ///< without anything that watches
  int batch = 1;
  int rounds = kLeastRounds;
  std::vector<double> seconds = {};

  /// A run long enough to need neither a warm-up of its own nor, beside short ones, three rounds.
  static bool is_long(double seconds, const Plan& plan) { return seconds > plan.budget / 500; }

  double turn_seconds() const { return (batch > 1 ? batch + 1 : 1) * sample->seconds; }
};

/// What this thread alone has computed so far, in seconds.
double processor_seconds() {
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double run_once(const TimedRunner& runner, const ReferenceState& truth) {
  const Entrant& e = *runner.entrant;
  const Trajectory end = integrate(*e.module, *e.method, runner.bare, e.initial, e.parameters);
  const double error = end.status == Status::ok ? error_of(end.state, truth, e.which) : kInfinity;
  runner.sample->error = std::max(runner.sample->error, error);
  return end.seconds;
}

/// The run that tells error and drift. Gives up after `longest` seconds.
Sample watched_run(const Entrant& e, const ReferenceState& truth, double longest,
                   const std::function<bool()>& give_up) {
  Settings watched = e.settings;
  watched.monitor = true;
  watched.sample_every = 0;
  const double end = processor_seconds() + longest;
  Sample sample;
  // Asking the clock costs more than a short step.
  unsigned asked = 0;
  watched.give_up = [&] {
    if (++asked % 64 != 0 || (processor_seconds() < end && !(give_up && give_up()))) return false;
    return sample.too_slow = true;
  };
  Trajectory run;
  try {
    run = integrate(*e.module, *e.method, watched, e.initial, e.parameters);
  } catch (const std::invalid_argument& problem) {
    sample.refused = problem.what();
    sample.error = kNaN;
    return sample;
  }
  if (give_up && give_up()) throw Abandoned{};
  sample.status = run.status;
  sample.steps = run.steps;
  sample.evaluations = run.evaluations;
  sample.seconds = run.seconds;
  for (const InvariantRecord& record : run.invariants)
    sample.drift = std::max(sample.drift, record.drift);
  // A state at another time than the reference's has no error.
  sample.error = run.status == Status::ok ? error_of(run.state, truth, e.which) : kNaN;
  return sample;
}

/// How many rounds each takes part in, so that all of them together keep to the budget: equal time
/// for each, and what the short ones leave over goes to the others.
void share_out(std::vector<TimedRunner>& runners, const Plan& plan) {
  if (plan.rounds > 0) {
    for (TimedRunner& runner : runners) runner.rounds = plan.rounds;
    return;
  }
  const auto rounds_for = [&](const TimedRunner& runner, double share) {
    const int least = TimedRunner::is_long(runner.turn_seconds(), plan) ? 1 : kLeastRounds;
    return std::clamp(static_cast<int>(std::min(share / runner.turn_seconds(), 1e6)), least,
                      kMostTimings);
  };
  const auto cost = [&](double share) {
    return std::accumulate(runners.begin(), runners.end(), 0.,
                           [&](double sum, const TimedRunner& r) {
                             return sum + rounds_for(r, share) * r.turn_seconds();
                           });
  };
  double low = 0, high = plan.budget;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = (low + high) / 2;
    (cost(middle) > plan.budget ? high : low) = middle;
  }
  for (TimedRunner& runner : runners) runner.rounds = rounds_for(runner, low);
}

void take_turn(TimedRunner& runner, const ReferenceState& truth) {
  if (runner.batch > 1) run_once(runner, truth);
  const double start = processor_seconds();
  double spent = 0;
  for (int i = 0; i < runner.batch; ++i) spent += run_once(runner, truth);
  // The clock goes on while other programs have the processor, and then shows more than this one
  // has used in all.
  spent = std::min(spent, processor_seconds() - start);
  runner.seconds.push_back(spent / runner.batch);
}

void timed_rounds(std::vector<TimedRunner>& runners, const ReferenceState& truth, const Plan& plan,
                  const std::function<void(double)>& spent) {
  int rounds = 0;
  for (const TimedRunner& runner : runners) rounds = std::max(rounds, runner.rounds);
  std::vector<std::size_t> order(runners.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937 dice(1);
  for (int round = 0; round < rounds; ++round) {
    std::shuffle(order.begin(), order.end(), dice);
    for (const std::size_t i : order) {
      TimedRunner& runner = runners[i];
      // Spreads its rounds evenly over all of them.
      if ((round + 1) * runner.rounds / rounds == round * runner.rounds / rounds) continue;
      take_turn(runner, truth);
      if (plan.give_up && plan.give_up()) throw Abandoned{};
      spent(runner.turn_seconds());
    }
  }
}

void summarise(TimedRunner& runner) {
  std::vector<double>& seconds = runner.seconds;
  std::sort(seconds.begin(), seconds.end());
  const auto quantile = [&](double share) {
    const double place = share * static_cast<double>(seconds.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, seconds.size() - 1);
    return std::lerp(seconds[below], seconds[above], place - std::floor(place));
  };
  runner.sample->seconds = quantile(0.5);
  runner.sample->spread = (quantile(0.75) - quantile(0.25)) / 2;
  runner.sample->rounds = static_cast<int>(seconds.size());
}

/// Whether a run of the same method on the same module has already been too slow: tolerances are
/// tried from coarse to fine.
bool hopeless(std::span<const Entrant> before, const std::vector<Sample>& samples,
              const Entrant& entrant) {
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].module == entrant.module && before[i].method == entrant.method &&
        samples[i].too_slow && entrant.settings.rtol <= before[i].settings.rtol)
      return true;
  }
  return false;
}

}  // namespace

double error_of(const std::vector<double>& x, const ReferenceState& truth,
                std::span<const int> which) {
  assert(which.empty() ? x.size() == truth.state.size() : which.size() == truth.state.size());
  double largest = 0;
  for (std::size_t i = 0; i < truth.state.size(); ++i) {
    const double value = x[which.empty() ? i : static_cast<std::size_t>(which[i])];
    const double error = std::abs((value - truth.state[i]) - truth.rest[i]) / truth.scale[i];
    if (std::isnan(error)) return kInfinity;
    largest = std::max(largest, error);
  }
  return largest;
}

std::vector<Sample> measure(std::span<const Entrant> entrants, const ReferenceState& truth,
                            const Plan& plan) {
  std::vector<Sample> samples;
  samples.reserve(entrants.size());  // runners point into it
  std::vector<TimedRunner> runners;
  // The first runs are about so much of the whole.
  constexpr double kFirstRuns = 0.1;
  const auto report = [&](double share) {
    if (plan.progress) plan.progress(share);
  };
  for (std::size_t i = 0; i < entrants.size(); ++i) {
    const Entrant& entrant = entrants[i];
    if (hopeless(entrants.first(i), samples, entrant)) {
      samples.push_back({.status = Status::stopped, .too_slow = true, .error = kNaN});
      continue;
    }
    samples.push_back(watched_run(entrant, truth, plan.longest_run, plan.give_up));
    Sample& sample = samples.back();
    report(kFirstRuns * static_cast<double>(i + 1) / static_cast<double>(entrants.size()));
    if (!sample.refused.empty() || sample.status != Status::ok) continue;
    TimedRunner runner{&entrant, &sample, entrant.settings};
    runner.bare.monitor = false;
    runner.bare.sample_every = 0;
    runner.bare.give_up = {};
    if (!TimedRunner::is_long(sample.seconds, plan)) sample.seconds = run_once(runner, truth);
    runner.batch =
        static_cast<int>(std::ceil(kTurnSeconds / std::max(sample.seconds, kTurnSeconds * 1e-4)));
    runners.push_back(runner);
  }
  share_out(runners, plan);
  double total = 0, spent = 0;
  for (const TimedRunner& runner : runners) total += runner.rounds * runner.turn_seconds();
  timed_rounds(runners, truth, plan, [&](double seconds) {
    spent += seconds;
    report(kFirstRuns + (1 - kFirstRuns) * std::min(spent / total, 1.));
  });
  for (TimedRunner& runner : runners) summarise(runner);
  return samples;
}

double conditioning(const Entrant& entrant, const ReferenceState& truth, int times) {
  // The first that stays small is taken: where a change grows to the size of the state itself, it
  // says too little about smaller ones.
  constexpr double kChanges[] = {0x1p-26, 0x1p-36, 0x1p-46};
  constexpr double kSmall = 0.05;
  const auto run = [&](double duration, const std::vector<double>& from) {
    Settings settings = entrant.settings;
    settings.monitor = false;
    settings.sample_every = 0;
    settings.duration = duration;
    return integrate(*entrant.module, *entrant.method, settings, from, entrant.parameters);
  };
  const auto distance = [&](const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < truth.scale.size(); ++i) {
      const auto place = entrant.which.empty() ? i : static_cast<std::size_t>(entrant.which[i]);
      largest = std::max(largest, std::abs(a[place] - b[place]) / truth.scale[i]);
    }
    return largest;
  };
  double largest = 1;
  std::vector<double> from = entrant.initial;
  const double piece = entrant.settings.duration / times;
  for (int k = 0; k < times; ++k) {
    const double rest = piece * (times - k);
    const Trajectory end = run(rest, from);
    if (end.status != Status::ok) return kInfinity;
    for (std::size_t j = 0; j < truth.scale.size(); ++j) {
      const auto place = entrant.which.empty() ? j : static_cast<std::size_t>(entrant.which[j]);
      double growth = 0;
      bool small = false;
      for (const double change : kChanges) {
        std::vector<double> moved = from;
        moved[place] += change * truth.scale[j];
        const Trajectory neighbour = run(rest, moved);
        if (neighbour.status != Status::ok) return kInfinity;
        const double apart = distance(neighbour.state, end.state);
        growth = std::max(growth, apart / change);
        small = apart < kSmall;
        if (small) break;
      }
      if (!small) return kInfinity;  // at least so many times, and nobody knows how many
      largest = std::max(largest, growth);
    }
    const Trajectory next = run(piece, from);
    if (next.status != Status::ok) return kInfinity;
    from = next.state;
  }
  return largest;
}

double explained_error(const Entrant& entrant, const Sample& sample, const ReferenceState& truth,
                       double conditioning) {
  if (entrant.settings.fixed_step > 0) return kInfinity;
  constexpr double kGenerous = 1000;
  const double smallest = *std::min_element(truth.scale.begin(), truth.scale.end());
  const double of_a_step = entrant.settings.rtol + entrant.settings.atol / smallest +
                           std::numeric_limits<double>::epsilon();
  return kGenerous * conditioning * static_cast<double>(sample.steps) * of_a_step;
}

}  // namespace casimir
