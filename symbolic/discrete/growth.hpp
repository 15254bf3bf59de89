#pragma once

#include <optional>
#include <string>
#include <vector>

namespace casimir::discrete {

/// What a beginning of a sequence of degrees suggests. None of it is a proof: the next degree may
/// be another.
struct Growth {
  /// How the degrees grow, as far as they are known.
  enum class Kind { polynomial, exponential, unclear };
  Kind kind = Kind::unclear;
  std::optional<int> degree;    ///< of polynomial growth
  std::string formula;          ///< "2*n^2 + 1" where all known degrees obey it; or empty
  std::string recurrence;       ///< "d(n) = 3*d(n-1) - d(n-2)", and from where they obey it
  std::optional<double> ratio;  ///< of exponential growth: the entropy is its logarithm
};

std::string to_string(Growth::Kind kind);

/// \param degrees  of the first, second, .. iterate
Growth growth_of(const std::vector<int>& degrees);

}  // namespace casimir::discrete
