#pragma once

#include <vector>

#include "symbolic/search/system.hpp"
#include "symbolic/search/watch.hpp"
#include "symbolic/structure/parametric_kernel.hpp"

namespace casimir::structure {

/// The constants c_k with sum_k c_k v_k = 0 for given vectors v_k of polynomials.
struct ConstantKernel {
  /// A basis over the functions of the parameters, with polynomials in these for entries.
  std::vector<ParametricRow> basis;
  /// The number of solutions for generic parameters is at most this.
  ///
  /// Theorem: the rank of a matrix of polynomials in parameters, at values of these in a prime
  /// field, is no larger than its rank over the functions of the parameters. No hypothesis is
  /// needed.
  std::size_t bound = 0;
};

/// \param columns  the vectors v_k, all of one length
ConstantKernel constant_kernel(const search::System& system,
                               const std::vector<std::vector<Polynomial>>& columns,
                               const search::Watch& watch);

}  // namespace casimir::structure
