#include "symbolic/expression/expression_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/decimal.hpp"

namespace casimir {

double bit_length(const GiNaC::numeric& number) {
  if (!number.is_crational()) return 64;
  return std::max<double>(number.numer().int_length(), number.denom().int_length());
}

namespace {

using GiNaC::ex;

/// Shared parts are looked at once, and count as often as they are used.
class SizeOfExpression {
 public:
  const Quantity& of(const ex& e) {
    if (const auto it = known_.find(e); it != known_.end()) return it->second;
    const Quantity q = fresh(e);
    return known_.emplace(e, q).first->second;
  }

 private:
  Quantity fresh(const ex& e) {
    if (GiNaC::is_a<GiNaC::numeric>(e))
      return {e, std::max(1.0, bit_length(GiNaC::ex_to<GiNaC::numeric>(e))), 0, 1};
    if (GiNaC::is_a<GiNaC::symbol>(e)) return {e, 1, 1, 1};
    if (e.nops() == 0) return {e, 1, 0, 1};
    if (GiNaC::is_a<GiNaC::power>(e)) return power(e);
    const bool sum = GiNaC::is_a<GiNaC::add>(e);
    Quantity q{e, 0, 0, GiNaC::is_a<GiNaC::function>(e) ? 1. : 0., 0};
    for (std::size_t i = 0; i < e.nops(); ++i) {
      const Quantity& part = of(e.op(i));
      q.bits = sum ? std::max(q.bits, part.bits) : q.bits + part.bits;
      q.degree = sum ? std::max(q.degree, part.degree) : q.degree + part.degree;
      q.nodes += part.nodes;
      q.depth = std::max(q.depth, part.depth);
    }
    if (sum) q.bits += std::ceil(std::log2(static_cast<double>(e.nops())));
    if (GiNaC::is_a<GiNaC::function>(e)) q.degree = std::max(1.0, q.degree);
    q.depth += 1;
    return q;
  }

  Quantity power(const ex& e) {
    const Quantity& base = of(e.op(0));
    const Quantity& exponent = of(e.op(1));
    Quantity q{e, base.bits, base.degree, base.nodes + exponent.nodes,
               1 + std::max(base.depth, exponent.depth)};
    if (GiNaC::is_a<GiNaC::numeric>(e.op(1))) {
      const double size = std::max(
          1.0, std::abs(GiNaC::ex_to<GiNaC::numeric>(GiNaC::abs(e.op(1)).evalf()).to_double()));
      q.bits *= size;
      q.degree *= size;
    } else {
      q.bits += exponent.bits;
      q.degree += exponent.degree;
    }
    return q;
  }

  std::unordered_map<ex, Quantity> known_;
};

/// Bits of the number that GiNaC raises to the power when it raises `base` to one; 0 where it
/// raises none.
double bits_of_base(const ex& base, const Limits& limits) {
  if (base.info(GiNaC::info_flags::rational)) return bit_length(GiNaC::ex_to<GiNaC::numeric>(base));
  if (GiNaC::is_a<GiNaC::mul>(base))
    return bits_of_base(base.op(base.nops() - 1), limits);  // its number
  const auto value = decimal(base, limits.bits);
  return value && !value->is_zero() ? std::abs(std::log2(GiNaC::abs(*value).to_double())) : 0;
}

/// Parts that are shared are put in once.
class Substitution : public GiNaC::map_function {
 public:
  Substitution(const GiNaC::exmap& values, const Limits& limits)
      : values_(values), limits_(limits) {}

  ex operator()(const ex& e) override {
    if (const auto it = values_.find(e); it != values_.end()) return it->second;
    if (e.nops() == 0) return e;
    if (const auto it = known_.find(e); it != known_.end()) return it->second;
    if (is_atan2(e) && (*this)(e.op(0)).is_zero() && (*this)(e.op(1)).is_zero()) throw NoAngle();
    const ex result = GiNaC::is_a<GiNaC::power>(e)
                          ? checked_power((*this)(e.op(0)), (*this)(e.op(1)), limits_)
                          : e.map(*this);
    return known_.emplace(e, result).first->second;
  }

 private:
  /// GiNaC's value of atan2(0, 0) is 0.
  static bool is_atan2(const ex& e) {
    return GiNaC::is_a<GiNaC::function>(e) && e.nops() == 2 &&
           GiNaC::ex_to<GiNaC::function>(e).get_name() == "atan2";
  }

  const GiNaC::exmap& values_;
  const Limits& limits_;
  std::unordered_map<ex, ex> known_;
};

}  // namespace

ex checked_power(const ex& base, const ex& exponent, const Limits& limits) {
  // GiNaC leaves other exponents than numbers as they are.
  const bool unit = base.is_zero() || base.is_equal(ex(1)) || base.is_equal(ex(-1));
  if (GiNaC::is_a<GiNaC::numeric>(exponent) && !unit) {
    const GiNaC::numeric size = GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>(exponent));
    if (size > 1 && size.to_double() * bits_of_base(base, limits) > limits.bits)
      throw TooLarge(fmt::format("a power would have more than {:g} bits", limits.bits), limits,
                     &Limits::bits);
  }
  return GiNaC::pow(base, exponent);
}

ex substituted(const ex& expression, const GiNaC::exmap& values, const Limits& limits) {
  return Substitution(values, limits)(expression);
}

bool is_fit_for_normal(const ex& expression) {
  GiNaC::numeric common = 1;
  GiNaC::numeric most = 1;
  for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part) {
    if (!GiNaC::is_a<GiNaC::power>(*part)) continue;
    const ex exponent = part->op(1);
    if (!exponent.info(GiNaC::info_flags::rational)) continue;
    const GiNaC::numeric number = GiNaC::ex_to<GiNaC::numeric>(exponent);
    common = GiNaC::lcm(common, number.denom());
    most = std::max(most, GiNaC::abs(number));
    constexpr int kMostBits = 29;  // derivatives and products add to it
    if ((common * most).int_length() > kMostBits) return false;
  }
  return true;
}

const ex& fit_for_normal(const ex& expression) {
  if (!is_fit_for_normal(expression))
    throw TooLarge(
        "the largest exponent here, times the common denominator of all, has more than eight "
        "digits");
  return expression;
}

double most_terms(const ex& expression) {
  double terms = 1;
  if (GiNaC::is_a<GiNaC::add>(expression)) {
    terms = 0;
    for (const ex& part : expression) terms += most_terms(part);
  } else if (GiNaC::is_a<GiNaC::mul>(expression)) {
    for (const ex& part : expression) terms *= most_terms(part);
  } else if (GiNaC::is_a<GiNaC::power>(expression) &&
             !expression.op(1).info(GiNaC::info_flags::posint)) {
    terms = most_terms(expression.op(0));
  } else if (GiNaC::is_a<GiNaC::power>(expression)) {
    // One for each monomial of degree n in the terms of the base: binomial(base - 1 + n, n).
    const double others = most_terms(expression.op(0)) - 1;
    const double n = GiNaC::ex_to<GiNaC::numeric>(expression.op(1)).to_double();
    const double less = std::min(others, n), more = std::max(others, n);
    for (double i = 1; i <= less && std::isfinite(terms); ++i) terms *= (more + i) / i;
  }
  return terms;
}

ex expanded_within(const ex& expression, double terms) {
  return most_terms(expression) > terms ? expression : expression.expand();
}

Quantity measured(const ex& value) {
  Quantity q = SizeOfExpression().of(value);
  q.value = value;
  return q;
}

}  // namespace casimir
