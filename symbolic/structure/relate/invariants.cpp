#include "symbolic/structure/relate/invariants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/algebra/polynomial.hpp"
#include "symbolic/structure/relate/linear_family.hpp"

namespace casimir::structure {
namespace {

using Numbers = std::vector<std::pair<std::string, std::string>>;

/// A basis of what the vectors span.
RationalMatrix basis_of(const RationalMatrix& vectors) {
  if (vectors.empty()) return {};
  RationalMatrix result;
  for (const std::size_t i : independent_columns(transposed(vectors))) result.push_back(vectors[i]);
  return result;
}

/// [U, V].
RationalMatrix products_of(const StructureConstants& c, const RationalMatrix& u,
                           const RationalMatrix& v) {
  RationalMatrix result;
  for (const auto& a : u)
    for (const auto& b : v) result.push_back(commutator(c, a, b));
  return basis_of(result);
}

RationalMatrix whole(std::size_t n) {
  RationalMatrix result(n, std::vector<cln::cl_RA>(n, 0));
  for (std::size_t i = 0; i < n; ++i) result[i][i] = 1;
  return result;
}

/// The v with [v, x] in `space` for all x.
RationalMatrix above(const StructureConstants& c, const RationalMatrix& space) {
  const std::size_t n = c.size();
  // Linear forms that vanish on the space.
  const RationalMatrix forms = space.empty() ? whole(n) : null_space(space, n);
  RationalMatrix rows;
  for (const auto& form : forms) {
    for (std::size_t j = 0; j < n; ++j) {
      rows.emplace_back(n, 0);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k) rows.back()[i] = rows.back()[i] + form[k] * c[i][j][k];
    }
  }
  return null_space(rows, n);
}

/// The dimension of the D with a D[x,y] = b [Dx,y] + g [x,Dy] (Novotny and Hrivnak 2008).
std::size_t derivations(const StructureConstants& c, const cln::cl_RA& a, const cln::cl_RA& b,
                        const cln::cl_RA& g) {
  const std::size_t n = c.size();
  LinearFamily family(n * n);  // D x_i = sum_k d[i n + k] x_k
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) {
        LinearFamily::Row row;
        const auto add = [&](std::size_t unknown, const cln::cl_RA& number) {
          if (cln::zerop(number)) return;
          cln::cl_RA& sum = row.try_emplace(unknown, 0).first->second;
          sum = sum + number;
          if (cln::zerop(sum)) row.erase(unknown);
        };
        for (std::size_t l = 0; l < n; ++l) {
          add(l * n + k, a * c[i][j][l]);
          add(i * n + l, -b * c[l][j][k]);
          add(j * n + l, -g * c[i][l][k]);
        }
        if (!row.empty()) family.add(std::move(row), 0);
      }
    }
  }
  return family.free().size();
}

void add_derivations(Numbers& numbers, const StructureConstants& c) {
  using cln::cl_RA;
  const auto add = [&](const cl_RA& a, const cl_RA& b, const cl_RA& g) {
    numbers.emplace_back(
        a == 1 && b == 1 && g == 1
            ? "dimension of the derivations"
            : fmt::format("dimension of the D with {}*D[x,y] = {}*[Dx,y] + {}*[x,Dy]",
                          rational_text(a), rational_text(b), rational_text(g)),
        std::to_string(derivations(c, a, b, g)));
  };
  add(1, 1, 1);
  add(0, 1, 1);
  add(0, 1, -1);
  add(1, 1, -1);
  const std::vector<cl_RA> factors{-2, -1, 0, cl_RA(1) / 2, 1, 2, 3};
  for (const cl_RA& factor : factors) {
    add(factor, 1, 0);
    if (factor != 0 && factor != 1) add(factor, 1, 1);
  }
}

/// The matrix of ad x for the general x, over a ring of n variables.
std::vector<std::vector<Polynomial>> general_adjoint(const StructureConstants& c,
                                                     const PolynomialRing& ring) {
  const std::size_t n = c.size();
  std::vector<std::vector<Polynomial>> result(n, std::vector<Polynomial>(n, Polynomial(ring)));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k)
        if (!cln::zerop(c[i][j][k])) result[k][j] += ring.variable(i).scaled(c[i][j][k]);
  return result;
}

/// c in p = c q; nothing where there is none.
std::optional<cln::cl_RA> quotient(const Polynomial& p, const Polynomial& q) {
  if (p.is_zero()) return cln::cl_RA(0);
  const cln::cl_RA factor = p.content() / q.content();
  if (!(p == q.scaled(factor))) return std::nullopt;
  return factor;
}

/// Identities between the traces of powers of ad x, which the spectrum of ad x decides.
void add_traces(Numbers& numbers, const StructureConstants& c) {
  constexpr std::size_t kLargest = 6, kHighest = 6;
  if (c.size() > kLargest) return;
  const PolynomialRing ring(c.size());
  const auto ad = general_adjoint(c, ring);
  auto power = ad;
  std::optional<std::pair<std::size_t, Polynomial>> first;
  for (std::size_t m = 1; m <= std::min(kHighest, c.size()); ++m) {
    Polynomial trace(ring);
    for (std::size_t i = 0; i < c.size(); ++i) trace += power[i][i];
    numbers.emplace_back(fmt::format("tr(ad(x)^{}) is zero", m), trace.is_zero() ? "yes" : "no");
    if (first) {
      const std::size_t common = std::lcm(first->first, m);
      const auto factor = quotient(trace.pow(common / m), first->second.pow(common / first->first));
      numbers.emplace_back(fmt::format("c in tr(ad(x)^{})^{} = c*tr(ad(x)^{})^{}", m, common / m,
                                       first->first, common / first->first),
                           factor ? rational_text(*factor) : "none");
    } else if (!trace.is_zero()) {
      first.emplace(m, trace);
    }
    auto next = power;
    for (std::size_t i = 0; i < c.size(); ++i) {
      for (std::size_t j = 0; j < c.size(); ++j) {
        SumOfProducts sum(ring);
        for (std::size_t k = 0; k < c.size(); ++k) sum.add(power[i][k], ad[k][j]);
        next[i][j] = sum.finish();
      }
    }
    power = std::move(next);
  }
}

/// How many of the components of each degree are linearly independent.
void add_degrees(Numbers& numbers, const LinearCase& c) {
  unsigned long highest = 0;
  for (const Terms& component : c.upper) highest = std::max(highest, degree_of(component));
  for (unsigned long d = 0; d <= highest; ++d) {
    std::map<std::vector<unsigned long>, std::size_t> columns;
    for (const Terms& component : c.upper)
      for (const auto& [number, exponents] : of_degree(component, d))
        columns.try_emplace(exponents, columns.size());
    RationalMatrix rows;
    for (const Terms& component : c.upper) {
      rows.emplace_back(columns.size(), 0);
      for (const auto& [number, exponents] : of_degree(component, d))
        rows.back()[columns.at(exponents)] = number;
    }
    numbers.emplace_back(fmt::format("dimension of what the brackets' terms of degree {} span", d),
                         std::to_string(columns.empty() ? 0 : rank(rows)));
  }
  RationalMatrix constant(c.dimension, std::vector<cln::cl_RA>(c.dimension, 0));
  for (std::size_t i = 0; i < c.dimension; ++i)
    for (std::size_t j = 0; j < c.dimension; ++j)
      for (const auto& [number, exponents] : of_degree(c.bracket(i, j), 0)) constant[i][j] = number;
  numbers.emplace_back("rank of the bracket at the origin", std::to_string(rank(constant)));
}

}  // namespace

std::pair<std::size_t, std::size_t> signature(RationalMatrix m) {
  std::pair<std::size_t, std::size_t> result{0, 0};
  const std::size_t n = m.size();
  std::vector<bool> done(n, false);
  const auto add_row = [&](std::size_t to, std::size_t from, const cln::cl_RA& factor) {
    for (std::size_t k = 0; k < n; ++k) m[to][k] = m[to][k] + factor * m[from][k];
    for (std::size_t k = 0; k < n; ++k) m[k][to] = m[k][to] + factor * m[k][from];
  };
  for (;;) {
    std::size_t pivot = n;
    for (std::size_t i = 0; i < n && pivot == n; ++i)
      if (!done[i] && !cln::zerop(m[i][i])) pivot = i;
    for (std::size_t i = 0; i < n && pivot == n; ++i) {
      for (std::size_t j = 0; j < n && pivot == n; ++j) {
        if (done[i] || done[j] || cln::zerop(m[i][j])) continue;
        add_row(i, j, 1);  // both diagonal entries are zero: now one is 2 m_ij
        pivot = i;
      }
    }
    if (pivot == n) return result;
    ++(cln::plusp(m[pivot][pivot]) ? result.first : result.second);
    for (std::size_t i = 0; i < n; ++i)
      if (i != pivot && !done[i] && !cln::zerop(m[i][pivot]))
        add_row(i, pivot, -m[i][pivot] / m[pivot][pivot]);
    done[pivot] = true;
  }
}

std::vector<std::pair<std::string, RationalMatrix>> characteristic_subspaces(
    const StructureConstants& c) {
  std::vector<std::pair<std::string, RationalMatrix>> result;
  const std::size_t n = c.size();
  const auto series = [&](const std::string& name, RationalMatrix space, const auto& next) {
    for (std::size_t k = 1; k <= n; ++k) {
      RationalMatrix following = next(space);
      const bool same = following.size() == space.size();
      result.emplace_back(fmt::format("{}, step {}", name, k), following);
      if (same) break;
      space = std::move(following);
    }
  };
  series("derived series", whole(n), [&](const RationalMatrix& s) { return products_of(c, s, s); });
  series("lower central series", whole(n),
         [&](const RationalMatrix& s) { return products_of(c, whole(n), s); });
  series("upper central series", {}, [&](const RationalMatrix& s) { return above(c, s); });
  result.emplace_back("null space of the Killing form", null_space(killing_form(c), n));
  return result;
}

Numbers linear_invariants(const LinearCase& c) {
  Numbers numbers;
  numbers.emplace_back("dimension", std::to_string(c.dimension));
  add_degrees(numbers, c);
  const StructureConstants constants = structure_constants(c);
  for (const auto& [name, space] : characteristic_subspaces(constants))
    numbers.emplace_back(name, std::to_string(space.size()));
  const auto [plus, minus] = signature(killing_form(constants));
  numbers.emplace_back("signature of the Killing form", fmt::format("({},{})", plus, minus));
  add_derivations(numbers, constants);
  add_traces(numbers, constants);
  return numbers;
}

}  // namespace casimir::structure
