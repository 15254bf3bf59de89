#pragma once

#include <ginac/ginac.h>

#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"

namespace casimir::obstruction {

/// A case with rational numbers for all its parameters.
struct HamiltonianSystem {
  std::vector<GiNaC::symbol> variables;
  std::vector<GiNaC::ex> rates;
  std::vector<std::vector<GiNaC::ex>> poisson;  ///< brackets of the variables
  GiNaC::ex hamiltonian;
  std::vector<std::pair<std::string, GiNaC::ex>> casimirs;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< name and value
  GiNaC::exmap start;  ///< the scene's initial values, where they are rational

  /// The place of a variable in the list. \throws std::logic_error  if it is none
  std::size_t index(const GiNaC::ex& variable) const;
};

/// The case with the parameters of one of its scenes.
/// \throws NotDecided  where it is not Hamiltonian, depends on time, or has a parameter without a
///                     rational value
HamiltonianSystem hamiltonian_system(const Model& model, const std::string& scene);

}  // namespace casimir::obstruction
