// Expressions to polynomials: a FunctionRing reads GiNaC's trees.
#include <cln/integer.h>
#include <cln/rational.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <sstream>
#include <unordered_map>

#include "symbolic/algebra/machine_word.hpp"
#include "symbolic/algebra/number_text.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/expression/elementary.hpp"
#include "symbolic/expression/pairs.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/functions/gaussian_argument.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

cln::cl_RA rational(const GiNaC::numeric& number) {
  if (!number.is_rational())
    throw ModelError("a number that is not rational in an exact expression");
  return cln::the<cln::cl_RA>(number.to_cl_N());
}

TooLarge too_many_terms(const char* what) {
  return TooLarge(fmt::format("an expanded {} would have more than {:g} terms; {}", what,
                              limits().terms, limit_hint(&Limits::terms)));
}

/// Numbers would grow until memory is full: roots of a high order in numbers with powers as high.
void check_bits(double bits) {
  if (bits > limits().bits)
    throw TooLarge(
        fmt::format("a number in an expanded polynomial would have more than {:.0f} bits; {}",
                    limits().bits, limit_hint(&Limits::bits)));
}

/// log of binomial(n + k, k): the number of terms of a general polynomial.
double log_binomial(double n, double k) {
  return std::lgamma(n + k + 1) - std::lgamma(n + 1) - std::lgamma(k + 1);
}

}  // namespace

const Polynomial& FunctionRing::convert(const ex& e) {
  if (const auto it = known_.find(e); it != known_.end()) return it->second;
  return known_.emplace(e, convert_new(e)).first->second;
}

Polynomial FunctionRing::convert_new(const ex& e) {
  if (GiNaC::is_exactly_a<GiNaC::add>(e)) return convert_sum(e);
  if (GiNaC::is_exactly_a<GiNaC::mul>(e)) return convert_product(e);
  if (GiNaC::is_a<GiNaC::symbol>(e)) return ring_->variable(place_of(e));
  if (GiNaC::is_a<GiNaC::power>(e)) return convert_power(e.op(0), e.op(1));
  if (GiNaC::is_a<GiNaC::numeric>(e)) return convert_number(GiNaC::ex_to<GiNaC::numeric>(e));
  if (GiNaC::is_a<GiNaC::function>(e)) return convert_function(GiNaC::ex_to<GiNaC::function>(e));
  if (GiNaC::is_a<GiNaC::constant>(e)) {
    const Polynomial one = ring_->constant(1);
    std::size_t index = 0;
    if (find(Kind::function, one, kConstant, &index) != nullptr)
      return ring_->variable(symbols_.size() + index);
    return generator(Kind::function, e, one, kConstant,
                     [&](const Polynomial&) { return Polynomial(*ring_); });
  }
  throw ModelError("an expression that exact algebra does not know");
}

std::size_t FunctionRing::place_of(const ex& symbol) const {
  const auto place = places_.find(symbol);
  if (place == places_.end()) throw ModelError("an expression uses a symbol of another case");
  return place->second;
}

Polynomial FunctionRing::convert_number(const GiNaC::numeric& number) {
  if (number.is_real()) return ring_->constant(rational(number));
  std::size_t index = 0;
  const Polynomial minus_one = ring_->constant(-1);
  const Polynomial i = find(Kind::imaginary, minus_one, 2, &index) != nullptr
                           ? ring_->variable(symbols_.size() + index)
                           : generator(Kind::imaginary, GiNaC::I, minus_one, 2,
                                       [&](const Polynomial&) { return Polynomial(*ring_); });
  return ring_->constant(rational(number.real())) + i.scaled(rational(number.imag()));
}

/// Multiplies `monomial` by base^exponent if that is a number or a whole power of a symbol, else
/// leaves it as it is.
bool FunctionRing::multiply_power(const ex& base, const ex& exponent, Monomial& monomial) const {
  const GiNaC::numeric& power = GiNaC::ex_to<GiNaC::numeric>(exponent);
  constexpr int kMaxBits = 20;
  if (!GiNaC::is_exactly_a<GiNaC::symbol>(base) || !power.is_pos_integer() ||
      power.int_length() > kMaxBits)
    return false;
  monomial.exponents[place_of(base)] += static_cast<unsigned long>(power.to_long());
  return true;
}

/// Multiplies `monomial` by `e` if that is a symbol, a whole power of one, or a product of such;
/// false otherwise, and then the monomial may have some of the factors.
bool FunctionRing::multiply_monomial(const ex& e, Monomial& monomial) const {
  if (GiNaC::is_exactly_a<GiNaC::symbol>(e)) {
    ++monomial.exponents[place_of(e)];
    return true;
  }
  if (GiNaC::is_exactly_a<GiNaC::mul>(e)) {
    if (!multiply_number(Pairs::number(e), monomial)) return false;
    for (const GiNaC::expair& pair : Pairs::of(e)) {
      if (!multiply_power(pair.rest, pair.coeff, monomial)) return false;
    }
    return true;
  }
  if (!GiNaC::is_exactly_a<GiNaC::power>(e)) return false;
  const ex exponent = e.op(1);
  return GiNaC::is_exactly_a<GiNaC::numeric>(exponent) &&
         multiply_power(e.op(0), exponent, monomial);
}

bool FunctionRing::multiply_number(const ex& e, Monomial& monomial) {
  const GiNaC::numeric& number = GiNaC::ex_to<GiNaC::numeric>(e);
  if (!number.is_rational()) return false;
  monomial.coefficient = monomial.coefficient * rational(number);
  return true;
}

/// Monomials are collected at once: made into polynomials and added one by one, a long sum of them
/// would cost the square of its length.
Polynomial FunctionRing::convert_sum(const ex& e) {
  TermCollector monomials(*ring_);
  GiNaC::exvector others;
  std::unordered_map<ex, cln::cl_RA> factors;  // of others, where not 1
  Monomial monomial;
  const auto restart = [&] {
    monomial.coefficient = 1;
    monomial.exponents.assign(ring_->size(), 0);
  };
  const GiNaC::epvector& pairs = Pairs::of(e);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    restart();
    const bool real = multiply_number(pairs[i].coeff, monomial);
    if (real && multiply_monomial(pairs[i].rest, monomial)) {
      monomials.add(monomial.coefficient, monomial.exponents);
      continue;
    }
    others.push_back(real ? pairs[i].rest : e.op(i));
    if (real && !pairs[i].coeff.is_equal(1))
      factors.emplace(pairs[i].rest, rational(GiNaC::ex_to<GiNaC::numeric>(pairs[i].coeff)));
  }
  restart();
  if (multiply_number(Pairs::number(e), monomial))
    monomials.add(monomial.coefficient, monomial.exponents);
  else
    others.push_back(Pairs::number(e));
  Polynomial first = monomials.finish();
  if (others.empty()) return first;
  order(others);
  std::vector<const Polynomial*> summands{&first};
  std::deque<Polynomial> multiples;
  for (const ex& term : others) {
    summands.push_back(&convert(term));
    const auto factor = factors.find(term);
    if (factor == factors.end()) continue;
    multiples.push_back(summands.back()->scaled(factor->second));
    summands.back() = &multiples.back();
  }
  return Polynomial::sum(*ring_, std::move(summands));
}

Polynomial FunctionRing::convert_product(const ex& e) {
  Monomial monomial{1, std::vector<unsigned long>(ring_->size())};
  GiNaC::exvector others;
  const GiNaC::epvector& pairs = Pairs::of(e);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!multiply_power(pairs[i].rest, pairs[i].coeff, monomial)) others.push_back(e.op(i));
  }
  if (!multiply_number(Pairs::number(e), monomial)) others.push_back(Pairs::number(e));
  TermCollector collector(*ring_);
  collector.add(monomial.coefficient, monomial.exponents);
  Polynomial product = collector.finish();
  order(others);
  for (const ex& factor : others) product = checked_product(product, convert(factor));
  return product;
}

namespace {

std::string text_of(const GiNaC::numeric& number) {
  if (number.is_integer() && GiNaC::abs(number) < 1000) return std::to_string(number.to_int());
  std::ostringstream stream;
  stream << number;
  return stream.str();
}

}  // namespace

/// Text that orders expressions, the same in every process.
const std::string& FunctionRing::order_key(const ex& e) {
  const auto known = order_keys_.find(e);
  if (known != order_keys_.end()) return known->second;
  std::string key;
  if (GiNaC::is_exactly_a<GiNaC::symbol>(e)) {
    key = GiNaC::ex_to<GiNaC::symbol>(e).get_name();
  } else if (e.nops() == 0) {
    key = GiNaC::is_exactly_a<GiNaC::numeric>(e) ? text_of(GiNaC::ex_to<GiNaC::numeric>(e))
                                                 : expression_text(e);
  } else if (GiNaC::is_exactly_a<GiNaC::add>(e)) {
    key = order_key_of_sum(e);
  } else {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < e.nops(); ++i) parts.push_back(order_key(e.op(i)));
    if (GiNaC::is_a<GiNaC::mul>(e)) std::sort(parts.begin(), parts.end());
    key = GiNaC::is_a<GiNaC::mul>(e)        ? "*"
          : GiNaC::is_a<GiNaC::function>(e) ? GiNaC::ex_to<GiNaC::function>(e).get_name()
                                            : "^";
    for (const std::string& part : parts) key += "(" + part + ")";
  }
  return order_keys_.emplace(e, std::move(key)).first->second;
}

/// Up to the sign of the whole: GiNaC makes (a - b)^2 of (b - a)^2 or the other way round, by the
/// addresses of a and b.
std::string FunctionRing::order_key_of_sum(const ex& e) {
  std::vector<std::pair<std::string, GiNaC::numeric>> parts;
  for (const GiNaC::expair& pair : Pairs::of(e))
    parts.emplace_back(order_key(pair.rest), GiNaC::ex_to<GiNaC::numeric>(pair.coeff));
  parts.emplace_back("", GiNaC::ex_to<GiNaC::numeric>(Pairs::number(e)));
  std::sort(parts.begin(), parts.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  int sign = 0;
  std::string result = "+";
  for (const auto& [key, coefficient] : parts) {
    if (sign == 0) sign = coefficient.csgn();
    result += "(" + text_of(sign < 0 ? -coefficient : coefficient) + "*" + key + ")";
  }
  return result;
}

/// GiNaC orders terms and factors by memory addresses; where generators are made, their numbers,
/// and with them every printed text, would depend on that.
void FunctionRing::order(GiNaC::exvector& operands) {
  if (capacity_ == 0 || operands.size() < 2) return;
  std::sort(operands.begin(), operands.end(),
            [this](const ex& a, const ex& b) { return order_key(a) < order_key(b); });
}

Polynomial FunctionRing::checked_product(const Polynomial& a, const Polynomial& b) const {
  // Products that cancel or coincide are fewer than the pairs of terms.
  constexpr double kPairs = 100;
  if (static_cast<double>(a.terms()) * static_cast<double>(b.terms()) > limits().terms * kPairs)
    throw too_many_terms("product");
  check_bits(a.bits() + b.bits());
  Polynomial product = a * b;
  if (static_cast<double>(product.terms()) > limits().terms) throw too_many_terms("product");
  return product;
}

Polynomial FunctionRing::power(const Polynomial& p, unsigned long exponent) const {
  if (p.terms() > 1 && log_binomial(static_cast<double>(p.terms()) - 1,
                                    static_cast<double>(exponent)) > std::log(limits().terms)) {
    // The bound by the number of monomials of that degree may be smaller.
    double used = 0;
    for (std::size_t i = 0; i < ring_->size(); ++i) used += p.uses(i) ? 1 : 0;
    const double degree = static_cast<double>(p.total_degree()) * static_cast<double>(exponent);
    if (log_binomial(used, degree) > std::log(limits().terms)) throw too_many_terms("power");
  }
  // The bits of a unit, 1 for its numerator, denominator and content, are not its own.
  check_bits((p.bits() - 3) * static_cast<double>(exponent));
  return p.pow(exponent);
}

Polynomial FunctionRing::convert_power(const ex& base, const ex& exponent) {
  if (!GiNaC::is_a<GiNaC::numeric>(exponent) ||
      !GiNaC::ex_to<GiNaC::numeric>(exponent).is_rational())
    return convert(GiNaC::exp(exponent * GiNaC::log(base)));
  const cln::cl_RA e = rational(GiNaC::ex_to<GiNaC::numeric>(exponent));
  const Polynomial b = convert(base);
  const cln::cl_I whole = cln::floor1(e);
  const cln::cl_RA part = e - whole;
  // GiNaC makes x^(-1/2) of both, and sqrt(-1) is not what 1/sqrt(-1) is.
  if (complex_ && capacity_ > 0 && cln::minusp(e) && !cln::zerop(part) &&
      (known_sign(b) <= 0 || !is_real_everywhere(b)))
    throw TooLarge(
        "with complex numbers, (1/x)^(1/2) and 1/x^(1/2) differ where x < 0, and are not told "
        "apart "
        "here");
  const unsigned long size = machine_word(whole);
  Polynomial result = power(whole >= 0 ? b : inverse(b), size);
  if (!cln::zerop(part)) {
    // 1/sqrt(x) has a value for x > 0 alone.
    if (cln::minusp(e) && cln::evenp(cln::denominator(part)) && !complex_) {
      const auto [top, bottom] = fraction(b);
      imply_radicand(factors_of(checked_product(numerator(top), bottom)), true);
    }
    const Polynomial one = root(b, machine_word(cln::denominator(part)));
    result = checked_product(result, power(one, machine_word(cln::numerator(part))));
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
  // So what holds among exponentials, of equal arguments and of multiples of each other, holds for
  // these too. The sum that tanh is divided by vanishes nowhere over the real numbers, and over the
  // complex ones tanh has no value where it does.
  if (const auto exponentials = by_exponentials(f)) return convert(*exponentials);
  const Polynomial v = convert(f.op(0));
  const Polynomial one = ring_->constant(1);
  const auto opaque = [&](const Polynomial& factor, const Polynomial& key, unsigned long tag) {
    std::size_t index = 0;
    if (find(Kind::function, key, tag, &index) != nullptr)
      return ring_->variable(symbols_.size() + index);
    if (const auto known = known_inverse(f)) return *known;
    return generator(Kind::function, f, key, tag,
                     [&](const Polynomial& slope) { return slope * factor; });
  };
  if (name == "log") return logarithm(f, v);
  if (name == "atan" && !complex_ && v.is_constant() && !v.is_zero()) {
    // Between arctangents of rational numbers and Pi there are relations, as Machin's.
    if (const auto known = gaussian_argument(v.term_list()[0].first)) {
      Polynomial sum = convert(GiNaC::Pi).scaled(cln::cl_RA(known->quarters) / 4);
      for (const auto& [part, times] : known->parts)
        sum += convert(GiNaC::atan(ex(GiNaC::numeric(part)))).scaled(times);
      return sum;
    }
  }
  if (name == "atan") return opaque(inverse(one + v * v), v, kArcTangent);
  if (name == "asin" || name == "acos") {
    // Of x/|x| it is a quarter of a turn, of that sign; it has no slope.
    if (!complex_ && numerator(one - checked_product(v, v)).is_zero()) {
      const Polynomial quarter = convert(GiNaC::Pi).scaled(cln::cl_RA(1) / 2);
      return checked_product(name == "asin" ? v : one - v, quarter);
    }
    imply_between(v);
    const Polynomial slope = inverse(root(one - v * v, 2));
    return name == "asin" ? opaque(slope, v, kArcSine) : opaque(-slope, v, kArcCosine);
  }
  if (name == "atan2") {
    // D atan2(y, x) = (x Dy - y Dx)/(x^2 + y^2); the key is kept by its value.
    const Polynomial x = convert(f.op(1));
    const Polynomial scale = inverse(x * x + v * v);
    for (std::size_t i = 0; i < generators_.size(); ++i) {
      if (generators_[i].value.is_equal(f)) return ring_->variable(symbols_.size() + i);
    }
    if (const auto known = known_inverse(f)) return *known;
    std::vector<Polynomial> derivatives;
    for (std::size_t i = 0; i < symbols_.size(); ++i) {
      derivatives.push_back((x * derivative(v, i) - v * derivative(x, i)) * scale);
    }
    const Polynomial g = generator(Kind::function, f, one, kArcTangentOfTwo,
                                   [&](const Polynomial&) { return Polynomial(*ring_); });
    generators_.back().derivatives = std::move(derivatives);
    return g;
  }
  throw ModelError("the function " + name + " has no derivation here");
}

}  // namespace casimir
