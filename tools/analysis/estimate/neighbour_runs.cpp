#include "tools/analysis/estimate/neighbour_runs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/every_second.hpp"
#include "symbolic/error.hpp"
#include "tools/analysis/run/taylor_path.hpp"

namespace casimir {
namespace {

constexpr double kDoubleRounding = 0x1p-53;
/// Relative changes of a state whose growth is measured. The first that stays small is taken: where
/// a change grows to the size of the state itself, it says too little about smaller ones.
constexpr double kChanges[] = {0x1p-26, 0x1p-36, 0x1p-46};
constexpr double kSmallGrowth = 0.05;
/// Of the run that is repeated: no whole number of periods of anything between them.
constexpr double kSamplesOfRun = 61.8;

/// Series continue behind their last coefficient, so that steps of many tolerances are much the
/// same and err alike: their runs are repeated with a tolerance at which they have other
/// coefficients.
double part_of_tolerance(const Method& method, const Settings& settings) {
  constexpr double kFine = 1e-12;
  if (!method.series || !(settings.rtol > 0) || settings.fixed_step > 0) return kHundredth;
  return std::min(kHundredth, kFine / settings.rtol);
}

/// More steps than a run with this part of the tolerance has: one that takes so many follows
/// something else than the first, such as the rounding of the equations, and may come to no end.
unsigned long long steps_of_repeated(const Method& method, const Trajectory& trajectory,
                                     double part) {
  constexpr double kHighOrder = 8, kTimes = 3, kAlways = 10000;
  const double order = method.order > 0 ? method.order : kHighOrder;
  const auto first = static_cast<double>(trajectory.steps + trajectory.rejected);
  return static_cast<unsigned long long>(kAlways + kTimes * std::pow(part, -1 / order) * first);
}

}  // namespace

double relative_distance(const std::vector<double>& a, const std::vector<double>& b,
                         const std::vector<double>& sizes) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]) / sizes[i]);
  }
  return largest;
}

NeighbourRuns::NeighbourRuns(const PreparedScene& run, const CompiledModule& compiled,
                             const Method& method, const Settings& settings,
                             const Trajectory& trajectory, const std::vector<double>& sizes)
    : run_(run),
      compiled_(compiled),
      method_(method),
      first_(trajectory),
      own_(settings),
      tight_(settings),
      sizes_(sizes) {
  const double part = part_of_tolerance(method, settings);
  if (tight_.max_steps == 0) tight_.max_steps = steps_of_repeated(method, trajectory, part);
  // Only a run that is watched goes on where products of states are beyond all numbers.
  constexpr double kHuge = 1e130;
  tight_.monitor = std::ranges::max(sizes) > kHuge;
  tight_.sample_every = std::abs(settings.duration) / kSamplesOfRun;
  tight_.invariant_changes = nullptr;
  tight_.rtol = std::max(settings.rtol * part, 2 * kLeastTolerance);
  tight_.atol = settings.atol * part;
  if (part < kHundredth) refined_ = kHundredth / part;
  tight_.fixed_step = settings.fixed_step / 2;
  // At the least tolerance the steps would be the same ones.
  constexpr double kOdd = 0.0618;
  tight_.begin_anew = settings.fixed_step > 0 ? 0 : kOdd * std::abs(settings.duration);
  // Behind each jump of the equations both runs would err by the same.
  constexpr double kFurther = 4;
  tight_.land_further = kFurther;
}

bool NeighbourRuns::begin() {
  better_ = integrate(compiled_.module, method_, tight_, run_.initial, run_.parameters);
  if (better_.status != Status::ok && better_.status != Status::stopped && refined_ > 0) {
    // Noise of the equations may be in the way of a much finer tolerance.
    tight_.rtol *= refined_;
    tight_.atol *= refined_;
    better_ = integrate(compiled_.module, method_, tight_, run_.initial, run_.parameters);
  }
  constexpr double kNearRounding = 1e-11, kLooser = 1e4;
  const bool too_tight = method_.implicit && tight_.rtol < kNearRounding &&
                         !(tight_.fixed_step > 0) && better_.status != Status::stopped;
  if (better_.status != Status::ok && too_tight) {
    tight_.rtol *= kLooser;
    tight_.atol *= kLooser;
    better_ = integrate(compiled_.module, method_, tight_, run_.initial, run_.parameters);
  }
  return better_.status == Status::ok;
}

std::optional<double> NeighbourRuns::distance_of_samples(const Trajectory& trajectory,
                                                         double every) const {
  Settings again = tight_;
  again.sample_every = every;
  const Trajectory other =
      integrate(compiled_.module, method_, again, run_.initial, run_.parameters);
  if (other.status != Status::ok || other.samples.size() != trajectory.samples.size())
    return std::nullopt;
  double largest = 0;
  for (std::size_t k = 0; k < other.samples.size(); ++k)
    largest = std::max(largest, relative_distance(other.samples[k], trajectory.samples[k], sizes_));
  return largest;
}

NeighbourRuns::Way NeighbourRuns::way_of(Settings settings) const {
  constexpr std::size_t kMost = 8192;
  Way way;
  std::size_t steps = 0, stride = 1;
  settings.monitor = true;
  settings.invariant_changes = nullptr;
  settings.sample_every = 0;
  settings.watch_within = [&](double t, const double* x, const auto&) {
    if (++steps % stride != 0) return;
    if (way.times.size() == kMost) {
      keep_every_second(way.times);
      keep_every_second(way.states);
      stride *= 2;
      if (steps % stride != 0) return;
    }
    way.times.push_back(t);
    way.states.emplace_back(x, x + sizes_.size());
  };
  way.reached =
      integrate(compiled_.module, method_, settings, run_.initial, run_.parameters).status ==
      Status::ok;
  return way;
}

NeighbourRuns::Way NeighbourRuns::at_times(const std::vector<double>& times, Settings settings,
                                           const Module& module, const Method& method) const {
  Way way;
  const double direction = settings.duration < 0 ? -1 : 1;
  std::vector<double> state(sizes_.size());
  settings.monitor = true;
  settings.invariant_changes = nullptr;
  settings.sample_every = 0;
  settings.watch_within = [&](double t, const double*, const auto& state_at) {
    for (; way.times.size() < times.size(); way.states.push_back(state)) {
      const double time = times[way.times.size()];
      if (direction * (time - t) > 0) return;
      state_at(time, state.data());
      way.times.push_back(time);
    }
  };
  const Trajectory run = integrate(module, method, settings, run_.initial, run_.parameters);
  way.reached = run.status == Status::ok;
  way.end = run.state;
  return way;
}

/// By series, or where these get nowhere by Radau's method.
NeighbourRuns::Way NeighbourRuns::reference(const std::vector<double>& times, double rtol) const {
  constexpr unsigned long long kMostSteps = 20000;
  Settings settings;
  settings.begin = own_.begin;
  settings.duration = own_.duration;
  settings.rtol = rtol;
  settings.atol = rtol * std::ranges::min(sizes_);
  settings.max_steps = kMostSteps;
  settings.give_up = own_.give_up;
  const Specialisation& s = run_.specialisation;
  const Module series = taylor_module_without_compiler(s.rhs, s.limits, {}, run_.parameters);
  Way way = at_times(times, settings, series, *find_method("taylor"));
  if (way.reached) return way;
  const Method& stiff = *find_method("radau9");
  return at_times(times, settings, compile_for(run_, stiff).module, stiff);
}

double NeighbourRuns::largest_distance(const Way& a, const Way& b) const {
  double largest = 0;
  for (std::size_t k = 0; k < std::min(a.states.size(), b.states.size()); ++k)
    largest = std::max(largest, relative_distance(a.states[k], b.states[k], sizes_));
  return largest;
}

NeighbourRuns::Parting NeighbourRuns::parted_on_the_way(double least) const {
  const Module& module = compiled_.module;
  const Way first = way_of(own_), second = at_times(first.times, tight_, module, method_);
  if (!first.reached || !second.reached) return {};
  const double apart = largest_distance(first, second);
  if (!(apart > least)) return {};
  constexpr double kShrinks = 0.3, kFine = 1e-9, kFinest = 1e-12;
  Settings third = tight_;
  third.rtol *= kHundredth;
  third.atol *= kHundredth;
  third.fixed_step /= 2;
  if (third.fixed_step > 0 || third.rtol >= 2 * kLeastTolerance) {
    const Way tighter = at_times(first.times, third, module, method_);
    if (tighter.reached && largest_distance(second, tighter) < kShrinks * apart) return {};
  }
  const Way fine = reference(first.times, kFine), finest = reference(first.times, kFinest);
  if (!fine.reached || !finest.reached || !(largest_distance(fine, finest) < kShrinks * apart))
    return {.apart = apart};
  return {.at_end = relative_distance(finest.end, first_.state, sizes_)};
}

std::optional<double> NeighbourRuns::moved_by_rounding() const {
  std::vector<double> moved = run_.initial;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (run_.rounding[i] != 0)
      moved[i] = std::nextafter(moved[i], run_.rounding[i] > 0 ? HUGE_VAL : -HUGE_VAL);
  if (moved == run_.initial) return std::nullopt;
  const auto moved_by = [&](const Settings& settings, const Trajectory& beside) {
    const Trajectory other = integrate(compiled_.module, method_, settings, moved, run_.parameters);
    return other.status == Status::ok ? relative_distance(other.state, beside.state, sizes_)
                                      : HUGE_VAL;
  };
  const double apart = moved_by(tight_, better_);
  // Near what a method can do it may be the tolerance that a run fails of.
  return std::isfinite(apart) ? apart : moved_by(own_, first_);
}

std::optional<double> NeighbourRuns::growth_of_state(std::size_t j) const {
  return growth([&](double change) {
    std::vector<double> moved = run_.initial;
    moved[j] += change * sizes_[j];
    return integrate(compiled_.module, method_, tight_, moved, run_.parameters);
  });
}

double NeighbourRuns::moved_by_parameter(std::size_t j) const {
  const double rounding = std::abs(run_.parameter_rounding[j] / run_.parameters[j]);
  constexpr double kFarMore = 30, kRoundings = 1000;
  double nearby = 0;
  for (const double side : {-HUGE_VAL, HUGE_VAL}) {
    const auto other = with_parameter(j, std::nextafter(run_.parameters[j], side));
    if (!other || other->status != Status::ok) return HUGE_VAL;
    nearby = std::max(nearby, relative_distance(other->state, better_.state, sizes_));
  }
  const auto grown = growth([&](double change) {
    Trajectory none;
    none.status = Status::non_finite;
    return with_parameter(j, run_.parameters[j] * (1 + change)).value_or(none);
  });
  const double foreseen = grown ? *grown * rounding : 0;
  const bool is_more = nearby > kFarMore * std::max(foreseen, kRoundings * kDoubleRounding);
  return !grown || is_more ? std::max(nearby, foreseen) : foreseen;
}

/// Nothing where the equations have no value at that parameter.
std::optional<Trajectory> NeighbourRuns::with_parameter(std::size_t j, double value) const {
  PreparedScene moved = run_;  // where nothing is compiled, the module holds the parameters
  moved.parameters[j] = value;
  try {
    return integrate(compile_for(moved, method_).module, method_, tight_, moved.initial,
                     moved.parameters);
  } catch (const ModelError&) {
    return std::nullopt;
  }
}

std::optional<double> NeighbourRuns::growth(
    const std::function<Trajectory(double change)>& neighbour_at) const {
  double largest = 0;
  for (const double change : kChanges) {
    const Trajectory neighbour = neighbour_at(change);
    if (neighbour.status != Status::ok) return std::nullopt;
    const double apart = relative_distance(neighbour.state, better_.state, sizes_);
    largest = std::max(largest, apart / change);
    if (apart < kSmallGrowth) break;
  }
  return largest;
}

}  // namespace casimir
