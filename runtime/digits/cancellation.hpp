#pragma once

#include <cln/real.h>

#include <vector>

#include "runtime/program.hpp"

namespace casimir {

/// Decimal digits that the rates lose at a state, beyond those of its numbers, where what is nearly
/// equal is subtracted: (1 - cos(y))/y^2 loses eighty at y = 10^(-40). Two runs with too few digits
/// agree in that all is lost.
///
/// The rates are evaluated in Arb's balls, with more and more digits until the radius of each is
/// small beside what it changes in the time of the run. One that never is is taken for zero: that
/// of sin(y)^2 + cos(y)^2 - 1.
/// \param rates  of the states; its inputs are the states, parameters and the time
/// \param at  their values
/// \param duration  of the run
int cancelled_digits(const Program& rates, const std::vector<cln::cl_R>& at,
                     const cln::cl_R& duration, int digits);

}  // namespace casimir
