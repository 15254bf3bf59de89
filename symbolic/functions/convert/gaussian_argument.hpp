#pragma once

#include <cln/rational.h>

#include <optional>
#include <utility>
#include <vector>

namespace casimir {

/// atan(r) = quarters*Pi/4 + sum of times*atan(b/a), where 0 < b < a and a^2 + b^2 is prime.
struct GaussianArgument {
  cln::cl_I quarters = 0;
  std::vector<std::pair<cln::cl_RA, cln::cl_I>> parts;  ///< b/a, and how often
};

/// By the factors of the Gaussian integer q + i p for r = p/q: the argument of a product is the sum
/// of the arguments, up to whole turns. Different b/a have arguments that are linearly independent,
/// with Pi, over the rationals, since factorisation is unique there. Empty where p^2 + q^2 is
/// prime, so that nothing is taken apart, or is not factored.
std::optional<GaussianArgument> gaussian_argument(const cln::cl_RA& r);

}  // namespace casimir
