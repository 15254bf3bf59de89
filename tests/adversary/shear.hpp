#pragma once

#include "tests/adversary/case.hpp"
#include "tests/adversary/random.hpp"

namespace casimir::adversary {

/// The same case in the coordinate x_i + c*x_j instead of x_i, for random i, j and c: all that is
/// claimed stays true, or false. Only for systems given by equations without time.
Case sheared(const Case& claim, Random& random);

}  // namespace casimir::adversary
