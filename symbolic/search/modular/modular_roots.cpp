#include "symbolic/search/modular/modular_roots.hpp"

#include "symbolic/search/modular/nmod_poly.hpp"

namespace casimir::search {

std::optional<Residue> random_root(const std::vector<Residue>& coefficients, const Modulus& modulus,
                                   std::mt19937_64& random) {
  const std::vector<Residue> roots =
      ModularPolynomial::with_coefficients(coefficients, modulus).roots(modulus);
  if (roots.empty()) return std::nullopt;
  return roots[random() % roots.size()];
}

}  // namespace casimir::search
