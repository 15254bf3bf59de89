#include "tools/analysis/sweep/grid_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "codegen/optimise/lower.hpp"
#include "codegen/optimise/terms.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/program/term_size.hpp"
#include "tools/analysis/error.hpp"

namespace casimir {
namespace {

Program program_of(const std::vector<GiNaC::ex>& functions,
                   const std::vector<GiNaC::symbol>& symbols) {
  codegen::Dag dag(symbols, symbols.size());
  std::vector<codegen::Scaled> outputs;
  std::vector<std::string> inputs, labels;
  for (const GiNaC::symbol& symbol : symbols) inputs.push_back(symbol.get_name());
  for (const GiNaC::ex& f : functions) {
    outputs.push_back(dag.convert(f));
    labels.push_back(fmt::format("f{}", labels.size()));
  }
  return codegen::lowered(codegen::system_of(dag, symbols.size(), outputs), inputs, labels);
}

std::size_t place_in(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// The constraints and assumptions of a case, at states and parameters in double.
class PointCheck {
 public:
  PointCheck(const Model& model, const Scene& scene, const Specialisation& s) : model_(model) {
    std::vector<GiNaC::ex> functions;
    for (const NamedExpression& c : model.constraints) functions.push_back(c.value);
    for (const Assumption& a : model.assumptions) functions.push_back(a.difference);
    const std::vector<GiNaC::symbol> symbols = model.symbols();
    program_ = program_of(functions, symbols);
    const auto add = [&](const GiNaC::ex& e) {
      inputs_.push_back(
          Arithmetic<SizedNumber>::plain(GiNaC::ex_to<GiNaC::numeric>(e.evalf()).to_double()));
    };
    for (const GiNaC::ex& e : scene.initial) add(e);
    for (const GiNaC::ex& e : scene.parameters) add(e);
    for (const std::string& name : s.states) states_.push_back(place_among(symbols, name));
    for (const std::string& name : s.parameters) parameters_.push_back(place_among(symbols, name));
  }

  /// Empty: nothing is.
  std::string what_is_wrong(const std::vector<double>& state,
                            const std::vector<double>& parameters) {
    for (std::size_t i = 0; i < state.size(); ++i)
      inputs_[states_[i]] = Arithmetic<SizedNumber>::plain(state[i]);
    for (std::size_t i = 0; i < parameters.size(); ++i)
      inputs_[parameters_[i]] = Arithmetic<SizedNumber>::plain(parameters[i]);
    if (std::ranges::any_of(inputs_, [](const SizedNumber& x) { return !std::isfinite(x.value); }))
      return "a value is no number";
    const std::vector<SizedNumber> values = evaluate(program_, inputs_);
    for (std::size_t i = 0; i < model_.constraints.size(); ++i) {
      if (!vanishes(values[i]))
        return fmt::format(
            "the constraint {} is {:.3g} instead of 0\n  hint: a state can be let be an "
            "expression of what the sweep goes over, as g1=sin(theta)",
            model_.constraints[i].name, static_cast<double>(values[i].value));
    }
    for (std::size_t i = 0; i < model_.assumptions.size(); ++i) {
      if (!holds(model_.assumptions[i], values[model_.constraints.size() + i]))
        return fmt::format("the assumption {} does not hold", model_.assumptions[i].text);
    }
    return {};
  }

 private:
  static std::size_t place_among(const std::vector<GiNaC::symbol>& symbols,
                                 const std::string& name) {
    const auto found = std::ranges::find_if(
        symbols, [&](const GiNaC::symbol& symbol) { return symbol.get_name() == name; });
    return static_cast<std::size_t>(found - symbols.begin());
  }

  static bool vanishes(const SizedNumber& x) {
    constexpr long double kRounding = 1e-13L;
    return std::abs(x.value) <= kRounding * std::max(x.size, 1.0L);
  }

  static bool holds(const Assumption& a, const SizedNumber& x) {
    if (a.comparison == Comparison::equal) return vanishes(x);
    return !std::isnan(x.value) && casimir::holds(a.comparison, (x.value > 0) - (x.value < 0));
  }

  const Model& model_;
  Program program_;
  std::vector<SizedNumber> inputs_;  ///< variables and parameters: the scene's, then the point's
  std::vector<std::size_t> states_, parameters_;  ///< where those of the run are among them
};

}  // namespace

GridPoints::GridPoints(const Model& model, const Scene& scene, const PreparedScene& run,
                       const Grid& grid, const Lets& lets)
    : run_(run), grid_(grid) {
  for (const Axis& axis : grid.axes) axes_.push_back(target(axis.name));
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
  const auto exact = [](double x) {
    return GiNaC::ex(GiNaC::numeric(cln::rational(cln::cl_DF(x))));
  };
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
    const std::string wrong = check.what_is_wrong(state, parameters);
    if (wrong.empty()) continue;
    std::string where;
    const std::vector<double> values = grid_.at(point);
    for (std::size_t i = 0; i < values.size(); ++i)
      where += fmt::format("{}{} = {:g}", i == 0 ? "" : ", ", grid_.axes[i].name, values[i]);
    throw RequestError(fmt::format("at {}: {}", where, wrong));
  }
}

}  // namespace casimir
