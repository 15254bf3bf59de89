#include "tools/analysis/run/ensemble_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "runtime/program/exact_number.hpp"
#include "runtime/step/step_watch.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/estimate/growth_of_changes.hpp"
#include "tools/analysis/run/parameter_domain.hpp"
#include "tools/analysis/run/point_check.hpp"
#include "tools/analysis/run/taylor_path.hpp"

namespace casimir {
namespace {

PreparedScene scene_of(const PreparedScene& run, const Ensemble& ensemble, std::size_t member) {
  PreparedScene own = run;
  const double *const x = ensemble.state(member), *const p = ensemble.values_of(member);
  own.initial.assign(x, x + ensemble.states);
  own.parameters.assign(p, p + ensemble.parameters);
  own.rounding.assign(own.initial.size(), 0);
  own.parameter_rounding.assign(own.parameters.size(), 0);
  // The exact start as well, which closed forms begin at.
  std::vector<double> values = own.initial;
  values.insert(values.end(), own.parameters.begin(), own.parameters.end());
  values.push_back(own.duration);
  Program start;
  start.output_names = own.specialisation.start.output_names;
  for (const double value : values) {
    start.outputs.push_back(static_cast<int>(start.code.size()));
    start.code.push_back({Op::constant, static_cast<int>(start.constants.size())});
    start.constants.push_back(exact_number(value));
  }
  own.specialisation.start = std::move(start);
  return own;
}

/// Nothing is compiled for it that the ensemble has not compiled.
CompiledModule module_of(const PreparedScene& own, const Method& method) {
  if (!method.series) return compile_for(own, method);
  const Specialisation& s = own.specialisation;
  return {.module = taylor_module_without_compiler(s.rhs, s.limits, {}, own.parameters),
          .compiled = false};
}

}  // namespace

std::vector<MemberEnd> ends_of(const EnsembleResult& result) {
  std::vector<MemberEnd> ends;
  for (const MemberResult& member : result.members) {
    double size = 0;
    for (const double x : member.state) size = std::max(size, std::abs(x));
    ends.push_back({member.status == Status::ok, member.steps, size});
  }
  return ends;
}

std::vector<std::size_t> members_to_check(const std::vector<MemberEnd>& ends) {
  constexpr double kGoldenSection = 0.6180339887498949;
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (ends[i].arrived) all.push_back(i);
  if (all.empty()) return {};
  const double between = kGoldenSection * static_cast<double>(all.size());
  std::set<std::size_t> some{all.front(), all[static_cast<std::size_t>(between)], all.back()};
  constexpr unsigned long long kByFar = 4;
  const auto steps = [&](std::size_t i) { return ends[i].steps; };
  const std::size_t longest = *std::ranges::max_element(all, {}, steps);
  const std::size_t among = *std::ranges::min_element(some, {}, steps);
  if (steps(longest) > kByFar * steps(among)) some.insert(longest);
  constexpr double kFarBeyond = 1e5;
  constexpr std::size_t kMostBeyond = 12;
  std::ranges::sort(all, [&](std::size_t a, std::size_t b) { return ends[a].size > ends[b].size; });
  const double usual = ends[all[all.size() / 2]].size;
  for (std::size_t k = 0; k < std::min(all.size(), kMostBeyond); ++k)
    if (ends[all[k]].size > kFarBeyond * usual) some.insert(all[k]);
  return {some.begin(), some.end()};
}

std::vector<CheckedMember> check_members(const PreparedScene& run, const Method& method,
                                         const Settings& settings, const Ensemble& ensemble,
                                         const EnsembleResult& result,
                                         const std::vector<std::size_t>& which, double budget) {
  constexpr double kPart = 0.1;
  std::vector<CheckedMember> checked;
  bool too_slow = false;  // one was: the others take as long
  for (const std::size_t member : which) {
    CheckedMember& found = checked.emplace_back(CheckedMember{member, {}});
    if (too_slow) {
      found.trust.known = found.trust.unconfirmed = true;
      continue;
    }
    const PreparedScene own = scene_of(run, ensemble, member);
    const Method& how = method.series ? *find_method("taylor") : method;
    const CompiledModule compiled = module_of(own, how);
    Settings alone = settings;
    alone.monitor = true;
    alone.atol = ensemble.atol_of(member, settings.atol);
    alone.give_up = time_limit(budget);
    const Trajectory again = integrate(compiled.module, how, alone, own.initial, own.parameters);
    if (again.status != Status::ok) {
      found.trust.known = found.trust.unconfirmed = true;
      too_slow = again.status == Status::stopped;
      continue;
    }
    found.trust = assess(own, compiled, how, alone, again, kPart * budget);
    const std::vector<double> sizes = sizes_of(again);
    double apart = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i)
      apart =
          std::max(apart, std::abs(result.members[member].state[i] - again.state[i]) / sizes[i]);
    found.trust.error_estimate = std::max(found.trust.error_estimate, apart);
  }
  return checked;
}

bool may_pass_over(const PreparedScene& run, const Settings& settings) {
  if (!(settings.fixed_step > 0)) return false;
  const double* const parameters = run.parameters.empty() ? nullptr : run.parameters.data();
  return StepWatch(run.specialisation.rhs).looks(parameters, run.initial.data());
}

std::string require_members(const Model& model, const Scene& scene, const Specialisation& s,
                            const Ensemble& ensemble) {
  if (model.constraints.empty() && model.assumptions.empty() &&
      implied_by_parameters(model, {}).empty())
    return {};
  PointCheck check(model, scene, s);
  std::size_t beside = 0;
  std::string first;
  for (std::size_t member = 0; member < ensemble.size(); ++member) {
    const double *x = ensemble.state(member), *p = ensemble.values_of(member);
    const auto fault = check({x, x + ensemble.states}, {p, p + ensemble.parameters});
    if (!fault) continue;
    const std::string text = fmt::format("member {}: {}", member + 1, fault->text);
    if (!fault->constraint) throw RequestError(text);
    if (++beside == 1) first = text;
  }
  if (beside == 0) return {};
  return fmt::format(
      "{}{}; what is proved of the case, its invariants among it, need not hold there", first,
      beside > 1 ? fmt::format(", and {} more members are not on the constraints", beside - 1)
                 : "");
}

}  // namespace casimir
