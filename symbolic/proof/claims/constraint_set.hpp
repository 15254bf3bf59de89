#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/proof/claims/ranks.hpp"

namespace casimir {

/// A matrix, and the rank that a fact says it has.
struct RankedRows {
  PolynomialRows rows;
  std::size_t rank;
  /// Some of the rows: the rank is so much more than theirs at the point.
  PolynomialRows beyond{};
};

/// \throws NotCertified
std::size_t rank_at(RealPoint& point, const RankedRows& one);

/// The k constraints of a case as an algebraic set in the space of its variables and parameters.
///
/// Theorem 1: where it is irreducible over the rational numbers, a minor that is not zero at one
/// regular real point is not zero at almost all. Theorem 2: each part of the set has at most k
/// dimensions less than the space (Krull); so if the points at which a minor is zero, too, have
/// more than k less, then it is not zero at almost all points of every part. Hypotheses: c*d = 0
/// has two parts, and c is zero on one of them, of which a point of the other says nothing. And the
/// real points have these dimensions if one of them is regular: those of x^2 + (y^2 - y)^2 = 0,
/// which is irreducible, are two, and one of them says nothing of the other.
class ConstraintSet {
 public:
  explicit ConstraintSet(Prover& prover);

  /// Whether all constraints are certainly zero there, and not by their parameters alone: (a - 1)*c
  /// is zero at a = 1 for all c, and for almost all a at c = 0 only.
  bool contains(const RealPoint& point) const;

  /// Whether the set is certainly a smooth one around the point, with the gradients of the
  /// constraints across it: these are independent there, or those of some constraints are, and the
  /// others lie in the ideal of these.
  bool is_regular(RealPoint& point) const;

  /// Whether matrices that have these ranks at a point of the set have them at almost all: the
  /// hypotheses above. False where one is not shown.
  bool have_ranks_everywhere(RealPoint& point, std::vector<RankedRows> all) const;

  /// Conditions on parameters without which the rank is smaller everywhere on the set, as of
  /// `needed_parameters`: u^2 - a^2 is a - a^2 where u^2 = a. Those that are found: of polynomials.
  /// A polynomial in parameters alone that is zero wherever the constraints are and a minor, or
  /// where the set is not smooth, gives the values at which these may be so all over it: u is zero
  /// all over u^2 = a, and over u^2 + v^2 = a, at a = 0. Its factors are conditions, some
  /// perhaps needless ones.
  /// \param point  of the set
  std::vector<std::string> needed_parameters_of(RealPoint& point, const RankedRows& one) const;

  /// Whether a function is certainly constant on each part, for fixed parameters: up to a
  /// combination of the constraints it has no variable.
  bool makes_constant(const NamedExpression& f) const;

  /// The gradients of the constraints, without powers.
  const PolynomialRows& slopes() const { return slopes_; }

 private:
  std::optional<bool> is_zero_at(const Polynomial& p, const RealPoint& point) const;
  bool are_polynomials(const PolynomialRows& rows) const;
  bool has_variables(const Polynomial& p) const;
  bool is_rational(const RealPoint& point) const;
  bool has_rank_everywhere(RealPoint& point, const RankedRows& one) const;
  void add_values_at(const std::vector<Polynomial>& equations,
                     std::vector<std::string>& conditions) const;
  void add_singular_values(std::vector<std::string>& conditions) const;

  Prover& prover_;
  std::vector<Polynomial> numerators_;
  std::vector<Polynomial> reduced_;  ///< without powers, and without factors that have no variable
  PolynomialRows slopes_;
};

}  // namespace casimir
