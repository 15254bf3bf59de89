#include "tools/run_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "codegen/literal.hpp"
#include "symbolic/decimal.hpp"
#include "symbolic/expression.hpp"
#include "tools/errors.hpp"

namespace casimir::tools {

void add_run_options(CLI::App& command, RunOptions& options) {
  const auto positive = [&](const char* name, std::optional<double>& target, const char* text) {
    command.add_option(name, target, text)->type_name("X")->check(CLI::PositiveNumber);
  };
  positive("--rtol", options.rtol, "Relative tolerance of a step");
  positive("--atol", options.atol, "Absolute tolerance of a step");
  positive("--tolerance", options.tolerance,
           "Sets both tolerances; the absolute one relative to the initial state if that is small");
  positive("--step", options.step, "Constant step instead of error control");
  command.add_option("--duration", options.duration, "Duration of the run (default: the scene's)")
      ->type_name("T");
  command.add_option("--max-steps", options.max_steps, "Limit on the number of steps")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
}

void add_projection(CLI::App& command, RunOptions& options) {
  command.add_flag("--project", options.project,
                   "After each step, move the state back onto the level of every invariant that is "
                   "proved");
  command
      .add_option("--project-onto", options.project_onto,
                  "The same, but only of these: H, Casimirs, integrals")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("A,B");
}

Settings settings_for(const RunOptions& options, const SceneRun& run, double default_tolerance) {
  Settings settings;
  if (!options.duration) {
    settings.duration = duration_of(run);
  } else {
    const std::optional<GiNaC::numeric> value =
        real_decimal(parse_constant({*options.duration, {"--duration", 1, 1}, *options.duration}));
    if (!value) {
      throw UsageError(
          fmt::format("--duration '{}': expected a real number", printable(*options.duration)));
    }
    settings.duration = value->to_double();
  }
  settings.rtol = options.rtol.value_or(options.tolerance.value_or(default_tolerance));
  double size = 0;
  for (const double x : run.initial) size = std::max(size, std::abs(x));
  const double unit = size > 0 ? std::min(size, 1.0) : 1.0;
  // Small components beside large ones keep three digits more than the large ones need.
  constexpr double kSmallComponents = 1e-3;
  settings.atol = options.atol        ? *options.atol
                  : options.tolerance ? *options.tolerance * unit
                                      : settings.rtol * unit * kSmallComponents;
  settings.fixed_step = options.step.value_or(0);
  settings.max_steps = options.max_steps;
  settings.invariant_terms = run.invariant_terms();
  settings.invariants = &run.specialisation.invariants;
  return settings;
}

const Method& method_named(const std::string& name) {
  // Taylor series need the fewest steps at every tolerance, on every system measured that is not
  // stiff, and need no compiler where the right-hand side is quadratic.
  if (name == "auto") return *find_method("taylor");
  if (const Method* method = find_method(name)) return *method;
  std::vector<std::string> known = method_names();
  known.emplace_back("auto");
  throw UsageError(
      fmt::format("there is no method '{}'; {}", printable(name), suggest_or_list(name, known)));
}

std::string method_list() { return fmt::format("{}", fmt::join(method_names(), ", ")); }

}  // namespace casimir::tools
