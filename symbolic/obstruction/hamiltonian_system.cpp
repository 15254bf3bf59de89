#include "symbolic/obstruction/hamiltonian_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"
#include "symbolic/obstruction/equation/parametric_function.hpp"

namespace casimir::obstruction {
namespace {

bool is_rational(const GiNaC::ex& value) {
  return GiNaC::is_a<GiNaC::numeric>(value) && GiNaC::ex_to<GiNaC::numeric>(value).is_rational();
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The values of the parameters in the scene.
GiNaC::exmap numbers(const Model& model, const std::string& scene_name, const std::string& free,
                     std::vector<std::pair<std::string, std::string>>& texts) {
  GiNaC::exmap result;
  for (const auto& [name, value] : model.fixed)
    texts.emplace_back(name.value, expression_text(value));
  std::vector<std::size_t> needed;
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    if (!contains(names_in(free), model.parameters[i].get_name())) needed.push_back(i);
  if (needed.empty()) return result;
  for (const std::size_t i : needed) {
    if (function_name(model.parameters[i].get_name()))
      throw NotDecided(
          fmt::format("the function {} is arbitrary, and has to be written into the case",
                      model.parameters[i].get_name()));
  }
  if (model.scenes.empty())
    throw NotDecided(fmt::format("the parameter {} has no value, and needs one",
                                 model.parameters[needed.front()].get_name()));
  const Scene& scene = model.scene(scene_name);
  for (const std::size_t i : needed) {
    const std::string& name = model.parameters[i].get_name();
    if (!is_rational(scene.parameters[i]))
      throw NotDecided(fmt::format("the parameter {} has no rational value, and needs one", name));
    texts.emplace_back(name, expression_text(scene.parameters[i]));
    result[model.parameters[i]] = scene.parameters[i];
  }
  return result;
}

}  // namespace

std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> result;
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    result.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return result;
}

std::size_t HamiltonianSystem::index(const GiNaC::ex& variable) const {
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (variable.is_equal(variables[i])) return i;
  throw std::logic_error("not a variable of the system");
}

namespace {

/// The theorem is about symplectic manifolds: leaves of a bracket with the Jacobi identity.
void check_jacobi(const HamiltonianSystem& system) {
  const std::size_t n = system.variables.size();
  const auto& bracket = system.poisson;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) {
        GiNaC::ex defect = 0;
        for (std::size_t l = 0; l < n; ++l) {
          const GiNaC::symbol& x = system.variables[l];
          defect += bracket[i][l] * bracket[j][k].diff(x) + bracket[j][l] * bracket[k][i].diff(x) +
                    bracket[k][l] * bracket[i][j].diff(x);
        }
        if (!defect.normal().is_zero())
          throw NotDecided("the bracket's Jacobi identity was not shown here");
      }
}

/// The phase space is a union of leaves then. Where it is not, integrals that are there on the
/// constraints alone would not be excluded.
void check_constraints(const HamiltonianSystem& system) {
  for (const GiNaC::ex& constraint : system.constraints)
    for (const auto& row : system.poisson) {
      GiNaC::ex bracket = 0;
      for (std::size_t j = 0; j < row.size(); ++j)
        bracket += row[j] * constraint.diff(system.variables[j]);
      if (!bracket.normal().is_zero())
        throw NotDecided("the constraints of the phase space are no Casimir functions");
    }
}

}  // namespace

HamiltonianSystem hamiltonian_system(const Model& model, const std::string& scene,
                                     const std::string& free) {
  if (!model.poisson || !model.hamiltonian)
    throw NotDecided("the theorem is about Hamiltonian systems, and the case has no Hamiltonian");
  if (model.time) throw NotDecided("the theorem is about systems that do not depend on time");
  HamiltonianSystem result;
  result.limits = model.limits;
  const GiNaC::exmap values = numbers(model, scene, free, result.parameters);
  result.numbers = values;
  for (const std::string& name : names_in(free))
    for (const GiNaC::symbol& parameter : model.parameters) {
      if (parameter.get_name() != name) continue;
      if (result.free)
        result.further.push_back(parameter);
      else
        result.free = parameter;
    }
  if (result.further.size() + 1 > ParametricFunction::kMostParameters)
    throw NotDecided("more than four free parameters");
  result.variables = model.variables;
  result.hamiltonian = model.hamiltonian->subs(values);
  for (const GiNaC::ex& rate : model.poisson->flow(*model.hamiltonian))
    result.rates.push_back(rate.subs(values));
  const std::size_t n = model.variables.size();
  result.poisson.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      result.poisson[i].push_back((*model.poisson)(i, j).subs(values));
  check_jacobi(result);
  for (const NamedExpression& constraint : model.constraints)
    result.constraints.push_back(constraint.value.subs(values));
  check_constraints(result);
  result.lost = model.domain;
  result.lost.insert(result.lost.end(), model.bracket_domain.begin(), model.bracket_domain.end());
  for (const NamedExpression& constraint : model.constraints)
    result.lost.insert(result.lost.end(), constraint.domain.begin(), constraint.domain.end());
  for (Assumption assumption : model.assumptions) {
    assumption.difference = assumption.difference.subs(values);
    const auto in_it = [&](const GiNaC::symbol& x) { return assumption.difference.has(x); };
    if (std::any_of(result.variables.begin(), result.variables.end(), in_it))
      result.domain.push_back(std::move(assumption));
    else if (!GiNaC::is_a<GiNaC::numeric>(assumption.difference))
      result.of_free.push_back(std::move(assumption));
  }
  for (const NamedExpression& casimir : model.casimirs)
    result.casimirs.emplace_back(casimir.name, casimir.value.subs(values));
  const auto place = std::find_if(model.scenes.begin(), model.scenes.end(),
                                  [&](const Scene& s) { return s.name == scene; });
  if (place != model.scenes.end())
    for (std::size_t i = 0; i < n && i < place->initial.size(); ++i)
      if (is_rational(place->initial[i])) result.start[model.variables[i]] = place->initial[i];
  return result;
}

HamiltonianSystem with_value(const HamiltonianSystem& system, const cln::cl_RA& value) {
  if (!system.free) throw std::logic_error("the system has no free parameter");
  const GiNaC::numeric number{cln::cl_N(value)};
  const GiNaC::exmap is_value{{*system.free, number}};
  HamiltonianSystem result = system;
  result.free.reset();
  result.numbers[*system.free] = number;
  result.parameters.emplace_back(system.free->get_name(), rational_text(value));
  try {
    result.hamiltonian = system.hamiltonian.subs(is_value);
    for (GiNaC::ex& rate : result.rates) rate = rate.subs(is_value);
    for (auto& row : result.poisson)
      for (GiNaC::ex& bracket : row) bracket = bracket.subs(is_value);
    for (auto& [name, casimir] : result.casimirs) casimir = casimir.subs(is_value);
    for (GiNaC::ex& constraint : result.constraints) constraint = constraint.subs(is_value);
    for (Assumption& one : result.domain) one.difference = one.difference.subs(is_value);
  } catch (const std::domain_error&) {
    throw NotDecided("the equations have no value at that value of the parameter");
  }
  return result;
}

}  // namespace casimir::obstruction
