#include "tools/analysis/run/conservation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tools/analysis/error.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/estimate/reference_state.hpp"
#include "tools/analysis/run/changing_invariant.hpp"

namespace casimir {
namespace {

constexpr double kConservingTolerance = 1e-12;
/// A stiff scene takes more from a method that is not made for it, and would take hours.
constexpr unsigned long long kMostStiffStepsWatched = 200'000;

/// Whether a scene may be refused: its motion ends, comes close to where the variables end, or
/// takes another method.
bool may_be_refused(const Scene& scene) {
  return scene.extreme == Extreme::blowup || scene.extreme == Extreme::gimbal ||
         scene.extreme == Extreme::stiff;
}

/// Which invariant drifted most, for the table.
/// \param among_numbers  not of those that have no value at some state, whose drift is infinite
double largest_drift(const Trajectory& trajectory, bool among_numbers = false) {
  double drift = 0;
  for (const InvariantRecord& record : trajectory.invariants)
    if (!among_numbers || std::isfinite(record.drift)) drift = std::max(drift, record.drift);
  return drift;
}

/// What `progress` is told of.
void show_progress(Settings& settings, const ConservationOptions& options) {
  if (!options.progress) return;
  settings.progress = [&options, duration = std::abs(settings.duration),
                       calls = 0U](double t) mutable {
    constexpr unsigned kBetween = 256;  // a step of a small system is faster than a clock
    if (++calls % kBetween == 0 && duration > 0) options.progress(std::abs(t) / duration);
  };
}

Trajectory trajectory_of(const Model& model, const PreparedScene& run, const Method& method,
                         Settings settings) {
  CancelledParts parts(model, run);
  parts.watch(settings);
  try {
    Trajectory trajectory =
        integrate(compile_for(run, method).module, method, settings, run.initial, run.parameters);
    if (parts.lost()) parts.end(trajectory);
    return trajectory;
  } catch (const std::invalid_argument& problem) {
    throw RequestError(problem.what());
  }
}

/// What the trajectory says in a row of its own.
void judge_conservation(Row& row, const Trajectory& trajectory, const Scene& scene, double bound,
                        const std::vector<std::string>& names) {
  row.drift = largest_drift(trajectory);
  row.seconds = trajectory.seconds;
  row.steps = trajectory.steps;
  row.evaluations = trajectory.evaluations;
  row.status = trajectory.status;
  row.refused = trajectory.status != Status::ok && may_be_refused(scene);
  // Written so that a drift that is not a number fails too.
  row.failed = !row.refused && (trajectory.status != Status::ok || !(row.drift <= bound));
  if (trajectory.status == Status::ok && row.failed) {
    const auto lost = std::ranges::find_if(
        trajectory.invariants, [](const auto& record) { return !std::isfinite(record.drift); });
    const double drifted = largest_drift(trajectory, true);
    row.end = drifted > bound ? RowEnd::drifted : RowEnd::lost;
    if (row.end == RowEnd::drifted)
      row.drift = drifted;
    else
      row.reason = names.at(static_cast<std::size_t>(lost - trajectory.invariants.begin()));
    row.bound = bound;
  }
  if (trajectory.invariants.empty()) row.drift = std::numeric_limits<double>::quiet_NaN();
}

/// The first and the last state, with the variables that are not integrated at their first values.
std::vector<std::vector<double>> ends_of(const Model& model, const Scene& scene,
                                         const PreparedScene& run, const Trajectory& trajectory) {
  std::vector<double> first;
  for (const GiNaC::ex& value : scene.initial)
    first.push_back(GiNaC::ex_to<GiNaC::numeric>(value.evalf()).to_double());
  std::vector<double> last = first;
  const std::vector<int>& places = run.specialisation.state_indices;
  if (places.size() != model.variables.size()) return {first};
  for (std::size_t i = 0; i < places.size(); ++i)
    last[static_cast<std::size_t>(places[i])] = trajectory.state[i];
  return {first, last};
}

}  // namespace

const std::vector<std::string>& conserving_methods() {
  static const std::vector<std::string> kMethods{"taylor", "dop853", "gauss8"};
  return kMethods;
}

Conservation conserve(const Model& model, const Scene& scene, const Method& method,
                      const ConservationOptions& options) {
  SceneOptions code = options.code;
  code.observe = std::vector<std::string>{};
  const PreparedScene run = prepare(model, scene, code);
  Settings settings = settings_for(options.run, run, kConservingTolerance);
  settings.give_up = options.give_up;
  show_progress(settings, options);
  if (scene.extreme == Extreme::stiff && settings.max_steps == 0)
    settings.max_steps = kMostStiffStepsWatched;
  Conservation result;
  result.invariants = run.specialisation.invariant_names;
  if (options.watch) options.watch(settings, result.invariants);
  Row& row = result.row;
  row.case_name = model.name;
  row.scene = scene.name;
  row.method = method.name;
  row.tolerance = settings.rtol;
  if (!suits(run, method)) {
    row.end = method.splits ? RowEnd::does_not_split : RowEnd::refused;
    row.refused = true;
    return result;
  }
  const Trajectory& trajectory =
      result.trajectory.emplace(trajectory_of(model, run, method, settings));
  judge_conservation(row, trajectory, scene, options.bound, result.invariants);
  if (row.ok())
    if (auto name = changing_invariant(model, scene, ends_of(model, scene, run, trajectory),
                                       {0, trajectory.time})) {
      row.end = RowEnd::changes;
      row.failed = true;
      row.reason = std::move(*name);
    }
  if (trajectory.status == Status::ok && !scene.reference.empty() && !options.run.duration) {
    // A run with many digits for a state that nobody asked for may take minutes and gigabytes.
    const ReferenceStateOrReason truth =
        reference_state_of(scene, run, {.only_the_file = true, .give_up = options.give_up});
    if (truth.truth) row.error = error_of(trajectory.state, *truth.truth);
  }
  return result;
}

}  // namespace casimir
