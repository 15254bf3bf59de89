#pragma once

#include <cstddef>
#include <vector>

#include "runtime/program.hpp"

namespace casimir {

/// The states that start at 0 and stay there, as M3 on a relation of Hess: the largest set S of
/// them whose rates vanish wherever all of S do. Where their rates are smooth in S, they are a
/// matrix, continuous along the solution, times S, so that S = 0 is the only solution (Gronwall's
/// lemma). Rates in which |.|, a root, a logarithm or another function with an edge sees a state of
/// S are taken for others.
///
/// That a rate vanishes is seen at sixteen random points modulo two primes of 31 bits, in which
/// functions of the other states are as random: what does not vanish identically and has degree d
/// is taken for 0 with a probability below (d / 2^30)^16, and what vanishes by an identity between
/// functions, as sin^2 + cos^2 = 1, is not seen.
/// \param rhs  a right-hand side
/// \param zero_at_start  for each state whether it starts at 0
/// \return  the states, in their order
std::vector<std::size_t> states_that_stay_zero(const Program& rhs,
                                               const std::vector<bool>& zero_at_start);

/// The right-hand side with the number 0 for the rates of these states.
Program at_rest(Program rhs, const std::vector<std::size_t>& states);

}  // namespace casimir
