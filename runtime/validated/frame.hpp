#pragma once

#include <vector>

#include "runtime/validated/linear.hpp"

namespace casimir::validated {

/// A matrix of doubles whose columns are nearly orthonormal, with a bound for what its transpose
/// is not the inverse by.
struct Frame {
  Matrix<double> columns;  ///< B, taken as exact
  /// e such that B^-1 w = B^T w + F B^T w for all w, with |F| <= e in the maximum norm.
  double defect = 0;
};

/// The unit matrix.
Frame unit_frame(std::size_t dimension);

/// Columns by Gram and Schmidt: first the directions of `first` in their order, then those of
/// `others`, the ones with the largest weight before. Of either, a column that depends on the ones
/// before it is left out.
/// \param first   gradients that the set is thin along.
/// \param others  a column for each coordinate of the set that is to be framed.
/// \param weights of the columns of `others`: how far the set reaches along them.
/// \param taken   gets the number of the column that each of `first` became, or -1.
/// \return        a frame with `defect` below 1/2; empty columns where there is none.
Frame frame_along(const std::vector<std::vector<double>>& first, const Matrix<double>& others,
                  const std::vector<double>& weights, std::vector<int>& taken);

}  // namespace casimir::validated
