#include "codegen/scene_hamiltonian.hpp"

#include <algorithm>

#include "symbolic/expression/expression_size.hpp"

namespace casimir {

std::optional<SceneHamiltonian> scene_hamiltonian(const Model& model, const Scene& scene,
                                                  const std::vector<std::string>& states,
                                                  const std::vector<std::string>& parameters,
                                                  std::string& why_not) {
  if (!model.poisson || !model.hamiltonian) {
    why_not = "the equations have no Hamiltonian with a bracket";
    return {};
  }
  if (states.size() != model.variables.size()) {
    why_not = "states are left out, and what is left has no bracket; observe every variable";
    return {};
  }
  Scene binding = scene;
  SceneHamiltonian source;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    if (!std::ranges::count(parameters, model.parameters[i].get_name())) continue;
    binding.parameters.at(i) = model.parameters[i];
    source.parameters.push_back(model.parameters[i]);
  }
  source.states = model.variables;
  source.hamiltonian = model.at_parameters(*model.hamiltonian, binding);
  if (model.time && source.hamiltonian.has(*model.time)) {
    why_not = "the Hamiltonian depends on the time";
    return {};
  }
  const auto n = static_cast<unsigned>(states.size());
  source.bracket = GiNaC::matrix(n, n);
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = 0; j < n; ++j)
      source.bracket(i, j) = model.at_parameters((*model.poisson)(i, j), binding);
  return source;
}

bool codegen::is_null(const GiNaC::ex& e) {
  return e.expand().is_zero() || normal_form(e).is_zero();
}

}  // namespace casimir
