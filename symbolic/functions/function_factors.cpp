#include "symbolic/functions/function_factors.hpp"

#include <algorithm>

namespace casimir::functions {

namespace {

/// A power of a root as a factor that its relation hides: a + b u is u (a' u^(q-1) + b) where a is
/// a' u^q. Without it x^2 + y^2 + x r would not be r (r + x).
std::pair<Polynomial, Polynomial> without_roots(const GeneratorTable& table, Polynomial p) {
  Polynomial roots = table.ring().constant(1);
  for (std::size_t g = 0; g < table.generators().size(); ++g) {
    if (table.generators()[g].kind != Kind::root || table.generators()[g].base.is_constant() ||
        !p.uses(table.place(g)))
      continue;
    const std::vector<Polynomial> parts = p.coefficients(table.place(g));
    const unsigned long order = table.generators()[g].order;
    Polynomial first(table.ring());
    if (parts.size() > order || parts[0].is_zero() ||
        !parts[0].divide(table.generators()[g].base, &first))
      continue;
    std::size_t least = 1;
    while (parts[least].is_zero()) ++least;
    const Polynomial u = table.variable(g);
    p = first * u.pow(order - least);
    for (std::size_t k = least; k < parts.size(); ++k) p += parts[k] * u.pow(k - least);
    roots *= u.pow(least);
  }
  return {std::move(p), std::move(roots)};
}

}  // namespace

Factors factors_of(const GeneratorTable& table, const Polynomial& whole) {
  const auto [p, roots] = without_roots(table, whole);
  Factors factors = p.factors();
  if (!roots.is_constant()) {
    for (const auto& [u, exponent] : roots.factors()) {
      if (u.is_constant()) continue;
      const auto same = std::find_if(factors.begin(), factors.end(),
                                     [&u = u](const auto& factor) { return factor.first == u; });
      if (same == factors.end())
        factors.emplace_back(u, exponent);
      else
        same->second += exponent;
    }
  }
  for (std::size_t g = 0; g < table.generators().size(); ++g) {
    if (table.generators()[g].kind != Kind::sine) continue;
    const Polynomial s = table.variable(g);
    const Polynomial one = table.ring().constant(1);
    const auto find_factor = [&](const Polynomial& f) {
      return std::find_if(factors.begin(), factors.end(),
                          [&](const auto& factor) { return factor.first == f; });
    };
    const auto minus = find_factor(s - one);
    const auto plus = find_factor(s + one);
    if (minus == factors.end() || plus == factors.end()) continue;
    // (s - 1)(s + 1) = -c^2; the constant factor stands first.
    const unsigned long times = std::min(minus->second, plus->second);
    minus->second -= times;
    plus->second -= times;
    if (times % 2 == 1) factors.front().first = -factors.front().first;
    factors.emplace_back(table.ring().variable(table.place(g) + 1), 2 * times);
  }
  std::erase_if(factors, [](const auto& factor) { return factor.second == 0; });
  return factors;
}

}  // namespace casimir::functions
