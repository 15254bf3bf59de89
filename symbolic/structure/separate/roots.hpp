#pragma once

#include <optional>

#include "symbolic/search/watch.hpp"
#include "symbolic/structure/separate/leaves.hpp"

namespace casimir::structure {

/// Functions u_1, .., u_n on the leaves as the roots of u^n + a_1 u^(n-1) + .. + a_n: the
/// coefficients a_1, .., a_n. Whatever is said of the roots is computed by these alone.
using RootCoefficients = std::vector<Polynomial>;

/// A bivector with the square root of its characteristic polynomial relative to that of the case,
/// det(P' - u P) = (u^n + a_1 u^(n-1) + ..)^2 det(P) on a leaf.
struct Characteristic {
  Bivector bivector;
  RootCoefficients coefficients;
  std::vector<std::size_t> rows;  ///< of the minor of P by which it was found
  Polynomial pfaffian;            ///< of that minor: all this holds where it is not zero
};

/// Of the bivector times a function of the parameters, so that the coefficients are polynomials in
/// them; empty where they are no polynomials in the coordinates.
///
/// Theorem: if P' is tangent to the leaves (`Leaves::is_tangent`), P + t P' is a skew form on the
/// dual of a space of dimension 2n, and the Pfaffians of its minors with 2n rows are one polynomial
/// in t times numbers that do not depend on t. So one that is not zero for t = 0 is enough.
std::optional<Characteristic> characteristic_of(const Leaves& leaves, const Bivector& p,
                                                const search::Watch& watch);

/// False where the roots of det(P' - u P) are not distinct at one point, chosen at random: then
/// they are hardly ever. On a level, where no point is at hand, true.
bool may_have_distinct_roots(const Leaves& leaves, const Bivector& p);

/// Whether {a_k, a_l} = 0 on the level for all k, l; then {u_i, u_j} = 0 where the roots are
/// distinct, as they are functions of the coefficients there.
bool roots_commute(const Leaves& leaves, const RootCoefficients& a);

/// The leading minors of the matrix of the power sums u_1^(i+j) + .. + u_n^(i+j), from the second
/// on. The last one is the discriminant; all are positive where, and only where, the roots are real
/// and distinct (Hermite).
std::vector<Polynomial> hermite_minors(const Leaves& leaves, const RootCoefficients& a);

/// Functions that are all positive where, and only where, the roots are real and distinct: the
/// minors above or, of roots that are polynomials with real coefficients, the squares of their
/// differences, which are much shorter.
std::vector<Polynomial> positive_where_real(const Leaves& leaves, const RootCoefficients& a);

/// {a_k, F_j}, all times one function that vanishes nowhere.
std::vector<std::vector<Polynomial>> rates_of_coefficients(
    const Leaves& leaves, const RootCoefficients& a, const std::vector<Polynomial>& integrals);

/// The discriminant of the roots and det {a_k, F_j}, both modulo the ideal of the level, or where
/// the roots are polynomials their differences and det {u_i, F_j}, which are much shorter; empty
/// where one of them is zero. Where neither is, the roots are distinct and, with the integrals,
/// coordinates on the leaf: {u_i, F_j} = -sum_k {a_k, F_j} u_i^(n-k) / D'(u_i), so that det {u_i,
/// F_j} is det {a_k, F_j} times Vandermonde's determinant over the product of all D'(u_i).
std::optional<std::vector<Polynomial>> regular_where(const Leaves& leaves,
                                                     const RootCoefficients& a,
                                                     const std::vector<Polynomial>& integrals);

/// The factors, each as often as it occurs; none where they would take too long.
std::vector<Polynomial> moderate_factors(const Polynomial& p);

/// The roots, where all of them are polynomials; empty where this is not so, and where that would
/// take too long to find out.
std::optional<std::vector<Polynomial>> polynomial_roots(const Leaves& leaves,
                                                        const RootCoefficients& a);

}  // namespace casimir::structure
