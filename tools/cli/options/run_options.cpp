#include "tools/cli/options/run_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/expression.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/options/number_checks.hpp"

namespace casimir::tools {

void add_run_options(CLI::App& command, RunOptions& options) {
  const auto positive = [&](const char* name, std::optional<double>& target, const char* text) {
    command.add_option(name, target, text)->type_name("X")->check(positive_number());
  };
  positive("--rtol", options.asked.rtol, "Relative tolerance of a step");
  positive("--atol", options.asked.atol, "Absolute tolerance of a step");
  positive("--tolerance", options.asked.tolerance,
           "Sets both tolerances; the absolute one relative to the initial state if that is small");
  positive("--step", options.asked.step, "Constant step instead of error control");
  command.add_option("--duration", options.duration, "Duration of the run (default: the scene's)")
      ->type_name("T");
  command.add_option("--max-steps", options.asked.max_steps, "Limit on the number of steps")
      ->type_name("N")
      ->check(count_from_one());
}

void add_projection(CLI::App& command, RunOptions& options) {
  command.add_flag("--project", options.asked.project,
                   "After each step, move the state back onto the level of every invariant that is "
                   "proved");
  command
      .add_option("--project-onto", options.asked.project_onto,
                  "The same, but only of these: H, Casimirs, integrals")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("A,B");
}

RunRequest RunOptions::request(const Limits& limits) const {
  RunRequest request = asked;
  if (!duration) return request;
  const std::optional<GiNaC::numeric> value = real_decimal(
      parse_constant({*duration, {"--duration", 1, 1}, *duration}, limits), limits.bits);
  if (!value)
    throw UsageError(fmt::format("--duration '{}': expected a real number", printable(*duration)));
  request.duration = value->to_double();
  return request;
}

std::string method_list() { return fmt::format("{}", fmt::join(method_names(), ", ")); }

}  // namespace casimir::tools
