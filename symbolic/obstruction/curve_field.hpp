#pragma once

#include <ginac/ginac.h>

#include <map>
#include <memory>
#include <vector>

#include "symbolic/obstruction/equation/parametric_function.hpp"
#include "symbolic/obstruction/equation/univariate.hpp"

namespace casimir::obstruction {

/// An element of a CurveField: coefficients of products of the adjoined roots, a bit for each.
template <class F>
using CurveElement = std::map<unsigned, F>;

/// Rational functions on an algebraic curve: K(z) with square roots of rational functions adjoined,
/// no product of which is a square in K(z), so that this is a field. F is K(z): RationalFunction
/// for K = Q, ParametricFunction for K = Q(c). What is computed over Q(c) holds at a number c where
/// none of `conditions` vanishes: no denominator, and nothing that was divided by, is zero there.
template <class F>
class CurveField {
 public:
  using Element = CurveElement<F>;

  static Element constant(const F& value);

  /// An element whose square is this: with a new root, or one that the roots give already.
  Element root_of(const F& square);

  Element sum(const Element& a, const Element& b) const;
  Element difference(const Element& a, const Element& b) const;
  Element product(const Element& a, const Element& b) const;
  /// \throws NotDecided  for zero
  Element inverse(const Element& a) const;
  Element power(const Element& a, long exponent) const;
  /// With respect to z.
  Element derivative(const Element& a) const;
  static bool is_zero(const Element& a) { return a.empty(); }
  /// The element as a function in Q(z). \throws NotDecided  where it is none
  static F rational(const Element& a);

  /// The value of an expression where its symbols have the values given. A square root of what is a
  /// square of a function in Q(z) on the curve is the one with a positive leading coefficient,
  /// which is the principal value where z is real and large.
  /// \throws NotDecided  for a function or number that the field does not have
  Element value(const GiNaC::ex& expression, const GiNaC::exmap& symbols_to_index,
                const std::vector<Element>& values) const;

  /// The squares of the roots.
  const std::vector<F>& squares() const { return squares_; }
  /// What must not vanish for the parameter to be given a number; shared by copies.
  const ParameterConditions& conditions() const { return *conditions_; }

 private:
  F square_of(unsigned roots) const;
  std::vector<F> squares_;
  std::shared_ptr<ParameterConditions> conditions_ = std::make_shared<ParameterConditions>();
};

/// The rank of a matrix by rows, and in `rows` its echelon form by the columns in order.
template <class F>
std::size_t reduce_rows(const CurveField<F>& field, std::vector<std::vector<CurveElement<F>>>& rows,
                        std::vector<std::size_t>* pivots = nullptr);

}  // namespace casimir::obstruction
