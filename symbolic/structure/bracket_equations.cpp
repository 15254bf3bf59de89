#include "symbolic/structure/bracket_equations.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "symbolic/case/limits.hpp"
#include "symbolic/search/modular/span.hpp"

namespace casimir::structure {
namespace {

using Exponents = std::vector<unsigned long>;
using Row = std::map<std::size_t, cln::cl_RA>;

void subtract(Row& row, const Row& other, const cln::cl_RA& factor) {
  for (const auto& [column, number] : other) {
    cln::cl_RA& sum = row[column];
    sum = sum - factor * number;
    if (cln::zerop(sum)) row.erase(column);
  }
}

/// Gauss and Jordan: each row has a first column that no other has, with the number 1.
std::vector<Row> row_reduced(std::vector<Row> rows) {
  std::map<std::size_t, Row> reduced;  // by the first column
  for (Row& row : rows) {
    for (const auto& [column, other] : reduced) {
      const auto own = row.find(column);
      if (own != row.end()) subtract(row, other, cln::cl_RA(own->second));
    }
    if (row.empty()) continue;
    const std::size_t first = row.begin()->first;
    const cln::cl_RA leading = row.begin()->second;
    for (auto& [column, number] : row) number = number / leading;
    for (auto& [column, other] : reduced) {
      const auto own = other.find(first);
      if (own != other.end()) subtract(other, row, cln::cl_RA(own->second));
    }
    reduced.emplace(first, row);
  }
  std::vector<Row> result;
  for (auto& [column, row] : reduced) result.push_back(std::move(row));
  return result;
}

}  // namespace

Polynomial entry(const Bivector& p, std::size_t n, std::size_t i, std::size_t j) {
  if (i == j) return Polynomial(p.front().ring());
  if (i > j) return -entry(p, n, j, i);
  return p[i * n - i * (i + 1) / 2 + (j - i - 1)];
}

std::vector<Polynomial> hamiltonian_field(const Bivector& p, std::size_t n, const Polynomial& f) {
  std::vector<Polynomial> result(n, Polynomial(f.ring()));
  for (std::size_t j = 0; j < n; ++j) {
    const Polynomial slope = f.derivative(j);
    if (slope.is_zero()) continue;
    for (std::size_t i = 0; i < n; ++i) result[i] += entry(p, n, i, j) * slope;
  }
  return result;
}

std::vector<Polynomial> schouten(const Bivector& p, const Bivector& q, std::size_t n) {
  std::vector<Polynomial> result;
  const auto add = [n](SumOfProducts& sum, const Bivector& a, const Bivector& b, std::size_t i,
                       std::size_t j, std::size_t k) {
    const Polynomial inner = entry(b, n, j, k);
    if (inner.is_constant()) return;
    for (std::size_t l = 0; l < n; ++l) {
      const Polynomial slope = inner.derivative(l);
      if (!slope.is_zero()) sum.add(entry(a, n, i, l), slope);
    }
  };
  for (const std::vector<std::size_t>& t : skew_indices(n, 3)) {
    SumOfProducts sum(p.front().ring());
    for (std::size_t s = 0; s < 3; ++s) {
      const std::size_t i = t[s], j = t[(s + 1) % 3], k = t[(s + 2) % 3];
      add(sum, p, q, i, j, k);
      add(sum, q, p, i, j, k);
    }
    result.push_back(sum.finish());
  }
  return result;
}

ConstantEquations::ConstantEquations(const search::System& system, std::size_t unknowns)
    : system_(system),
      first_(system.ring().size()),
      unknowns_(unknowns),
      ring_(system.ring().size() + unknowns) {}

void ConstantEquations::add(const std::vector<Summand>& sum) {
  // By the monomials in what moves.
  std::map<Exponents, std::unique_ptr<TermCollector>> parts;
  for (const Summand& summand : sum) {
    for (auto [number, exponents] : summand.p.term_list()) {
      Exponents moving(exponents.size(), 0);
      for (std::size_t i = 0; i < exponents.size(); ++i)
        if (!system_.is_constant()[i]) std::swap(moving[i], exponents[i]);
      exponents.resize(ring_.size(), 0);
      for (const std::size_t u : summand.unknowns) ++exponents[first_ + u];
      std::unique_ptr<TermCollector>& part = parts[moving];
      if (!part) part = std::make_unique<TermCollector>(ring_);
      part->add(number, exponents);
    }
  }
  for (auto& [moving, part] : parts) {
    Polynomial equation = part->finish();
    if (!equation.is_zero()) equations_.push_back(std::move(equation));
  }
}

/// Equations of which the others are combinations. With parameters: a set whose rows are
/// independent modulo a prime. If it is too small, equations are missing and there are more
/// solutions: what is found is proved afterwards, and "none" remains true.
std::vector<Polynomial> ConstantEquations::independent() const {
  std::map<Exponents, std::size_t> columns;
  const search::Modulus modulus = search::usable_modulus(system_);
  std::mt19937_64 random(31);
  const std::optional<search::Point> point = system_.random_point(modulus, random);
  bool plain = true;
  std::vector<Row> exact;
  std::vector<std::map<std::size_t, search::Residue>> rows;
  for (const Polynomial& equation : equations_) {
    exact.emplace_back();
    rows.emplace_back();
    for (const auto& [number, exponents] : equation.term_list()) {
      search::Residue residue = modulus.reduce(number).value_or(0);
      for (std::size_t i = 0; i < first_; ++i) {
        if (exponents[i] == 0) continue;
        plain = false;
        residue = modulus.multiply(residue, modulus.power((*point)[i], exponents[i]));
      }
      // Of high degree first, so that these are the ones that elimination removes.
      Exponents own(exponents.begin() + static_cast<std::ptrdiff_t>(first_), exponents.end());
      const std::size_t column = columns.try_emplace(own, columns.size()).first->second;
      exact.back()[column] = number;
      search::Residue& sum = rows.back()[column];
      sum = modulus.add(sum, residue);
    }
  }
  std::vector<Polynomial> result;
  if (!plain) {
    search::Span span(modulus);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      std::vector<search::Residue> dense(columns.size(), 0);
      for (const auto& [column, residue] : rows[r]) dense[column] = residue;
      if (span.insert(std::move(dense))) result.push_back(equations_[r]);
    }
    return result;
  }
  std::vector<Exponents> monomials(columns.size());
  for (const auto& [own, column] : columns) monomials[column] = own;
  for (const Row& row : row_reduced(std::move(exact))) {
    TermCollector collector(ring_);
    for (const auto& [column, number] : row) {
      Exponents exponents(first_, 0);
      exponents.insert(exponents.end(), monomials[column].begin(), monomials[column].end());
      collector.add(number, exponents);
    }
    result.push_back(collector.finish());
  }
  return result;
}

std::vector<search::Branch> ConstantEquations::solve(const search::Watch& watch) const {
  std::vector<std::size_t> places(unknowns_);
  std::iota(places.begin(), places.end(), first_);
  try {
    return search::solve_system(independent(), places, watch);
  } catch (const TooLarge&) {
    search::Branch unknown;
    unknown.decided = false;
    return {unknown};
  }
}

std::vector<std::size_t> ConstantEquations::free_in(const search::Branch& family) const {
  std::vector<std::size_t> result;
  for (std::size_t u = 0; u < unknowns_; ++u) {
    if (std::none_of(family.solved.begin(), family.solved.end(),
                     [&](const search::SolvedUnknown& s) { return s.place == first_ + u; }))
      result.push_back(u);
  }
  return result;
}

GiNaC::ex ConstantEquations::value(const Polynomial& p,
                                   const std::vector<GiNaC::ex>& unknowns) const {
  GiNaC::ex sum = 0;
  for (const auto& [number, exponents] : p.term_list()) {
    GiNaC::ex term = GiNaC::numeric(number);
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      const GiNaC::ex base =
          i < first_ ? system_.expression(system_.ring().variable(i)) : unknowns[i - first_];
      term *= GiNaC::pow(base, GiNaC::numeric(static_cast<unsigned long>(exponents[i])));
    }
    sum += term;
  }
  return sum.normal();
}

std::optional<std::vector<GiNaC::ex>> ConstantEquations::values(
    const search::Branch& family, const std::vector<GiNaC::ex>& free) const {
  std::vector<GiNaC::ex> result(unknowns_);
  const std::vector<std::size_t> places = free_in(family);
  for (std::size_t k = 0; k < places.size(); ++k) result[places[k]] = free[k];
  for (auto s = family.solved.rbegin(); s != family.solved.rend(); ++s) {
    const GiNaC::ex bottom = value(s->denominator, result);
    if (bottom.is_zero()) return std::nullopt;
    result[s->place - first_] = (value(s->numerator, result) / bottom).normal();
  }
  const auto vanishes = [&](const Polynomial& p) { return value(p, result).is_zero(); };
  if (std::any_of(family.nonzero.begin(), family.nonzero.end(), vanishes)) return std::nullopt;
  if (!std::all_of(family.rest.begin(), family.rest.end(), vanishes)) return std::nullopt;
  return result;
}

}  // namespace casimir::structure
