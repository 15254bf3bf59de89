#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/model.hpp"

namespace casimir {

/// x' of a rational map, as texts in the notation of case files.
struct RationalMapText {
  std::string step;  ///< the name of the step, or empty where it has a value
  /// Denominators that several next values have, with names that the case does not use.
  std::vector<std::pair<std::string, std::string>> definitions;
  std::vector<std::string> next;                 ///< one for each variable
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
