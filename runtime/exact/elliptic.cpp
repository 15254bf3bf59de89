#include "runtime/exact/elliptic.hpp"

#include <cln/integer.h>
#include <cln/real.h>

#include <cmath>

namespace casimir {
namespace {

cln::cl_F number(int value, const cln::cl_F& like) {
  return cln::cl_float(cln::cl_RA(value), like);
}

/// Whether nothing is left of the smaller one in the digits that there are.
bool vanishes(const cln::cl_F& small, const cln::cl_F& beside) {
  return cln::abs(small) <=
         cln::abs(beside) * cln::float_epsilon(cln::float_format(beside)) * number(16, beside);
}

/// Of 1 - m, below which the sums of hyperbolic functions converge fast.
constexpr double kNearOne = 0.01;

}  // namespace

TwoDoubles two_doubles(const cln::cl_F& value) {
  const double high = cln::double_approx(value);
  return {high, cln::double_approx(value - cln::cl_float(cln::cl_DF(high), value))};
}

TwoDoubles difference(double later, double earlier) {
  const double high = later - earlier, back = high + earlier;
  return {high, (later - back) - (earlier - (back - high))};
}

Phase::Phase(const cln::cl_F& rate, const cln::cl_F& start)
    : rate_(two_doubles(rate)), start_(two_doubles(start)) {}

Phase::Turned Phase::after(const TwoDoubles& t) const {
  const double product = rate_.high * t.high;
  const double rest = std::fma(rate_.high, t.high, -product);
  double whole = std::nearbyint(product);
  const double part = product - whole;  // exact
  const double sum = part + start_.high, back = sum - part;
  const double lost = (part - (sum - back)) + (start_.high - back);
  const double small = rest + (rate_.low * t.high + rate_.high * t.low) + (lost + start_.low);
  const double turns = std::nearbyint(sum + small);
  return {(sum - turns) + small, whole + turns};
}

JacobiFunctions::JacobiFunctions(const cln::cl_F& parameter, const cln::cl_F& complement)
    : parameter_(cln::double_approx(parameter)),
      complement_(cln::double_approx(complement)),
      m_(parameter),
      m1_(complement) {
  const cln::cl_F half = number(1, parameter) / number(2, parameter);
  cln::cl_F a = number(1, parameter), b = cln::sqrt(complement);
  constexpr double kNothing = 1e-18;
  while (!vanishes(a - b, a)) {
    const cln::cl_F c = (a - b) * half, mean = (a + b) * half;
    b = cln::sqrt(a * b);
    a = mean;
    const double ratio = cln::double_approx(c / a);
    if (ratio > kNothing) ratio_.push_back(ratio);
  }
  quarter_ = cln::pi(parameter) * half / a;
  // sn of small arguments: 2^n a_n with the a_n of the limit.
  scale_ = std::ldexp(cln::double_approx(a), static_cast<int>(ratio_.size()));
  four_quarters_ = cln::double_approx(quarter_ * number(4, quarter_));
  if (complement_ < kNearOne) {  // the mean of 1 and k gives Pi / 2K'
    cln::cl_F u = number(1, parameter), v = cln::sqrt(parameter);
    while (!vanishes(u - v, u)) {
      const cln::cl_F mean = (u + v) * half;
      v = cln::sqrt(u * v);
      u = mean;
    }
    decay_ = cln::double_approx(u);
  }
}

JacobiFunctions::Values JacobiFunctions::by_means(double u) const {
  double phi = scale_ * u;
  for (std::size_t n = ratio_.size(); n-- > 0;)
    phi = (phi + std::asin(ratio_[n] * std::sin(phi))) / 2;
  const double cn = std::cos(phi);
  return {std::sin(phi), cn, std::sqrt(complement_ + parameter_ * cn * cn), phi};
}

/// With v = decay (u - 2 n K), summed over all n: dn = decay sum sech v, k cn = decay sum (-1)^n
/// sech v, k sn = decay sum (-1)^n tanh v, where the terms of n and -n are taken together.
JacobiFunctions::Values JacobiFunctions::by_hyperbolic_functions(double u) const {
  constexpr int kTerms = 6;  // of size exp(-3.68 (2 n - 1)) at most, for the m that come here
  const double v = decay_ * u, period = decay_ * four_quarters_ / 2;
  double sine = std::tanh(v), cosine = 1 / std::cosh(v), delta = cosine, sign = -1;
  for (int n = 1; n <= kTerms; ++n, sign = -sign) {
    const double before = 1 / std::cosh(v - n * period), behind = 1 / std::cosh(v + n * period);
    sine += sign * (std::tanh(v - n * period) + std::tanh(v + n * period));
    cosine += sign * (before + behind);
    delta += before + behind;
  }
  const double factor = decay_ / std::sqrt(parameter_);
  sine *= factor;
  cosine *= factor;
  return {sine, cosine, decay_ * delta, std::atan2(sine, cosine)};
}

JacobiFunctions::Values JacobiFunctions::at_part(double part) const {
  // From 0 to a quarter, where nothing cancels; the rest by symmetry.
  const double size = std::abs(part);
  const bool beyond = size > 0.25;
  const double u = four_quarters_ * (beyond ? 0.5 - size : size);
  const auto [sn, cn, dn, am] = complement_ < kNearOne ? by_hyperbolic_functions(u) : by_means(u);
  constexpr double kPi = 3.14159265358979323846;
  return {std::copysign(sn, part), beyond ? -cn : cn, dn,
          std::copysign(beyond ? kPi - am : am, part)};
}

cln::cl_F JacobiFunctions::inverse(const cln::cl_F& sine, const cln::cl_F& cosine) const {
  // Landen's transformation: tan(phi_{n+1} - phi_n) = b_n / a_n tan phi_n, on the branch on which
  // phi_{n+1} is near 2 phi_n; in the end F = phi_n / (2^n a_n).
  const cln::cl_F pi = cln::pi(m_), half = number(1, m_) / number(2, m_);
  cln::cl_F a = number(1, m_), b = cln::sqrt(m1_);
  cln::cl_F phi = cln::cl_float(cln::atan(cosine, sine), m_), power = number(1, m_);
  while (!vanishes(a - b, a)) {
    const cln::cl_F s = cln::cl_float(cln::sin(phi), m_), c = cln::cl_float(cln::cos(phi), m_);
    cln::cl_F next = cln::cl_float(cln::atan(a * c, b * s), m_);
    const cln::cl_I turns = cln::round1((phi - next) / (number(2, m_) * pi));
    next = next + number(2, m_) * pi * cln::cl_float(turns, m_);
    phi = phi + next;
    const cln::cl_F mean = (a + b) * half;
    b = cln::sqrt(a * b);
    a = mean;
    power = power * number(2, m_);
  }
  return phi / (power * a);
}

}  // namespace casimir
