#pragma once

#include <functional>
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

/// A vector of functions that may be in the kernel of a matrix: to the gradients of integrals, for
/// one, the field is orthogonal. That is checked, so that a candidate need not be sure.
struct KernelCandidate {
  std::vector<Polynomial> vector;
  /// Whether the product with that row is zero as a function; if empty, it is multiplied out.
  std::function<bool(std::size_t row)> orthogonal{};
};

/// Empty if no exact point was found. The rank at a point bounds the generic rank from below. That
/// no point has a larger one is shown, in this order, by skew symmetry (such a rank is even), by
/// vectors in the kernel that are independent at the point, or by the minors that border a regular
/// one: if they vanish identically, so do all larger minors.
std::optional<GenericRank> generic_rank(
    Prover& prover, const PolynomialRows& rows,
    const std::function<std::vector<KernelCandidate>()>& kernel = {});

/// The rank of the gradients of functions; in the kernel are the flows of those that commute with
/// all, and for a system without a bracket its field.
std::optional<GenericRank> gradient_rank(Prover& prover, const std::vector<Polynomial>& functions);

/// The rows' values at a point.
std::vector<std::vector<cln::cl_RA>> values_at(const PolynomialRows& rows,
                                               const std::vector<cln::cl_RA>& point);

/// Whether all entries have values at points: logarithms, inverse functions and I have none.
bool have_values(const Prover& prover, const PolynomialRows& rows);

/// "M1 = 2, M2 = 1/3, ..", to be printed as evidence.
std::string point_text(const Prover& prover, const std::vector<cln::cl_RA>& point);

}  // namespace casimir
