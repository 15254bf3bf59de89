#pragma once

#include <vector>

namespace casimir {

/// Where a polynomial passes through zero.
struct PolynomialRoot {
  double at = 0;
  bool rising = false;
};

/// Every passage of a polynomial through zero between 0 and `end`, in order, and none twice.
///
/// Isolated by Descartes' rule of signs in Bernstein's basis, with bisection until each part has
/// one change of sign or none (Lane and Riesenfeld, 1981), then found in its bracket by TOMS 748.
/// Zeros so close together that their order is a matter of rounding do not count: nothing passes
/// there.
/// \param c  coefficients of s^0, s^1, ..
/// \param above  the side from which it comes: on the joint of two steps what rounding says of the
///     sign of c[0] does not count, else a passage there would be seen twice or never.
std::vector<PolynomialRoot> passages(const std::vector<double>& c, double end, bool above);

}  // namespace casimir
