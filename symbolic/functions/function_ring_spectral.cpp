// Functions of a spectral parameter: the coefficients that do not depend on it.
#include <map>

#include "symbolic/functions/function_ring.hpp"

namespace casimir {

bool FunctionRing::depends_on(const Generator& g, std::size_t symbol) {
  if (symbol < g.derivatives.size() && !g.derivatives[symbol].is_zero()) return true;
  return g.base.uses(symbol);
}

std::vector<Polynomial> FunctionRing::spectral_coefficients(const Polynomial& p,
                                                            std::size_t spectral,
                                                            std::size_t coordinates) const {
  const auto free_of_coordinates = [&](const Generator& g) {
    for (std::size_t i = 0; i < coordinates; ++i) {
      if (depends_on(g, i)) return false;
    }
    return true;
  };
  Polynomial cleared = p;
  for (std::size_t g = generators_.size(); g-- > 0;) {
    if (generators_[g].kind != Kind::inverse || !free_of_coordinates(generators_[g])) continue;
    const std::vector<Polynomial> parts = cleared.coefficients(symbols_.size() + g);
    Polynomial sum = parts[0];
    for (std::size_t k = 1; k < parts.size(); ++k)
      sum = checked_product(sum, generators_[g].base) + parts[k];
    cleared = std::move(sum);
  }
  // Powers of the parameter and of the roots that contain it are independent, once the relations
  // of those roots are used up.
  std::vector<std::size_t> spectral_variables{spectral};
  for (std::size_t g = generators_.size(); g-- > 0;) {
    const Generator& generator = generators_[g];
    if (!depends_on(generator, spectral) || !free_of_coordinates(generator)) continue;
    if (!generator.relation.empty())
      throw TooLarge("parts of angles that contain the spectral parameter are not told apart here");
    if (generator.kind != Kind::inverse) spectral_variables.push_back(symbols_.size() + g);
    if (generator.kind == Kind::root || generator.kind == Kind::cosine)
      cleared = reduced_power(cleared, g);
  }
  std::map<std::vector<unsigned long>, Polynomial> coefficients;
  for (const auto& [coefficient, exponents] : cleared.term_list()) {
    std::vector<unsigned long> key;
    Polynomial term = ring_->constant(coefficient);
    std::vector<unsigned long> rest = exponents;
    for (const std::size_t v : spectral_variables) key.push_back(std::exchange(rest[v], 0));
    for (std::size_t i = 0; i < rest.size(); ++i) {
      if (rest[i] > 0) term *= ring_->variable(i).pow(rest[i]);
    }
    coefficients.try_emplace(key, Polynomial(*ring_)).first->second += term;
  }
  std::vector<Polynomial> result;
  for (auto& [key, coefficient] : coefficients) result.push_back(std::move(coefficient));
  return result;
}

}  // namespace casimir
