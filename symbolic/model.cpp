#include "symbolic/model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/algebra/exact_constant.hpp"
#include "symbolic/algebra/where_defined.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/model/given_functions.hpp"
#include "symbolic/model/model_dynamics.hpp"

namespace casimir {

using GiNaC::ex;

std::vector<std::string> names_of(const std::vector<NamedExpression>& list) {
  std::vector<std::string> names;
  for (const NamedExpression& item : list) names.push_back(item.name);
  return names;
}

std::vector<ex> PoissonMap::composed_brackets() const {
  GiNaC::exmap values;
  for (std::size_t i = 0; i < expressions.size(); ++i)
    values[target.coordinates()[i]] = expressions[i];
  std::vector<ex> result;
  for (std::size_t i = 0; i < expressions.size(); ++i) {
    for (std::size_t j = i + 1; j < expressions.size(); ++j) {
      result.push_back(target(i, j).subs(values, GiNaC::subs_options::no_pattern));
    }
  }
  return result;
}

bool Assumption::holds_at(const GiNaC::exmap& point, const Limits& limits) const {
  return where_defined([&] {
           const std::optional<int> sign =
               sign_of_constant(substituted(difference, point, limits), limits.bits);
           return sign && holds(comparison, *sign);
         })
      .value_or(false);
}

std::string to_string(Extreme extreme) {
  switch (extreme) {
    case Extreme::separatrix:
      return "separatrix";
    case Extreme::stiff:
      return "stiff";
    case Extreme::scale:
      return "scale";
    case Extreme::gimbal:
      return "gimbal";
    case Extreme::long_run:
      return "long";
    case Extreme::blowup:
      return "blowup";
  }
  return {};
}

const std::vector<Extreme>& extremes() {
  static const std::vector<Extreme> all{Extreme::separatrix, Extreme::stiff,    Extreme::scale,
                                        Extreme::gimbal,     Extreme::long_run, Extreme::blowup};
  return all;
}

std::vector<GiNaC::symbol> Model::symbols() const {
  std::vector<GiNaC::symbol> result = variables;
  result.insert(result.end(), parameters.begin(), parameters.end());
  return result;
}

const Scene& Model::scene(const std::string& scene_name) const {
  const auto usable = [&](const Scene& found) -> const Scene& {
    if (found.singular) throw SingularPoint(found.unusable);
    if (!found.unusable.empty()) throw CaseError({file}, found.unusable);
    return found;
  };
  std::vector<std::string> known;
  for (const Scene& candidate : scenes) {
    if (candidate.name == scene_name) return usable(candidate);
    known.push_back(candidate.name);
  }
  if (scenes.empty())
    throw CaseError({file}, "the case has no [[scene]], which this command needs");
  if (scene_name == "default") return usable(scenes.front());
  throw CaseError({file}, fmt::format("there is no scene '{}'", printable(scene_name)), {},
                  suggest_or_list(scene_name, known, "scenes of this case"));
}

namespace {

/// The names of a finished model. What they stand for is measured when it is first used.
class ModelNames : public NameTable {
 public:
  explicit ModelNames(const Model& model)
      : NameTable(model.limits), dynamics_(model), complex_(model.complex_numbers) {}
  const Dynamics* dynamics() override { return &dynamics_; }
  bool complex_numbers() const override { return complex_; }

  const Quantity* find(const std::string& name) override {
    if (const auto later = unmeasured_.find(name); later != unmeasured_.end()) {
      add(name, with_parts(measured(later->second.value), later->second.domain));
      unmeasured_.erase(later);
    }
    return NameTable::find(name);
  }

  std::vector<std::string> known() const override {
    std::vector<std::string> names = NameTable::known();
    for (const auto& [name, value] : unmeasured_) names.push_back(name);
    return names;
  }

  void add_unless_known(const NamedExpression& f) {
    if (NameTable::find(f.name) == nullptr) unmeasured_.try_emplace(f.name, f);
  }

 private:
  ModelDynamics dynamics_;
  bool complex_;
  std::map<std::string, NamedExpression> unmeasured_;
};

ModelNames names_of(const Model& model) {
  ModelNames names(model);
  const auto add = [&](const std::vector<NamedExpression>& list) {
    for (const NamedExpression& item : list) names.add_unless_known(item);
  };
  for (const GiNaC::symbol& s : model.variables) names.add(s.get_name(), Quantity::symbol(s));
  for (const GiNaC::symbol& s : model.parameters) {
    const auto function = function_name(s.get_name());
    names.add(function ? function->name : s.get_name(), Quantity::symbol(s));
  }
  for (const auto& [parameter, value] : model.fixed)
    names.add_unless_known({parameter.value, value, {}});
  if (model.time) names.add(model.time->get_name(), Quantity::symbol(*model.time));
  add(model.definitions);
  add(model.casimirs);
  add(model.integrals);
  if (model.hamiltonian) names.add_unless_known({"H", *model.hamiltonian, {}, model.domain});
  return names;
}

}  // namespace

GiNaC::ex Model::parse(const Text& text) const {
  ModelNames names = names_of(*this);
  return parse_expression(text, names).value;
}

NamedExpression Model::parse_named(const Text& text) const {
  ModelNames names = names_of(*this);
  const Quantity quantity = parse_expression(text, names);
  return {text.value, quantity.value, text.where, lost_parts(quantity)};
}

Identity Model::parse_identity(const Text& text) const {
  ModelNames names = names_of(*this);
  const auto [left, right] = casimir::parse_equation(text, names);
  Identity identity{text.value, text.where, left.value, right.value, {}, lost_parts(left)};
  for (const ex& part : lost_parts(right)) identity.domain.push_back(part);
  return identity;
}

ex Model::rate(const ex& f) const {
  GiNaC::exvector terms;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const ex slope = f.diff(variables[i]);
    if (!slope.is_zero()) terms.push_back(slope * field[i]);
  }
  if (time) terms.push_back(f.diff(*time));
  return GiNaC::add(terms);
}

GiNaC::exmap Model::parameter_values(const Scene& scene) const {
  GiNaC::exmap numbers, result;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (!function_name(parameters[i].get_name())) numbers[parameters[i]] = scene.parameters[i];
  result = numbers;
  // The body of a function is written with the other parameters.
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (function_name(parameters[i].get_name()))
      result[parameters[i]] = substituted(scene.parameters[i], numbers, limits);
  return result;
}

GiNaC::ex Model::at_parameters(const GiNaC::ex& expression, const Scene& scene) const {
  const ex result = substituted(expression, parameter_values(scene), limits);
  for (const GiNaC::symbol& parameter : parameters)
    if (function_name(parameter.get_name()) && result.has(parameter))
      throw function_not_given(scene.name, parameter.get_name());
  return result;
}

Model anywhere(const Model& model) {
  Model result = model;
  std::erase_if(result.assumptions, [&](const Assumption& a) {
    return std::ranges::any_of(model.variables,
                               [&](const GiNaC::symbol& x) { return a.difference.has(x); });
  });
  return result;
}

}  // namespace casimir
