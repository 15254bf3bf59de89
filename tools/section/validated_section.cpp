// casimir section --validated: crossings that are proved, none missed and none doubled.
#include "tools/section/validated_section.hpp"

#include <cln/float.h>
#include <cln/real.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>

#include "runtime/program/exact_number.hpp"
#include "symbolic/expression/expression.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/analysis/section/orbits.hpp"
#include "tools/analysis/section/validated_crossings.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/stopwatch.hpp"
#include "tools/text/runs/enclosure_report.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Crossings that were enclosed, and all that is said of them.
struct CrossingReport {
  const Model& model;
  const SectionProblem& problem;
  std::string scene;
  const ProvedCrossings& proved;
  double seconds;

  bool wanted(const ValidatedCrossing& crossing) const {
    return crossing.upwards == problem.plane.upwards;
  }
  std::size_t count() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(proved.run.crossings, [this](const auto& c) { return wanted(c); }));
  }
  std::string until() const {
    return decimal_ends({proved.run.crossings_until, proved.run.crossings_until}).first;
  }
  cln::cl_RA widest() const {
    cln::cl_RA largest = 0;
    for (const ValidatedCrossing& crossing : proved.run.crossings)
      for (const RationalInterval& x : crossing.states)
        largest = std::max(largest, cln::cl_RA((x.high - x.low) / 2));
    return largest;
  }
};

Json interval_json(const RationalInterval& interval) {
  const auto [low, high] = decimal_ends(interval);
  return {low, high};
}

Json crossings_json(const CrossingReport& report) {
  const ValidatedRun& run = report.proved.run;
  Json list = Json::array();
  for (const ValidatedCrossing& crossing : run.crossings) {
    if (!report.wanted(crossing)) continue;
    Json one = {
        {"n", list.size() + 1}, {"t", interval_json(crossing.time)}, {"enclosure", Json::object()}};
    for (std::size_t i = 0; i < crossing.states.size(); ++i)
      one["enclosure"][report.proved.names[i]] = interval_json(crossing.states[i]);
    list.push_back(std::move(one));
  }
  return list;
}

Json to_json(const CrossingReport& report) {
  const ValidatedRun& run = report.proved.run;
  Json json = {{"case", report.model.name},
               {"scene", report.scene},
               {"plane", report.problem.plane_text},
               {"direction", report.problem.plane.upwards ? "up" : "down"},
               {"status", run.status == ValidatedStatus::ok ? "ok" : "not_enclosed"},
               {"t", report.until()}};
  json["validated"] = {{"radius", decimal_above(report.widest())},
                       {"count", report.count()},
                       {"count_back", run.crossings.size() - report.count()},
                       {"starts_on_plane", run.starts_on_plane},
                       {"crossings", crossings_json(report)},
                       {"contracted_by", run.contracted_by},
                       {"steps", run.steps}};
  json["seconds"] = report.seconds;
  json["warnings"] = report.proved.doubts;
  if (run.status != ValidatedStatus::ok)
    json["stopped"] = {{"time", report.until()}, {"reason", run.reason}};
  return json;
}

void print_text(const CrossingReport& report) {
  const ValidatedRun& run = report.proved.run;
  const SectionProblem& problem = report.problem;
  fmt::print("{}, scene '{}', crossings of {}{} {}\n", report.model.name, printable(report.scene),
             printable(problem.plane_text, 200),
             problem.plane_text.find('=') == std::string::npos ? " = 0" : "",
             problem.plane.upwards ? "upwards" : "downwards");
  fmt::print("  enclosed in {}: {} steps\n", duration_text(report.seconds), run.steps);
  if (!run.contracted_by.empty())
    fmt::print("  made smaller by {}, proved to be constant\n", fmt::join(run.contracted_by, ", "));
  std::size_t n = 0;
  for (const ValidatedCrossing& crossing : run.crossings) {
    if (!report.wanted(crossing)) continue;
    const auto [low, high] = decimal_ends(crossing.time, 13);
    fmt::print("  {:>5}  t in [{}, {}]\n", ++n, low, high);
  }
  fmt::print(
      "  proved: {} {} between t = 0 and t = {} and no other in this direction, each in its "
      "interval\n",
      n, n == 1 ? "crossing" : "crossings", report.until());
  fmt::print("  the widest box of a state at one of them has the radius {}\n",
             decimal_above(report.widest()));
  if (run.starts_on_plane)
    fmt::print("  the start may lie on the surface: a crossing there is not counted\n");
  for (const std::string& doubt : report.proved.doubts) fmt::print("  note: {}\n", doubt);
}

}  // namespace

namespace {

/// What was asked of all orbits.
ValidatedOptions crossing_options(const SectionProblem& problem,
                                  const std::optional<std::string>& duration) {
  if (problem.plane.period > 0)
    throw UsageError("--validated needs a surface that is no angle: give it as --plane, by a sine");
  ValidatedOptions options;
  if (duration)
    options.duration = parse_real_constant({*duration, {"--duration", 1, 1}, *duration},
                                           problem.run.specialisation.limits);
  return options;
}

int status_of(const CrossingReport& report) {
  const ValidatedRun& run = report.proved.run;
  if (run.status == ValidatedStatus::ok) return kDone;
  std::cout.flush();
  std::cerr << fmt::format("casimir: error: crossings are enclosed up to t = {} only: {}\n",
                           report.until(), run.reason);
  return run.status == ValidatedStatus::stopped ? kEnvironment : kNotContinued;
}

/// Points of the plane on the level, all over the domain of possible motion.
std::vector<std::vector<double>> starts_of_orbits(const SectionProblem& problem,
                                                  const OrbitRequest& request,
                                                  const Common& common) {
  const LevelSet level(problem);
  const OrbitCutter cutter(
      problem, {request.tolerance, request.jobs, time_limit(common.time_limit)}, request.count);
  const std::vector<PlacedPoint> domain = points_of_domain(level, cutter.returning(), {});
  if (domain.empty())
    throw UsageError(
        fmt::format("no motion was found that comes back to the plane: {}", why_no_points(level)));
  std::vector<std::vector<double>> starts;
  for (const PlacedPoint& point : spread_out(level, domain, request.count))
    starts.emplace_back(point.x.data(), point.x.data() + point.x.size());
  return starts;
}

Json start_json(const Model& model, const std::vector<double>& start) {
  Json json = Json::object();
  for (std::size_t i = 0; i < start.size(); ++i)
    json[model.variables[i].get_name()] = exact_text(start[i]);
  return json;
}

}  // namespace

int enclose_section(const Common& common, const Model& model, const SectionProblem& problem,
                    const std::optional<std::string>& duration) {
  const Scene& scene = model.scene(common.scene);
  ValidatedOptions options = crossing_options(problem, duration);
  Progress progress(!common.quiet);
  progress.begin(model.name + ": crossings");
  options.run.give_up = [&progress, late = time_limit(common.time_limit)](double share) {
    progress.show(share);
    return late && late();
  };
  const Stopwatch watch;
  const ProvedCrossings proved = enclose_crossings(model, scene, problem.plane_function, options);
  const CrossingReport report{model, problem, scene.name, proved, watch.seconds()};
  if (common.json)
    print_json(to_json(report));
  else if (!common.quiet)
    print_text(report);
  return status_of(report);
}

int enclose_orbits(const Common& common, const Model& model, const SectionProblem& problem,
                   const OrbitRequest& orbits, const std::optional<std::string>& duration) {
  ValidatedOptions options = crossing_options(problem, duration);
  const std::vector<std::vector<double>> starts = starts_of_orbits(problem, orbits, common);
  options.run.give_up = [late = time_limit(common.time_limit)](double) { return late && late(); };
  Scene scene = model.scene(common.scene);
  Json all = {{"case", model.name}, {"scene", scene.name}, {"orbits", Json::array()}};
  int worst = kDone;
  const Stopwatch all_of_them;
  for (const std::vector<double>& start : starts) {
    for (std::size_t i = 0; i < start.size(); ++i)
      scene.initial[i] = GiNaC::numeric(exact_number(start[i]));
    const Stopwatch own;
    const ProvedCrossings proved = enclose_crossings(model, scene, problem.plane_function, options);
    const CrossingReport report{model, problem, scene.name, proved, own.seconds()};
    if (common.json) {
      Json one = to_json(report);
      one["start"] = start_json(model, start);
      all["orbits"].push_back(std::move(one));
    } else if (!common.quiet) {
      fmt::print("orbit from");
      for (std::size_t i = 0; i < start.size(); ++i)
        fmt::print(" {} = {}", model.variables[i].get_name(), exact_text(start[i]));
      fmt::print("\n");
      print_text(report);
    }
    worst = std::max(worst, status_of(report));
  }
  all["seconds"] = all_of_them.seconds();
  if (common.json) print_json(all);
  return worst;
}

}  // namespace casimir::tools
