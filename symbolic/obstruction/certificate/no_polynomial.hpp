#pragma once

#include <cln/rational.h>

#include <string>
#include <utility>
#include <vector>

namespace casimir::obstruction {

/// A step of a proof by linear algebra: no polynomial P in z of a degree up to `degree`, but zero,
/// has the image zero; or none of exactly that degree. Polynomials are coefficients from degree 0
/// on.
struct NoPolynomial {
  std::string what;  ///< as "case 2: invariants of degree 4"
  /// Zero: the image is a P'' + b P' + c P, and the polynomials are a, b, c. Otherwise that of the
  /// recursion for the symmetric power of this degree, and they are G, G', G W'/W and G^2 r.
  long power = 0;
  std::vector<std::vector<cln::cl_RA>> polynomials;
  long degree = 0;
  bool exactly = false;  ///< of exactly that degree, not up to it
  /// Of a degree below 0: the orders at the singular points that leave it, with the numbers of
  /// conjugate points; infinity, whose order is added and not subtracted, has the number -1.
  std::vector<std::pair<long, long>> orders = {};
};

}  // namespace casimir::obstruction
