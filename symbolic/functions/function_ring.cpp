#include "symbolic/functions/function_ring.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>
#include <map>
#include <unordered_set>

#include "symbolic/expression/pairs.hpp"

namespace casimir {

using GiNaC::ex;

namespace {

/// `seen` has what was looked through: expressions share their parts.
bool uses_imaginary_unit(const ex& e, std::unordered_set<ex>& seen) {
  if (GiNaC::is_exactly_a<GiNaC::numeric>(e)) return !GiNaC::ex_to<GiNaC::numeric>(e).is_real();
  if (e.nops() == 0 || !seen.insert(e).second) return false;
  if (GiNaC::is_exactly_a<GiNaC::add>(e) || GiNaC::is_exactly_a<GiNaC::mul>(e)) {
    const GiNaC::epvector& pairs = Pairs::of(e);
    return uses_imaginary_unit(Pairs::number(e), seen) ||
           std::any_of(pairs.begin(), pairs.end(), [&](const GiNaC::expair& pair) {
             return uses_imaginary_unit(pair.rest, seen) || uses_imaginary_unit(pair.coeff, seen);
           });
  }
  for (std::size_t i = 0; i < e.nops(); ++i) {
    if (uses_imaginary_unit(e.op(i), seen)) return true;
  }
  return false;
}

}  // namespace

FunctionRing::FunctionRing(std::vector<GiNaC::symbol> symbols,
                           const std::vector<Assumption>& assumptions,
                           const std::vector<ex>& expressions)
    : symbols_(std::move(symbols)), assumptions_(assumptions) {
  for (std::size_t i = 0; i < symbols_.size(); ++i) places_.emplace(symbols_[i], i);
  build(expressions);
}

FunctionRing::~FunctionRing() = default;

/// The ring of a FLINT polynomial has a fixed number of variables, so that generators are first
/// counted: when they do not fit, or an angle needs a finer unit, everything starts again.
void FunctionRing::build(const std::vector<ex>& expressions) {
  for (bool first = true;;) {
    known_.clear();
    signs_.clear();
    nonzero_.clear();
    generators_.clear();
    probes_ = {};
    radicands_.clear();
    ring_ = std::make_unique<PolynomialRing>(symbols_.size() + capacity_);
    try {
      read_signs();
      const std::size_t signs = implied_.size(), products = products_.size();
      for (const ex& e : expressions) convert(e);
      // What roots and logarithms imply may give a meaning to what is assumed, or to each other.
      const std::size_t known = implied_.size() + products_.size();
      const bool more = implied_.size() > signs || (known > signs + products && tell_more_signs());
      if (!more || known + assumptions_.size() < 2) {
        built_ = true;
        return;
      }
    } catch (const Full&) {
      if (!first) continue;
      first = false;  // only now is it seen that there is more than polynomials
      std::unordered_set<ex> seen;
      complex_ = std::any_of(expressions.begin(), expressions.end(),
                             [&](const ex& e) { return uses_imaginary_unit(e, seen); });
    }
  }
}

const FunctionRing::Generator* FunctionRing::find(Kind kind, const Polynomial& base,
                                                  unsigned long order, std::size_t* index) const {
  for (std::size_t i = 0; i < generators_.size(); ++i) {
    const Generator& g = generators_[i];
    if (g.kind == kind && g.order == order && g.base == base) {
      *index = i;
      return &g;
    }
  }
  return nullptr;
}

std::vector<Polynomial> FunctionRing::slopes(const Polynomial& p) const {
  std::vector<Polynomial> result;
  for (std::size_t i = 0; i < symbols_.size(); ++i) result.push_back(derivative(p, i));
  return result;
}

/// A larger ring and everything once more: rarely more than once, since the fields of unused
/// generators cost little.
void FunctionRing::grow() {
  constexpr std::size_t kFirst = 16;
  capacity_ = capacity_ == 0 ? kFirst : 2 * capacity_;
  throw Full{};
}

Polynomial FunctionRing::generator(
    Kind kind, const ex& value, const Polynomial& base, unsigned long order,
    const std::function<Polynomial(const Polynomial& slope)>& derivative_of) {
  if (generators_.size() == capacity_) grow();
  const std::size_t index = generators_.size();
  const std::vector<Polynomial> base_slopes = slopes(base);
  generators_.push_back({kind, value, base, order, {}, 1 + expression_size(base)});
  std::vector<Polynomial> derivatives;
  for (const Polynomial& slope : base_slopes) {
    derivatives.push_back(slope.is_zero() ? slope : derivative_of(slope));
  }
  generators_[index].derivatives = std::move(derivatives);
  return ring_->variable(symbols_.size() + index);
}

Polynomial FunctionRing::derivative(const Polynomial& p, std::size_t symbol) const {
  Polynomial result = p.derivative(symbol);
  for (std::size_t g = 0; g < generators_.size(); ++g) {
    if (generators_[g].derivatives.empty() || !p.uses(symbols_.size() + g)) continue;
    const Polynomial& inner = generators_[g].derivatives[symbol];
    if (!inner.is_zero()) result += p.derivative(symbols_.size() + g) * inner;
  }
  return result;
}

/// p = first / second without generators of the kind 1/d.
std::pair<Polynomial, Polynomial> FunctionRing::fraction(const Polynomial& p) const {
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

Polynomial FunctionRing::numerator(const Polynomial& p) const {
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
bool FunctionRing::vanishes_by_partners(const Polynomial& p, std::size_t below) const {
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

std::vector<Polynomial> FunctionRing::common_numerators(std::vector<Polynomial> row) const {
  // Each relation leads to earlier generators only, so one sweep backwards is enough.
  for (std::size_t g = generators_.size(); g-- > 0;) {
    long highest = 0;
    for (const Polynomial& p : row) highest = std::max(highest, p.degree(symbols_.size() + g));
    if (highest == 0) continue;
    for (Polynomial& p : row) {
      if (generators_[g].kind == Kind::inverse)
        p = without_inverse(p, g, static_cast<unsigned long>(highest));
      else if (has_power_relation(generators_[g]))
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

Polynomial FunctionRing::reduced(Polynomial p) const {
  for (std::size_t g = generators_.size(); g-- > 0;) {
    if (has_power_relation(generators_[g])) p = reduced_power(p, g);
    if (generators_[g].partner) p = by_partner(p, g);
  }
  return p;
}

bool FunctionRing::has_power_relation(const Generator& g) const {
  return g.kind == Kind::cosine || g.kind == Kind::root || g.kind == Kind::absolute ||
         g.kind == Kind::imaginary || !g.relation.empty();
}

/// p by u^n = the sum of relation[k] u^k.
Polynomial FunctionRing::by_relation(const Polynomial& p, std::size_t g) const {
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
Polynomial FunctionRing::by_partner(const Polynomial& p, std::size_t g) const {
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
Polynomial FunctionRing::without_inverse(const Polynomial& p, std::size_t g,
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
Polynomial FunctionRing::reduced_power(const Polynomial& p, std::size_t g) const {
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
Polynomial FunctionRing::reduced_sparse_power(const Polynomial& p, std::size_t g) const {
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

}  // namespace casimir
