#include "symbolic/search/modular/modular_roots.hpp"

#include <flint/ulong_extras.h>

#include "symbolic/search/modular/nmod_poly.hpp"

namespace casimir::search {

std::vector<Residue> different_roots(const std::vector<Residue>& coefficients,
                                     const Modulus& modulus) {
  return ModularPolynomial::with_coefficients(coefficients, modulus).roots(modulus);
}

std::optional<Residue> random_root(const std::vector<Residue>& coefficients, const Modulus& modulus,
                                   std::mt19937_64& random) {
  const std::vector<Residue> roots = different_roots(coefficients, modulus);
  if (roots.empty()) return std::nullopt;
  return roots[random() % roots.size()];
}

std::optional<Residue> random_square_root(Residue square, const Modulus& modulus,
                                          std::mt19937_64& random) {
  if (square == 0) return 0;
  const mp_limb_t root = n_sqrtmod(square, modulus.prime());
  if (root == 0) return std::nullopt;
  const Residue result = static_cast<Residue>(root);
  return random() % 2 == 0 ? result : modulus.negative(result);
}

}  // namespace casimir::search
