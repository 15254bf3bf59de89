#include "symbolic/algebra/exact_constant.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/rational.h>
#include <cln/rational_io.h>

#include <map>
#include <set>
#include <vector>

#include "symbolic/algebra/integer_factors.hpp"
#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/elementary.hpp"

namespace casimir {
namespace {

using cln::cl_RA;
using GiNaC::ex;

/// None of the theorems applies.
struct Unknown {};

struct Less {
  bool operator()(const cl_RA& a, const cl_RA& b) const { return a < b; }
};

/// A product of p^e with 0 < e < 1, of I, of exp(a + b I), and of one logarithm or Pi.
struct RadicalTerm {
  std::map<cl_RA, cl_RA, Less> powers;  ///< prime to exponent
  bool imaginary = false;
  cl_RA exponent_real = 0, exponent_imaginary = 0;
  cl_RA logarithm = 0;  ///< of this prime; 0: none, 1: Pi

  friend int compare(const RadicalTerm& a, const RadicalTerm& b) {
    const auto three_way = [](const cl_RA& x, const cl_RA& y) { return cln::compare(x, y); };
    if (const int c = three_way(a.logarithm, b.logarithm)) return c;
    if (const int c = three_way(a.exponent_real, b.exponent_real)) return c;
    if (const int c = three_way(a.exponent_imaginary, b.exponent_imaginary)) return c;
    if (a.imaginary != b.imaginary) return a.imaginary ? 1 : -1;
    auto i = a.powers.begin();
    auto j = b.powers.begin();
    for (; i != a.powers.end() && j != b.powers.end(); ++i, ++j) {
      if (const int c = three_way(i->first, j->first)) return c;
      if (const int c = three_way(i->second, j->second)) return c;
    }
    return i != a.powers.end() ? 1 : j != b.powers.end() ? -1 : 0;
  }
  friend bool operator<(const RadicalTerm& a, const RadicalTerm& b) { return compare(a, b) < 0; }
};

using Sum = std::map<RadicalTerm, cl_RA>;

void add_to(Sum& sum, const RadicalTerm& monomial, const cl_RA& coefficient) {
  cl_RA& place = sum[monomial];
  place = place + coefficient;
  if (cln::zerop(place)) sum.erase(monomial);
}

Sum constant(const cl_RA& value) {
  Sum sum;
  if (!cln::zerop(value)) sum[RadicalTerm{}] = value;
  return sum;
}

/// p^e of a prime, any rational e: a rational factor times a power with 0 <= exponent < 1.
void take_power(RadicalTerm& monomial, cl_RA& coefficient, const cl_RA& prime,
                const cl_RA& exponent) {
  const cl_RA total =
      monomial.powers.contains(prime) ? monomial.powers[prime] + exponent : exponent;
  const cln::cl_I whole = cln::floor1(total);
  constexpr long kMaxPower = 10000;
  if (cln::abs(whole) > kMaxPower) throw Unknown{};
  coefficient = coefficient * cln::expt(prime, whole);
  const cl_RA rest = total - whole;
  if (cln::zerop(rest))
    monomial.powers.erase(prime);
  else
    monomial.powers[prime] = rest;
}

Sum product(const Sum& a, const Sum& b) {
  constexpr std::size_t kMaxTerms = 4000;
  if (a.size() * b.size() > kMaxTerms) throw Unknown{};
  Sum result;
  for (const auto& [m, c] : a) {
    for (const auto& [n, d] : b) {
      RadicalTerm monomial = m;
      cl_RA coefficient = c * d;
      for (const auto& [prime, exponent] : n.powers)
        take_power(monomial, coefficient, prime, exponent);
      if (m.imaginary && n.imaginary) coefficient = -coefficient;
      monomial.imaginary = m.imaginary != n.imaginary;
      monomial.exponent_real = m.exponent_real + n.exponent_real;
      monomial.exponent_imaginary = m.exponent_imaginary + n.exponent_imaginary;
      if (!cln::zerop(m.logarithm) && !cln::zerop(n.logarithm)) throw Unknown{};
      monomial.logarithm = m.logarithm + n.logarithm;
      add_to(result, monomial, coefficient);
    }
  }
  return result;
}

Sum sum_of(Sum a, const Sum& b) {
  for (const auto& [monomial, coefficient] : b) add_to(a, monomial, coefficient);
  return a;
}

/// Zero or not, of what is in normal form.
bool is_zero(const Sum& sum) {
  if (sum.empty()) return true;
  // Monomials of one exponential and one logarithm are its algebraic coefficient, which is not
  // zero.
  std::set<cl_RA, Less> logarithms;
  std::set<std::pair<std::string, std::string>> exponentials;
  for (const auto& [m, c] : sum) {
    logarithms.insert(m.logarithm);
    exponentials.emplace(rational_text(m.exponent_real), rational_text(m.exponent_imaginary));
  }
  const bool plain = logarithms.size() == 1;           // Lindemann and Weierstrass
  const bool linear_forms = exponentials.size() == 1;  // Baker; log p and I Pi are independent
  if (!plain && !linear_forms) throw Unknown{};
  return false;
}

struct Quotient {
  Sum top, bottom;
};

Quotient operator+(const Quotient& a, const Quotient& b) {
  return {sum_of(product(a.top, b.bottom), product(b.top, a.bottom)), product(a.bottom, b.bottom)};
}
Quotient operator*(const Quotient& a, const Quotient& b) {
  return {product(a.top, b.top), product(a.bottom, b.bottom)};
}
Quotient inverse(const Quotient& a) {
  if (is_zero(a.top)) throw Unknown{};
  return {a.bottom, a.top};
}

Quotient evaluate(const ex& e);

/// base^exponent where the base is one term without logarithms and exponentials.
Quotient root(const Quotient& base, const cl_RA& exponent) {
  if (base.top.size() != 1 || base.bottom.size() != 1) throw Unknown{};
  RadicalTerm result;
  cl_RA coefficient = 1;
  const auto take = [&](const Sum& side, int sign) {
    const auto& [m, c] = *side.begin();
    if (m.imaginary || !cln::zerop(m.logarithm) || !cln::zerop(m.exponent_real) ||
        !cln::zerop(m.exponent_imaginary) || cln::minusp(c)) {
      throw Unknown{};
    }
    for (const auto& [prime, power] : m.powers)
      take_power(result, coefficient, prime, sign * power * exponent);
    const std::pair<cln::cl_I, int> parts[] = {{cln::numerator(c), sign},
                                               {cln::denominator(c), -sign}};
    for (const auto& [integer, direction] : parts) {
      const auto factors = prime_factors(integer);
      if (!factors) throw Unknown{};
      for (const auto& [prime, times] : *factors)
        take_power(result, coefficient, prime, direction * cl_RA(cln::cl_I(times)) * exponent);
    }
  };
  take(base.top, 1);
  take(base.bottom, -1);
  return {Sum{{result, coefficient}}, constant(1)};
}

Quotient power(const Quotient& base, const ex& exponent) {
  if (!GiNaC::is_a<GiNaC::numeric>(exponent)) throw Unknown{};
  const GiNaC::numeric number = GiNaC::ex_to<GiNaC::numeric>(exponent);
  if (!number.is_rational()) throw Unknown{};
  if (!number.is_integer()) {
    const bool negative = base.top.size() == 1 && cln::minusp(base.top.begin()->second);
    if (negative && number.denom().is_equal(2)) {  // (-a)^(k/2) = I^k a^(k/2)
      RadicalTerm i;
      i.imaginary = true;
      const Quotient minus_one{constant(-1), constant(1)};
      return power({Sum{{i, 1}}, constant(1)}, number.numer()) *
             root(minus_one * base, cln::the<cln::cl_RA>(number.to_cl_N()));
    }
    return root(base, cln::the<cln::cl_RA>(number.to_cl_N()));
  }
  constexpr int kMaxExponent = 200;
  if (GiNaC::abs(number) > kMaxExponent) throw Unknown{};
  Quotient result{constant(1), constant(1)};
  for (int k = std::abs(number.to_int()); k > 0; --k) result = result * base;
  return number.is_negative() ? inverse(result) : result;
}

/// exp(a + b I) for rational a, b.
Quotient exponential(const cl_RA& real, const cl_RA& imaginary) {
  RadicalTerm m;
  m.exponent_real = real;
  m.exponent_imaginary = imaginary;
  return {Sum{{m, 1}}, constant(1)};
}

cl_RA rational_argument(const ex& argument) {
  if (!GiNaC::is_a<GiNaC::numeric>(argument)) throw Unknown{};
  const GiNaC::numeric number = GiNaC::ex_to<GiNaC::numeric>(argument);
  if (!number.is_rational()) throw Unknown{};
  return cln::the<cln::cl_RA>(number.to_cl_N());
}

Quotient logarithm(const cl_RA& argument) {
  if (argument <= 0) throw Unknown{};
  Sum sum;
  const std::pair<cln::cl_I, int> parts[] = {{cln::numerator(argument), 1},
                                             {cln::denominator(argument), -1}};
  for (const auto& [integer, sign] : parts) {
    const auto factors = prime_factors(integer);
    if (!factors) throw Unknown{};
    for (const auto& [prime, times] : *factors) {
      RadicalTerm m;
      m.logarithm = prime;
      add_to(sum, m, sign * cl_RA(cln::cl_I(times)));
    }
  }
  return {sum, constant(1)};
}

Quotient evaluate(const ex& e);

Quotient function_value(const GiNaC::function& f) {
  const std::string name = f.get_name();
  if (name == "log") return logarithm(rational_argument(f.op(0)));
  if (name == "exp") return exponential(rational_argument(f.op(0)), 0);
  if (const auto exponentials = by_exponentials(f)) return evaluate(*exponentials);
  if (name != "sin" && name != "cos" && name != "tan") throw Unknown{};
  const cl_RA angle = rational_argument(f.op(0));
  const Quotient forward = exponential(0, angle);
  const Quotient back = exponential(0, -angle);
  const Quotient minus_one{constant(-1), constant(1)};
  RadicalTerm i;
  i.imaginary = true;
  const Quotient sine = (forward + minus_one * back) * inverse({Sum{{i, 2}}, constant(1)});
  const Quotient cosine = (forward + back) * Quotient{constant(cln::cl_RA(1) / 2), constant(1)};
  return name == "sin" ? sine : name == "cos" ? cosine : sine * inverse(cosine);
}

Quotient evaluate(const ex& e) {
  if (GiNaC::is_a<GiNaC::numeric>(e)) {
    const GiNaC::numeric number = GiNaC::ex_to<GiNaC::numeric>(e);
    if (!number.is_crational()) throw Unknown{};
    Sum sum = constant(cln::the<cln::cl_RA>(number.real().to_cl_N()));
    RadicalTerm i;
    i.imaginary = true;
    add_to(sum, i, cln::the<cln::cl_RA>(number.imag().to_cl_N()));
    return {sum, constant(1)};
  }
  if (e.is_equal(GiNaC::Pi)) {
    RadicalTerm m;
    m.logarithm = 1;
    return {Sum{{m, 1}}, constant(1)};
  }
  if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
    Quotient result = evaluate(e.op(0));
    for (std::size_t k = 1; k < e.nops(); ++k) {
      const Quotient next = evaluate(e.op(k));
      result = GiNaC::is_a<GiNaC::add>(e) ? result + next : result * next;
    }
    return result;
  }
  if (GiNaC::is_a<GiNaC::power>(e)) return power(evaluate(e.op(0)), e.op(1));
  if (GiNaC::is_a<GiNaC::function>(e)) return function_value(GiNaC::ex_to<GiNaC::function>(e));
  throw Unknown{};
}

std::string text_of(const cl_RA& value) { return rational_text(value); }

std::string text_of(const RadicalTerm& m) {
  std::string text;
  const auto times = [&](const std::string& factor) { text += (text.empty() ? "" : "*") + factor; };
  for (const auto& [prime, exponent] : m.powers) {
    times(exponent == cln::cl_RA(1) / 2 ? "sqrt(" + text_of(prime) + ")"
                                        : text_of(prime) + "^(" + text_of(exponent) + ")");
  }
  if (!cln::zerop(m.exponent_real)) times("exp(" + text_of(m.exponent_real) + ")");
  if (!cln::zerop(m.exponent_imaginary)) times("exp(" + text_of(m.exponent_imaginary) + "*I)");
  if (!cln::zerop(m.logarithm))
    times(m.logarithm == 1 ? "Pi" : "log(" + text_of(m.logarithm) + ")");
  if (m.imaginary) times("I");
  return text;
}

std::string text_of(const Sum& sum) {
  std::string text;
  for (const auto& [monomial, coefficient] : sum) {
    const std::string factors = text_of(monomial);
    const bool minus = cln::minusp(coefficient);
    text += text.empty() ? (minus ? "-" : "") : (minus ? " - " : " + ");
    const bool unit = cln::abs(coefficient) == 1 && !factors.empty();
    if (!unit) text += text_of(cln::abs(coefficient)) + (factors.empty() ? "" : "*");
    text += factors;
  }
  return text.empty() ? "0" : text;
}

}  // namespace

std::optional<ExactConstant> exact_constant(const ex& value) {
  try {
    Quotient quotient = evaluate(value);
    if (is_zero(quotient.bottom)) return std::nullopt;
    const bool zero = is_zero(quotient.top);
    if (quotient.bottom.size() == 1 &&
        compare(quotient.bottom.begin()->first, RadicalTerm{}) == 0) {
      const cl_RA factor = quotient.bottom.begin()->second;
      for (auto& [monomial, coefficient] : quotient.top) coefficient = coefficient / factor;
      return ExactConstant{zero, text_of(quotient.top)};
    }
    return ExactConstant{zero,
                         "(" + text_of(quotient.top) + ")/(" + text_of(quotient.bottom) + ")"};
  } catch (const Unknown&) {
    return std::nullopt;
  }
}

std::optional<int> sign_of_constant(const ex& value, double bits) {
  if (GiNaC::is_a<GiNaC::numeric>(value)) {
    const GiNaC::numeric number = GiNaC::ex_to<GiNaC::numeric>(value);
    return number.is_real() ? std::optional(number.csgn()) : std::nullopt;
  }
  if (const auto exact = exact_constant(value); exact && exact->zero) return 0;
  // Which side of zero an irrational number is on is read off many digits, and only where they
  // leave no doubt.
  constexpr long kDigits = 60;
  const long before = GiNaC::Digits;
  GiNaC::Digits = kDigits;
  const std::optional<GiNaC::numeric> number = real_decimal(value, bits);
  GiNaC::Digits = before;
  const GiNaC::numeric doubt = GiNaC::numeric(10).power(-20);
  if (!number || GiNaC::abs(*number) < doubt) return std::nullopt;
  return number->csgn();
}

}  // namespace casimir
