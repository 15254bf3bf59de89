#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// The rank of a matrix of functions at generic points, with what shows it.
///
/// Theorem: a minor of functions that are analytic on a connected set and that is not zero at one
/// point of it is zero on no open part of it. So the rank at a point is a lower bound for that at
/// almost all points of its piece (`FunctionRing::pieces`), and each piece needs a point of its
/// own. Minors that are identically zero, in the ring, bound the rank from above.
struct GenericRank {
  std::size_t rank = 0;  ///< at every one of `points`, and so at almost all points of their pieces
  bool exact = false;    ///< no point has a larger rank: full, or all larger minors vanish
  /// One on each piece that was found; empty where the matrix is constant.
  std::vector<RealPoint> points;
  /// What the pieces are, where it is not shown that there are no others.
  std::string where;
  /// Conditions on parameters without which the rank seems to be smaller, as "a != 0". Only of
  /// `rank_with_conditions`. What `needed_parameters` does not find is left out: the rank is that
  /// for almost all values.
  std::vector<std::string> nonzero;
  std::string uneven;  ///< why the rank is not said: it seems to differ from piece to piece
};

/// A vector of functions that may be in the kernel of a matrix: to the gradients of integrals, for
/// one, the field is orthogonal. That is checked, so that a candidate need not be sure.
struct KernelCandidate {
  std::vector<Polynomial> vector;
  /// Whether the product with that row is zero as a function; if empty, it is multiplied out.
  std::function<bool(std::size_t row)> orthogonal{};
};

/// Empty if no point of the domain was found. That no point has a larger rank is shown, in this
/// order, by skew symmetry (such a rank is even), by vectors in the kernel that are independent at
/// the points, or by the minors that border a regular one: if they vanish identically, so do all
/// larger minors.
std::optional<GenericRank> generic_rank(
    Prover& prover, const PolynomialRows& rows,
    const std::function<std::vector<KernelCandidate>()>& kernel = {});

/// The same, with the conditions on parameters.
std::optional<GenericRank> rank_with_conditions(
    Prover& prover, const PolynomialRows& rows,
    const std::function<std::vector<KernelCandidate>()>& kernel = {});

/// Rows and columns of a minor of this size that is certainly not zero at the point; fewer where
/// the rank is smaller there.
std::pair<std::vector<std::size_t>, std::vector<std::size_t>> regular_minor(
    RealPoint& point, const PolynomialRows& matrix, std::size_t size);

/// Points of a claim's domain, sorted by the pieces on which functions are analytic.
class PiecePoints {
 public:
  /// \param functions  whose pieces these are
  PiecePoints(Prover& prover, const std::vector<Polynomial>& functions);

  struct Piece {
    std::vector<RealPoint> points;
    /// A point shows what holds at almost all points of the piece; else only of its connected part,
    /// so that each point has to be looked at. So it is, too, where the assumptions leave no open
    /// set, see `thin_domain`.
    bool rigid = true;
  };
  /// Of those that were found, each with at least one point.
  std::vector<Piece>& pieces() { return pieces_; }
  /// As of GenericRank.
  const std::string& where() const { return where_; }
  /// Another point of the only piece; false if there are several, or enough points.
  bool add_point();

 private:
  std::optional<RealPoint> draw();
  void sort_by_signs(const FunctionRing::Pieces& what);

  Prover& prover_;
  std::vector<Piece> pieces_;
  std::string where_;
};

/// "M1 = 2, M2 = 1/3", for each of the points.
std::string text_of(const std::vector<RealPoint>& points);

/// The rank of the gradients of functions; in the kernel are the flows of those that commute with
/// all, and for a system without a bracket its field.
std::optional<GenericRank> gradient_rank(Prover& prover, const std::vector<Polynomial>& functions);

}  // namespace casimir
