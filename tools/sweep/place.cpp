#include "tools/sweep/place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "codegen/lower.hpp"
#include "codegen/terms.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/term_size.hpp"
#include "symbolic/expression.hpp"
#include "tools/cli.hpp"

namespace casimir::tools {
namespace {

/// The name before the equal sign of a --let.
std::string let_name(const std::string& let) {
  std::string name = let.substr(0, let.find('='));
  std::erase(name, ' ');
  return name;
}

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

}  // namespace

std::vector<std::string> Places::names(const Grid& grid, const std::vector<std::string>& lets) {
  std::vector<std::string> result;
  for (const Axis& axis : grid.axes)
    if (axis.kind != Axis::Kind::free) result.push_back(axis.name);
  for (const std::string& let : lets) result.push_back(let_name(let));
  return result;
}

Places::Places(const Model& model, const Scene& scene, const SceneRun& run, const Grid& grid,
               const std::vector<std::string>& lets)
    : run_(run), grid_(grid) {
  for (const Axis& axis : grid.axes) axes_.push_back(target(axis.name));
  read_lets(model, lets);
  check(model, scene);
}

Places::Target Places::target(const std::string& name) const {
  const Specialisation& s = run_.specialisation;
  const std::size_t state = place_in(s.states, name);
  if (state < s.states.size()) return {true, state, name};
  return {false, place_in(s.parameters, name), name};
}

void Places::read_lets(const Model& model, const std::vector<std::string>& lets) {
  NameTable table;
  std::vector<GiNaC::symbol> symbols;
  for (const Axis& axis : grid_.axes) {
    symbols.emplace_back(axis.name);
    table.add(axis.name, Quantity::symbol(symbols.back()));
  }
  std::vector<GiNaC::ex> functions;
  const auto known = [&](const std::string& name) {
    const auto is = [&](const GiNaC::symbol& s) { return s.get_name() == name; };
    return std::ranges::any_of(model.variables, is) || std::ranges::any_of(model.parameters, is);
  };
  for (const std::string& let : lets) {
    const Text option{let, {"--let", 1, 1}, let};
    const std::size_t equals = let.find('=');
    if (equals == std::string::npos)
      throw option.error("expected NAME=EXPR, such as --let \"g1=sin(theta)\"");
    const std::string name = let_name(let);
    if (!known(name)) {
      std::vector<std::string> names;
      for (const auto* list : {&model.variables, &model.parameters})
        for (const GiNaC::symbol& s : *list) names.push_back(s.get_name());
      throw option.error(fmt::format("there is no variable or parameter '{}'", printable(name)), 0,
                         suggest(name, names));
    }
    for (const Target& other : axes_)
      if (other.name == name) throw option.error(fmt::format("'{}' is given by --over", name));
    for (const Target& other : lets_)
      if (other.name == name) throw option.error(fmt::format("there are two '{}'", name));
    Text expression{let.substr(equals + 1), {"--let", 1, static_cast<int>(equals) + 2}, let};
    functions.push_back(parse_expression(expression, table).value);
    lets_.push_back(target(name));
  }
  let_values_ = program_of(functions, symbols);
}

std::pair<std::vector<double>, std::vector<double>> Places::at(std::size_t point) const {
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

/// What the scene was checked for exactly holds to rounding at every point.
void Places::check(const Model& model, const Scene& scene) const {
  constexpr long double kRounding = 1e-13L;
  std::vector<GiNaC::ex> functions;
  std::vector<GiNaC::symbol> symbols = model.variables;
  symbols.insert(symbols.end(), model.parameters.begin(), model.parameters.end());
  for (const NamedExpression& c : model.constraints) functions.push_back(c.value);
  for (const Assumption& a : model.assumptions) functions.push_back(a.difference);
  const Program program = program_of(functions, symbols);
  const Specialisation& s = run_.specialisation;
  std::vector<SizedNumber> inputs;
  const auto number = [](const GiNaC::ex& e) {
    return Arithmetic<SizedNumber>::plain(GiNaC::ex_to<GiNaC::numeric>(e.evalf()).to_double());
  };
  for (const GiNaC::ex& e : scene.initial) inputs.push_back(number(e));
  for (const GiNaC::ex& e : scene.parameters) inputs.push_back(number(e));
  for (std::size_t point = 0; point < grid_.points(); ++point) {
    const auto [state, parameters] = at(point);
    const auto fail = [&](const std::string& what) {
      std::string where;
      const std::vector<double> values = grid_.at(point);
      for (std::size_t i = 0; i < values.size(); ++i)
        where += fmt::format("{}{} = {:g}", i == 0 ? "" : ", ", grid_.axes[i].name, values[i]);
      throw UsageError(fmt::format("at {}: {}", where, what));
    };
    for (std::size_t i = 0; i < model.variables.size(); ++i) {
      const std::size_t place = place_in(s.states, model.variables[i].get_name());
      if (place >= state.size()) continue;
      inputs[i] = Arithmetic<SizedNumber>::plain(state[place]);
      if (!std::isfinite(state[place])) fail(s.states[place] + " is no number");
    }
    for (std::size_t i = 0; i < model.parameters.size(); ++i) {
      const std::size_t place = place_in(s.parameters, model.parameters[i].get_name());
      if (place >= parameters.size()) continue;
      inputs[model.variables.size() + i] = Arithmetic<SizedNumber>::plain(parameters[place]);
      if (!std::isfinite(parameters[place])) fail(s.parameters[place] + " is no number");
    }
    if (functions.empty()) continue;
    const std::vector<SizedNumber> values = evaluate(program, inputs);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const long double x = values[i].value;
      if (i < model.constraints.size()) {
        if (!(std::abs(x) <= kRounding * std::max(values[i].size, 1.0L)))
          fail(fmt::format(
              "the constraint {} is {:.3g} instead of 0\n  hint: --let can give a state "
              "as an expression, such as --over theta=0:Pi:50 --let g1=sin(theta)",
              model.constraints[i].name, static_cast<double>(x)));
        continue;
      }
      const Assumption& a = model.assumptions[i - model.constraints.size()];
      const bool holds = a.relation == "!=" ? x != 0
                         : a.relation == "=="
                             ? std::abs(x) <= kRounding * std::max(values[i].size, 1.0L)
                         : a.relation == ">"  ? x > 0
                         : a.relation == ">=" ? x >= 0
                         : a.relation == "<"  ? x < 0
                                              : x <= 0;
      if (!holds) fail(fmt::format("the assumption {} does not hold", a.text));
    }
  }
}

}  // namespace casimir::tools
