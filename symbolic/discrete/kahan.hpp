#pragma once

#include <cln/float.h>

#include <optional>
#include <string>
#include <vector>

#include "symbolic/model.hpp"

namespace casimir {

/// What of a map starts at a scene of the flow.
struct MapStart {
  std::string scene;
  std::string step;              ///< where the step is a parameter; empty: 1/10
  std::vector<cln::cl_F> added;  ///< one for each of RationalMapText::added
};

/// x' of a rational map, as texts in the notation of case files.
struct RationalMapText {
  std::string step;  ///< the name of the step, or empty where it has a value
  /// Denominators that several next values have, with names that the case does not use.
  std::vector<std::pair<std::string, std::string>> definitions;
  std::vector<std::string> added;  ///< variables beside those of the flow
  std::vector<std::string> next;   ///< one for each variable, and then for each added one
  /// Definitions that vanish at every state: the map is the discretisation on this level alone.
  std::vector<std::string> relations;
  std::vector<std::string> conditions;                            ///< on the parameters
  std::vector<std::pair<std::string, std::string>> conditionals;  ///< what the map keeps there
  /// Which next values are taken together, one list after the other; empty: all of them at once.
  std::vector<std::vector<std::size_t>> steps;
  std::vector<MapStart> starts;  ///< where variables are added: of the scenes that have one
  std::optional<std::string> modified_integral;  ///< see `kahan_map`
  std::optional<std::string> density;            ///< the same
};

/// Kahan's map x' = x + eps (I - (eps/2) f'(x))^(-1) f(x) of a quadratic field f; of a linear one
/// it is the implicit midpoint rule.
///
/// For a Hamiltonian H of degree 3 and a bracket that does not depend on the variables it keeps
/// H + dH.(x' - x)/3 and the density 1/det(I - (eps/2) f') (Celledoni, McLachlan, Owren and Quispel
/// 2013): both are given where these hypotheses hold.
/// \param value  of the step; without it the step is a parameter
/// \throws ModelError  where the field is no polynomial of degree at most 2 in the variables;
///                     TooLarge
RationalMapText kahan_map(const Model& flow, const std::optional<GiNaC::ex>& value);

/// \throws ModelError  where Kahan's map is not defined: see `kahan_map`.
void check_quadratic(const Model& flow);

/// The implicit midpoint rule x' = x + eps f((x + x')/2), which is a rational map for fields of
/// degree 1.
/// \throws ModelError  for others; TooLarge
RationalMapText midpoint_map(const Model& flow, const std::optional<GiNaC::ex>& value);

}  // namespace casimir
