// Polynomials by the relations of a GeneratorTable: numerators, and what reduces to zero.
#include <algorithm>
#include <map>
#include <utility>

#include "symbolic/functions/generator_table.hpp"

namespace casimir::functions {

/// p = first / second without generators of the kind 1/d.
std::pair<Polynomial, Polynomial> GeneratorTable::fraction(const Polynomial& p) const {
  Polynomial top = p;
  Polynomial bottom = ring_->constant(1);
  for (std::size_t g = generators_.size(); g-- > 0;) {
    if (generators_[g].kind != Kind::inverse) continue;
    const std::vector<Polynomial> parts = top.coefficients(symbols_.size() + g);
    if (parts.size() == 1) continue;
    Polynomial sum = parts[0];
    for (std::size_t k = 1; k < parts.size(); ++k)
      sum = checked_product(sum, generators_[g].base) + parts[k];
    top = std::move(sum);
    bottom = checked_product(bottom, power(generators_[g].base, parts.size() - 1));
  }
  return {std::move(top), std::move(bottom)};
}

Polynomial GeneratorTable::numerator(const Polynomial& p) const {
  if (generators_.empty()) return p;
  std::vector<Polynomial> row;
  row.push_back(p);
  Polynomial result = std::move(common_numerators(std::move(row))[0]);
  if (!result.is_zero() && vanishes_by_partners(result, generators_.size()))
    return Polynomial(*ring_);
  return result;
}

/// p = 0 where u p = 0 and w p = 0, if u and w have no common zero: then p need not be divided by
/// either.
bool GeneratorTable::vanishes_by_partners(const Polynomial& p, std::size_t below) const {
  for (std::size_t g = below; g-- > 0;) {
    if (!generators_[g].partner || !p.uses(symbols_.size() + g)) continue;
    const auto vanishes = [&](std::size_t place) {
      std::vector<Polynomial> row{checked_product(p, ring_->variable(place))};
      row = common_numerators(std::move(row));
      return row[0].is_zero() || vanishes_by_partners(row[0], g);
    };
    if (vanishes(symbols_.size() + g) && vanishes(generators_[g].partner->first)) return true;
  }
  return false;
}

std::vector<Polynomial> GeneratorTable::common_numerators(std::vector<Polynomial> row) const {
  // Each relation leads to earlier generators only, so one sweep backwards is enough.
  for (std::size_t g = generators_.size(); g-- > 0;) {
    long highest = 0;
    for (const Polynomial& p : row) highest = std::max(highest, p.degree(symbols_.size() + g));
    if (highest == 0) continue;
    for (Polynomial& p : row) {
      if (generators_[g].kind == Kind::inverse)
        p = without_inverse(p, g, static_cast<unsigned long>(highest));
      else if (generators_[g].has_power_relation())
        p = reduced_power(p, g);
      if (generators_[g].partner) p = by_partner(p, g);
    }
    const auto& quotient = generators_[g].quotient;
    if (!quotient) continue;
    for (Polynomial& p : row) {  // linear by now
      const std::vector<Polynomial> parts = p.coefficients(symbols_.size() + g);
      p = parts.empty() ? p : checked_product(parts[0], quotient->first);
      if (parts.size() > 1) p += checked_product(parts[1], quotient->second);
    }
  }
  return row;
}

Polynomial GeneratorTable::reduced(Polynomial p) const {
  for (std::size_t g = generators_.size(); g-- > 0;) {
    if (generators_[g].has_power_relation()) p = reduced_power(p, g);
    if (generators_[g].partner) p = by_partner(p, g);
  }
  return p;
}

/// p by u^n = the sum of relation[k] u^k.
Polynomial GeneratorTable::by_relation(const Polynomial& p, std::size_t g) const {
  const std::vector<Polynomial>& relation = generators_[g].relation;
  std::vector<Polynomial> parts = p.coefficients(symbols_.size() + g);
  const std::size_t n = relation.size();
  if (parts.size() <= n) return p;
  for (std::size_t k = parts.size(); k-- > n;) {
    if (parts[k].is_zero()) continue;
    for (std::size_t i = 0; i < n; ++i)
      if (!relation[i].is_zero()) parts[k - n + i] += checked_product(parts[k], relation[i]);
  }
  Polynomial result(*ring_);
  const Polynomial u = ring_->variable(symbols_.size() + g);
  for (std::size_t i = n; i-- > 0;) result = result * u + parts[i];
  return result;
}

/// p, linear in u, by u w = second.
Polynomial GeneratorTable::by_partner(const Polynomial& p, std::size_t g) const {
  const std::vector<Polynomial> parts = p.coefficients(symbols_.size() + g);
  if (parts.size() < 2) return p;
  const auto& [w, product] = *generators_[g].partner;
  Polynomial result = parts[0];
  const std::vector<Polynomial> inner = parts[1].coefficients(w);
  Polynomial power = ring_->constant(1);
  for (std::size_t k = 0; k < inner.size(); ++k) {
    if (k == 0) {
      result += inner[0] * ring_->variable(symbols_.size() + g);
    } else {
      result += checked_product(checked_product(inner[k], product), power);
      power *= ring_->variable(w);
    }
  }
  return result;
}

/// p times that power of the denominator, by which no 1/d is left.
Polynomial GeneratorTable::without_inverse(const Polynomial& p, std::size_t g,
                                           unsigned long power) const {
  Polynomial result(*ring_);
  const std::vector<Polynomial> parts = p.coefficients(symbols_.size() + g);
  for (unsigned long k = 0; k <= power; ++k) {
    if (!result.is_zero()) result = checked_product(result, generators_[g].base);
    if (k < parts.size()) result += parts[k];
  }
  return result;
}

/// p by u^q = base, so that only powers of u below q are left.
Polynomial GeneratorTable::reduced_power(const Polynomial& p, std::size_t g) const {
  if (!generators_[g].relation.empty()) return by_relation(p, g);
  const unsigned long q = generators_[g].order;
  if (p.degree(symbols_.size() + g) < static_cast<long>(q)) return p;
  constexpr unsigned long kDense = 64;
  if (q > kDense) return reduced_sparse_power(p, g);
  const std::vector<Polynomial> parts = p.coefficients(symbols_.size() + g);
  std::vector<Polynomial> sums;
  Polynomial power = ring_->constant(1);
  for (unsigned long r = 0; r < q; ++r) {
    // Horner's scheme in the base over the powers r, r + q, r + 2q, ..
    Polynomial sum(*ring_);
    for (unsigned long k = parts.size(); k-- > 0;) {
      if (k % q != r) continue;
      if (!sum.is_zero()) sum = checked_product(sum, generators_[g].base);
      sum += parts[k];
    }
    sums.push_back(r == 0 ? std::move(sum) : sum * power);
    power *= ring_->variable(symbols_.size() + g);
  }
  return Polynomial::sum(*ring_, std::move(sums));
}

/// The same for roots of a high order, of whose powers few occur.
Polynomial GeneratorTable::reduced_sparse_power(const Polynomial& p, std::size_t g) const {
  const std::size_t place = symbols_.size() + g;
  const unsigned long q = generators_[g].order;
  std::map<unsigned long, TermCollector> parts;  // by the power of the base
  for (const auto& [coefficient, exponents] : p.term_list()) {
    const unsigned long whole = exponents[place] / q;
    std::vector<unsigned long> rest = exponents;
    rest[place] %= q;
    parts.try_emplace(whole, *ring_).first->second.add(coefficient, rest);
  }
  Polynomial result(*ring_);
  for (auto& [whole, terms] : parts)
    result += checked_product(terms.finish(), power(generators_[g].base, whole));
  return result;
}
namespace {

/// Divides both by their greatest common divisor, which has the leading coefficient 1. The same few
/// denominators come again and again, and their factors are remembered.
void cancel(Polynomial& top, Polynomial& bottom) {
  constexpr std::size_t kMostTerms = 100;
  constexpr long kMostDegree = 50;
  if (bottom.terms() > kMostTerms || bottom.total_degree() > kMostDegree) {
    const Polynomial common = Polynomial::gcd(top, bottom);
    top.divide(common, &top);
    bottom.divide(common, &bottom);
    return;
  }
  Polynomial quotient(top.ring());
  for (const auto& [f, exponent] : bottom.factors()) {
    if (f.is_constant()) continue;
    const Polynomial factor = f.scaled(1 / f.term_list()[0].first);
    for (unsigned long k = 0; k < exponent && top.divide(factor, &quotient); ++k) {
      std::swap(top, quotient);
      bottom.divide(factor, &bottom);
    }
  }
}

}  // namespace

std::pair<Polynomial, Polynomial> GeneratorTable::lowest_terms(const Polynomial& p) const {
  if (generators_.empty()) return {p, ring_->constant(1)};
  const auto [unreduced_top, unreduced_bottom] = fraction(reduced(p));
  Polynomial top = reduced(unreduced_top);
  Polynomial bottom = reduced(unreduced_bottom);
  if (top.is_zero()) return {top, ring_->constant(1)};
  if (bottom.is_constant()) return {std::move(top), std::move(bottom)};
  cancel(top, bottom);
  return {std::move(top), std::move(bottom)};
}

}  // namespace casimir::functions
