#pragma once

#include <optional>
#include <vector>

#include "symbolic/discrete/prime_field.hpp"

namespace casimir::discrete {

/// The value of a function at a point and its partial derivatives there, residues modulo the prime.
/// Without slopes they are 0, as those of a constant.
struct Jet {
  Element value = 0;
  std::vector<Element> slopes{};
};

/// Their arithmetic, by the rules of differentiation: a map's Jacobian matrix at a point costs a
/// few evaluations of the map, and no derivative is written down. Rational functions alone, whose
/// derivatives modulo a prime are the residues of their derivatives.
class JetField {
 public:
  static Jet constant(Element a) { return {a}; }
  /// The variable of this number, of so many.
  static Jet variable(Element value, std::size_t number, std::size_t variables);
  Jet add(const Jet& a, const Jet& b) const;
  Jet multiply(const Jet& a, const Jet& b) const;
  Jet power(const Jet& a, std::uint64_t n) const;
  /// Empty where the value is zero.
  std::optional<Jet> inverse(const Jet& a) const;

 private:
  Jet scaled(const Jet& a, Element value, Element slope) const;

  PrimeField field_;
};

}  // namespace casimir::discrete
