#pragma once

#include <ginac/ginac.h>

#include <vector>

namespace casimir {

/// The period of a function that is an angle: of which atan2(..) or angular variables are terms
/// with rational coefficients. 0 where there is none.
/// \param angles  variables that are known up to multiples of 2 Pi.
double period_of(const GiNaC::ex& function, const std::vector<GiNaC::symbol>& angles);

/// Of these variables, those that enter all the functions by 2 Pi-periodic functions alone. One
/// that does not enter at all counts as an angle if there is an angle that does: the precession of
/// a top, but not the place of a free point.
/// \param functions  without parameters.
std::vector<bool> angles_among(const std::vector<GiNaC::symbol>& variables,
                               const std::vector<GiNaC::ex>& functions);

}  // namespace casimir
