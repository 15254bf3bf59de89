#include "symbolic/function_ring.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace casimir {
namespace {

using GiNaC::ex;

constexpr double kMaxTerms = 5e6;

cln::cl_RA rational(const GiNaC::numeric& number) {
  if (!number.is_rational())
    throw ModelError("a number that is not rational in an exact expression");
  return cln::the<cln::cl_RA>(number.to_cl_N());
}

/// log of binomial(n + k, k): the number of terms of a general polynomial.
double log_binomial(double n, double k) {
  return std::lgamma(n + k + 1) - std::lgamma(n + 1) - std::lgamma(k + 1);
}

}  // namespace

FunctionRing::FunctionRing(std::vector<GiNaC::symbol> symbols,
                           const std::vector<Assumption>& assumptions,
                           const std::vector<ex>& expressions)
    : symbols_(std::move(symbols)), assumptions_(assumptions) {
  build(expressions);
}

FunctionRing::~FunctionRing() = default;

/// The ring of a FLINT polynomial has a fixed number of variables, so that generators are first
/// counted: when they do not fit, or an angle needs a finer unit, everything starts again.
void FunctionRing::build(const std::vector<ex>& expressions) {
  for (;;) {
    known_.clear();
    signs_.clear();
    generators_.clear();
    ring_ = std::make_unique<PolynomialRing>(symbols_.size() + capacity_);
    try {
      for (const Assumption& assumption : assumptions_) {
        const bool positive = assumption.relation == ">" || assumption.relation == ">=";
        const bool negative = assumption.relation == "<" || assumption.relation == "<=";
        if (!positive && !negative) continue;
        const auto factors = fraction(convert(assumption.difference)).first.factors();
        // The sign of a product is the sign of one factor only where it has only one.
        if (factors.size() != 2 || factors[1].second % 2 == 0) continue;
        const int flip = cln::minusp(factors[0].first.term_list()[0].first) ? -1 : 1;
        signs_.emplace_back(factors[1].first, positive ? flip : -flip);
      }
      for (const ex& e : expressions) convert(e);
      return;
    } catch (const Full&) {
    }
  }
}

Polynomial FunctionRing::convert(const ex& e) {
  if (GiNaC::is_a<GiNaC::numeric>(e)) {
    const GiNaC::numeric number = GiNaC::ex_to<GiNaC::numeric>(e);
    if (number.is_real()) return ring_->constant(rational(number));
  }
  if (const auto it = known_.find(e); it != known_.end()) return it->second;
  Polynomial p = convert_new(e);
  known_.emplace(e, p);
  return p;
}

Polynomial FunctionRing::convert_new(const ex& e) {
  if (GiNaC::is_a<GiNaC::symbol>(e)) {
    for (std::size_t i = 0; i < symbols_.size(); ++i) {
      if (symbols_[i].is_equal(GiNaC::ex_to<GiNaC::basic>(e))) return ring_->variable(i);
    }
    throw ModelError("an expression uses a symbol of another case");
  }
  if (GiNaC::is_a<GiNaC::numeric>(e)) {
    const GiNaC::numeric number = GiNaC::ex_to<GiNaC::numeric>(e);
    std::size_t index = 0;
    const Polynomial minus_one = ring_->constant(-1);
    const Polynomial i = find(Kind::imaginary, minus_one, 2, &index) != nullptr
                             ? ring_->variable(symbols_.size() + index)
                             : generator(Kind::imaginary, GiNaC::I, minus_one, 2,
                                         [&](const Polynomial&) { return Polynomial(*ring_); });
    return ring_->constant(rational(number.real())) + i.scaled(rational(number.imag()));
  }
  if (GiNaC::is_a<GiNaC::add>(e)) {
    Polynomial sum(*ring_);
    for (const ex& term : ordered_operands(e)) sum += convert(term);
    return sum;
  }
  if (GiNaC::is_a<GiNaC::mul>(e)) {
    Polynomial product = ring_->constant(1);
    for (const ex& factor : ordered_operands(e))
      product = checked_product(product, convert(factor));
    return product;
  }
  if (GiNaC::is_a<GiNaC::power>(e)) return convert_power(e.op(0), e.op(1));
  if (GiNaC::is_a<GiNaC::function>(e)) return convert_function(GiNaC::ex_to<GiNaC::function>(e));
  if (GiNaC::is_a<GiNaC::constant>(e)) {
    const Polynomial one = ring_->constant(1);
    std::size_t index = 0;
    if (find(Kind::function, one, 0, &index) != nullptr)
      return ring_->variable(symbols_.size() + index);
    return generator(Kind::function, e, one, 0,
                     [&](const Polynomial&) { return Polynomial(*ring_); });
  }
  throw ModelError("an expression that exact algebra does not know");
}

/// Text that orders expressions, the same in every process.
const std::string& FunctionRing::order_key(const ex& e) {
  const auto known = order_keys_.find(e);
  if (known != order_keys_.end()) return known->second;
  std::string key;
  if (e.nops() == 0) {
    std::ostringstream stream;
    stream << e;
    key = stream.str();
  } else {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < e.nops(); ++i) parts.push_back(order_key(e.op(i)));
    const bool commutes = GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e);
    if (commutes) std::sort(parts.begin(), parts.end());
    key = GiNaC::is_a<GiNaC::add>(e)        ? "+"
          : GiNaC::is_a<GiNaC::mul>(e)      ? "*"
          : GiNaC::is_a<GiNaC::function>(e) ? GiNaC::ex_to<GiNaC::function>(e).get_name()
                                            : "^";
    for (const std::string& part : parts) key += "(" + part + ")";
  }
  return order_keys_.emplace(e, std::move(key)).first->second;
}

/// Terms or factors. GiNaC orders them by memory addresses; where generators are made, their
/// numbers, and with them every printed text, would depend on that.
GiNaC::exvector FunctionRing::ordered_operands(const ex& e) {
  GiNaC::exvector operands(e.begin(), e.end());
  if (capacity_ == 0) return operands;
  std::sort(operands.begin(), operands.end(),
            [this](const ex& a, const ex& b) { return order_key(a) < order_key(b); });
  return operands;
}

Polynomial FunctionRing::checked_product(const Polynomial& a, const Polynomial& b) const {
  if (static_cast<double>(a.terms()) * static_cast<double>(b.terms()) > kMaxTerms * 20) {
    throw TooLarge("an expanded product would have too many terms");
  }
  return a * b;
}

Polynomial FunctionRing::power(const Polynomial& p, unsigned long exponent) const {
  if (p.terms() > 1 && log_binomial(static_cast<double>(p.terms()) - 1,
                                    static_cast<double>(exponent)) > std::log(kMaxTerms)) {
    // The bound by the number of monomials of that degree may be smaller.
    double used = 0;
    for (std::size_t i = 0; i < ring_->size(); ++i) used += p.uses(i) ? 1 : 0;
    const double degree = static_cast<double>(p.total_degree()) * static_cast<double>(exponent);
    if (log_binomial(used, degree) > std::log(kMaxTerms))
      throw TooLarge("an expanded power would have too many terms");
  }
  return p.pow(exponent);
}

Polynomial FunctionRing::convert_power(const ex& base, const ex& exponent) {
  if (!GiNaC::is_a<GiNaC::numeric>(exponent))
    return convert(GiNaC::exp(exponent * GiNaC::log(base)));
  const cln::cl_RA e = rational(GiNaC::ex_to<GiNaC::numeric>(exponent));
  const Polynomial b = convert(base);
  const cln::cl_I whole = cln::floor1(e);
  const cln::cl_RA part = e - whole;
  const long size = cln::cl_I_to_long(cln::abs(whole));
  Polynomial result = whole >= 0 ? power(b, static_cast<unsigned long>(size))
                                 : power(inverse(b), static_cast<unsigned long>(size));
  if (!cln::zerop(part)) {
    const unsigned long q = cln::cl_I_to_ulong(cln::denominator(part));
    result = checked_product(result, power(root(b, q), cln::cl_I_to_ulong(cln::numerator(part))));
  }
  return result;
}

Polynomial FunctionRing::convert_function(const GiNaC::function& f) {
  const std::string name = f.get_name();
  if (name == "sin") return sine_cosine(convert(f.op(0))).first;
  if (name == "cos") return sine_cosine(convert(f.op(0))).second;
  if (name == "tan") {
    const auto [s, c] = sine_cosine(convert(f.op(0)));
    return checked_product(s, inverse(c));
  }
  if (name == "exp") return exponential(convert(f.op(0)));
  const Polynomial v = convert(f.op(0));
  const Polynomial one = ring_->constant(1);
  const auto opaque = [&](const Polynomial& factor, const Polynomial& key, unsigned long tag) {
    std::size_t index = 0;
    if (find(Kind::function, key, tag, &index) != nullptr)
      return ring_->variable(symbols_.size() + index);
    return generator(Kind::function, f, key, tag,
                     [&](const Polynomial& slope) { return slope * factor; });
  };
  if (name == "log") return opaque(inverse(v), v, 1);
  if (name == "atan") return opaque(inverse(one + v * v), v, 2);
  if (name == "asin") return opaque(inverse(root(one - v * v, 2)), v, 3);
  if (name == "acos") return opaque(-inverse(root(one - v * v, 2)), v, 4);
  if (name == "atan2") {
    // D atan2(y, x) = (x Dy - y Dx)/(x^2 + y^2); the key is kept by its value.
    const Polynomial x = convert(f.op(1));
    const Polynomial scale = inverse(x * x + v * v);
    for (std::size_t i = 0; i < generators_.size(); ++i) {
      if (generators_[i].value.is_equal(f)) return ring_->variable(symbols_.size() + i);
    }
    std::vector<Polynomial> derivatives;
    for (std::size_t i = 0; i < symbols_.size(); ++i) {
      derivatives.push_back((x * derivative(v, i) - v * derivative(x, i)) * scale);
    }
    const Polynomial g =
        generator(Kind::function, f, one, 5, [&](const Polynomial&) { return Polynomial(*ring_); });
    generators_.back().derivatives = std::move(derivatives);
    return g;
  }
  throw ModelError("the function " + name + " has no derivation here");
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

Polynomial FunctionRing::generator(
    Kind kind, const ex& value, const Polynomial& base, unsigned long order,
    const std::function<Polynomial(const Polynomial& slope)>& derivative_of) {
  if (generators_.size() == capacity_) {
    capacity_ = capacity_ == 0 ? 4 : capacity_ + capacity_ / 2;
    throw Full{};
  }
  const std::size_t index = generators_.size();
  const std::vector<Polynomial> base_slopes = slopes(base);
  generators_.push_back({kind, value, base, order, {}});
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
    bottom = checked_product(bottom, generators_[g].base.pow(parts.size() - 1));
  }
  return {std::move(top), std::move(bottom)};
}

Polynomial FunctionRing::numerator(const Polynomial& p) const {
  Polynomial result = p;
  // Each relation leads to earlier generators only, so one sweep backwards is enough.
  for (std::size_t g = generators_.size(); g-- > 0;) {
    const Generator& generator = generators_[g];
    const std::size_t variable = symbols_.size() + g;
    if (!result.uses(variable)) continue;
    if (generator.kind == Kind::inverse) {
      Polynomial reduced(*ring_);
      for (const Polynomial& part : result.coefficients(variable))
        reduced = checked_product(reduced, generator.base) + part;
      result = std::move(reduced);
    } else if (generator.kind == Kind::cosine || generator.kind == Kind::root ||
               generator.kind == Kind::absolute || generator.kind == Kind::imaginary) {
      result = reduced_power(result, g);
    }
  }
  return result;
}

/// `p` with the relation u^q = b of one generator used up.
Polynomial FunctionRing::reduced_power(const Polynomial& p, std::size_t g) const {
  const Generator& generator = generators_[g];
  const Polynomial x = ring_->variable(symbols_.size() + g);
  const std::vector<Polynomial> parts = p.coefficients(symbols_.size() + g);
  Polynomial reduced(*ring_);
  for (std::size_t k = parts.size(); k-- > 0;)
    reduced += parts[k] * generator.base.pow(k / generator.order) * x.pow(k % generator.order);
  return reduced;
}

}  // namespace casimir
