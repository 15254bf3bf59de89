#pragma once

#include <flint/nmod_poly.h>

#include <optional>
#include <utility>
#include <vector>

#include "symbolic/discrete/prime_field.hpp"

namespace casimir::discrete {

/// FLINT's polynomial over a prime field.
class Univariate {
 public:
  explicit Univariate(Element prime = kPrime) { nmod_poly_init(value_, prime); }
  ~Univariate() { nmod_poly_clear(value_); }
  Univariate(const Univariate& other) : Univariate(other.value_->mod.n) {
    nmod_poly_set(value_, other.value_);
  }
  Univariate(Univariate&& other) noexcept : Univariate(other.value_->mod.n) {
    nmod_poly_swap(value_, other.value_);
  }
  Univariate& operator=(Univariate other) noexcept {
    nmod_poly_swap(value_, other.value_);
    return *this;
  }
  nmod_poly_struct* raw() { return value_; }
  const nmod_poly_struct* raw() const { return value_; }
  long degree() const { return nmod_poly_degree(value_); }
  bool is_zero() const { return nmod_poly_is_zero(value_); }

  /// Its zeros in the field, each once. \pre not zero
  std::vector<Element> zeros() const;

 private:
  nmod_poly_t value_;
};

/// A rational function in lowest terms.
struct Quotient {
  Univariate top, bottom;
};

/// The rational function a/b of least degree with these values: Euclid's algorithm on the
/// interpolating polynomial g and M = product of (t - t_i) runs through all pairs with a = b g
/// modulo M, and the quotient after the true one is large (by more than six degrees).
/// \return  nothing where none stands out: then there are too few points
std::optional<Quotient> quotient_from_values(const std::vector<Element>& t,
                                             const std::vector<Element>& y, Element prime = kPrime);

}  // namespace casimir::discrete
