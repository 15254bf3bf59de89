#pragma once

#include <optional>
#include <vector>

#include "symbolic/prover.hpp"

namespace casimir {

using PolynomialRows = std::vector<std::vector<Polynomial>>;

/// The rank of a matrix of functions at generic points, with what shows it.
struct GenericRank {
  std::size_t rank = 0;  ///< the rank at `point`, so a lower bound for the generic one
  std::vector<cln::cl_RA> point;
  bool exact = false;  ///< no point has a larger rank: full, or all larger minors vanish
};

/// Empty if no exact point was found. The rank at a point bounds the generic rank from below;
/// where it is not full, the bordered minors of a regular minor are expanded: if all of them vanish
/// identically, the bound is sharp.
std::optional<GenericRank> generic_rank(Prover& prover, const PolynomialRows& rows);

/// "M1 = 2, M2 = 1/3, ..", to be printed as evidence.
std::string point_text(const Prover& prover, const std::vector<cln::cl_RA>& point);

}  // namespace casimir
