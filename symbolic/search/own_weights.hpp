#pragma once

#include <optional>
#include <vector>

#include "symbolic/search/system.hpp"

namespace casimir::search {

/// Whole numbers w_i, not all 0, one for each atom, by which the equations of motion are
/// quasi-homogeneous: with a number c, each term of the rate of x_i has the weight w_i + c, and all
/// terms of a relation between atoms have one weight. Of several, positive ones where small numbers
/// give some, and the smallest. Empty where there are none.
std::optional<std::vector<int>> own_weights(const System& system);

}  // namespace casimir::search
