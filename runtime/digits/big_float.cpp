#include "runtime/digits/big_float.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/program/arb_function.hpp"

namespace casimir {

thread_local slong BigFloat::bits = 64;

namespace {

/// An integer of FLINT.
struct Integer {
  Integer() { fmpz_init(value); }
  ~Integer() { fmpz_clear(value); }
  Integer(const Integer&) = delete;
  Integer& operator=(const Integer&) = delete;
  fmpz_t value;
};

void assign(Integer& target, const cln::cl_I& value) {
  constexpr std::size_t kWord = 32;
  const cln::cl_I size = cln::abs(value);
  std::vector<ulong> words;  // one at least
  for (std::size_t at = 0; at == 0 || at < cln::integer_length(size); at += 2 * kWord) {
    const auto half = [&](std::size_t from) {
      return cln::cl_I_to_ulong(cln::ldb(size, cln::cl_byte(kWord, from)));
    };
    words.push_back(half(at) | half(at + kWord) << kWord);
  }
  fmpz_set_ui_array(target.value, words.data(), static_cast<slong>(words.size()));
  if (cln::minusp(value)) fmpz_neg(target.value, target.value);
}

cln::cl_I to_cln(const Integer& value) {
  if (fmpz_is_zero(value.value)) return 0;
  std::vector<ulong> words(fmpz_size(value.value));
  Integer absolute;  // the words of negative numbers cannot be asked for
  fmpz_abs(absolute.value, value.value);
  fmpz_get_ui_array(words.data(), static_cast<slong>(words.size()), absolute.value);
  cln::cl_I size = 0;
  for (auto word = words.rbegin(); word != words.rend(); ++word)
    size = cln::ash(size, FLINT_BITS) + cln::cl_I(*word);
  return fmpz_sgn(value.value) < 0 ? -size : size;
}

/// A function of Arb's on a number that is exact; its error bound is below the last place.
template <class Function, class... Numbers>
BigFloat applied_to(Function function, const Numbers&... numbers) {
  BigFloat result;
  function(result.ball(), numbers.ball()..., BigFloat::precision());
  mag_zero(arb_radref(result.ball()));
  if (!result.finite()) throw std::domain_error("the value is not a finite number");
  return result;
}

}  // namespace

BigFloat::BigFloat(const cln::cl_R& exact) : BigFloat() {
  const cln::cl_RA value = cln::rational(exact);
  Integer numerator, denominator;
  assign(numerator, cln::numerator(value));
  assign(denominator, cln::denominator(value));
  arf_fmpz_div_fmpz(mid(), numerator.value, denominator.value, bits, ARF_RND_NEAR);
}

cln::cl_RA BigFloat::rational() const {
  Integer mantissa, exponent;
  arf_get_fmpz_2exp(mantissa.value, exponent.value, mid());
  const cln::cl_I power = cln::ash(1, cln::abs(to_cln(exponent)));
  return fmpz_sgn(exponent.value) < 0 ? to_cln(mantissa) / power : to_cln(mantissa) * power;
}

double BigFloat::log2() const {
  if (is_zero()) return -std::numeric_limits<double>::infinity();
  mp_srcptr limbs = nullptr;
  mp_size_t count = 0;
  ARF_GET_MPN_READONLY(limbs, count, mid());
  return fmpz_get_d(ARF_EXPREF(mid())) + std::log2(static_cast<double>(limbs[count - 1])) -
         FLINT_BITS;
}

using A = Arithmetic<BigFloat>;

BigFloat A::pi() {
  BigFloat result;
  arb_const_pi(result.ball(), BigFloat::precision());
  mag_zero(arb_radref(result.ball()));
  return result;
}

BigFloat A::divide(const N& a, const N& b) {
  if (b.is_zero()) throw std::domain_error("division by zero");
  return a / b;
}

BigFloat A::sqrt(const N& a) {
  if (a.sign() < 0) throw std::domain_error("square root of a negative number");
  return applied_to(arb_sqrt, a);
}

BigFloat A::power(const N& a, const N& e) {
  if (a.sign() <= 0) throw std::domain_error("broken power of a number that is not positive");
  return applied_to(arb_pow, a, e);
}

BigFloat A::function(Op op, const N& a) {
  if (op == Op::tan) return divide(function(Op::sin, a), function(Op::cos, a));
  return applied_to(arb_function(op), a);
}

BigFloat A::log(const N& a) {
  if (a.sign() <= 0) throw std::domain_error("logarithm of a number that is not positive");
  return applied_to(arb_log, a);
}

BigFloat A::asin(const N& a) {
  if (arf_cmpabs_2exp_si(a.mid(), 0) > 0) throw std::domain_error("arcsine of a number above 1");
  return applied_to(arb_asin, a);
}

BigFloat A::acos(const N& a) {
  if (arf_cmpabs_2exp_si(a.mid(), 0) > 0) throw std::domain_error("arccosine of a number above 1");
  return applied_to(arb_acos, a);
}

BigFloat A::atan2(const N& y, const N& x) {
  if (y.is_zero() && x.is_zero()) throw std::domain_error("the angle of the origin");
  return applied_to(arb_atan2, y, x);
}

BigFloat A::convolution(const Series& u, const Series& v, int k, int from, int to) {
  BigFloat sum;
  if (to < from) return sum;
  const auto at = [](const Series& s, int j) { return s[static_cast<std::size_t>(j)].ball(); };
  const slong bits = BigFloat::precision();
  if (&u != &v || from + to != k) {
    arb_approx_dot(sum.ball(), nullptr, 0, at(u, from), 1, at(v, k - from), -1, to - from + 1,
                   bits);
    return sum;
  }
  // A square: each product of two different coefficients occurs twice.
  const int half = (k + 1) / 2;
  arb_approx_dot(sum.ball(), nullptr, 0, at(u, from), 1, at(u, k - from), -1, half - from, bits);
  arf_mul_2exp_si(sum.mid(), sum.mid(), 1);
  if (k % 2 == 0) {
    const BigFloat& middle = u[static_cast<std::size_t>(k / 2)];
    arf_addmul(sum.mid(), middle.mid(), middle.mid(), bits, ARF_RND_DOWN);
  }
  return sum;
}

BigFloat A::weighted(const Series& u, const Series& v, int k, int from, int to) {
  BigFloat sum;
  if (to < from) return sum;
  const slong bits = BigFloat::precision();
  static thread_local Series terms;
  const auto count = static_cast<std::size_t>(to - from + 1);
  if (terms.size() < count) terms.resize(count);
  for (int j = from; j <= to; ++j)
    arf_mul_si(terms[static_cast<std::size_t>(j - from)].mid(),
               u[static_cast<std::size_t>(j)].mid(), j, bits, ARF_RND_DOWN);
  arb_approx_dot(sum.ball(), nullptr, 0, terms[0].ball(), 1,
                 v[static_cast<std::size_t>(k - from)].ball(), -1, to - from + 1, bits);
  return sum;
}

void A::begin_order(int k) const {
  constexpr int kOrdersBetween = 16;
  if (give_up && k % kOrdersBetween == 0 && give_up()) throw GivenUp{};
  if (bits > 0) BigFloat::set_precision(bits - bits * k / order + spare);
}

cln::cl_F to_cln(const BigFloat& value, cln::float_format_t format) {
  // Not by way of a rational number: that of exp(-10^12) would fill the memory.
  Integer mantissa, exponent;
  arf_get_fmpz_2exp(mantissa.value, exponent.value, value.mid());
  return cln::scale_float(cln::cl_float(to_cln(mantissa), format), to_cln(exponent));
}

}  // namespace casimir
