#include "symbolic/structure/conformal_equations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "symbolic/error.hpp"
#include "symbolic/search/modular/modular_roots.hpp"
#include "symbolic/search/modular/span.hpp"
#include "symbolic/structure/pencil_solver.hpp"

namespace casimir::structure {

using search::Monomials;
using search::Watch;

namespace {

std::vector<unsigned long> exponents_of(const Monomials& list, std::size_t i) {
  return {list[i], list[i] + list.variables()};
}

/// The rank modulo the prime is not above the true one.
bool has_full_rank(const std::vector<ParametricRow>& rows, std::size_t columns,
                   const search::Point& point, const search::Modulus& modulus) {
  search::Span span(modulus);
  for (const ParametricRow& row : rows) {
    std::vector<search::Residue> values(columns, 0);
    for (const auto& [column, entry] : row) {
      const auto value = search::value_at(entry, point, modulus);
      if (!value) return false;
      values[column] = *value;
    }
    if (span.insert(std::move(values)) && span.dimension() == columns) return true;
  }
  return false;
}

/// The point with the roots of each polynomial behind it, for all combinations; none where one of
/// the polynomials does not have as many different roots as its degree.
std::vector<search::Point> with_all_roots(const search::Point& point,
                                          const std::vector<std::vector<Polynomial>>& polynomials,
                                          const search::Modulus& modulus) {
  std::vector<search::Point> result{point};
  for (const std::vector<Polynomial>& coefficients : polynomials) {
    std::vector<search::Residue> values;
    for (const Polynomial& coefficient : coefficients) {
      const auto value = search::value_at(coefficient, point, modulus);
      if (!value) return {};
      values.push_back(*value);
    }
    const std::vector<search::Residue> roots = search::different_roots(values, modulus);
    if (roots.size() + 1 != coefficients.size()) return {};
    std::vector<search::Point> longer;
    for (const search::Point& own : result) {
      for (const search::Residue root : roots) {
        longer.push_back(own);
        longer.back().push_back(root);
      }
    }
    result = std::move(longer);
  }
  return result;
}

}  // namespace

Cofactor lowest(Polynomial top, Polynomial bottom) {
  if (top.is_zero()) return {std::move(top), bottom.ring().constant(1)};
  const Polynomial common = Polynomial::gcd(top, bottom);
  top.divide(common, &top);
  bottom.divide(common, &bottom);
  const cln::cl_RA number = bottom.content();
  return {top.scaled(1 / number), bottom.scaled(1 / number)};
}

Cofactor sum_of(const Cofactor& a, const Cofactor& b) {
  return lowest(a.top * b.bottom + b.top * a.bottom, a.bottom * b.bottom);
}

Cofactor negative_of(const Cofactor& a) { return {-a.top, a.bottom}; }

ConformalEquations::ConformalEquations(const Model& model, TensorType type)
    : lift_(model, type), system_(lift_.model(), {}, {}), divergence_(system_.ring()) {
  const std::size_t n = dimension();
  if (system_.atoms().size() > n + components())
    throw ModelError("conformal tensors need equations of motion that are polynomials");
  for (std::size_t i = 0; i < n; ++i) {
    motion_.field.push_back(system_.prover().convert(model.field[i]));
    // A common denominator is multiplied out of the flow of a search.
    if (!(motion_.field[i] == system_.flow()[i]))
      throw ModelError("conformal tensors need equations of motion that are polynomials");
    divergence_ += motion_.field[i].derivative(i);
  }
  if (std::ranges::all_of(motion_.field, [](const Polynomial& p) { return p.is_zero(); }))
    throw ModelError("there is no motion: it keeps all tensors");
  // The rate of u_I is the sum of coupling[J][I] u_J: see Lift.
  motion_.coupling.resize(components());
  for (std::size_t from = 0; from < components(); ++from)
    for (std::size_t to = 0; to < components(); ++to)
      motion_.coupling[from].push_back(system_.flow()[n + from].derivative(n + to));
  lowest_ = -1;
  for (const Polynomial& rate : motion_.field) {
    for (const auto& [exponents, coefficient] : coefficients_of(rate)) {
      const int degree = static_cast<int>(std::accumulate(exponents.begin(), exponents.end(), 0UL));
      highest_ = std::max(highest_, degree);
      lowest_ = lowest_ < 0 ? degree : std::min(lowest_, degree);
    }
  }
}

std::map<std::vector<unsigned long>, Polynomial> ConformalEquations::coefficients_of(
    const Polynomial& p) const {
  std::map<std::vector<unsigned long>,
           std::vector<std::pair<cln::cl_RA, std::vector<unsigned long>>>>
      parts;
  const auto n = static_cast<std::ptrdiff_t>(dimension());
  for (auto [number, exponents] : p.term_list()) {
    std::vector<unsigned long> own(exponents.begin(), exponents.begin() + n);
    std::fill(exponents.begin(), exponents.begin() + n, 0);
    parts[std::move(own)].emplace_back(number, std::move(exponents));
  }
  std::map<std::vector<unsigned long>, Polynomial> result;
  for (const auto& [own, terms] : parts) {
    TermCollector collector(p.ring());
    for (const auto& [number, exponents] : terms) collector.add(number, exponents);
    result.emplace(own, collector.finish());
  }
  return result;
}

int ConformalEquations::degree_of(const Polynomial& p) const {
  int degree = -1;
  for (const auto& [exponents, coefficient] : coefficients_of(p))
    degree = std::max(degree,
                      static_cast<int>(std::accumulate(exponents.begin(), exponents.end(), 0UL)));
  return degree;
}

Polynomial ConformalEquations::monomial(const std::vector<unsigned long>& exponents) const {
  Polynomial result = system_.ring().constant(1);
  for (std::size_t v = 0; v < dimension(); ++v)
    result = result * system_.ring().variable(v).pow(exponents[v]);
  return result;
}

/// The terms of a degree in the coordinates.
Polynomial ConformalEquations::part(const Polynomial& p, int degree) const {
  TermCollector collector(system_.ring());
  for (const auto& [number, exponents] : p.term_list()) {
    const auto end = exponents.begin() + static_cast<std::ptrdiff_t>(dimension());
    if (static_cast<int>(std::accumulate(exponents.begin(), end, 0UL)) == degree)
      collector.add(number, exponents);
  }
  return collector.finish();
}

ConformalEquations::Motion ConformalEquations::motion_of(int degree) const {
  Motion result;
  for (const Polynomial& rate : motion_.field) result.field.push_back(part(rate, degree));
  for (const std::vector<Polynomial>& row : motion_.coupling) {
    result.coupling.emplace_back();
    for (const Polynomial& entry : row) result.coupling.back().push_back(part(entry, degree - 1));
  }
  return result;
}

/// Of a term of the coupling the weight counts with those of the basis vectors that it leads from
/// and to.
ConformalEquations::Motion ConformalEquations::motion_of(
    const Motion& motion, const search::NewtonFaces::Face& face) const {
  const auto taken = [&](const Polynomial& p, long more) {
    TermCollector collector(system_.ring());
    for (const auto& [number, exponents] : p.term_list()) {
      const std::vector<long> own(exponents.begin(),
                                  exponents.begin() + static_cast<std::ptrdiff_t>(dimension()));
      if (search::product(face.direction, own) + more == face.height)
        collector.add(number, exponents);
    }
    return collector.finish();
  };
  std::vector<long> weights;
  for (const std::vector<std::size_t>& list : lift_.indices()) {
    long sum = 0;
    for (const std::size_t i : list) sum += face.direction[i];
    weights.push_back(lift_.type().form ? -sum : sum);
  }
  Motion result;
  for (std::size_t i = 0; i < dimension(); ++i)
    result.field.push_back(taken(motion.field[i], -face.direction[i]));
  for (std::size_t from = 0; from < components(); ++from) {
    result.coupling.emplace_back();
    for (std::size_t to = 0; to < components(); ++to)
      result.coupling.back().push_back(
          taken(motion.coupling[from][to], weights[from] - weights[to]));
  }
  return result;
}

/// The components of L_X T where one component of T is a monomial and the others are zero.
std::vector<Polynomial> ConformalEquations::contribution(const Motion& motion,
                                                         std::size_t component,
                                                         const Polynomial& own) const {
  std::vector<Polynomial> result;
  for (std::size_t to = 0; to < components(); ++to)
    result.push_back(motion.coupling[component][to] * own);
  for (std::size_t i = 0; i < dimension(); ++i)
    result[component] += motion.field[i] * own.derivative(i);
  return result;
}

std::vector<Polynomial> ConformalEquations::derivative(
    const std::vector<Polynomial>& tensor) const {
  std::vector<Polynomial> result(components(), Polynomial(system_.ring()));
  for (std::size_t c = 0; c < components(); ++c) {
    const std::vector<Polynomial> own = contribution(motion_, c, tensor[c]);
    for (std::size_t to = 0; to < components(); ++to) result[to] += own[to];
  }
  return result;
}

ConformalEquations::Basis ConformalEquations::basis(int degree) const {
  return {search::all_monomials(std::vector<int>(dimension(), 1), degree), components()};
}

std::vector<Polynomial> ConformalEquations::tensor_of(const Basis& basis,
                                                      const ParametricRow& row) const {
  std::vector<Polynomial> result(components(), Polynomial(system_.ring()));
  for (const auto& [column, number] : row)
    result[column / basis.monomials.size()] +=
        number * monomial(exponents_of(basis.monomials, column % basis.monomials.size()));
  return result;
}

ParametricRow ConformalEquations::row_of(const Basis& basis,
                                         const std::vector<Polynomial>& tensor) const {
  std::map<std::vector<unsigned long>, std::size_t> places;
  for (std::size_t i = 0; i < basis.monomials.size(); ++i)
    places.emplace(std::vector<unsigned long>(basis.monomials[i], basis.monomials[i] + dimension()),
                   i);
  ParametricRow result;
  for (std::size_t c = 0; c < components(); ++c)
    for (const auto& [exponents, number] : coefficients_of(tensor[c]))
      result.emplace(c * basis.monomials.size() + places.at(exponents), number);
  return result;
}

/// Over a ring that has the unknowns of f behind the variables of the system's.
std::vector<ParametricRow> ConformalEquations::rows(const Ansatz& ansatz,
                                                    const PolynomialRing& ring) const {
  std::map<std::pair<std::size_t, std::vector<unsigned long>>, ParametricRow> all;
  const std::size_t first = system_.ring().size();
  for (std::size_t c = 0; c < components(); ++c) {
    for (std::size_t i = 0; i < ansatz.monomials.size(); ++i) {
      const std::size_t column = c * ansatz.monomials.size() + i;
      const Polynomial own = monomial(exponents_of(ansatz.monomials, i));
      const auto add = [&](std::size_t to, const Polynomial& p, const Polynomial& factor) {
        for (const auto& [exponents, number] : coefficients_of(p)) {
          const Polynomial entry = in_ring(number, ring) * factor;
          const auto [place, is_new] = all[{to, exponents}].try_emplace(column, entry);
          if (!is_new) place->second += entry;
        }
      };
      const std::vector<Polynomial> rates = contribution(ansatz.motion, c, own);
      for (std::size_t to = 0; to < components(); ++to)
        add(to, rates[to] * ansatz.known.bottom, ring.constant(1));
      add(c, -(ansatz.known.top * own), ring.constant(1));
      for (std::size_t k = 0; k < ansatz.unknown.size(); ++k)
        add(c, -(monomial(ansatz.unknown[k]) * own * ansatz.known.bottom),
            ring.variable(first + k));
    }
  }
  std::vector<ParametricRow> result;
  for (auto& [place, row] : all) {
    std::erase_if(row, [](const auto& entry) { return entry.second.is_zero(); });
    if (!row.empty()) result.push_back(std::move(row));
  }
  return result;
}

bool ConformalEquations::has_no_solution(const std::vector<ParametricRow>& rows,
                                         std::size_t columns) const {
  const search::Modulus modulus = search::Modulus::nth(0);
  std::mt19937_64 random(31);
  search::Point point(system_.ring().size(), 0);
  for (search::Residue& value : point) value = modulus.random(random);
  return has_full_rank(rows, columns, point, modulus);
}

bool ConformalEquations::has_no_solution_at_roots(
    const std::vector<ParametricRow>& rows, std::size_t columns,
    const std::vector<std::vector<Polynomial>>& roots) const {
  constexpr std::size_t kTries = 100;
  constexpr std::size_t kMostCombinations = 100;
  std::mt19937_64 random(43);
  for (std::size_t attempt = 0; attempt < kTries; ++attempt) {
    // x^2 + 2 has no root modulo half of the primes.
    const search::Modulus modulus = search::Modulus::nth(attempt);
    search::Point point(system_.ring().size(), 0);
    for (search::Residue& value : point) value = modulus.random(random);
    const std::vector<search::Point> points = with_all_roots(point, roots, modulus);
    if (points.empty()) continue;
    return points.size() <= kMostCombinations &&
           std::ranges::all_of(points, [&](const search::Point& own) {
             return has_full_rank(rows, columns, own, modulus);
           });
  }
  return false;
}

std::vector<ParametricRow> ConformalEquations::solutions(const Basis& basis,
                                                         const Cofactor& cofactor,
                                                         const Watch& watch) const {
  const Ansatz ansatz{motion_, basis.monomials, cofactor, {}};
  std::vector<ParametricRow> equations = rows(ansatz, system_.ring());
  if (has_no_solution(equations, basis.size())) return {};
  return kernel_of(std::move(equations), basis.size(), system_.ring(),
                   [&](double share) { watch.tick(share); })
      .basis;
}

}  // namespace casimir::structure
