#include "symbolic/function_ring.hpp"

#include <cln/integer.h>
#include <cln/rational.h>
#include <cln/rational_io.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace casimir {
namespace {

using GiNaC::ex;

constexpr double kMaxTerms = 5e6;
constexpr long kMaxMultiple = 64;

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
    for (std::size_t i = 0; i < e.nops(); ++i) sum += convert(e.op(i));
    return sum;
  }
  if (GiNaC::is_a<GiNaC::mul>(e)) {
    Polynomial product = ring_->constant(1);
    for (std::size_t i = 0; i < e.nops(); ++i) product = checked_product(product, convert(e.op(i)));
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
    const std::vector<Polynomial> parts = result.coefficients(variable);
    Polynomial reduced(*ring_);
    if (generator.kind == Kind::inverse) {
      for (const Polynomial& part : parts)
        reduced = checked_product(reduced, generator.base) + part;
    } else if (generator.kind == Kind::cosine || generator.kind == Kind::root ||
               generator.kind == Kind::absolute || generator.kind == Kind::imaginary) {
      const Polynomial x = ring_->variable(variable);
      for (std::size_t k = parts.size(); k-- > 0;) {
        reduced += parts[k] * generator.base.pow(k / generator.order) * x.pow(k % generator.order);
      }
    } else {
      continue;
    }
    result = std::move(reduced);
  }
  return result;
}

/// The generators 1/f of the irreducible factors f of a denominator.
Polynomial FunctionRing::inverse(const Polynomial& p) {
  const auto [top, bottom] = fraction(p);
  if (numerator(top).is_zero())
    throw ModelError("division by an expression that is identically zero");
  Polynomial result = bottom;
  for (const auto& [factor, exponent] : top.factors()) {
    if (factor.is_constant()) {
      result = result.scaled(1 / factor.term_list()[0].first);
      continue;
    }
    std::size_t index = 0;
    Polynomial y(*ring_);
    if (find(Kind::inverse, factor, 1, &index) != nullptr) {
      y = ring_->variable(symbols_.size() + index);
    } else {
      const Polynomial next =
          ring_->variable(std::min(symbols_.size() + generators_.size(), ring_->size() - 1));
      y = generator(Kind::inverse, 1 / expression(factor), factor, 1,
                    [&](const Polynomial& slope) { return -(slope * next * next); });
    }
    result = checked_product(result, y.pow(exponent));
  }
  return result;
}

/// The sign that the assumptions give to an irreducible polynomial, or 0.
int FunctionRing::known_sign(const Polynomial& p) const {
  for (const auto& [polynomial, sign] : signs_) {
    if (polynomial == p) return sign;
    if (polynomial == -p) return -sign;
  }
  return 0;
}

Polynomial FunctionRing::absolute(const Polynomial& p) {
  const int sign = known_sign(p);
  if (sign != 0) return sign > 0 ? p : -p;
  std::size_t index = 0;
  const Polynomial square = p * p;
  if (find(Kind::absolute, square, 2, &index) != nullptr)
    return ring_->variable(symbols_.size() + index);
  const Polynomial over = inverse(square);
  const Polynomial next =
      ring_->variable(std::min(symbols_.size() + generators_.size(), ring_->size() - 1));
  return generator(
      Kind::absolute, GiNaC::sqrt(expression(square)), square, 2,
      [&](const Polynomial& slope) { return (slope * next * over).scaled(cln::cl_RA(1) / 2); });
}

/// p^(1/q): over a common denominator, and with q-th powers taken out of the radicand.
Polynomial FunctionRing::root(const Polynomial& p, unsigned long q) {
  const auto [top, bottom] = fraction(p);
  if (numerator(top).is_zero()) return Polynomial(*ring_);
  const bool even = q % 2 == 0;
  // For an odd root the branch on negative numbers is a convention that nothing may rest on.
  const auto outside = [&](const Polynomial& f, unsigned long k) {
    return even && k % 2 == 1 ? absolute(f).pow(k) : f.pow(k);
  };
  Polynomial factor = ring_->constant(1);
  Polynomial radicand = ring_->constant(1);
  for (const auto& [f, exponent] : bottom.factors()) {
    if (f.is_constant()) {
      radicand = radicand.scaled(1 / f.term_list()[0].first);
      continue;
    }
    if (!even && known_sign(f) <= 0) return plain_root(p, q);
    const unsigned long k = (exponent + q - 1) / q;
    factor = checked_product(factor, inverse(outside(f, k)));
    radicand = checked_product(radicand, f.pow(k * q - exponent));
  }
  radicand = checked_product(radicand, top);
  Polynomial inside = ring_->constant(1);
  for (const auto& [f, exponent] : radicand.factors()) {
    const bool keep = f.is_constant() || (!even && known_sign(f) <= 0);
    inside = checked_product(inside, keep ? f.pow(exponent) : f.pow(exponent % q));
    if (!keep && exponent >= q) factor = checked_product(factor, outside(f, exponent / q));
  }
  // The positive constant factor has a root of its own, so that sqrt(2 x) = sqrt(2) sqrt(x).
  const cln::cl_RA content = cln::abs(inside.content());
  factor = checked_product(factor, number_root(content, q));
  inside = inside.scaled(1 / content);
  return inside == ring_->constant(1) ? factor : checked_product(factor, plain_root(inside, q));
}

/// r^(1/q) for r > 0, by roots of primes: so that sqrt(6) = sqrt(2) sqrt(3).
Polynomial FunctionRing::number_root(const cln::cl_RA& r, unsigned long q) {
  const cln::cl_I denominator = cln::denominator(r);
  cln::cl_I rest = cln::numerator(r) * cln::expt_pos(denominator, cln::cl_I(q - 1));
  Polynomial result = ring_->constant(1 / cln::cl_RA(denominator));
  const auto take = [&](const cln::cl_I& p, unsigned long times) {
    result = result.scaled(cln::expt(p, cln::cl_I(times / q)));
    if (times % q != 0)
      result = checked_product(result, plain_root(ring_->constant(p), q).pow(times % q));
  };
  constexpr long kTrialDivisors = 2000;
  for (long p = 2; p < kTrialDivisors && rest > 1; ++p) {
    unsigned long times = 0;
    for (; cln::zerop(cln::mod(rest, p)); ++times) rest = cln::exquo(rest, cln::cl_I(p));
    if (times > 0) take(p, times);
  }
  cln::cl_I whole;
  if (cln::rootp(rest, static_cast<unsigned>(q), &whole)) return result.scaled(whole);
  take(rest, 1);
  return result;
}

Polynomial FunctionRing::plain_root(const Polynomial& radicand, unsigned long q) {
  std::size_t index = 0;
  if (find(Kind::root, radicand, q, &index) != nullptr)
    return ring_->variable(symbols_.size() + index);
  const Polynomial over = radicand.is_constant() ? radicand : inverse(radicand);
  const Polynomial next =
      ring_->variable(std::min(symbols_.size() + generators_.size(), ring_->size() - 1));
  return generator(Kind::root,
                   GiNaC::pow(expression(radicand), GiNaC::numeric(1, static_cast<long>(q))),
                   radicand, q, [&](const Polynomial& slope) {
                     return (slope * next * over).scaled(cln::cl_RA(1) / static_cast<long>(q));
                   });
}

/// The unit m/L of a monomial m in an angle or exponent, and how often the term contains it.
std::pair<Polynomial, cln::cl_I> FunctionRing::unit_of(const std::vector<unsigned long>& monomial,
                                                       const cln::cl_RA& coefficient) {
  Polynomial m = ring_->constant(1);
  for (std::size_t i = 0; i < monomial.size(); ++i) {
    if (monomial[i] > 0) m *= ring_->variable(i).pow(monomial[i]);
  }
  const ex key = expression(m);
  auto it = std::find_if(units_.begin(), units_.end(),
                         [&](const auto& unit) { return unit.first.is_equal(key); });
  if (it == units_.end()) {
    units_.emplace_back(key, cln::denominator(coefficient));
    it = units_.end() - 1;
  }
  const cln::cl_I finer = cln::lcm(it->second, cln::denominator(coefficient));
  if (finer != it->second) {
    it->second = finer;
    throw Full{};
  }
  const cln::cl_RA times = coefficient * finer;
  return {m.scaled(1 / cln::cl_RA(finer)), cln::numerator(times)};
}

std::pair<Polynomial, Polynomial> FunctionRing::sine_cosine(const Polynomial& angle) {
  Polynomial s(*ring_);
  Polynomial c = ring_->constant(1);
  for (const auto& [coefficient, monomial] : angle.term_list()) {
    const auto [unit, times] = unit_of(monomial, coefficient);
    if (cln::abs(times) > kMaxMultiple) throw TooLarge("a multiple of an angle is too large");
    const ex angle_value = expression(unit);
    std::size_t index = 0;
    Polynomial s1(*ring_);
    Polynomial c1(*ring_);
    if (find(Kind::sine, unit, 1, &index) != nullptr) {
      s1 = ring_->variable(symbols_.size() + index);
      c1 = ring_->variable(symbols_.size() + index + 1);
    } else {
      if (generators_.size() + 2 > capacity_) {
        capacity_ = capacity_ == 0 ? 4 : capacity_ + capacity_ / 2;
        throw Full{};
      }
      s1 = ring_->variable(symbols_.size() + generators_.size());
      c1 = ring_->variable(symbols_.size() + generators_.size() + 1);
      const std::vector<Polynomial> unit_slopes = slopes(unit);
      Generator sine{Kind::sine, GiNaC::sin(angle_value), unit, 1, {}};
      // The relation c^2 = 1 - s^2 is stored as the "radicand" of c.
      Generator cosine{Kind::cosine, GiNaC::cos(angle_value), ring_->constant(1) - s1 * s1, 2, {}};
      for (const Polynomial& slope : unit_slopes) {
        sine.derivatives.push_back(c1 * slope);
        cosine.derivatives.push_back(-(s1 * slope));
      }
      generators_.push_back(std::move(sine));
      generators_.push_back(std::move(cosine));
    }
    if (cln::minusp(times)) s1 = -s1;
    for (long k = cln::cl_I_to_long(cln::abs(times)); k > 0; --k) {
      Polynomial next = s * c1 + c * s1;
      c = c * c1 - s * s1;
      s = std::move(next);
    }
  }
  return {std::move(s), std::move(c)};
}

Polynomial FunctionRing::exponential(const Polynomial& exponent) {
  Polynomial result = ring_->constant(1);
  for (const auto& [coefficient, monomial] : exponent.term_list()) {
    const auto [unit, times] = unit_of(monomial, coefficient);
    if (cln::abs(times) > kMaxMultiple) throw TooLarge("a multiple of an exponent is too large");
    std::size_t index = 0;
    Polynomial e(*ring_);
    if (find(Kind::exponential, unit, 1, &index) != nullptr) {
      e = ring_->variable(symbols_.size() + index);
    } else {
      const Polynomial next =
          ring_->variable(std::min(symbols_.size() + generators_.size(), ring_->size() - 1));
      e = generator(Kind::exponential, GiNaC::exp(expression(unit)), unit, 1,
                    [&](const Polynomial& slope) { return slope * next; });
    }
    const Polynomial base = cln::minusp(times) ? inverse(e) : e;
    result = checked_product(result, base.pow(cln::cl_I_to_ulong(cln::abs(times))));
  }
  return result;
}

ex FunctionRing::expression(const Polynomial& p) const {
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

std::string FunctionRing::text(const Polynomial& p) const {
  std::string result;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    std::string factors;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      if (!factors.empty()) factors += "*";
      factors +=
          i < symbols_.size() ? symbols_[i].get_name() : name(generators_[i - symbols_.size()]);
      if (exponents[i] > 1) factors += "^" + std::to_string(exponents[i]);
    }
    std::ostringstream number;
    number << cln::abs(coefficient);
    const bool unit = cln::abs(coefficient) == 1 && !factors.empty();
    const std::string sign =
        cln::minusp(coefficient) ? (result.empty() ? "-" : " - ") : (result.empty() ? "" : " + ");
    result += sign + (unit ? "" : number.str()) + (unit || factors.empty() ? "" : "*") + factors;
  }
  return result.empty() ? "0" : result;
}

std::string FunctionRing::name(const Generator& g) const {
  switch (g.kind) {
    case Kind::sine:
      return "sin(" + text(g.base) + ")";
    case Kind::cosine: {
      // Its sine stands just before it and has the angle.
      const auto index = static_cast<std::size_t>(&g - generators_.data());
      return "cos(" + text(generators_[index - 1].base) + ")";
    }
    case Kind::exponential:
      return "exp(" + text(g.base) + ")";
    case Kind::root:
      return g.order == 2 ? "sqrt(" + text(g.base) + ")"
                          : "(" + text(g.base) + ")^(1/" + std::to_string(g.order) + ")";
    case Kind::inverse:
      return "(1/(" + text(g.base) + "))";
    case Kind::absolute:
      return "sqrt(" + text(g.base) + ")";
    case Kind::imaginary:
      return "I";
    case Kind::function:
      break;
  }
  std::ostringstream stream;
  stream << g.value;
  return stream.str();
}

bool FunctionRing::complete(std::vector<cln::cl_RA>& point,
                            const std::function<cln::cl_RA()>& draw) const {
  point.resize(ring_->size(), 0);
  for (std::size_t g = 0; g < generators_.size(); ++g) {
    const Generator& generator = generators_[g];
    cln::cl_RA& value = point[symbols_.size() + g];
    switch (generator.kind) {
      case Kind::sine: {
        const cln::cl_RA t = draw();
        value = 2 * t / (1 + t * t);
        point[symbols_.size() + g + 1] = (1 - t * t) / (1 + t * t);
        break;
      }
      case Kind::cosine:
        break;
      case Kind::exponential:
        value = cln::abs(draw());
        if (cln::zerop(value)) return false;
        break;
      case Kind::function:
        value = draw();
        break;
      case Kind::imaginary:
        return false;
      case Kind::inverse: {
        const cln::cl_RA d = generator.base.evaluate(point);
        if (cln::zerop(d)) return false;
        value = 1 / d;
        break;
      }
      case Kind::root:
      case Kind::absolute: {
        const cln::cl_RA b = generator.base.evaluate(point);
        if (cln::minusp(b)) return false;
        if (!cln::rootp(b, static_cast<unsigned>(generator.order), &value)) return false;
        break;
      }
    }
  }
  return true;
}

std::vector<Polynomial> FunctionRing::denominators() const {
  std::vector<Polynomial> result;
  for (const Generator& g : generators_) {
    if (g.kind == Kind::inverse) result.push_back(g.base);
  }
  return result;
}

bool FunctionRing::is_polynomial(const Polynomial& p) const {
  for (std::size_t g = 0; g < generators_.size(); ++g) {
    if (p.uses(symbols_.size() + g)) return false;
  }
  return true;
}

}  // namespace casimir
