#include "symbolic/structure/separate/roots.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "symbolic/error.hpp"
#include "symbolic/search/modular/monomials.hpp"
#include "symbolic/search/polynomial_system.hpp"
#include "symbolic/structure/separate/constant_kernel.hpp"

namespace casimir::structure {
namespace {

std::vector<Polynomial> differences_of(const std::vector<Polynomial>& roots) {
  std::vector<Polynomial> result;
  for (std::size_t i = 0; i < roots.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) result.push_back(roots[i] - roots[j]);
  return result;
}

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
    Characteristic result{p, {}, own, minor};
    for (Polynomial& component : result.bivector) component = component * scale;
    for (std::size_t k = 1; k <= n; ++k) {
      Polynomial ratio(leaves.ring());
      scale.pow(k).divide(quotients[k - 1].denominator, &ratio);
      const Polynomial a = leaves.reduced(quotients[k - 1].f * ratio);
      result.coefficients.push_back(k % 2 == 1 ? -a : a);
    }
    return result;
  }
  return std::nullopt;
}

bool may_have_distinct_roots(const Leaves& leaves, const Bivector& p) {
  if (!leaves.ideal().empty()) return true;
  std::vector<cln::cl_RA> point;
  for (std::size_t i = 0; i < leaves.ring().size(); ++i) {
    const long spread = static_cast<long>(i);
    point.emplace_back(cln::cl_RA(7 * spread * spread + 11 * spread + 3) / (2 * spread + 5));
  }
  Bivector own, other;
  for (std::size_t c = 0; c < p.size(); ++c) {
    own.push_back(leaves.ring().constant(leaves.bivector()[c].evaluate(point)));
    other.push_back(leaves.ring().constant(p[c].evaluate(point)));
  }
  const std::size_t n = leaves.degrees_of_freedom();
  for (const std::vector<std::size_t>& rows : leaves.choices(2 * n)) {
    std::vector<Polynomial> pencil = pfaffian_of_pencil(own, other, leaves.dimension(), rows);
    if (pencil.front().is_zero()) continue;
    const cln::cl_RA unit = pencil.front().term_list().front().first;
    RootCoefficients a;
    for (std::size_t k = 1; k <= n; ++k)
      a.push_back(pencil[k].scaled((k % 2 == 0 ? 1 : -1) / unit));
    return !hermite_minors(leaves, a).back().is_zero();
  }
  return true;
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

std::vector<Polynomial> positive_where_real(const Leaves& leaves, const RootCoefficients& a) {
  const auto roots = polynomial_roots(leaves, a);
  if (!roots) return hermite_minors(leaves, a);
  std::vector<Polynomial> result = differences_of(*roots);
  for (Polynomial& p : result) p = p * p;
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

std::optional<std::vector<Polynomial>> regular_where(const Leaves& leaves,
                                                     const RootCoefficients& a,
                                                     const std::vector<Polynomial>& integrals) {
  const auto roots = polynomial_roots(leaves, a);
  std::vector<Polynomial> result =
      roots ? differences_of(*roots) : std::vector{hermite_minors(leaves, a).back()};
  result.push_back(search::determinant_without_sign(
      rates_of_coefficients(leaves, roots ? *roots : a, integrals), leaves.ring()));
  for (Polynomial& p : result) {
    p = leaves.reduced(p);
    if (p.is_zero()) return std::nullopt;
  }
  // Where the functions themselves are not analytic, minors of their derivatives say nothing.
  const FunctionRing& functions = leaves.system().functions();
  const auto add = [&](const Polynomial& f) {
    if (!f.is_constant() && !functions.is_nowhere_zero(f)) result.push_back(f);
  };
  for (const auto* list : {&a, &integrals})
    for (const Polynomial& p : *list) {
      for (const Polynomial& f : functions.radicand_factors(p, true)) add(f);
      add(functions.lowest_terms(p).second);
    }
  return result;
}

std::vector<Polynomial> moderate_factors(const Polynomial& p) {
  std::vector<Polynomial> result;
  try {
    for (const auto& [factor, exponent] : p.factors())
      result.insert(result.end(), exponent, factor);
  } catch (const TooLarge&) {
    result.clear();
  } catch (const std::overflow_error&) {
    result.clear();
  }
  return result;
}

std::optional<std::vector<Polynomial>> polynomial_roots(const Leaves& leaves,
                                                        const RootCoefficients& a) {
  const PolynomialRing larger(leaves.ring().size() + 1);
  TermCollector sum(larger);
  std::vector<unsigned long> power(larger.size(), 0);
  power.back() = a.size();
  sum.add(1, power);
  for (std::size_t k = 1; k <= a.size(); ++k) {
    for (auto [number, exponents] : a[k - 1].term_list()) {
      exponents.push_back(a.size() - k);
      sum.add(number, exponents);
    }
  }
  std::vector<Polynomial> result;
  for (const Polynomial& factor : moderate_factors(sum.finish())) {
    if (factor.is_constant()) continue;
    const std::vector<Polynomial> c = factor.coefficients(leaves.ring().size());
    if (c.size() != 2 || !c[1].is_constant()) return std::nullopt;
    const cln::cl_RA leading = c[1].term_list().front().first;
    TermCollector root(leaves.ring());
    for (auto [number, exponents] : c[0].term_list()) {
      exponents.pop_back();
      root.add(-number / leading, exponents);
    }
    result.push_back(root.finish());
  }
  if (result.size() != a.size()) return std::nullopt;
  return result;
}

}  // namespace casimir::structure
