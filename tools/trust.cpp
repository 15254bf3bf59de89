#include "tools/trust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tools/run_report.hpp"

namespace casimir::tools {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;
/// Relative changes of a state whose growth is measured. The first that stays small is taken: where
/// a change grows to the size of the state itself, it says too little about smaller ones.
constexpr double kChanges[] = {0x1p-26, 0x1p-36, 0x1p-46};
constexpr double kSmall = 0.05;
/// Rounding errors that grow to this size leave no digits to speak of.
constexpr double kSpoiled = 1e-3;

std::vector<double> sizes_of(const Trajectory& trajectory, const std::vector<double>& initial) {
  std::vector<double> sizes;
  double largest = 0;
  for (std::size_t i = 0; i < initial.size(); ++i) {
    sizes.push_back(std::max(std::abs(initial[i]), std::abs(trajectory.state[i])));
    largest = std::max(largest, sizes.back());
  }
  for (double& size : sizes) size = largest == 0 ? 1 : std::max(size, 1e-3 * largest);
  return sizes;
}

double distance(const std::vector<double>& a, const std::vector<double>& b,
                const std::vector<double>& sizes) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]) / sizes[i]);
  }
  return largest;
}

}  // namespace

Trust assess(const SceneRun& run, const CompiledModule& compiled, const Method& method,
             const Settings& settings, const Trajectory& trajectory, double budget) {
  Trust trust;
  const std::size_t n = run.initial.size();
  const auto rounded_parameters =
      std::count_if(run.parameter_rounding.begin(), run.parameter_rounding.end(),
                    [](double rounding) { return rounding != 0; });
  const double runs = static_cast<double>(n + 2) + static_cast<double>(rounded_parameters);
  if (trajectory.status != Status::ok || trajectory.seconds * runs > budget) return trust;
  const std::vector<double> sizes = sizes_of(trajectory, run.initial);
  Settings bare = settings;
  bare.monitor = false;
  bare.sample_every = 0;
  const auto end_of = [&](const Settings& how, const std::vector<double>& from) {
    return integrate(compiled.module, method, how, from, run.parameters);
  };
  Settings tight = bare;
  tight.rtol = std::max(settings.rtol / 100, 2 * kLeastTolerance);
  tight.atol = settings.atol / 100;
  tight.fixed_step = settings.fixed_step / 2;
  const Trajectory better = end_of(tight, run.initial);
  if (better.status != Status::ok) return trust;
  // How many times a relative change of one input grows; nothing if a run fails.
  const auto growth_of = [&](const auto& neighbour_at) -> std::optional<double> {
    double growth = 0;
    for (const double change : kChanges) {
      const Trajectory neighbour = neighbour_at(change);
      if (neighbour.status != Status::ok) return std::nullopt;
      const double apart = distance(neighbour.state, better.state, sizes);
      growth = std::max(growth, apart / change);
      if (apart < kSmall) break;
    }
    return growth;
  };
  for (std::size_t j = 0; j < n; ++j) {
    const auto growth = growth_of([&](double change) {
      std::vector<double> moved = run.initial;
      moved[j] += change * sizes[j];
      return end_of(tight, moved);
    });
    if (!growth) return trust;
    trust.conditioning = std::max(trust.conditioning, *growth);
    trust.input_rounding += *growth * std::abs(run.rounding[j]) / sizes[j];
  }
  for (std::size_t j = 0; j < run.parameters.size(); ++j) {
    if (run.parameter_rounding[j] == 0) continue;
    const auto growth = growth_of([&](double change) {
      SceneRun moved = run;  // where nothing is compiled, the module holds the parameters
      moved.parameters[j] *= 1 + change;
      return integrate(compile_for(moved, method).module, method, tight, moved.initial,
                       moved.parameters);
    });
    if (!growth) return trust;
    trust.input_rounding += *growth * std::abs(run.parameter_rounding[j] / run.parameters[j]);
  }
  trust.known = true;
  trust.error_estimate = distance(better.state, trajectory.state, sizes) +
                         trust.conditioning * kUnitRoundoff + trust.input_rounding;
  trust.beyond_double = !(trust.conditioning * kUnitRoundoff < kSpoiled);
  return trust;
}

nlohmann::ordered_json to_json(const Trust& trust) {
  if (!trust.known) {
    return {{"conditioning", nullptr},
            {"input_rounding", nullptr},
            {"error_estimate", nullptr},
            {"beyond_double", nullptr}};
  }
  return {{"conditioning", exact_text(trust.conditioning)},
          {"input_rounding", exact_text(trust.input_rounding)},
          {"error_estimate", exact_text(trust.error_estimate)},
          {"beyond_double", trust.beyond_double}};
}

std::vector<std::string> warnings_of(const Trust& trust) {
  std::vector<std::string> warnings;
  if (!trust.known) return warnings;
  if (trust.beyond_double) {
    warnings.push_back(
        fmt::format("small changes of the initial state grow {:.0e} times: double precision "
                    "cannot hold this motion to its end",
                    trust.conditioning));
  } else if (!(trust.error_estimate < kSpoiled)) {
    warnings.push_back(
        fmt::format("a run with a hundredth of the tolerance ends elsewhere, by {:.0e} of the "
                    "state: tighten --tolerance",
                    trust.error_estimate));
  }
  return warnings;
}

}  // namespace casimir::tools
