#pragma once

#include "symbolic/structure/separate/roots.hpp"

namespace casimir::structure {

/// Functions on the leaf with a root u: remainders modulo u^n + a_1 u^(n-1) + .. + a_n by their
/// coefficients, the constant one first, each modulo the level.
///
/// Theorem: where the roots are distinct, a remainder is zero at all of them exactly where its
/// coefficients are zero (Vandermonde).
class WithRoot {
 public:
  using Element = std::vector<Polynomial>;

  /// Borrows both.
  WithRoot(const Leaves& leaves, const RootCoefficients& a) : leaves_(leaves), a_(a) {}

  Element constant(const Polynomial& p) const { return reduced({p}); }
  Element root() const;
  /// sum of coefficients times powers of u.
  Element reduced(Element p) const;
  Element product(const Element& a, const Element& b) const;
  Element sum(Element a, const Element& b) const;
  Element difference(Element a, const Element& b) const;
  /// D'(u) for the polynomial D.
  Element slope() const;
  /// -sum_k {a_k, f} u^(n-k), which is D'(u) {u, f}.
  Element moved(const Polynomial& f) const;
  /// D'(u) {e, f} for a function e of the state and u.
  Element moved(const Element& e, const Polynomial& f) const;

 private:
  const Leaves& leaves_;
  const RootCoefficients& a_;
};

}  // namespace casimir::structure
