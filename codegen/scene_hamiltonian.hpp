#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <vector>

#include "symbolic/model.hpp"

namespace casimir {

/// A Hamiltonian system for the values of a scene, with its bracket: what methods that need more
/// than a right-hand side are made from.
struct SceneHamiltonian {
  std::vector<GiNaC::symbol> states, parameters;
  GiNaC::matrix bracket;  ///< {x_i, x_j}
  GiNaC::ex hamiltonian;
};

/// The system of a scene, or nothing and why there is none: no bracket, states left out, a
/// dependence on time.
/// \param states  the kept ones, as Specialisation::states
std::optional<SceneHamiltonian> scene_hamiltonian(const Model& model, const Scene& scene,
                                                  const std::vector<std::string>& states,
                                                  const std::vector<std::string>& parameters,
                                                  std::string& why_not);

namespace codegen {
/// Whether an expression vanishes as a quotient of polynomials in the functions that stand in it.
bool is_null(const GiNaC::ex& e);
}  // namespace codegen

}  // namespace casimir
