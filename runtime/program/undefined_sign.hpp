#pragma once

#include <vector>

#include "runtime/program.hpp"

namespace casimir {

/// Of a run that `takes_sign_of_zero`.
inline constexpr const char* kSignOfZero =
    "the equations have no value: the sign of 0 is taken all along";

/// Whether a sign is taken of 0 at both ends of a run, and to first order beside them: where the
/// motion stays there, its rates have no value all along, whatever an integrator takes for them. A
/// motion that only passes such a point, or comes back to it, is one on both sides.
/// \param rhs  a right-hand side
/// \param start, end  values of its inputs
/// \throws std::domain_error  where it has no value for another reason.
bool takes_sign_of_zero(const Program& rhs, const std::vector<double>& start,
                        const std::vector<double>& end);

}  // namespace casimir
