#include "tools/analysis/sweep/integrations.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "runtime/ensemble.hpp"
#include "tools/analysis/error.hpp"

namespace casimir {

Integrations::Integrations(const PreparedScene& run, const GridPoints& places, const Method& method,
                           const Settings& settings, std::size_t points, RunRequest asked)
    : run_(run),
      places_(places),
      method_(method),
      settings_(settings),
      asked_(std::move(asked)),
      kernel_(ensemble_kernel(run, method, points, !(settings.fixed_step > 0))) {}

std::vector<std::string> Integrations::columns() const {
  const Specialisation& s = run_.specialisation;
  std::vector<std::string> names{"t"};
  names.insert(names.end(), s.states.begin(), s.states.end());
  for (const std::string& name : s.invariant_names) names.push_back("drift_" + name);
  names.emplace_back("steps");
  return names;
}

std::string Integrations::fingerprint() const {
  return std::string("integrate ") + (asked_.atol ? "" : "atol in units of each start, ") +
         run_fingerprint(run_, method_, settings_);
}

Ensemble Integrations::members(const std::vector<std::size_t>& points) const {
  Ensemble ensemble;
  ensemble.states = run_.specialisation.states.size();
  ensemble.parameters = run_.parameters.size();
  for (const std::size_t point : points) {
    const auto [state, parameters] = places_.at(point);
    ensemble.initial.insert(ensemble.initial.end(), state.begin(), state.end());
    ensemble.values.insert(ensemble.values.end(), parameters.begin(), parameters.end());
  }
  scale_tolerances(asked_, run_, settings_, ensemble);
  return ensemble;
}

std::vector<CheckedMember> Integrations::check(const std::vector<PointResult>& rows) const {
  const std::size_t states = run_.specialisation.states.size();
  std::vector<MemberEnd> ends;
  for (const PointResult& row : rows) {
    double size = 0;
    for (std::size_t i = 1; i <= states; ++i) size = std::max(size, std::abs(row.values[i]));
    ends.push_back(
        {row.status == Status::ok, static_cast<unsigned long long>(row.values.back()), size});
  }
  const std::vector<std::size_t> points = members_to_check(ends);
  EnsembleResult result;
  std::vector<std::size_t> which;
  for (const std::size_t point : points) {
    const auto state = rows[point].values.begin() + 1;  // behind the time
    which.push_back(which.size());
    MemberResult& member = result.members.emplace_back();
    member.status = Status::ok;
    member.time = rows[point].values.front();
    member.steps = static_cast<unsigned long long>(rows[point].values.back());
    member.state.assign(state, state + static_cast<std::ptrdiff_t>(states));
  }
  std::vector<CheckedMember> checked =
      check_members(run_, method_, settings_, members(points), result, which);
  for (CheckedMember& member : checked) member.member = points[member.member];
  return checked;
}

std::vector<PointResult> Integrations::run(const std::vector<std::size_t>& points, int threads,
                                           const std::function<bool()>& give_up) const {
  const Specialisation& s = run_.specialisation;
  const Ensemble ensemble = members(points);
  Settings settings = settings_;
  settings.give_up = give_up;
  EnsembleResult done;
  try {
    done = integrate_ensemble(ensemble, run_, kernel_, method_, settings, threads);
  } catch (const std::invalid_argument& problem) {
    throw RequestError(problem.what());
  }
  std::vector<PointResult> results;
  for (const MemberResult& member : done.members) {
    PointResult& result = results.emplace_back();
    result.status = member.status;
    result.values.push_back(member.time);
    result.values.insert(result.values.end(), member.state.begin(), member.state.end());
    // A member whose turn never came has no invariants, and no state.
    result.values.resize(1 + s.states.size(), std::numeric_limits<double>::quiet_NaN());
    for (const InvariantRecord& record : member.invariants) result.values.push_back(record.drift);
    result.values.resize(1 + s.states.size() + s.invariant_names.size(),
                         std::numeric_limits<double>::quiet_NaN());
    result.values.push_back(static_cast<double>(member.steps));
  }
  return results;
}

std::vector<double> Integrations::largest_drifts(const std::vector<PointResult>& rows) const {
  const Specialisation& s = run_.specialisation;
  std::vector<double> drifts(s.invariant_names.size());
  for (const PointResult& row : rows) {
    if (row.status != Status::ok) continue;
    for (std::size_t i = 0; i < drifts.size(); ++i)
      drifts[i] = std::max(drifts[i], row.values[1 + s.states.size() + i]);
  }
  return drifts;
}

}  // namespace casimir
