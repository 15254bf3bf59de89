#pragma once

#include <vector>

#include "symbolic/algebra/rational_matrix.hpp"

namespace casimir::structure {

/// A linear map y = M x that takes a constant bracket (a skew matrix) to its normal form: blocks
/// (0, 1; -1, 0), then zeros.
RationalMatrix normal_basis(const RationalMatrix& skew);

}  // namespace casimir::structure
