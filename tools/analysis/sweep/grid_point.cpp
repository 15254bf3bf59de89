#include "tools/analysis/sweep/grid_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "codegen/program_of.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/program/exact_number.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/proof/exact_text.hpp"
#include "tools/analysis/run/point_check.hpp"

namespace casimir {
namespace {

std::size_t place_in(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

GridPoints::GridPoints(const Model& model, const Scene& scene, const PreparedScene& run,
                       const Grid& grid, const Lets& lets)
    : run_(run), grid_(grid) {
  for (const Axis& axis : grid.axes) {
    axes_.push_back(target(axis.name));
    fingerprint_ += axis.name;
    for (const double x : axis.values) fingerprint_ += " " + exact_text(x);
    fingerprint_ += "\n";
  }
  if (lets.text.empty() && !lets.values.empty())
    throw std::invalid_argument("the lets of a grid lack their text");
  fingerprint_ += lets.text;
  std::vector<GiNaC::ex> functions;
  for (const auto& [name, value] : lets.values) {
    lets_.push_back(target(name));
    functions.push_back(value);
  }
  let_values_ = program_of(functions, lets.axes);
  check(model, scene);
}

GridPoints::Target GridPoints::target(const std::string& name) const {
  const Specialisation& s = run_.specialisation;
  const std::size_t state = place_in(s.states, name);
  if (state < s.states.size()) return {true, state, name};
  return {false, place_in(s.parameters, name), name};
}

std::pair<std::vector<double>, std::vector<double>> GridPoints::at(std::size_t point) const {
  std::vector<double> state = run_.initial, parameters = run_.parameters;
  const auto put = [&](const Target& target, double value) {
    std::vector<double>& into = target.state ? state : parameters;
    if (target.place < into.size()) into[target.place] = value;  // else it is left out
  };
  const std::vector<double> values = grid_.at(point);
  for (std::size_t i = 0; i < axes_.size(); ++i)
    if (grid_.axes[i].kind != Axis::Kind::free) put(axes_[i], values[i]);
  if (!lets_.empty()) {
    const std::vector<double> results = evaluate(let_values_, values);
    for (std::size_t i = 0; i < lets_.size(); ++i) put(lets_[i], results[i]);
  }
  return {state, parameters};
}

Scene GridPoints::scene_at(std::size_t point, const Model& model, const Scene& scene) const {
  const auto [state, parameters] = at(point);
  const auto exact = [](double x) { return GiNaC::ex(GiNaC::numeric(exact_number(x))); };
  Scene placed = scene;
  for (const auto* targets : {&axes_, &lets_})
    for (const Target& target : *targets) {
      if (target.state && target.place < state.size()) {
        const int variable = run_.specialisation.state_indices[target.place];
        placed.initial[static_cast<std::size_t>(variable)] = exact(state[target.place]);
      } else if (!target.state && target.place < parameters.size()) {
        for (std::size_t i = 0; i < model.parameters.size(); ++i)
          if (model.parameters[i].get_name() == target.name)
            placed.parameters[i] = exact(parameters[target.place]);
      }
    }
  return placed;
}

/// What the scene was checked for exactly holds to rounding at every point.
void GridPoints::check(const Model& model, const Scene& scene) const {
  PointCheck check(model, scene, run_.specialisation);
  for (std::size_t point = 0; point < grid_.points(); ++point) {
    const auto [state, parameters] = at(point);
    const std::optional<PointFault> wrong = check(state, parameters);
    if (!wrong) continue;
    std::string where;
    const std::vector<double> values = grid_.at(point);
    for (std::size_t i = 0; i < values.size(); ++i)
      where += fmt::format("{}{} = {:g}", i == 0 ? "" : ", ", grid_.axes[i].name, values[i]);
    throw RequestError(fmt::format(
        "at {}: {}{}", where, wrong->text,
        wrong->constraint ? "\n  hint: a state can be let be an expression of what the sweep goes "
                            "over, as g1=sin(theta)"
                          : ""));
  }
}

}  // namespace casimir
