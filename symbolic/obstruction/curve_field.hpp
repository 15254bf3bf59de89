#pragma once

#include <ginac/ginac.h>

#include <map>
#include <vector>

#include "symbolic/obstruction/equation/univariate.hpp"

namespace casimir::obstruction {

/// An element of a CurveField: coefficients of products of the adjoined roots, a bit for each.
using CurveElement = std::map<unsigned, RationalFunction>;

/// Rational functions on an algebraic curve: Q(z) with square roots of rational functions adjoined,
/// no product of which is a square in Q(z), so that this is a field.
class CurveField {
 public:
  static CurveElement constant(const RationalFunction& value);

  /// An element whose square is this: with a new root, or one that the roots give already.
  CurveElement root_of(const RationalFunction& square);

  CurveElement sum(const CurveElement& a, const CurveElement& b) const;
  CurveElement difference(const CurveElement& a, const CurveElement& b) const;
  CurveElement product(const CurveElement& a, const CurveElement& b) const;
  /// \throws NotDecided  for zero
  CurveElement inverse(const CurveElement& a) const;
  CurveElement power(const CurveElement& a, long exponent) const;
  /// With respect to z.
  CurveElement derivative(const CurveElement& a) const;
  static bool is_zero(const CurveElement& a) { return a.empty(); }
  /// The element as a function in Q(z). \throws NotDecided  where it is none
  static RationalFunction rational(const CurveElement& a);

  /// The value of an expression where its symbols have the values given. A square root of what is a
  /// square of a function in Q(z) on the curve is the one with a positive leading coefficient,
  /// which is the principal value where z is real and large.
  /// \throws NotDecided  for a function or number that the field does not have
  CurveElement value(const GiNaC::ex& expression, const GiNaC::exmap& symbols_to_index,
                     const std::vector<CurveElement>& values) const;

  /// The squares of the roots.
  const std::vector<RationalFunction>& squares() const { return squares_; }

 private:
  RationalFunction square_of(unsigned roots) const;
  std::vector<RationalFunction> squares_;
};

/// The rank of a matrix by rows, and in `rows` its echelon form by the columns in order.
std::size_t reduce_rows(const CurveField& field, std::vector<std::vector<CurveElement>>& rows,
                        std::vector<std::size_t>* pivots = nullptr);

}  // namespace casimir::obstruction
