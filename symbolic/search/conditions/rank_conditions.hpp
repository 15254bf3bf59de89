#pragma once

#include <optional>
#include <vector>

#include "symbolic/search/conditions/parametric_block.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::search {

/// Where a block loses rank.
struct RankConditions {
  /// Irreducible polynomials in the parameters: where the rank is lower, there all minors of full
  /// rank vanish, and so do their combinations. Their common factors are these; for one parameter
  /// the rank is lower nowhere else.
  std::vector<Polynomial> factors;
  bool decided = true;  ///< false where the block was too large
  /// The rank is lower on the zero sets of the factors and nowhere else. On parts of these it may
  /// be lower still.
  bool covered = true;
  std::size_t rank = 0;  ///< for generic values, of what is left without constant coefficients
};

/// The common factors of the minors of full rank: of several random combinations of them, each the
/// determinant of U * A * V with integer matrices U and V.
/// \param free  places of the parameters that matter; factors without them are left out.
RankConditions rank_conditions(const System& system, ParametricBlock block,
                               const std::vector<std::size_t>& free, const Watch& watch);

/// Values of one parameter at which the block loses rank although it does not for generic values of
/// the other: candidates for the first coordinate of isolated points. Each is rational.
std::vector<cln::cl_RA> isolated_values(const System& system, const ParametricBlock& block,
                                        std::size_t first, std::size_t second, const Watch& watch);

}  // namespace casimir::search
