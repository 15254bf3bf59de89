#pragma once

#include <vector>

#include "symbolic/polynomial.hpp"

namespace casimir {

/// A Groebner basis of the ideal of `generators` in the ring's order, by Buchberger's algorithm
/// with the coprime criterion. Stops early on ideals that grow too large; what it returns always
/// generates the same ideal, so that remainder zero modulo it always proves membership.
std::vector<Polynomial> groebner_basis(const std::vector<Polynomial>& generators);

}  // namespace casimir
