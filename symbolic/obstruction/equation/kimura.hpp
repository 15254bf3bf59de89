#pragma once

#include <cln/rational.h>

#include <array>
#include <optional>
#include <string>

namespace casimir::obstruction {

/// The squares of the differences of exponents of Riemann's P equation at its three points: each
/// difference is the square root of a rational number, which may be negative.
using SquaredDifferences = std::array<cln::cl_RA, 3>;

/// Whether Riemann's P equation has a Galois group with a solvable identity component (Kimura
/// 1969): a sum of the differences with signs is an odd integer (the group is
/// reducible), or the differences, up to signs, order and integers, stand in Schwarz's list.
/// Square roots of rational numbers whose quotients are irrational are linearly independent over
/// the rational numbers, together with 1, so that sums are decided exactly.
/// \return  which, as "a sum of differences is the odd integer 3" or "Schwarz's list, 4"; empty where
///          the identity component is not solvable
std::optional<std::string> kimura(const SquaredDifferences& squares);

}  // namespace casimir::obstruction
