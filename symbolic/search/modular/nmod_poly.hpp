#pragma once

// FLINT's polynomials in one variable modulo a prime: for the files of this folder that need them.
#include <flint/nmod_poly.h>
#include <flint/nmod_poly_factor.h>

#include <utility>
#include <vector>

#include "symbolic/search/modular/modular.hpp"

namespace casimir::search {

/// A scoped nmod_poly.
class ModularPolynomial {
 public:
  explicit ModularPolynomial(const Modulus& modulus) { nmod_poly_init(value_, modulus.prime()); }
  ModularPolynomial(const ModularPolynomial& other) {
    nmod_poly_init(value_, other.value_->mod.n);
    nmod_poly_set(value_, other.value_);
  }
  ModularPolynomial& operator=(const ModularPolynomial& other) {
    nmod_poly_set(value_, other.value_);
    return *this;
  }
  ~ModularPolynomial() { nmod_poly_clear(value_); }

  static ModularPolynomial with_coefficients(const std::vector<Residue>& coefficients,
                                             const Modulus& modulus) {
    ModularPolynomial result(modulus);
    for (std::size_t k = 0; k < coefficients.size(); ++k)
      nmod_poly_set_coeff_ui(result.value_, static_cast<slong>(k), coefficients[k]);
    return result;
  }

  /// The polynomial of least degree with these values.
  static ModularPolynomial through(const std::vector<mp_limb_t>& places,
                                   const std::vector<mp_limb_t>& values, const Modulus& modulus) {
    ModularPolynomial result(modulus);
    nmod_poly_interpolate_nmod_vec(result.value_, places.data(), values.data(),
                                   static_cast<slong>(places.size()));
    return result;
  }
  static ModularPolynomial gcd(const ModularPolynomial& a, const ModularPolynomial& b) {
    ModularPolynomial result(a);
    nmod_poly_gcd(result.value_, a.value_, b.value_);
    return result;
  }
  ModularPolynomial divided_by(const ModularPolynomial& other) const {
    ModularPolynomial result(*this);
    nmod_poly_div(result.value_, value_, other.value_);
    return result;
  }
  static Residue resultant(const ModularPolynomial& a, const ModularPolynomial& b) {
    return static_cast<Residue>(nmod_poly_resultant(a.value_, b.value_));
  }
  long degree() const { return nmod_poly_degree(value_); }
  Residue coefficient(long k) const {
    return static_cast<Residue>(nmod_poly_get_coeff_ui(value_, k));
  }
  std::vector<Residue> roots(const Modulus& modulus) const {
    std::vector<Residue> result;
    if (degree() < 1) return result;
    nmod_poly_factor_t factors;
    nmod_poly_factor_init(factors);
    nmod_poly_factor(factors, value_);
    for (slong i = 0; i < factors->num; ++i) {
      if (nmod_poly_degree(factors->p + i) == 1)
        result.push_back(
            modulus.negative(static_cast<Residue>(nmod_poly_get_coeff_ui(factors->p + i, 0))));
    }
    nmod_poly_factor_clear(factors);
    return result;
  }

 private:
  nmod_poly_t value_;
};

}  // namespace casimir::search
