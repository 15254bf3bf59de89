#pragma once

#include "runtime/program.hpp"

namespace casimir {

/// Whether tables of the products of states would lose digits that the right-hand side itself
/// keeps.
///
/// Tables hold polynomials written out. Near a common zero of two sums, their product written out
/// is a difference of large terms: of 10^8 (x - 1)^2 near x = 1 nothing is left but rounding, which
/// moves a state that rests there. A sum times one state is no such thing: rounding its terms is as
/// much as rounding the state.
///
/// Not counted are products of two sums of states without constants that have no state in common,
/// as those of Steklov's top: these vanish together by chance only, and not along a motion.
/// \param rhs  of a right-hand side; inputs behind its states are constants
bool expansion_loses_digits(const Program& rhs);

}  // namespace casimir
