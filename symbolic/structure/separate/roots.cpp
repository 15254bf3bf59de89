#include "symbolic/structure/separate/roots.hpp"

#include <algorithm>
#include <numeric>

#include "symbolic/search/modular/monomials.hpp"
#include "symbolic/search/polynomial_system.hpp"
#include "symbolic/structure/separate/constant_kernel.hpp"

namespace casimir::structure {
namespace {

long degree_in_coordinates(const Leaves& leaves, const Polynomial& p) {
  unsigned long highest = 0;
  for (const auto& [number, exponents] : p.term_list()) {
    unsigned long sum = 0;
    for (std::size_t i = 0; i < leaves.dimension(); ++i) sum += exponents[i];
    highest = std::max(highest, sum);
  }
  return static_cast<long>(highest);
}

/// f and a function of the parameters d with f * divisor = d * dividend on the level.
struct Quotient {
  Polynomial f, denominator;
};

std::optional<Quotient> quotient_on_level(const Leaves& leaves, const Polynomial& dividend,
                                          const Polynomial& divisor, const search::Watch& watch) {
  Polynomial exact(leaves.ring());
  if (dividend.divide(divisor, &exact)) return Quotient{exact, leaves.ring().constant(1)};
  const long degree =
      degree_in_coordinates(leaves, dividend) - degree_in_coordinates(leaves, divisor);
  if (leaves.ideal().empty() || degree < 0) return std::nullopt;
  const search::Monomials monomials =
      search::all_monomials(std::vector<int>(leaves.dimension(), 1), static_cast<int>(degree));
  std::vector<Polynomial> list;
  std::vector<std::vector<Polynomial>> columns;
  for (std::size_t m = 0; m < monomials.size(); ++m) {
    std::vector<unsigned long> exponents(leaves.ring().size(), 0);
    for (std::size_t i = 0; i < leaves.dimension(); ++i) exponents[i] = monomials[m][i];
    TermCollector collector(leaves.ring());
    collector.add(1, exponents);
    list.push_back(collector.finish());
    columns.push_back({leaves.reduced(list.back() * divisor)});
  }
  columns.push_back({leaves.reduced(-dividend)});
  for (const ParametricRow& solution : constant_kernel(leaves.system(), columns, watch).basis) {
    const auto last = solution.find(list.size());
    if (last == solution.end()) continue;
    Quotient result{Polynomial(leaves.ring()), last->second};
    for (const auto& [k, number] : solution)
      if (k < list.size()) result.f += number * list[k];
    if (leaves.vanishes(result.f * divisor - result.denominator * dividend)) return result;
  }
  return std::nullopt;
}

/// A polynomial in two of the roots, x and y, by the coefficients of x^i y^j.
using TwoRoots = std::vector<std::vector<Polynomial>>;

/// Its remainder, of degree less than n in x and n - 1 in y, where x and y are different roots.
///
/// Theorem: D(x) = 0 and (D(y) - D(x))/(y - x) = 0, with D = u^n + a_1 u^(n-1) + .., hold for any
/// two roots in different places and are monic, in x and in y. So what has the remainder zero
/// vanishes for all such pairs. The converse needs that D has no multiple root, and is not used.
TwoRoots remainder(const Leaves& leaves, TwoRoots p, const RootCoefficients& a) {
  const std::size_t n = a.size();
  const PolynomialRing& ring = leaves.ring();
  const auto coefficient = [&](std::size_t k) { return k == 0 ? ring.constant(1) : a[k - 1]; };
  const std::vector<Polynomial> empty(n, Polynomial(ring));
  // y^(n-1) by sum_k a_(n-k) sum_(e<k) y^e x^(k-1-e) = 0.
  p.resize(p.size() + n, empty);
  for (std::size_t i = 0; i + n < p.size(); ++i) {
    const Polynomial top = p[i][n - 1];
    if (top.is_zero()) continue;
    for (std::size_t k = 1; k <= n; ++k) {
      for (std::size_t e = 0; e < k && e + 1 < n; ++e)
        p[i + k - 1 - e][e] -= top * coefficient(n - k);
    }
    p[i][n - 1] = Polynomial(ring);
  }
  for (std::size_t i = p.size(); i-- > n;) {
    for (std::size_t j = 0; j + 1 < n; ++j) {
      if (p[i][j].is_zero()) continue;
      for (std::size_t k = 1; k <= n; ++k) p[i - k][j] -= p[i][j] * a[k - 1];
    }
  }
  p.resize(n, empty);
  for (auto& row : p) row.resize(n - 1, Polynomial(ring));
  return p;
}

/// s(x) * sum_k {a_k, F} y^(n-k) for s = x^power.
TwoRoots moved_by(const std::vector<std::vector<Polynomial>>& rates, std::size_t integral,
                  std::size_t power) {
  const std::size_t n = rates.size();
  TwoRoots result(power + 1, std::vector<Polynomial>(n, Polynomial(rates[0][0].ring())));
  for (std::size_t k = 0; k < n; ++k) result[power][n - 1 - k] = rates[k][integral];
  return result;
}

}  // namespace

std::optional<Characteristic> characteristic_of(const Leaves& leaves, const Bivector& p,
                                                const search::Watch& watch) {
  const std::size_t n = leaves.degrees_of_freedom();
  std::vector<std::vector<std::size_t>> places = leaves.choices(2 * n);
  std::vector<std::pair<Polynomial, std::vector<std::size_t>>> minors;
  for (const std::vector<std::size_t>& own : places) {
    Polynomial minor = pfaffian(leaves.bivector(), leaves.dimension(), own);
    if (!leaves.vanishes(minor)) minors.emplace_back(std::move(minor), own);
  }
  std::ranges::stable_sort(minors, {}, [](const auto& own) { return own.first.terms(); });
  for (const auto& [minor, own] : minors) {
    const std::vector<Polynomial> pencil =
        pfaffian_of_pencil(leaves.bivector(), p, leaves.dimension(), own);
    std::vector<Quotient> quotients;
    Polynomial scale = leaves.ring().constant(1);
    for (std::size_t k = 1; k <= n; ++k) {
      auto quotient = quotient_on_level(leaves, pencil[k], minor, watch);
      if (!quotient) break;
      scale = scale * quotient->denominator;
      quotients.push_back(std::move(*quotient));
    }
    if (quotients.size() < n) continue;
    // The roots are those of P' times `scale`, the coefficient a_k has its k-th power.
    Characteristic result{p, {}, minor};
    for (Polynomial& component : result.bivector) component = component * scale;
    for (std::size_t k = 1; k <= n; ++k) {
      Polynomial ratio(leaves.ring());
      scale.pow(k).divide(quotients[k - 1].denominator, &ratio);
      const Polynomial a = quotients[k - 1].f * ratio;
      result.coefficients.push_back(k % 2 == 1 ? -a : a);
    }
    return result;
  }
  return std::nullopt;
}

bool roots_commute(const Leaves& leaves, const RootCoefficients& a) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (std::size_t l = k + 1; l < a.size(); ++l)
      if (!leaves.vanishes(leaves.bracket(a[k], a[l]))) return false;
  }
  return true;
}

std::vector<Polynomial> hermite_minors(const Leaves& leaves, const RootCoefficients& a) {
  const std::size_t n = a.size();
  const PolynomialRing& ring = leaves.ring();
  std::vector<Polynomial> sums{ring.constant(static_cast<long>(n))};
  for (std::size_t k = 1; k + 1 < 2 * n; ++k) {
    // Newton's identities.
    Polynomial sum(ring);
    if (k <= n) sum -= a[k - 1].scaled(static_cast<long>(k));
    for (std::size_t j = 1; j < k && j <= n; ++j) sum -= a[j - 1] * sums[k - j];
    sums.push_back(std::move(sum));
  }
  std::vector<Polynomial> result;
  for (std::size_t size = 2; size <= n; ++size) {
    std::vector<std::size_t> order(size);
    std::iota(order.begin(), order.end(), 0);
    // By Leibniz's formula: the sign of each product matters, and n is small.
    Polynomial determinant(ring);
    do {
      Polynomial product = ring.constant(1);
      bool odd = false;
      for (std::size_t i = 0; i < size; ++i) {
        product = product * sums[i + order[i]];
        for (std::size_t j = i + 1; j < size; ++j) odd ^= order[j] < order[i];
      }
      if (odd)
        determinant -= product;
      else
        determinant += product;
    } while (std::ranges::next_permutation(order).found);
    result.push_back(std::move(determinant));
  }
  return result;
}

std::vector<std::vector<Polynomial>> rates_of_coefficients(
    const Leaves& leaves, const RootCoefficients& a, const std::vector<Polynomial>& integrals) {
  std::vector<Polynomial> all;
  for (const Polynomial& coefficient : a) {
    for (const Polynomial& f : integrals) all.push_back(leaves.bracket(coefficient, f));
  }
  all = leaves.system().functions().common_numerators(std::move(all));
  std::vector<std::vector<Polynomial>> result;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(k * integrals.size());
    result.emplace_back(first, first + static_cast<std::ptrdiff_t>(integrals.size()));
  }
  return result;
}

std::optional<std::vector<std::vector<Polynomial>>> staeckel_multipliers(
    const Leaves& leaves, const RootCoefficients& a, const std::vector<Polynomial>& integrals,
    const search::Watch& watch) {
  const std::size_t n = a.size(), highest = n + 1;
  const auto rates = rates_of_coefficients(leaves, a, integrals);
  std::vector<std::vector<Polynomial>> columns;
  const auto column = [&](std::size_t j, std::size_t power) {
    std::vector<Polynomial> result;
    for (const auto& row : remainder(leaves, moved_by(rates, j, power), a))
      for (const Polynomial& p : row) result.push_back(leaves.reduced(p));
    return result;
  };
  for (std::size_t power = 0; power <= highest; ++power) {
    for (std::size_t j = 0; j < n; ++j) columns.push_back(column(j, power));
    if (power == 0) continue;
    for (const ParametricRow& solution : constant_kernel(leaves.system(), columns, watch).basis) {
      std::vector<std::vector<Polynomial>> s(
          n, std::vector<Polynomial>(power + 1, Polynomial(leaves.ring())));
      std::vector<Polynomial> sums(n * (n - 1), Polynomial(leaves.ring()));
      for (const auto& [k, number] : solution) {
        s[k % n][k / n] = number;
        for (std::size_t c = 0; c < sums.size(); ++c) sums[c] += number * columns[k][c];
      }
      if (std::ranges::all_of(sums, [&](const Polynomial& p) { return leaves.vanishes(p); }))
        return s;
    }
  }
  return std::nullopt;
}

}  // namespace casimir::structure
