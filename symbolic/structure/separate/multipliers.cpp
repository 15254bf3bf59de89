#include "symbolic/structure/separate/multipliers.hpp"

#include <algorithm>
#include <array>

#include "symbolic/search/modular/monomials.hpp"
#include "symbolic/structure/separate/constant_kernel.hpp"

namespace casimir::structure {
namespace {

/// The degree of products of Casimir functions, by the number of these.
constexpr std::array<int, 4> kHighestOfProducts{0, 6, 4, 3};

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

/// Divided by all that the coefficients have in common, the first one with a positive lead.
void make_primitive(Multipliers& s) {
  std::optional<Polynomial> common;
  for (const std::vector<Polynomial>& row : s) {
    for (const Polynomial& p : row)
      if (!p.is_zero()) common = common ? Polynomial::gcd(*common, p) : p;
  }
  if (!common) return;
  cln::cl_RA content = 0;
  for (std::vector<Polynomial>& row : s) {
    for (std::size_t m = row.size(); m-- > 0;) {
      if (row[m].is_zero()) continue;
      Polynomial quotient(row[m].ring());
      row[m].divide(*common, &quotient);
      row[m] = std::move(quotient);
      const cln::cl_RA own = row[m].content();
      if (cln::zerop(content))
        content = own;
      else
        content = cln::cl_RA(cln::gcd(cln::numerator(content), cln::numerator(own))) /
                  cln::lcm(cln::denominator(content), cln::denominator(own)) * cln::signum(content);
    }
  }
  for (std::vector<Polynomial>& row : s)
    for (Polynomial& p : row) p = p.scaled(1 / content);
}

/// The vector that belongs to s_j = u^power.
using VectorOfPower = std::function<std::vector<Polynomial>(std::size_t j, std::size_t power)>;

/// Whether the sums of the vectors vanish on the level, and some coefficient does not.
bool hold(const Leaves& leaves, const Multipliers& s, const VectorOfPower& summand) {
  bool some = false;
  std::vector<Polynomial> sums;
  for (std::size_t j = 0; j < s.size(); ++j) {
    for (std::size_t m = 0; m < s[j].size(); ++m) {
      if (s[j][m].is_zero()) continue;
      some = some || !leaves.vanishes(s[j][m]);
      const std::vector<Polynomial> own = summand(j, m);
      sums.resize(own.size(), Polynomial(leaves.ring()));
      for (std::size_t i = 0; i < own.size(); ++i) sums[i] += own[i] * s[j][m];
    }
  }
  return some && std::ranges::all_of(sums, [&](const Polynomial& p) { return leaves.vanishes(p); });
}

/// The multipliers of the lowest degree for which the sums of the vectors vanish.
std::optional<Multipliers> lowest(const Leaves& leaves, std::size_t n,
                                  const std::vector<Polynomial>& constants,
                                  const VectorOfPower& summand, const search::Watch& watch) {
  struct Coefficient {
    std::size_t j, power, constant;
  };
  std::vector<Coefficient> unknowns;
  std::vector<std::vector<Polynomial>> columns;
  for (std::size_t power = 0; power <= n + 1; ++power) {
    for (std::size_t j = 0; j < n; ++j) {
      const std::vector<Polynomial> own = summand(j, power);
      for (std::size_t c = 0; c < constants.size(); ++c) {
        unknowns.push_back({j, power, c});
        columns.emplace_back();
        for (const Polynomial& p : own) columns.back().push_back(leaves.reduced(p * constants[c]));
      }
    }
    for (const ParametricRow& solution : constant_kernel(leaves.system(), columns, watch).basis) {
      Multipliers s(n, std::vector<Polynomial>(power + 1, Polynomial(leaves.ring())));
      for (const auto& [k, number] : solution)
        s[unknowns[k].j][unknowns[k].power] += number * constants[unknowns[k].constant];
      make_primitive(s);
      if (!hold(leaves, s, summand)) continue;
      return s;
    }
  }
  return std::nullopt;
}

/// For roots that are polynomials.
std::optional<StaeckelForm> form_of_each(const Leaves& leaves, const std::vector<Polynomial>& roots,
                                         const std::vector<Polynomial>& integrals,
                                         const std::vector<Polynomial>& constants,
                                         const search::Watch& watch) {
  const auto rates = rates_of_coefficients(leaves, roots, integrals);
  StaeckelForm result{roots, {}};
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const auto summand = [&](std::size_t j, std::size_t power) {
      std::vector<Polynomial> own;
      for (std::size_t k = 0; k < roots.size(); ++k)
        if (k != i) own.push_back(roots[i].pow(power) * rates[k][j]);
      return own;
    };
    auto s = lowest(leaves, roots.size(), constants, summand, watch);
    if (!s) return std::nullopt;
    result.multipliers.push_back(std::move(*s));
  }
  return result;
}

}  // namespace

std::vector<Polynomial> leaf_constants(const Leaves& leaves,
                                       const std::vector<Polynomial>& casimirs) {
  std::vector<Polynomial> own, result;
  for (const Polynomial& c : casimirs) {
    Polynomial p = leaves.reduced(c);
    bool moves = false;
    for (std::size_t i = 0; i < leaves.dimension(); ++i) moves = moves || p.uses(i);
    if (moves && std::ranges::find(own, p) == own.end()) own.push_back(std::move(p));
  }
  const int highest = own.size() < kHighestOfProducts.size() ? kHighestOfProducts[own.size()] : 1;
  std::vector<int> degrees;
  for (const Polynomial& p : own) {
    int degree = 1;
    for (const auto& [number, exponents] : p.term_list()) {
      int sum = 0;
      for (std::size_t i = 0; i < leaves.dimension(); ++i) sum += static_cast<int>(exponents[i]);
      degree = std::max(degree, sum);
    }
    degrees.push_back(degree);
  }
  for (const std::vector<int>& e : search::products_up_to(degrees, highest, 0)) {
    Polynomial product = leaves.ring().constant(1);
    for (std::size_t g = 0; g < e.size(); ++g)
      product = product * own[g].pow(static_cast<unsigned long>(e[g]));
    result.push_back(std::move(product));
  }
  std::ranges::stable_sort(result, {}, [](const Polynomial& p) { return p.total_degree(); });
  return result;
}

std::optional<StaeckelForm> staeckel_form(const Leaves& leaves, const RootCoefficients& a,
                                          const std::vector<Polynomial>& integrals,
                                          const std::vector<Polynomial>& casimirs,
                                          const search::Watch& watch) {
  const auto rates = rates_of_coefficients(leaves, a, integrals);
  const std::vector<Polynomial> constants = leaf_constants(leaves, casimirs);
  const auto summand = [&](std::size_t j, std::size_t power) {
    std::vector<Polynomial> result;
    for (const auto& row : remainder(leaves, moved_by(rates, j, power), a))
      result.insert(result.end(), row.begin(), row.end());
    return result;
  };
  if (auto s = lowest(leaves, a.size(), constants, summand, watch)) return StaeckelForm{{}, {*s}};
  const auto roots = polynomial_roots(leaves, a);
  if (!roots || roots->size() != a.size()) return std::nullopt;
  return form_of_each(leaves, *roots, integrals, constants, watch);
}

}  // namespace casimir::structure
