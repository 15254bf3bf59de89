#pragma once

#include <cln/rational.h>
#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/model.hpp"

namespace casimir::obstruction {

/// A case with rational numbers for all its parameters but at most some free ones.
struct HamiltonianSystem {
  std::vector<GiNaC::symbol> variables;
  std::vector<GiNaC::ex> rates;
  std::vector<std::vector<GiNaC::ex>> poisson;  ///< brackets of the variables
  GiNaC::ex hamiltonian;
  std::vector<std::pair<std::string, GiNaC::ex>> casimirs;
  std::vector<GiNaC::ex> constraints;  ///< Casimir functions too; they vanish on the phase space
  std::vector<Assumption> domain;      ///< what the case assumes of its variables ..
  std::vector<GiNaC::ex> lost;  ///< parts that have cancelled, without whose values there are none
  std::vector<Assumption> of_free;  ///< .. and of parameters that have no number
  std::vector<std::pair<std::string, std::string>> parameters;  ///< name and value
  GiNaC::exmap numbers;                                         ///< of the parameters
  std::optional<GiNaC::symbol> free;   ///< the parameter that has no number
  std::vector<GiNaC::symbol> further;  ///< more of these
  GiNaC::exmap start;                  ///< the scene's initial values, where they are rational
  Limits limits{};                     ///< of the case

  /// The place of a variable in the list. \throws std::logic_error  if it is none
  std::size_t index(const GiNaC::ex& variable) const;
};

/// The names in "a,b".
std::vector<std::string> names_in(const std::string& list);

/// The case with the parameters of one of its scenes.
/// \param free  the names, with commas, of parameters that keep their symbols; empty for none
/// \throws NotDecided  where it is not Hamiltonian, depends on time, has a parameter without a
///                     rational value, or is constrained by what is no Casimir function: the
///                     theorem is about a neighbourhood in a leaf
HamiltonianSystem hamiltonian_system(const Model& model, const std::string& scene,
                                     const std::string& free = "");

/// The system with a number for its free parameter.
/// \throws NotDecided  where the equations have no value there
HamiltonianSystem with_value(const HamiltonianSystem& system, const cln::cl_RA& value);

}  // namespace casimir::obstruction
