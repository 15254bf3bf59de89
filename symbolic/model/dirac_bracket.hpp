#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/poisson.hpp"

namespace casimir {

/// The bracket of a system with constraints phi_a of the second class (Dirac 1950),
///   {f, g}_D = {f, g} - sum_ab {f, phi_a} (C^-1)_ab {phi_b, g},  C_ab = {phi_a, phi_b}.
/// The constraints are its Casimir functions, and it obeys the Jacobi identity wherever {,} does
/// and C is regular.
struct DiracBracket {
  PoissonStructure structure;
  GiNaC::ex determinant;  ///< of C: there is no bracket where it vanishes
};

/// \param written      {,}
/// \param constraints  at most kMostConstraints functions of the coordinates and of parameters
/// \param limits  of the case
/// \return  nothing where det C = 0, as it is for an odd number of constraints: identically, or where
///          the constraints vanish by an ideal membership
std::optional<DiracBracket> dirac_bracket(const PoissonStructure& written,
                                          const std::vector<GiNaC::ex>& constraints,
                                          const Limits& limits);

/// Determinants are expanded by minors.
inline constexpr std::size_t kMostConstraints = 8;

}  // namespace casimir
