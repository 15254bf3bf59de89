#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "symbolic/discrete/map_case.hpp"
#include "symbolic/model.hpp"

namespace casimir {

struct GivenFunctions;

/// See SymmetryText.
struct MapSymmetry {
  std::string name;
  std::vector<GiNaC::ex> variables;   ///< one for each of Model::variables
  std::vector<GiNaC::ex> parameters;  ///< one for each of Model::parameters
  bool reverses = false;
  std::vector<GiNaC::ex> domain{};  ///< as of NamedExpression
};

/// See ConjugacyText.
struct MapConjugacy {
  std::string name;
  std::vector<GiNaC::symbol> coordinates;  ///< y, as many as there are variables
  std::vector<GiNaC::ex> expressions;      ///< phi, one for each
  std::vector<GiNaC::ex> map;              ///< G, one for each, over the coordinates
  bool reverses = false;
  std::vector<GiNaC::ex> domain{};      ///< of phi, as of NamedExpression
  std::vector<GiNaC::ex> map_domain{};  ///< of G, over the coordinates
};

/// A case whose motion is a map x -> x', made mathematical.
struct MapModel {
  /// All but the motion: it has no Hamiltonian, and `field` is empty. Its casimirs are functions
  /// that are in involution with all others and that the map keeps; its integrals and relations
  /// are those of the map.
  Model base;
  std::vector<GiNaC::ex> next;         ///< x'_i for each variable
  std::vector<GiNaC::ex> next_domain;  ///< of these, as of NamedExpression
  int sign = 1;                        ///< -1: claimed to be anti-Poisson
  std::vector<MapSymmetry> symmetries;
  std::vector<MapConjugacy> conjugacies{};
  /// Maps of which this one is the composition, the first one first; empty for a single one. It has
  /// a value where all of them have. What the case assumes of its variables is assumed by the first
  /// one alone: the others begin where the ones before have led.
  std::vector<MapModel> steps{};

  /// f(x') for a function f of x.
  GiNaC::ex composed(const GiNaC::ex& f) const;
  /// The same, and behind it what f needs at x' and f(x') does not show: `substituted_with_parts`.
  std::vector<GiNaC::ex> composed_with_parts(const GiNaC::ex& f) const;

  /// The map in the place of a flow's equations, for code that writes functions: the values that it
  /// writes for dx/dt are the next ones.
  Model as_field() const;

 private:
  GiNaC::exmap image() const;
};

/// The map with functions that are given in the place of arbitrary ones.
MapModel with_functions(const MapModel& map, const GivenFunctions& given);

/// Reads every expression of the case file.
/// \throws CaseError  with the place of what is wrong.
MapModel build_map_model(const MapCaseFile& file, const ParameterValues& fixed = {},
                         const FindCase& find_case = {});

}  // namespace casimir
