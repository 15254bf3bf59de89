#include "tools/analysis/estimate/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/step/step_watch.hpp"
#include "tools/analysis/estimate/growth_of_changes.hpp"
#include "tools/analysis/estimate/neighbour_runs.hpp"
#include "tools/analysis/estimate/rounding_of_rates.hpp"
#include "tools/analysis/run/closed_form_error.hpp"
#include "tools/analysis/run/taylor_path.hpp"

namespace casimir {
namespace {

constexpr double kRoundoff = 0x1p-53;
/// Rounding errors that grow to this size leave no digits to speak of.
constexpr double kSpoiled = 1e-3;
constexpr double kSixDigits = 1e-6;
/// Seconds of a run that is repeated, and of one that may have passed something over.
constexpr double kLongToRepeat = 3, kLongestToRepeat = 10;
constexpr double kCrossCheckTolerance = 1e-10;
constexpr unsigned long long kCrossCheckSteps = 20000;
/// What is narrower than a thousandth of the run CVODE may step over.
constexpr double kLeastCrossCheckSteps = 1000, kMostCrossCheckSteps = 16000;

/// Where Taylor series get nowhere because the equations are stiff: by runs of the method itself,
/// which see the growth at the end only.
std::optional<Conditioning> conditioning_at_end(const NeighbourRuns& neighbours,
                                                std::size_t states) {
  Conditioning result;
  result.growth = {{0, 1}};
  for (std::size_t j = 0; j < states; ++j) {
    const auto growth = neighbours.growth_of_state(j);
    if (!growth) return std::nullopt;
    result.columns.push_back(*growth);
    result.at_end = std::max(result.at_end, *growth);
  }
  return result;
}

/// What rounding at every step comes to before it grows: as chance adds it up, and as the
/// invariants show.
double drift_of(const Trajectory& trajectory) {
  double drift = 0.03 * kRoundoff * std::sqrt(static_cast<double>(trajectory.steps));
  for (const InvariantRecord& record : trajectory.invariants) drift = std::max(drift, record.drift);
  return drift;
}

/// What two runs that only differ by rounding are believed at least: they may err alike.
double least_of_rounding(double growth, const Settings& settings, const Trajectory& trajectory) {
  const bool is_tighter = settings.rtol * kHundredth >= 2 * kLeastTolerance;
  return is_tighter || settings.fixed_step > 0 ? 0 : growth * drift_of(trajectory);
}

/// Where a second run would take too long: rounding errors that are made at every step and grow
/// from there on, the drift of invariants, which grows likewise, and the local errors allowed. Each
/// of these grows as well, half as much on the average as what was there at the start.
double estimate_without_repeat(double growth, const Settings& settings,
                               const Trajectory& trajectory) {
  const auto steps = static_cast<double>(trajectory.steps);
  return growth * drift_of(trajectory) + steps * settings.rtol * std::max(1., growth / 2);
}

/// What is to be believed at least of a run that takes as many steps as one with a hundredth of the
/// tolerance: something else than the tolerance sets them, such as kinks of the equations, or there
/// are only few of them. Then both have errors of one size, and their difference is no error.
/// (Series of another order take fewer steps, and err less.)
double least_of_equal_steps(double growth, const Settings& settings, const Trajectory& first,
                            const Trajectory& second) {
  constexpr double kEqual = 0.05;
  const auto steps = static_cast<double>(first.steps);
  const double more = static_cast<double>(second.steps) - steps;
  if (settings.fixed_step > 0 || std::abs(more) > std::max(1., kEqual * steps)) return 0;
  return kHundredth * steps * settings.rtol * std::max(1., growth);
}

/// The same motion by a method of another kind: steps that jump over a narrow passage do so at
/// every tolerance. Taylor series without a compiler, and for a run by these the Adams methods of
/// CVODE, where they get through in a few thousand steps.
struct CrossCheck {
  bool contradicts = false;  ///< they meet a singularity on the way
  double distance = 0;       ///< of the end states, as far as their own errors do not explain it
};

CrossCheck cross_check(const PreparedScene& run, const Method& method, const Settings& settings,
                       const Trajectory& trajectory, const std::vector<double>& sizes,
                       double growth) {
  const Specialisation& s = run.specialisation;
  const Module module = taylor_module_without_compiler(s.rhs, s.limits, {}, run.parameters);
  Settings own;
  own.duration = trajectory.time;
  own.rtol = kCrossCheckTolerance;
  own.atol = settings.atol * (own.rtol / std::max(settings.rtol, kLeastTolerance));
  own.max_steps = kCrossCheckSteps;
  own.longest_step = std::abs(trajectory.time) / kLeastCrossCheckSteps;
  own.give_up = settings.give_up;
  const Method* check = find_method(method.series ? "cvode-adams" : "taylor");
  // Differences are relative to the size of each state; series are as fast with a small one.
  if (check->series) own.atol = std::min(own.atol, own.rtol * std::ranges::min(sizes));
  Trajectory other = integrate(module, *check, own, run.initial, run.parameters);
  if (!method.series && other.status == Status::non_finite &&
      has_rates(module, other.time, other.state, run.parameters)) {
    // It is the series that end there, not the solution.
    check = find_method("cvode-adams");
    other = integrate(module, *check, own, run.initial, run.parameters);
  }
  CrossCheck result;
  result.contradicts = !method.series &&
                       (other.status == Status::singularity || other.status == Status::non_finite ||
                        other.status == Status::step_underflow);
  if (other.status != Status::ok) return result;
  // Both run with local errors of so much, which add up.
  const double local = std::max(100., static_cast<double>(other.steps)) * own.rtol +
                       std::max(100., static_cast<double>(trajectory.steps)) * settings.rtol;
  const double explained = std::min(0.1, growth * local);
  result.distance = relative_distance(other.state, trajectory.state, sizes);
  if (result.distance > explained && !check->series) {
    // It is CVODE that may have stepped over something: its word is taken for it with more steps.
    own.longest_step = std::abs(trajectory.time) / kMostCrossCheckSteps;
    own.max_steps = 4 * kCrossCheckSteps;
    const Trajectory again = integrate(module, *check, own, run.initial, run.parameters);
    if (again.status == Status::ok) {
      const double apart = relative_distance(again.state, trajectory.state, sizes);
      if (apart <= explained) result.distance = apart;
    }
  }
  if (!(result.distance > explained)) result.distance = 0;
  return result;
}

/// Whether runs are apart on the way though both end in the same place. It is looked at where that
/// takes next to no time, and where changes of the size of local errors become as large as the
/// state, and die out.
NeighbourRuns::Parting parting(const NeighbourRuns& neighbours, const Settings& settings,
                               const ErrorEstimate& trust, double share_of_budget) {
  constexpr double kOfConstantStep = 1e-4, kDiesOut = 0.1, kApart = 1e-3, kNextToNothing = 0.02;
  const double local =
      settings.fixed_step > 0 ? kOfConstantStep : std::max(kRoundoff, settings.rtol);
  const bool may_be =
      trust.on_the_way * local > kSpoiled && trust.conditioning < kDiesOut * trust.on_the_way;
  if (!(trust.error_estimate < kApart) || !(may_be || share_of_budget < kNextToNothing)) return {};
  return neighbours.parted_on_the_way(kApart);
}

/// The sizes of the states at both ends, where they are smaller than on the way.
std::vector<double> end_sizes(const PreparedScene& run, const Trajectory& trajectory) {
  Trajectory ends = trajectory;
  for (std::size_t i = 0; i < ends.sizes.size(); ++i)
    ends.sizes[i] = std::max(std::abs(run.initial[i]), std::abs(ends.state[i]));
  const double largest = std::ranges::max(ends.sizes);
  for (std::size_t i = 0; i < ends.sizes.size(); ++i)
    ends.sizes[i] = std::min(trajectory.sizes[i], std::max(ends.sizes[i], 1e-3 * largest));
  return sizes_of(ends);
}

/// Whether the states become more than ten times what they were: then each step multiplies them by
/// much the same number, and rounds it in much the same way, which a second run does as well.
bool grows(const PreparedScene& run, const std::vector<double>& sizes) {
  constexpr double kSmallPart = 0.1;
  double part = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    part = std::max(part, std::abs(run.initial[i]) / sizes[i]);
  return part < kSmallPart;
}

/// What rounding the start does to the end, where that is far more than the growth of small changes
/// says; else 0.
double unforeseen(const NeighbourRuns& neighbours, const PreparedScene& run,
                  const std::optional<Conditioning>& flow, const std::vector<double>& sizes) {
  constexpr double kFarMore = 30, kRoundings = 1000, kAll = 1;
  if (!flow) return 0;
  const std::optional<double> moved = neighbours.moved_by_rounding();
  if (!moved) return 0;
  double foreseen = kRoundings * kRoundoff;
  for (std::size_t j = 0; j < sizes.size(); ++j)
    foreseen += flow->columns[j] * 2 * kRoundoff * std::abs(run.initial[j]) / sizes[j];
  foreseen = std::max(foreseen, kRoundoff * flow->on_the_way());
  return *moved > kFarMore * foreseen ? std::min(*moved, kAll) : 0;
}

}  // namespace

bool ErrorEstimate::died_out() const {
  return beyond_double && conditioning * kRoundoff < kSpoiled;
}

namespace {

/// What rounding the duration to double does to the end state, relative to the sizes.
double moved_by_duration(const PreparedScene& run, const CompiledModule& compiled,
                         const Settings& settings, const Trajectory& trajectory,
                         const std::vector<double>& sizes) {
  double rounding = std::abs(run.duration_rounding);
  if (settings.duration != run.duration) {
    // One that is given with a command is a decimal; with few binary digits it is that exactly.
    constexpr int kFewBits = 20;
    const double scaled = std::ldexp(settings.duration, kFewBits);
    rounding = scaled == std::floor(scaled) ? 0 : kRoundoff * std::abs(settings.duration);
  }
  if (rounding == 0) return 0;
  std::vector<double> rates(trajectory.state.size());
  compiled.module.functions().rhs(trajectory.time, trajectory.state.data(),
                                  run.parameters.empty() ? nullptr : run.parameters.data(),
                                  rates.data());
  double moved = 0;
  for (std::size_t i = 0; i < rates.size(); ++i)
    if (std::isfinite(rates[i]) && sizes[i] > 0)
      moved = std::max(moved, std::abs(rates[i]) * rounding / sizes[i]);
  return moved;
}

/// A closed form is made of the exact numbers of the scene and takes no steps: neither rounding the
/// data, but for the duration, nor what grows on the way is an error of it.
ErrorEstimate assess_closed_form(const PreparedScene& run, const CompiledModule& compiled,
                                 double error, const Method& method, const Settings& settings,
                                 const Trajectory& trajectory, const std::vector<double>& sizes) {
  ErrorEstimate trust;
  const std::optional<Conditioning> flow =
      conditioning(run, settings, trajectory.time, sizes, false);
  trust.known = true;
  trust.conditioning = flow ? flow->at_end : 1;
  trust.on_the_way = flow ? flow->on_the_way() : 1;
  trust.input_rounding = moved_by_duration(run, compiled, settings, trajectory, sizes);
  trust.error_estimate = error + trust.input_rounding;
  if (flow && flow->followed > 0 && flow->followed < 0.99 * std::abs(trajectory.time))
    trust.followed = flow->followed;
  // Where another method gets there, what it says must agree as far as its own errors go.
  const CrossCheck check =
      cross_check(run, method, settings, trajectory, end_sizes(run, trajectory), trust.on_the_way);
  trust.error_estimate = std::max(trust.error_estimate, check.distance);
  return trust;
}

}  // namespace

ErrorEstimate assess(const PreparedScene& run, const CompiledModule& compiled, const Method& method,
                     const Settings& settings, const Trajectory& trajectory, double budget) {
  ErrorEstimate trust;
  if (trajectory.status != Status::ok) return trust;
  const std::vector<double> sizes = sizes_of(trajectory);
  if (method.closed_form)
    if (const std::optional<double> error = closed_form_error(run, sizes))
      return assess_closed_form(run, compiled, *error, method, settings, trajectory, sizes);
  const std::size_t n = run.initial.size();
  NeighbourRuns neighbours(run, compiled, method, settings, trajectory, sizes);
  // Polynomials of low degree hide nothing from a step.
  const StepWatch* const watch = compiled.module.watch();
  const double* const numbers = run.parameters.empty() ? nullptr : run.parameters.data();
  const bool may_hide =
      (watch && watch->looks(numbers, run.initial.data())) || run.specialisation.uses_time;
  const bool has_time = trajectory.seconds < kLongToRepeat * budget ||
                        (may_hide && trajectory.seconds < kLongestToRepeat);
  const bool repeated = has_time && neighbours.begin();
  trust.unconfirmed = has_time && !repeated;
  const bool stiff = method.implicit && !method.preserves_quadratic;
  std::optional<Conditioning> flow = conditioning(run, settings, trajectory.time, sizes, stiff);
  const bool short_of_end = !flow || flow->followed < 0.99 * std::abs(trajectory.time);
  const double neighbours_take = static_cast<double>(n) * 3 * trajectory.seconds;
  if (repeated && short_of_end && method.implicit && neighbours_take < budget)
    flow = conditioning_at_end(neighbours, n);
  trust.known = flow.has_value();
  const double growth = flow ? flow->at_end : 1;
  trust.conditioning = growth;
  trust.on_the_way = flow ? flow->on_the_way() : 1;
  for (std::size_t j = 0; flow && j < n; ++j)
    trust.input_rounding += flow->columns[j] * std::abs(run.rounding[j]) / sizes[j];
  for (std::size_t j = 0; repeated && j < run.parameters.size(); ++j) {
    if (run.parameter_rounding[j] == 0) continue;
    const double moved = neighbours.moved_by_parameter(j);
    trust.unconfirmed = trust.unconfirmed || std::isinf(moved);
    if (std::isfinite(moved)) trust.input_rounding += moved;
  }
  trust.input_rounding += moved_by_duration(run, compiled, settings, trajectory, sizes);
  if (repeated && trajectory.seconds < budget)
    trust.input_rounding = std::max(trust.input_rounding, unforeseen(neighbours, run, flow, sizes));
  trust.error_estimate = trust.input_rounding +
                         (repeated ? relative_distance(neighbours.better().state, trajectory.state,
                                                       end_sizes(run, trajectory)) +
                                         growth * kRoundoff
                                   : estimate_without_repeat(growth, settings, trajectory));
  if (repeated) {
    const auto [rounding, overflow] =
        error_of_rates(run, compiled.module, neighbours.better(), end_sizes(run, trajectory));
    trust.overflow = overflow;
    trust.error_estimate += std::min(rounding * growth, std::max(rounding, 1.));
    trust.error_estimate =
        std::max({trust.error_estimate, overflow, least_of_rounding(growth, settings, trajectory),
                  least_of_equal_steps(growth, settings, trajectory, neighbours.better())});
  }
  if (repeated && settings.sample_every > 0)
    trust.samples_error = neighbours.distance_of_samples(trajectory, settings.sample_every);
  if (grows(run, sizes)) trust.error_estimate += kRoundoff * static_cast<double>(trajectory.steps);
  if (!method.series || may_hide) {
    const CrossCheck check =
        cross_check(run, method, settings, trajectory, end_sizes(run, trajectory), growth);
    trust.unconfirmed = trust.unconfirmed || check.contradicts;
    trust.error_estimate = std::max(trust.error_estimate, check.distance);
  }
  trust.unconfirmed = trust.unconfirmed || (may_hide && !has_time && short_of_end);
  if (repeated) {
    const NeighbourRuns::Parting found =
        parting(neighbours, settings, trust, trajectory.seconds / budget);
    trust.parted = found.apart;
    trust.error_estimate = std::max({trust.error_estimate, found.at_end, found.apart.value_or(0)});
  }
  trust.beyond_double = !(trust.on_the_way * kRoundoff < kSpoiled);
  // Which way the motion took was decided by rounding: all of the state is in doubt, which the
  // growth up to the end does not show.
  if (trust.died_out()) trust.error_estimate = std::max(trust.error_estimate, 1.);
  if (!flow) return trust;
  if (trust.beyond_double) trust.six_digits_until = flow->time_of(kSixDigits / kRoundoff);
  if (flow->followed > 0 && flow->followed < 0.99 * std::abs(trajectory.time))
    trust.followed = flow->followed;
  return trust;
}

}  // namespace casimir
