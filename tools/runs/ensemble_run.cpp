// casimir integrate --ensemble: many initial states or parameter values at once.
#include "tools/runs/ensemble_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <optional>

#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/run/doubted_invariants.hpp"
#include "tools/analysis/run/ensemble_check.hpp"
#include "tools/analysis/run/ensemble_kernel.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/tables/table.hpp"
#include "tools/text/files/ensemble_file.hpp"
#include "tools/text/runs/checked_members.hpp"
#include "tools/text/runs/run_report.hpp"
#include "tools/text/runs/trust_report.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Worst first: the status of the whole is the first that some member has.
constexpr std::array kMemberStatuses = {
    Status::singularity,    Status::at_jump,        Status::non_finite,
    Status::step_underflow, Status::no_convergence, Status::drift_exceeded,
    Status::max_steps,      Status::stopped,        Status::ok};

/// An ensemble that was integrated, and all that a report says of it.
struct EnsembleReport {
  const PreparedScene& run;
  const Method& method;
  const Settings& settings;
  const EnsembleKernel& kernel;
  const EnsembleResult& result;
  const std::vector<CheckedMember>& checked;
  const std::vector<std::string>& warnings;

  const Specialisation& spec() const { return run.specialisation; }
  std::size_t count(Status status) const {
    return static_cast<std::size_t>(
        std::count_if(result.members.begin(), result.members.end(),
                      [&](const MemberResult& member) { return member.status == status; }));
  }
  Status worst() const {
    return *std::find_if(kMemberStatuses.begin(), kMemberStatuses.end(),
                         [&](Status status) { return count(status) > 0; });
  }
  int lanes() const { return kernel.lanes ? kernel.lanes->lanes : 1; }
};

std::vector<std::string> names_of_symbols(const std::vector<GiNaC::symbol>& symbols) {
  std::vector<std::string> names;
  for (const GiNaC::symbol& symbol : symbols) names.push_back(symbol.get_name());
  return names;
}

/// The members: what the file says in the place of what the scene says.
Ensemble members(const PreparedScene& run, const EnsembleFile& file) {
  const Specialisation& s = run.specialisation;
  Ensemble ensemble;
  ensemble.states = s.states.size();
  ensemble.parameters = run.parameters.size();
  for (std::size_t row = 0; row < file.rows(); ++row) {
    ensemble.initial.insert(ensemble.initial.end(), run.initial.begin(), run.initial.end());
    ensemble.values.insert(ensemble.values.end(), run.parameters.begin(), run.parameters.end());
  }
  const std::size_t columns = file.columns.size();
  for (std::size_t column = 0; column < columns; ++column) {
    const auto put = [&](const std::vector<std::string>& names, std::vector<double>& into) {
      const auto found = std::find(names.begin(), names.end(), file.columns[column]);
      if (found == names.end()) return;  // left out: nothing that is observed depends on it
      const auto place = static_cast<std::size_t>(found - names.begin());
      for (std::size_t row = 0; row < file.rows(); ++row)
        into[row * names.size() + place] = file.values[row * columns + column];
    };
    put(s.states, ensemble.initial);
    put(s.parameters, ensemble.values);
  }
  return ensemble;
}

Table table_of(const EnsembleReport& report) {
  const Specialisation& s = report.spec();
  const std::vector<MemberResult>& members = report.result.members;
  std::vector<std::int64_t> numbers, steps;
  std::vector<Status> statuses;
  std::vector<double> times;
  using Gaps = std::vector<std::optional<double>>;
  std::vector<Gaps> states(s.states.size()), drifts(s.invariant_names.size());
  for (const MemberResult& member : members) {
    numbers.push_back(static_cast<std::int64_t>(numbers.size()) + 1);
    steps.push_back(static_cast<std::int64_t>(member.steps));
    statuses.push_back(member.status);
    times.push_back(member.time);
    // A member whose turn never came has neither.
    for (std::size_t i = 0; i < states.size(); ++i)
      states[i].push_back(i < member.state.size() ? std::optional(member.state[i]) : std::nullopt);
    for (std::size_t k = 0; k < drifts.size(); ++k)
      drifts[k].push_back(k < member.invariants.size()
                              ? std::optional<double>(member.invariants[k].drift)
                              : std::nullopt);
  }
  Table table{
      {{"member", std::move(numbers)}, {"status", choices_of(statuses)}, {"t", std::move(times)}},
      {{"case", s.case_name}, {"scene", s.scene}, {"method", std::string(report.method.name)}}};
  for (std::size_t i = 0; i < states.size(); ++i)
    table.columns.push_back({s.states[i], std::move(states[i])});
  for (std::size_t k = 0; k < drifts.size(); ++k)
    table.columns.push_back({"drift_" + s.invariant_names[k], std::move(drifts[k])});
  table.columns.push_back({"steps", std::move(steps)});
  return table;
}

Json to_json(const Specialisation& s, std::size_t number, const MemberResult& member) {
  Json json = {{"member", number},
               {"status", to_string(member.status)},
               {"t", exact_text(member.time)},
               {"state", Json::object()},
               {"invariants", Json::object()},
               {"steps", member.steps},
               {"rejected", member.rejected}};
  for (std::size_t i = 0; i < s.states.size(); ++i)
    json["state"][s.states[i]] = exact_text(member.state[i]);
  for (std::size_t i = 0; i < member.invariants.size(); ++i) {
    const InvariantRecord& record = member.invariants[i];
    json["invariants"][s.invariant_names[i]] = {{"initial", exact_text(record.initial)},
                                                {"final", exact_text(record.final)},
                                                {"drift", exact_text(record.drift)}};
  }
  return json;
}

Json to_json(const EnsembleReport& report) {
  Json json = {{"case", report.spec().case_name},
               {"scene", report.spec().scene},
               {"method", report.method.name},
               {"tolerance", report.settings.rtol},
               {"rtol", report.settings.rtol},
               {"atol", report.settings.atol},
               {"ensemble", report.result.members.size()},
               {"status", to_string(report.worst())},
               {"counts", Json::object()},
               {"members", Json::array()}};
  for (auto status = kMemberStatuses.rbegin(); status != kMemberStatuses.rend(); ++status)
    if (report.count(*status) > 0) json["counts"][to_string(*status)] = report.count(*status);
  for (std::size_t i = 0; i < report.result.members.size(); ++i)
    json["members"].push_back(to_json(report.spec(), i + 1, report.result.members[i]));
  json["seconds"] = {{"generate", report.run.generate_seconds},
                     {"compile", report.kernel.seconds},
                     {"integrate", report.result.seconds}};
  json["jobs"] = report.result.jobs;
  json["lanes"] = report.lanes();
  json["instruction_set"] =
      report.kernel.lanes ? Json(report.kernel.lanes->instruction_set) : Json(nullptr);
  json["from_cache"] = report.kernel.from_cache;
  json["checked"] = checked_json(report.checked, "member");
  json["warnings"] = report.warnings;
  return json;
}

void print_text(const EnsembleReport& report) {
  const Specialisation& s = report.spec();
  const std::size_t count = report.result.members.size();
  fmt::print("{}, scene '{}', {} at tolerance {:g}, {} member{}\n", s.case_name, printable(s.scene),
             report.method.name, report.settings.rtol, count, count == 1 ? "" : "s");
  fmt::print("  generated in {}, {} in {}, integrated in {}: {} thread{}, {}\n",
             duration_text(report.run.generate_seconds),
             report.kernel.from_cache ? "fetched from the cache"
             : report.kernel.compiled ? "compiled"
                                      : "laid out",
             duration_text(report.kernel.seconds), duration_text(report.result.seconds),
             report.result.jobs, report.result.jobs == 1 ? "" : "s",
             report.kernel.lanes
                 ? fmt::format("{} members in a register", report.kernel.lanes->lanes)
                 : "member by member");
  for (auto status = kMemberStatuses.rbegin(); status != kMemberStatuses.rend(); ++status)
    if (report.count(*status) > 0)
      fmt::print("  {:<16} {:>8}\n", to_string(*status), report.count(*status));
  for (std::size_t k = 0; k < s.invariant_names.size(); ++k) {
    double drift = 0;
    for (const MemberResult& member : report.result.members)
      if (k < member.invariants.size()) drift = std::max(drift, member.invariants[k].drift);
    fmt::print("  {:<16} largest drift {:.1e}\n", s.invariant_names[k], drift);
  }
  if (!report.checked.empty())
    fmt::print("  {}\n", checked_text(report.checked, "member", report.result.members.size()));
  for (const std::string& warning : report.warnings) fmt::print("  warning: {}\n", warning);
}

/// On how the members were made, and on those that were integrated again by themselves.
std::vector<std::string> warnings_on(const EnsembleKernel& kernel, const PreparedScene& run,
                                     const Settings& settings,
                                     const std::vector<CheckedMember>& checked,
                                     const std::string& unwatched) {
  std::vector<std::string> warnings;
  if (!unwatched.empty()) warnings.push_back(unwatched);
  if (may_pass_over(run, settings)) warnings.emplace_back(kUnseenBetweenSteps);
  if (!kernel.warning.empty()) warnings.push_back(kernel.warning);
  for (std::string& warning : warnings_of(checked, "member", settings.fixed_step > 0))
    warnings.push_back(std::move(warning));
  return warnings;
}

/// What went wrong, on stderr.
int verdict(const EnsembleReport& report) {
  const Status worst = report.worst();
  if (worst == Status::ok) return kDone;
  const auto& members = report.result.members;
  // The first that could not be continued; where all of these were only stopped, the first of them.
  const auto first = std::find_if(members.begin(), members.end(), [&](const MemberResult& member) {
    return member.status != Status::ok &&
           (worst == Status::stopped || member.status != Status::stopped);
  });
  std::string state;
  for (std::size_t i = 0; i < first->state.size(); ++i)
    state +=
        fmt::format("{}{} = {:.6g}", i == 0 ? "" : ", ", report.spec().states[i], first->state[i]);
  const std::size_t failed = members.size() - report.count(Status::ok) -
                             (worst == Status::stopped ? 0 : report.count(Status::stopped));
  std::cout.flush();
  std::cerr << fmt::format(
      "casimir: error: {} of {} members {}; the first is member {}, at t = {}: {}\n"
      "  last good state: {}\n  hint: {}\n",
      failed, members.size(),
      worst == Status::stopped ? "were stopped" : "could not be integrated to the end",
      first - members.begin() + 1, exact_text(first->time), reason_of(first->status), state,
      advice(first->status));
  return worst == Status::stopped ? kEnvironment : kNotContinued;
}

/// Parameters that the file gives are known at run time only; the others are those of the scene.
PreparedScene prepared(const Model& model, const Scene& scene, SceneOptions how,
                       const EnsembleFile& file) {
  const std::vector<std::string> parameters = names_of_symbols(model.parameters);
  for (const std::string& column : file.columns)
    if (std::find(parameters.begin(), parameters.end(), column) != parameters.end())
      how.keep_parameters.push_back(column);
  return prepare(model, scene, how);
}

EnsembleFile file_of(const Model& model, const std::string& path) {
  std::vector<std::string> known = names_of_symbols(model.variables), fixed;
  for (const std::string& parameter : names_of_symbols(model.parameters))
    known.push_back(parameter);
  for (const auto& [name, value] : model.fixed) fixed.push_back(name.value);
  return read_ensemble(path, known, model.limits, fixed);
}

}  // namespace

int integrate_ensemble(const EnsembleRequest& request) {
  const Model model =
      request.kept.model_of(request.start.in(load_case(request.case_name, request.common.limits)),
                            request.common.parameter_values());
  const Scene& scene = model.scene(request.common.scene);
  const Method& method = method_named(request.method);
  const EnsembleFile file = file_of(model, request.file);
  const PreparedScene run = prepared(model, scene, request.how, file);
  Settings settings = settings_for(request.run.request(request.common.limits), run);
  settings.give_up = time_limit(request.common.time_limit);
  settings.invariant_terms = nullptr;
  Ensemble ensemble = members(run, file);
  const std::string off_constraints = require_members(model, scene, run.specialisation, ensemble);
  scale_tolerances(request.run.request(request.common.limits), run, settings, ensemble);
  const EnsembleKernel kernel =
      ensemble_kernel(run, method, ensemble.size(), !(settings.fixed_step > 0));
  EnsembleResult result;
  try {
    result = casimir::integrate_ensemble(ensemble, run, kernel, method, settings, request.jobs);
  } catch (const std::invalid_argument& problem) {
    throw UsageError(problem.what());
  }
  const std::vector<CheckedMember> checked =
      check_members(run, method, settings, ensemble, result, members_to_check(ends_of(result)));
  std::vector<std::string> warnings =
      warnings_on(kernel, run, settings, checked, unwatched_parts(model, scene));
  for (std::string& sentence :
       doubts_of_members(model, scene, run.specialisation.invariant_names, result, settings.rtol))
    warnings.push_back(std::move(sentence));
  if (!off_constraints.empty()) warnings.insert(warnings.begin(), off_constraints);
  const EnsembleReport report{run, method, settings, kernel, result, checked, warnings};
  if (!request.output.empty()) write_table(request.output, table_of(report));
  if (request.common.json) {
    print_json(to_json(report));
  } else if (!request.common.quiet) {
    print_text(report);
    if (!request.output.empty())
      fmt::print("  wrote {} members to {}\n", result.members.size(),
                 printable(request.output, 200));
  }
  return verdict(report);
}

}  // namespace casimir::tools
