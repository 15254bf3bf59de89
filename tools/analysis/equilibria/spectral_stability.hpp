#pragma once

#include <string>

namespace casimir {

/// What the linearised equations at a rest tell of it.
enum class SpectralStability {
  stable,         ///< no eigenvalue has a positive real part
  unstable,       ///< one has, whatever rounding has done
  undecided,      ///< rounding may have moved one over the imaginary axis
  no_derivative,  ///< there are no linearised equations
};

/// "spectrally stable", "unstable", "not decided" or "no derivative".
std::string to_string(SpectralStability stability);

}  // namespace casimir
