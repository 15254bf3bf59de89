#include "tools/analysis/run/point_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/program_of.hpp"
#include "runtime/evaluate.hpp"
#include "symbolic/model/given_functions.hpp"
#include "tools/analysis/run/parameter_domain.hpp"

namespace casimir {
namespace {

std::size_t place_among(const std::vector<GiNaC::symbol>& symbols, const std::string& name) {
  const auto found = std::ranges::find_if(
      symbols, [&](const GiNaC::symbol& symbol) { return symbol.get_name() == name; });
  return static_cast<std::size_t>(found - symbols.begin());
}

/// Beside the terms of the sum: a level of small terms is as sharp as any.
bool vanishes(const SizedNumber& x) {
  constexpr long double kRounding = 1e-13L;
  return std::abs(x.value) <= kRounding * x.size;
}

bool holds(const Assumption& a, const SizedNumber& x) {
  if (a.comparison == Comparison::equal) return vanishes(x);
  return !std::isnan(x.value) && casimir::holds(a.comparison, (x.value > 0) - (x.value < 0));
}

}  // namespace

PointCheck::PointCheck(const Model& model, const Scene& scene, const Specialisation& s) {
  const auto [own, own_scene] =
      has_arbitrary_functions(model) ? in_scene(model, scene) : std::pair{model, scene};
  std::vector<GiNaC::ex> functions;
  for (const NamedExpression& c : own.constraints) {
    functions.push_back(c.value);
    constraints_.push_back(c.name);
  }
  assumptions_ = own.assumptions;
  implied_ = assumptions_.size();
  GiNaC::exmap folded;
  for (std::size_t i = 0; i < own.parameters.size(); ++i)
    if (!std::ranges::count(s.parameters, own.parameters[i].get_name()))
      folded[own.parameters[i]] = own_scene.parameters.at(i);
  for (Assumption& one : implied_by_parameters(own, folded)) assumptions_.push_back(std::move(one));
  for (const Assumption& a : assumptions_) functions.push_back(a.difference);
  const std::vector<GiNaC::symbol> symbols = own.symbols();
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    for (const GiNaC::symbol& x : symbols)
      if (const GiNaC::ex slope = functions[i].diff(x); !slope.is_zero()) {
        functions.push_back(slope * x);
        slopes_.push_back(i);
      }
  program_ = program_of(functions, symbols);
  const auto add = [&](const GiNaC::ex& e) {
    inputs_.push_back(
        Arithmetic<SizedNumber>::plain(GiNaC::ex_to<GiNaC::numeric>(e.evalf()).to_double()));
  };
  for (const GiNaC::ex& e : own_scene.initial) add(e);
  for (const GiNaC::ex& e : own_scene.parameters) add(e);
  for (const std::string& name : s.states) states_.push_back(place_among(symbols, name));
  for (const std::string& name : s.parameters) parameters_.push_back(place_among(symbols, name));
}

std::optional<PointFault> PointCheck::operator()(const std::vector<double>& state,
                                                 const std::vector<double>& parameters) {
  for (std::size_t i = 0; i < state.size(); ++i)
    inputs_[states_[i]] = Arithmetic<SizedNumber>::plain(state[i]);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    inputs_[parameters_[i]] = Arithmetic<SizedNumber>::plain(parameters[i]);
  if (std::ranges::any_of(inputs_, [](const SizedNumber& x) { return !std::isfinite(x.value); }))
    return PointFault{false, "a value is no number"};
  std::vector<SizedNumber> values = evaluate(program_, inputs_);
  // A function is as sharp as the rounding of what it is of: the sine of pi is no zero.
  const std::size_t own = constraints_.size() + assumptions_.size();
  for (std::size_t k = 0; k < slopes_.size(); ++k)
    values[slopes_[k]].size = std::max(values[slopes_[k]].size, std::abs(values[own + k].value));
  for (std::size_t i = 0; i < assumptions_.size(); ++i)
    if (!holds(assumptions_[i], values[constraints_.size() + i]))
      return PointFault{
          false, i < implied_
                     ? fmt::format("the assumption {} does not hold", assumptions_[i].text)
                     : fmt::format("without {} the case has no values", assumptions_[i].text)};
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    if (!vanishes(values[i]))
      return PointFault{true, fmt::format("the constraint {} is {:.3g} instead of 0",
                                          constraints_[i], static_cast<double>(values[i].value))};
  return std::nullopt;
}

}  // namespace casimir
