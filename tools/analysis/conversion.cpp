#include "tools/analysis/conversion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/program_of.hpp"
#include "runtime/evaluate.hpp"

namespace casimir {
namespace {

/// A state that a map and its inverse do not bring back to this, relative to its size, has lost its
/// digits next to a singular point, or was never in the image.
constexpr double kRoundTrip = 1e-7;

std::vector<std::string> names_of(const std::vector<GiNaC::symbol>& symbols) {
  std::vector<std::string> names;
  for (const GiNaC::symbol& s : symbols) names.push_back(s.get_name());
  return names;
}

std::vector<GiNaC::ex> differences(const std::vector<Assumption>& domain) {
  std::vector<GiNaC::ex> result;
  for (const Assumption& a : domain) result.push_back(a.difference);
  return result;
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

/// The first condition that fails; null if all hold.
const Assumption* failing(const Program& program, const std::vector<Assumption>& domain,
                          const std::vector<double>& state) {
  const std::vector<double> values = evaluate(program, state);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int sign = (values[i] > 0) - (values[i] < 0);
    if (std::isnan(values[i]) || !holds(domain[i].comparison, sign)) return &domain[i];
  }
  return nullptr;
}

}  // namespace

Conversion::Conversion(const Model& model, Atlas atlas, const std::string& set)
    : limits_(model.limits), atlas_(std::move(atlas)) {
  const std::size_t to = atlas_.named(set);
  const std::size_t from = atlas_.of(model);
  const auto path = atlas_.path(from, to, false);
  if (path.empty() && from != to)
    throw ModelError(fmt::format("no maps lead from the variables of '{}' to '{}'",
                                 printable(model.name), printable(set)));
  names_ = names_of(atlas_.sets[to].variables);
  for (const CoordinateChange* change : path) {
    const auto& variables = atlas_.sets[change->from].variables;
    const Coordinates& there = atlas_.sets[change->to];
    Step step{change, {}, program_of(differences(there.domain), there.variables), there.domain, {}};
    for (const CoordinateChange::Branch& branch : change->branches) {
      step.branches.push_back({program_of(branch.expressions, variables),
                               program_of(differences(branch.domain), variables), branch.domain});
    }
    if (!change->forward) {
      const auto map = std::find_if(
          atlas_.changes.begin(), atlas_.changes.end(), [&](const CoordinateChange& other) {
            return other.forward && other.from == change->to && other.to == change->from;
          });
      step.back = program_of(map->branches[0].expressions, there.variables);
    }
    steps_.push_back(std::move(step));
  }
}

std::vector<double> Conversion::operator()(std::vector<double> state) const {
  for (const Step& step : steps_) state = apply(step, state);
  return state;
}

std::vector<double> Conversion::apply(const Step& step, const std::vector<double>& state) const {
  std::string why = "its expressions have no value there";
  for (const Branch& branch : step.branches) {
    try {
      if (const Assumption* condition = failing(branch.conditions, branch.domain, state)) {
        why = fmt::format("{} fails", condition->text);
        continue;
      }
      std::vector<double> result = evaluate(branch.values, state);
      if (!all_finite(result)) continue;
      if (const Assumption* condition = failing(step.there, step.there_domain, result)) {
        why = fmt::format("{} fails", condition->text);
        continue;
      }
      if (step.back) {
        const std::vector<double> again = evaluate(*step.back, result);
        double size = 0, off = 0;
        for (std::size_t i = 0; i < again.size(); ++i) {
          size = std::max(size, std::abs(state[i]));
          off = std::max(off, std::abs(again[i] - state[i]));
        }
        if (!(off <= kRoundTrip * size)) {
          why = fmt::format("mapped back, the state is off by {:.1e}", off);
          continue;
        }
      }
      return result;
    } catch (const std::domain_error&) {
    }
  }
  const Coordinates& from = atlas_.sets[step.change->from];
  std::string where;
  for (std::size_t i = 0; i < state.size(); ++i)
    where +=
        fmt::format("{}{} = {:.6g}", i == 0 ? "" : ", ", from.variables[i].get_name(), state[i]);
  throw SingularPoint(fmt::format("the variables of '{}' are singular at {} ({})",
                                  atlas_.sets[step.change->to].name, where, why));
}

std::vector<GiNaC::ex> Conversion::exact(const Scene& scene) const {
  std::vector<GiNaC::ex> state = scene.initial;
  for (const Step& step : steps_) state = image_of(atlas_, *step.change, state, limits_);
  return state;
}

}  // namespace casimir
