#include "symbolic/structure/separate/leaves.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace casimir::structure {
namespace {

constexpr std::size_t kMostCoordinatesOfLeaves = 12;

std::vector<GiNaC::ex> with_level(std::vector<GiNaC::ex> expressions,
                                  const std::vector<NamedExpression>& on) {
  for (const NamedExpression& f : on) expressions.push_back(f.value);
  return expressions;
}

/// A polynomial in one more variable by its coefficients, times another one.
std::vector<Polynomial> product(const std::vector<Polynomial>& a,
                                const std::vector<Polynomial>& b) {
  std::vector<Polynomial> result(a.size() + b.size() - 1, Polynomial(a.front().ring()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (!a[i].is_zero() && !b[j].is_zero()) result[i + j] += a[i] * b[j];
    }
  }
  return result;
}

}  // namespace

Leaves::Leaves(const Model& model, const std::vector<NamedExpression>& on,
               const std::vector<GiNaC::ex>& others)
    : on_(on), system_(model, {}, with_level(others, on)) {
  if (model.time)
    throw ModelError("variables that separate are searched for motions without explicit time");
  if (dimension() > kMostCoordinatesOfLeaves)
    throw ModelError(fmt::format("variables that separate are searched for up to {} coordinates",
                                 kMostCoordinatesOfLeaves));
  read_bivector();
  read_level();
  find_freedom();
}

void Leaves::read_bivector() {
  const std::size_t symbols = system_.functions().symbols().size();
  for (std::size_t i = 0; i < dimension(); ++i) {
    for (std::size_t j = i + 1; j < dimension(); ++j) {
      bivector_.push_back(system_.prover().bracket_entry(i, j));
      for (std::size_t g = symbols; g < ring().size(); ++g) {
        if (bivector_.back().uses(g))
          throw ModelError("variables that separate are searched for brackets of polynomials");
      }
    }
  }
}

void Leaves::read_level() {
  std::vector<Polynomial> generators;
  for (const NamedExpression& f : on_)
    generators.push_back(system_.functions().numerator(convert(f.value)));
  if (!generators.empty()) ideal_ = groebner_basis(generators);
  for (const Polynomial& f : ideal_) {
    const std::vector<unsigned long> lead = f.term_list().front().second;
    for (std::size_t i = 0; i < lead.size(); ++i)
      if (lead[i] > 0 && i >= dimension()) plain_leads_ = false;
  }
  for (std::size_t k = 0; k < on_.size(); ++k) {
    for (std::size_t i = 0; i < dimension(); ++i) {
      if (vanishes(bracket(ring().variable(i), generators[k]))) continue;
      throw NotLeaves(fmt::format(
          "the level is not made of symplectic leaves: on it {{{}, {}}} is not shown to be zero",
          system_.name(i), printable(on_[k].name)));
    }
  }
}

void Leaves::find_freedom() {
  for (freedom_ = dimension() / 2; freedom_ > 0; --freedom_) {
    for (const std::vector<std::size_t>& own : choices(2 * freedom_))
      if (!vanishes(pfaffian(bivector_, dimension(), own))) return;
  }
}

const Polynomial& Leaves::convert(const GiNaC::ex& expression) {
  return system_.prover().convert(expression);
}

Polynomial Leaves::reduced(const Polynomial& p) const {
  const Polynomial top = system_.functions().numerator(p);
  if (ideal_.empty()) return top;
  std::vector<Polynomial> quotients;
  return top.remainder(ideal_, &quotients);
}

Polynomial Leaves::bracket(const Polynomial& f, const Polynomial& g) const {
  const std::vector<Polynomial> of_f = gradient(f), of_g = gradient(g);
  SumOfProducts sum(ring());
  for (std::size_t i = 0; i < dimension(); ++i) {
    for (std::size_t j = 0; j < dimension(); ++j) {
      if (i == j || of_f[i].is_zero() || of_g[j].is_zero()) continue;
      sum.add(entry(bivector_, dimension(), i, j), of_f[i] * of_g[j]);
    }
  }
  return system_.functions().reduced(sum.finish());
}

std::vector<Polynomial> Leaves::gradient(const Polynomial& f) const {
  std::vector<Polynomial> result = system_.gradient(f);
  result.resize(dimension(), Polynomial(ring()));
  return result;
}

std::vector<std::vector<std::size_t>> Leaves::choices(std::size_t size) const {
  return skew_indices(dimension(), static_cast<int>(size));
}

bool Leaves::is_tangent(const Bivector& p, const std::vector<std::size_t>& rows) const {
  const std::size_t n = dimension();
  const Polynomial whole = pfaffian(bivector_, n, rows);
  // The inverse of a skew matrix, times its Pfaffian: those of the minors without two rows.
  std::vector<std::vector<Polynomial>> inverse(
      rows.size(), std::vector<Polynomial>(rows.size(), Polynomial(ring())));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      std::vector<std::size_t> rest;
      for (std::size_t k = 0; k < rows.size(); ++k)
        if (k != i && k != j) rest.push_back(rows[k]);
      const Polynomial minor = pfaffian(bivector_, n, rest);
      inverse[i][j] = (i + j) % 2 == 0 ? minor : -minor;
      inverse[j][i] = -inverse[i][j];
    }
  }
  for (std::size_t a = 0; a < n; ++a) {
    if (std::ranges::find(rows, a) != rows.end()) continue;
    for (std::size_t x = 0; x < n; ++x) {
      SumOfProducts sum(ring());
      sum.add(whole, entry(p, n, x, a));
      for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t j = 0; j < rows.size(); ++j)
          sum.add(-(entry(p, n, x, rows[i]) * inverse[i][j]), entry(bivector_, n, rows[j], a));
      }
      if (!vanishes(sum.finish())) return false;
    }
  }
  return true;
}

std::vector<Polynomial> pfaffian_of_pencil(const Bivector& p, const Bivector& q, std::size_t n,
                                           const std::vector<std::size_t>& places) {
  const PolynomialRing& ring = p.front().ring();
  if (places.empty()) return {ring.constant(1)};
  std::vector<Polynomial> sum(places.size() / 2 + 1, Polynomial(ring));
  // Along the first row.
  for (std::size_t k = 1; k < places.size(); ++k) {
    const std::vector<Polynomial> own{entry(p, n, places[0], places[k]),
                                      entry(q, n, places[0], places[k])};
    if (own[0].is_zero() && own[1].is_zero()) continue;
    std::vector<std::size_t> rest;
    for (std::size_t i = 1; i < places.size(); ++i)
      if (i != k) rest.push_back(places[i]);
    const std::vector<Polynomial> part = product(own, pfaffian_of_pencil(p, q, n, rest));
    for (std::size_t t = 0; t < part.size(); ++t) {
      if (k % 2 == 1)
        sum[t] += part[t];
      else
        sum[t] -= part[t];
    }
  }
  return sum;
}

Polynomial pfaffian(const Bivector& p, std::size_t n, const std::vector<std::size_t>& places) {
  const Bivector none(p.size(), Polynomial(p.front().ring()));
  return pfaffian_of_pencil(p, none, n, places).front();
}

}  // namespace casimir::structure
