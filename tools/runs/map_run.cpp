#include "tools/runs/map_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <limits>

#include "tools/analysis/run/changing_invariant.hpp"
#include "tools/analysis/run/doubted_invariants.hpp"
#include "tools/analysis/run/iterate.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/tables/table.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

/// How many steps a scene has, or the command asks for.
std::uint64_t steps_of(const Scene& scene, const std::optional<double>& asked) {
  if (!asked) require_duration(scene);
  const double duration = asked.value_or(
      scene.duration ? GiNaC::ex_to<GiNaC::numeric>(scene.duration->evalf()).to_double() : 0);
  return whole_steps(duration, "the duration");
}

Table table_of(const MapModel& map, const Scene& scene, const Iterated& run) {
  std::vector<std::int64_t> steps;
  for (const auto step : run.sample_steps) steps.push_back(static_cast<std::int64_t>(step));
  Table table{{{"t", std::move(steps)}}, {{"case", map.base.name}, {"scene", scene.name}}};
  for (std::size_t i = 0; i < run.names.size(); ++i) {
    std::vector<double> column;
    for (const std::vector<double>& state : run.samples) column.push_back(state[i]);
    table.columns.push_back({run.names[i], std::move(column)});
  }
  return table;
}

std::vector<std::string> warnings_of(const MapModel& map, const Iterated& run) {
  std::vector<std::string> warnings = doubts_of_orbit(map, run);
  if (std::string doubt = doubt_of_end(run); !doubt.empty()) warnings.push_back(std::move(doubt));
  return warnings;
}

nlohmann::ordered_json to_json(const MapModel& map, const Scene& scene, const Iterated& run) {
  nlohmann::ordered_json json{
      {"case", map.base.name},
      {"scene", scene.name},
      {"method", "map"},
      {"status", run.finite ? run.stopped ? "stopped" : "ok" : "non_finite"},
      {"t", std::to_string(run.steps)}};
  json["state"] = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < run.names.size(); ++i)
    json["state"][run.names[i]] = exact_text(run.state[i]);
  json["invariants"] = nlohmann::ordered_json::object();
  for (const Iterated::Invariant& invariant : run.invariants) {
    json["invariants"][invariant.name] = {{"initial", exact_text(invariant.initial)},
                                          {"final", exact_text(invariant.final)},
                                          {"drift", exact_text(invariant.drift)}};
  }
  json["steps"] = run.steps;
  json["rejected"] = 0;
  json["evaluations"] = run.steps;
  json["seconds"] = {{"generate", run.generate_seconds},
                     {"compile", run.compile_seconds},
                     {"integrate", run.seconds}};
  json["from_cache"] = run.from_cache;
  json["left_out"] = nlohmann::ordered_json::array();
  json["warnings"] = warnings_of(map, run);
  if (run.error_estimate)
    json["trust"] = {{"error_estimate", *run.error_estimate},
                     {"beyond_double", *run.error_estimate >= kSpoiledOrbit}};
  return json;
}

void print(const MapModel& map, const Scene& scene, const Iterated& run) {
  fmt::print("{}, scene '{}', {} steps of the map in double precision\n", map.base.name,
             printable(scene.name), run.steps);
  fmt::print("  {} in {}, iterated in {}\n", run.from_cache ? "fetched from the cache" : "compiled",
             duration_text(run.compile_seconds), duration_text(run.seconds));
  for (std::size_t i = 0; i < run.names.size(); ++i)
    fmt::print("  {:<10} {:>25}\n", run.names[i], exact_text(run.state[i]));
  for (const Iterated::Invariant& invariant : run.invariants)
    fmt::print("  {:<10} {:>25}   drift {:.1e}\n", invariant.name, exact_text(invariant.final),
               invariant.drift);
  if (run.error_estimate) fmt::print("  error of the state about {:.0e}\n", *run.error_estimate);
  for (const std::string& warning : warnings_of(map, run)) fmt::print("  warning: {}\n", warning);
}

}  // namespace

/// Doubles hold whole numbers up to 2^53.
std::uint64_t whole_steps(double value, const std::string& what) {
  constexpr double kMostWhole = 9007199254740992.0;
  if (!(value >= 0) || value > kMostWhole || value != std::floor(value))
    throw UsageError(
        fmt::format("{} of a map is a whole number of steps, and {:g} is none", what, value));
  return static_cast<std::uint64_t>(value);
}

int iterate_map(const MapRunRequest& request) {
  const MapModel map = map_model_of(request.file, request.common.parameter_values());
  const Scene& scene = map.base.scene(request.common.scene);
  const std::uint64_t steps = steps_of(scene, request.duration);
  if (request.every > 0 && request.output.empty()) throw UsageError("--every needs --output FILE");
  std::uint64_t every = 0;
  if (!request.output.empty())
    every = request.every > 0 ? whole_steps(request.every, "--every")
                              : std::max<std::uint64_t>(1, steps / 1000);
  const Iterated run = iterate(map, scene, steps, every, time_limit(request.common.time_limit));
  if (!request.output.empty()) write_table(request.output, table_of(map, scene, run));
  if (request.common.json)
    print_json(to_json(map, scene, run));
  else if (!request.common.quiet)
    print(map, scene, run);
  if (run.finite && !run.stopped) return kDone;
  std::string state;
  for (std::size_t i = 0; i < run.names.size(); ++i)
    state += fmt::format("{}{} = {:.6g}", i == 0 ? "" : ", ", run.names[i], run.state[i]);
  std::cout.flush();
  std::cerr << fmt::format("casimir: error: the iteration stopped after step {}: {}\n  state: {}\n",
                           run.steps, run.finite ? "the time limit was reached" : run.reason,
                           state);
  return run.finite ? kEnvironment : kNotContinued;
}

Row conserve_map(const MapModel& map, const Scene& scene, const std::optional<double>& duration,
                 double bound, const std::function<bool()>& give_up) {
  const Iterated run = iterate(map, scene, steps_of(scene, duration), 0, give_up, false);
  Row row{.case_name = map.base.name, .scene = scene.name, .method = "map"};
  for (const Iterated::Invariant& invariant : run.invariants)
    row.drift = std::max(row.drift, invariant.drift);
  row.seconds = run.seconds;
  row.steps = row.evaluations = run.steps;
  row.status = !run.finite ? Status::non_finite : run.stopped ? Status::stopped : Status::ok;
  // Written so that a drift that is not a number fails too.
  row.failed = row.status != Status::ok || !(row.drift <= bound);
  if (row.status == Status::ok && row.failed) {
    double drifted = 0;
    for (const Iterated::Invariant& invariant : run.invariants) {
      if (std::isfinite(invariant.drift))
        drifted = std::max(drifted, invariant.drift);
      else
        row.reason = invariant.name;
    }
    row.end = drifted > bound ? RowEnd::drifted : RowEnd::lost;
    if (row.end == RowEnd::drifted) {
      row.drift = drifted;
      row.reason.clear();
    }
    row.bound = bound;
  } else if (!row.failed) {
    if (auto name = changing_invariant(map, scene)) {
      row.end = RowEnd::changes_in_step;
      row.failed = true;
      row.reason = std::move(*name);
    }
  }
  if (run.invariants.empty()) row.drift = std::numeric_limits<double>::quiet_NaN();
  return row;
}

}  // namespace casimir::tools
