#include "tools/analysis/run_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "symbolic/error.hpp"
#include "tools/analysis/error.hpp"

namespace casimir {
namespace {

/// What the absolute tolerance of a start is a part of.
double unit_of(std::span<const double> start) {
  double size = 0;
  for (const double x : start) size = std::max(size, std::abs(x));
  return size > 0 ? std::min(size, 1.0) : 1.0;
}

}  // namespace

Settings settings_for(const RunRequest& request, const PreparedScene& run,
                      double default_tolerance) {
  Settings settings;
  settings.duration = request.duration ? *request.duration : duration_of(run);
  settings.rtol = request.rtol.value_or(request.tolerance.value_or(default_tolerance));
  const double unit = unit_of(run.initial);
  // Small components beside large ones keep three digits more than the large ones need.
  constexpr double kSmallComponents = 1e-3;
  settings.atol = request.atol        ? *request.atol
                  : request.tolerance ? *request.tolerance * unit
                                      : settings.rtol * unit * kSmallComponents;
  settings.fixed_step = request.step.value_or(0);
  settings.max_steps = request.max_steps;
  settings.invariant_terms = run.invariant_terms();
  settings.invariants = &run.specialisation.invariants;
  return settings;
}

void scale_tolerances(const RunRequest& request, const PreparedScene& run, const Settings& settings,
                      Ensemble& ensemble) {
  if (request.atol) return;
  constexpr double kBits = 4;
  const double scene = unit_of(run.initial);
  std::vector<double> own;
  for (std::size_t i = 0; i < ensemble.size(); ++i) {
    const double times = unit_of({ensemble.state(i), ensemble.states}) / scene;
    // Within 16 of the scene it is the scene's: towards 1 on both sides.
    const double power = kBits * std::trunc(std::log2(times) / kBits);
    own.push_back(settings.atol * std::exp2(power));
  }
  ensemble.atol = std::move(own);
}

const Method& method_named(const std::string& name) {
  // Taylor series need the fewest steps at every tolerance, on every system measured that is not
  // stiff, and need no compiler where the right-hand side is quadratic.
  if (name == "auto") return *find_method("taylor");
  if (const Method* method = find_method(name)) return *method;
  std::vector<std::string> known = method_names();
  known.emplace_back("auto");
  throw RequestError(
      fmt::format("there is no method '{}'; {}", printable(name), suggest_or_list(name, known)));
}

}  // namespace casimir
