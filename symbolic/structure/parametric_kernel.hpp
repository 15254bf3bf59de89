#pragma once

#include <functional>
#include <map>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"

namespace casimir::structure {

/// A vector with entries that are polynomials in parameters; those that are not zero.
using ParametricRow = std::map<std::size_t, Polynomial>;

/// The kernel of a matrix over the field of rational functions of the parameters.
struct ParametricKernel {
  std::vector<std::size_t> free;  ///< the columns without a pivot
  /// For each of these a vector of the kernel, whose other entries of this kind are zero.
  std::vector<ParametricRow> basis;
};

/// By elimination without fractions.
/// \param tick  called after each step, with the share that is done
ParametricKernel kernel_of(std::vector<ParametricRow> rows, std::size_t columns,
                           const PolynomialRing& ring, const std::function<void(double)>& tick);

}  // namespace casimir::structure
