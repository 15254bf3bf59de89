#pragma once

#include <functional>

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// What is known of the parameters that a matrix depends on.
struct MatrixParameters {
  std::function<bool(std::size_t)> is_parameter;   ///< a place in the ring, or a function of them
  std::function<bool(const Polynomial&)> depends;  ///< on one of them, through functions too
  /// Whether an irreducible factor was looked at: where it vanishes, another condition speaks.
  std::function<bool(const Polynomial&)> is_excluded;
  bool in_functions = false;  ///< some stand in functions that are not rational, such as sin(a*q)
};

/// Whether some minor of that size is not zero at almost all points, for all parameters at which
/// none of the factors vanishes that were looked at: each of its factors is one of these, or
/// vanishes nowhere, or has no parameters and so is the same function for all of them, or is never
/// identically zero. Looks at a minor that is regular at a point, and at some of its neighbours.
bool has_lasting_minor(Prover& prover, const PolynomialRows& rows, std::size_t rank,
                       const MatrixParameters& parameters);

}  // namespace casimir
