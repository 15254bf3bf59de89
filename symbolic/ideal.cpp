#include "symbolic/ideal.hpp"

#include <algorithm>
#include <deque>

namespace casimir {
namespace {

constexpr std::size_t kMaxPairs = 2000;
constexpr std::size_t kMaxBasis = 60;
constexpr std::size_t kMaxTerms = 20000;

using Monomial = std::vector<unsigned long>;

Polynomial power_product(const PolynomialRing& ring, const Monomial& exponents) {
  Polynomial result = ring.constant(1);
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    if (exponents[i] > 0) result *= ring.variable(i).pow(exponents[i]);
  }
  return result;
}

/// The combination that cancels the leading terms; zero if those are coprime, since it would
/// reduce to zero then.
Polynomial s_polynomial(const Polynomial& f, const Polynomial& g) {
  const auto [f_coefficient, f_monomial] = f.term_list().front();
  const auto [g_coefficient, g_monomial] = g.term_list().front();
  Monomial f_factor(f_monomial.size());
  Monomial g_factor(f_monomial.size());
  bool coprime = true;
  for (std::size_t i = 0; i < f_monomial.size(); ++i) {
    const unsigned long lcm = std::max(f_monomial[i], g_monomial[i]);
    f_factor[i] = lcm - f_monomial[i];
    g_factor[i] = lcm - g_monomial[i];
    coprime = coprime && std::min(f_monomial[i], g_monomial[i]) == 0;
  }
  if (coprime) return Polynomial(f.ring());
  return (f * power_product(f.ring(), f_factor)).scaled(1 / f_coefficient) -
         (g * power_product(f.ring(), g_factor)).scaled(1 / g_coefficient);
}

}  // namespace

std::vector<Polynomial> groebner_basis(const std::vector<Polynomial>& generators) {
  std::vector<Polynomial> basis;
  std::deque<std::pair<std::size_t, std::size_t>> pairs;
  const auto insert = [&](Polynomial p) {
    for (std::size_t i = 0; i < basis.size(); ++i) pairs.emplace_back(i, basis.size());
    basis.push_back(std::move(p));
  };
  for (const Polynomial& g : generators) {
    if (!g.is_zero()) insert(g);
  }
  std::vector<Polynomial> quotients;
  for (std::size_t done = 0; !pairs.empty() && done < kMaxPairs && basis.size() < kMaxBasis;
       ++done) {
    const auto [i, j] = pairs.front();
    pairs.pop_front();
    Polynomial rest = s_polynomial(basis[i], basis[j]);
    if (rest.is_zero()) continue;
    rest = rest.remainder(basis, &quotients);
    if (rest.is_zero() || rest.terms() > kMaxTerms) continue;
    insert(std::move(rest));
  }
  return basis;
}

std::vector<SolvedRelation> triangular_set(std::vector<Polynomial> relations,
                                           std::size_t coordinates) {
  std::vector<SolvedRelation> set;
  const auto uses_coordinates = [&](const Polynomial& p) {
    for (std::size_t i = 0; i < coordinates; ++i) {
      if (p.uses(i)) return true;
    }
    return false;
  };
  const auto pick = [&]() -> bool {
    for (std::size_t k = 0; k < relations.size(); ++k) {
      for (std::size_t v = 0; v < coordinates; ++v) {
        if (!relations[k].uses(v)) continue;
        const bool alone = std::count_if(relations.begin(), relations.end(),
                                         [&](const Polynomial& f) { return f.uses(v); }) == 1;
        Polynomial leading = relations[k].coefficients(v).back();
        if (!alone || uses_coordinates(leading)) continue;
        set.push_back({relations[k], v, std::move(leading)});
        relations.erase(relations.begin() + static_cast<std::ptrdiff_t>(k));
        return true;
      }
    }
    return false;
  };
  while (!relations.empty()) {
    if (!pick()) return {};
  }
  return set;
}

Polynomial pseudo_remainder(const Polynomial& p, const std::vector<SolvedRelation>& set) {
  Polynomial rest = p;
  for (const SolvedRelation& solved : set) {
    const long degree = solved.relation.degree(solved.variable);
    for (long k = rest.degree(solved.variable); k >= degree; k = rest.degree(solved.variable)) {
      const Polynomial top = rest.coefficients(solved.variable).back();
      const Polynomial shift =
          p.ring().variable(solved.variable).pow(static_cast<unsigned long>(k - degree));
      rest = rest * solved.leading - top * shift * solved.relation;
    }
  }
  return rest;
}

}  // namespace casimir
