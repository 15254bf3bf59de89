#include "symbolic/functions/generator_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "symbolic/case/limits.hpp"
#include "symbolic/functions/convert/elliptic_generators.hpp"

namespace casimir::functions {

using GiNaC::ex;

namespace {

/// log of binomial(n + k, k): the number of terms of a general polynomial.
double log_binomial(double n, double k) {
  return std::lgamma(n + k + 1) - std::lgamma(n + 1) - std::lgamma(k + 1);
}

}  // namespace

bool Generator::depends_on(std::size_t symbol) const {
  if (symbol < derivatives.size() && !derivatives[symbol].is_zero()) return true;
  return base.uses(symbol);
}

bool Generator::has_power_relation() const {
  return kind == Kind::cosine || kind == Kind::root || kind == Kind::absolute ||
         kind == Kind::imaginary || !relation.empty();
}

GeneratorTable::GeneratorTable(std::vector<GiNaC::symbol> symbols, Limits limits)
    : limits_(std::move(limits)), symbols_(std::move(symbols)) {}

TooLarge GeneratorTable::too_many_terms(const char* what) const {
  return TooLarge(
      fmt::format("an expanded {} would have more than {:g} terms", what, limits_.terms), limits_,
      &Limits::terms);
}

/// Numbers would grow until memory is full: roots of a high order in numbers with powers as high.
void GeneratorTable::check_bits(double bits) const {
  if (bits > limits_.bits)
    throw TooLarge(
        fmt::format("a number in an expanded polynomial would have more than {:.0f} bits",
                    limits_.bits),
        limits_, &Limits::bits);
}

void GeneratorTable::restart() {
  generators_.clear();
  ring_ = std::make_unique<PolynomialRing>(symbols_.size() + capacity_);
}

/// A larger ring and everything once more: rarely more than once, since the fields of unused
/// generators cost little.
void GeneratorTable::grow() {
  constexpr std::size_t kFirst = 16;
  capacity_ = capacity_ == 0 ? kFirst : 2 * capacity_;
  throw Full{};
}

Polynomial GeneratorTable::next_variable() const {
  return ring_->variable(std::min(symbols_.size() + generators_.size(), ring_->size() - 1));
}

const Generator* GeneratorTable::find(Kind kind, const Polynomial& base, unsigned long order,
                                      std::size_t* index) const {
  for (std::size_t i = 0; i < generators_.size(); ++i) {
    const Generator& g = generators_[i];
    if (g.kind == kind && g.order == order && g.base == base) {
      *index = i;
      return &g;
    }
  }
  return nullptr;
}

std::vector<Polynomial> GeneratorTable::slopes(const Polynomial& p) const {
  std::vector<Polynomial> result;
  for (std::size_t i = 0; i < symbols_.size(); ++i) result.push_back(derivative(p, i));
  return result;
}

Polynomial GeneratorTable::generator(
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

Polynomial GeneratorTable::derivative(const Polynomial& p, std::size_t symbol) const {
  Polynomial result = p.derivative(symbol);
  for (std::size_t g = 0; g < generators_.size(); ++g) {
    if (generators_[g].derivatives.empty() || !p.uses(symbols_.size() + g)) continue;
    const Polynomial& inner = generators_[g].derivatives[symbol];
    if (inner.is_zero()) continue;
    if (generators_[g].kind == Kind::function && generators_[g].order == kLastArbitrary)
      throw TooLarge("a higher derivative of an arbitrary function is needed than is looked at");
    if (generators_[g].kind == Kind::function && generators_[g].order == kModulusSlope)
      throw TooLarge("second derivatives of elliptic functions by the modulus are not known here");
    result += p.derivative(symbols_.size() + g) * inner;
  }
  return result;
}

Polynomial GeneratorTable::checked_product(const Polynomial& a, const Polynomial& b) const {
  // Products that cancel or coincide are fewer than the pairs of terms.
  constexpr double kPairs = 100;
  if (static_cast<double>(a.terms()) * static_cast<double>(b.terms()) > limits_.terms * kPairs)
    throw too_many_terms("product");
  check_bits(a.bits() + b.bits());
  Polynomial product = a * b;
  if (static_cast<double>(product.terms()) > limits_.terms) throw too_many_terms("product");
  return product;
}

Polynomial GeneratorTable::power(const Polynomial& p, unsigned long exponent) const {
  if (p.terms() > 1 && log_binomial(static_cast<double>(p.terms()) - 1,
                                    static_cast<double>(exponent)) > std::log(limits_.terms)) {
    // The bound by the number of monomials of that degree may be smaller.
    double used = 0;
    for (std::size_t i = 0; i < ring_->size(); ++i) used += p.uses(i) ? 1 : 0;
    const double degree = static_cast<double>(p.total_degree()) * static_cast<double>(exponent);
    if (log_binomial(used, degree) > std::log(limits_.terms)) throw too_many_terms("power");
  }
  // The bits of a unit, 1 for its numerator, denominator and content, are not its own.
  check_bits((p.bits() - 3) * static_cast<double>(exponent));
  return p.pow(exponent);
}

bool GeneratorTable::is_exponential(const Polynomial& p) const {
  for (std::size_t g = 0; g < generators_.size(); ++g) {
    if (generators_[g].kind == Kind::exponential && p == ring_->variable(symbols_.size() + g))
      return true;
  }
  return false;
}

/// Whether it has real values only, I apart from which functions might have others.
bool GeneratorTable::is_real_everywhere(const Polynomial& p) const {
  if (!complex_) return true;
  const auto used = generators_in({p});
  return std::all_of(used.begin(), used.end(), [&](std::size_t g) {
    const Generator& generator = generators_[g];
    switch (generator.kind) {
      case Kind::sine:
      case Kind::cosine:
      case Kind::exponential:
      case Kind::inverse:
      case Kind::absolute:
        return true;  // of what is real, which the others that are used make sure
      case Kind::root:
        return generator.base.is_constant() && !cln::minusp(generator.base.term_list()[0].first);
      case Kind::imaginary:
        return false;
      case Kind::function:
        return generator.order == kConstant || generator.order == kArcTangent ||
               generator.order == kArcTangentOfTwo || generator.order == kCosineOfPi;
    }
    return false;
  });
}

/// Their indices, with those that they are made of.
std::vector<std::size_t> GeneratorTable::generators_in(
    const std::vector<Polynomial>& functions) const {
  std::vector<bool> used(generators_.size());
  const auto mark = [&](const Polynomial& p) {
    for (std::size_t g = 0; g < generators_.size(); ++g)
      used[g] = used[g] || p.uses(symbols_.size() + g);
  };
  for (const Polynomial& f : functions) mark(f);
  // Each is made of earlier ones.
  for (std::size_t g = generators_.size(); g-- > 0;) {
    if (!used[g]) continue;
    mark(generators_[g].base);
    if (generators_[g].kind == Kind::cosine) used[g - 1] = true;
    // cos(v/3) is no smoother than the cos(v) of its relation.
    for (const Polynomial& coefficient : generators_[g].relation) mark(coefficient);
    if (generators_[g].quotient) mark(generators_[g].quotient->second);
    if (generators_[g].partner) used[generators_[g].partner->first - symbols_.size()] = true;
    for (const Polynomial& slope : generators_[g].derivatives) {
      // The arguments of atan2 are seen in its derivatives alone.
      if (generators_[g].kind == Kind::function && generators_[g].order == kArcTangentOfTwo)
        mark(slope);
    }
  }
  std::vector<std::size_t> result;
  for (std::size_t g = 0; g < used.size(); ++g)
    if (used[g]) result.push_back(g);
  return result;
}

bool GeneratorTable::depends_on(const Polynomial& p, std::size_t symbol) const {
  if (p.uses(symbol)) return true;
  const auto used = generators_in({p});
  return std::any_of(used.begin(), used.end(),
                     [&](std::size_t g) { return generators_[g].depends_on(symbol); });
}

double GeneratorTable::expression_size(const Polynomial& p) const {
  double size = 0;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] > 0) size += i < symbols_.size() ? 1 : generators_[i - symbols_.size()].size;
    }
  }
  return size;
}

ex GeneratorTable::expression(const Polynomial& p) const {
  // GiNaC shares what is repeated, but goes through all of it to compare and to sort.
  if (expression_size(p) > limits_.size)
    throw TooLarge(fmt::format("an expression would have more than {:g} factors", limits_.size),
                   limits_, &Limits::size);
  GiNaC::exvector terms;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    GiNaC::exvector factors{GiNaC::numeric(coefficient)};
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      const ex base =
          i < symbols_.size() ? ex(symbols_[i]) : generators_[i - symbols_.size()].value;
      factors.push_back(GiNaC::pow(base, static_cast<long>(exponents[i])));
    }
    terms.push_back(GiNaC::mul(factors));
  }
  return GiNaC::add(terms);
}

}  // namespace casimir::functions
