#include "symbolic/functions/spectral_coefficients.hpp"

#include <map>
#include <utility>

namespace casimir::functions {

std::vector<Polynomial> spectral_coefficients(const GeneratorTable& table, const Polynomial& p,
                                              std::size_t spectral, std::size_t coordinates) {
  const auto free_of_coordinates = [&](const Generator& g) {
    for (std::size_t i = 0; i < coordinates; ++i) {
      if (g.depends_on(i)) return false;
    }
    return true;
  };
  Polynomial cleared = p;
  for (std::size_t g = table.generators().size(); g-- > 0;) {
    if (table.generators()[g].kind != Kind::inverse || !free_of_coordinates(table.generators()[g]))
      continue;
    const std::vector<Polynomial> parts = cleared.coefficients(table.place(g));
    Polynomial sum = parts[0];
    for (std::size_t k = 1; k < parts.size(); ++k)
      sum = table.checked_product(sum, table.generators()[g].base) + parts[k];
    cleared = std::move(sum);
  }
  // Powers of the parameter and of the roots that contain it are independent, once the relations
  // of those roots are used up.
  std::vector<std::size_t> spectral_variables{spectral};
  for (std::size_t g = table.generators().size(); g-- > 0;) {
    const Generator& generator = table.generators()[g];
    if (!generator.depends_on(spectral) || !free_of_coordinates(generator)) continue;
    if (!generator.relation.empty())
      throw TooLarge("parts of angles that contain the spectral parameter are not told apart here");
    if (generator.kind != Kind::inverse) spectral_variables.push_back(table.place(g));
    if (generator.kind == Kind::root || generator.kind == Kind::cosine)
      cleared = table.reduced_power(cleared, g);
  }
  std::map<std::vector<unsigned long>, Polynomial> coefficients;
  for (const auto& [coefficient, exponents] : cleared.term_list()) {
    std::vector<unsigned long> key;
    Polynomial term = table.ring().constant(coefficient);
    std::vector<unsigned long> rest = exponents;
    for (const std::size_t v : spectral_variables) key.push_back(std::exchange(rest[v], 0));
    for (std::size_t i = 0; i < rest.size(); ++i) {
      if (rest[i] > 0) term *= table.ring().variable(i).pow(rest[i]);
    }
    coefficients.try_emplace(key, Polynomial(table.ring())).first->second += term;
  }
  std::vector<Polynomial> result;
  for (auto& [key, coefficient] : coefficients) result.push_back(std::move(coefficient));
  return result;
}

}  // namespace casimir::functions
