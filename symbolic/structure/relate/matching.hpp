#pragma once

#include <vector>

#include "symbolic/structure/relate/equations.hpp"

namespace casimir::structure {

/// A regular linear map of one case onto another, if one is found: see `Pair`. What is found is to
/// be proved; `none` is proved.
///
/// The quadratic equations for T become linear ones where the images of some elements are known.
/// So, for a linear bracket: T is first bound to keep the derived series and its like; where there
/// are Hamiltonians, the factor c and the multiples m_k follow from the spectrum of the operator
/// that the quadratic part makes with the Killing form (or a constant bracket), which T has to
/// take to its counterpart, as it takes the linear parts to each other; then small elements of `b`
/// are given small elements of `a` with the same spectra, until the equations that are left can be
/// solved by `solve_family`.
MapSearch match(const Pair& pair, const search::Watch& watch);

}  // namespace casimir::structure
