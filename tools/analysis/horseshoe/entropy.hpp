#pragma once

#include <cln/rational.h>

#include <utility>
#include <vector>

namespace casimir::horseshoe {

/// A graph by its arrows between nodes 0, 1, ..
using Arrows = std::vector<std::pair<std::size_t, std::size_t>>;

/// Whether every node leads to every node.
bool strongly_connected(std::size_t nodes, const Arrows& arrows);

/// A number that the spectral radius of the graph's matrix A is not below: min_i (A v)_i / v_i for
/// a positive vector v (Collatz and Wielandt; Horn & Johnson, Matrix Analysis, theorem 8.1.26),
/// computed exactly for a v near the eigenvector. Each arrow counts once, however often it is
/// given.
cln::cl_RA spectral_radius_above(std::size_t nodes, const Arrows& arrows);

/// A rational number below the natural logarithm of x > 0, by less than 2^-40.
cln::cl_RA logarithm_below(const cln::cl_RA& x);

}  // namespace casimir::horseshoe
