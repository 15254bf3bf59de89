#pragma once

#include <cln/float.h>
#include <cln/integer.h>
#include <cln/rational.h>
#include <cln/real.h>

#include <cmath>
#include <stdexcept>

#include "runtime/program.hpp"
#include "runtime/program/exact_number.hpp"

namespace casimir {

/// What generic code needs of a number type: exact constants, the elementary functions and the
/// sign, with a refusal (std::domain_error) where the result would not be a number of that type.
/// `function` is that of an operation which has a value at every number of which the result is one:
/// sin, cos, tan, sinh, cosh, tanh, exp.
template <class Number>
struct Arithmetic;

/// Built-in floating point. Follows IEEE arithmetic: nothing throws, NaN and infinities propagate.
template <class Real>
struct IeeeArithmetic {
  /// Rounded twice for types wider than double: by at most two units in the last place.
  static Real from(const cln::cl_RA& value) {
    const double high = nearest_double(value);
    if constexpr (sizeof(Real) <= sizeof(double)) return static_cast<Real>(high);
    if (!std::isfinite(high)) return static_cast<Real>(high);
    return static_cast<Real>(high) + static_cast<Real>(nearest_double(value - exact_number(high)));
  }
  static Real pi() { return static_cast<Real>(3.14159265358979323846264338327950288L); }
  static Real divide(Real a, Real b) { return a / b; }
  static Real sqrt(Real a) { return std::sqrt(a); }
  static Real power(Real a, Real e) { return std::pow(a, e); }
  static Real function(Op op, Real a) {
    switch (op) {
      case Op::sin:
        return std::sin(a);
      case Op::cos:
        return std::cos(a);
      case Op::tan:
        return std::tan(a);
      case Op::sinh:
        return std::sinh(a);
      case Op::cosh:
        return std::cosh(a);
      case Op::tanh:
        return std::tanh(a);
      default:
        return std::exp(a);
    }
  }
  static Real log(Real a) { return std::log(a); }
  static Real asin(Real a) { return std::asin(a); }
  static Real acos(Real a) { return std::acos(a); }
  static Real atan2(Real y, Real x) { return std::atan2(y, x); }
  static int sign(Real a) { return a < 0 ? -1 : a > 0 ? 1 : 0; }
};

template <>
struct Arithmetic<double> : IeeeArithmetic<double> {};
template <>
struct Arithmetic<long double> : IeeeArithmetic<long double> {};

/// Exact rationals: the four operations only.
template <>
struct Arithmetic<cln::cl_RA> {
  using N = cln::cl_RA;
  static N from(const cln::cl_RA& value) { return value; }
  static N divide(const N& a, const N& b) {
    if (cln::zerop(b)) throw std::domain_error("division by zero");
    return a / b;
  }
  static N pi() { return none(); }
  static N sqrt(const N& a) {
    N root;
    if (cln::minusp(a) || !cln::sqrtp(a, &root)) none();
    return root;
  }
  static N power(const N&, const N&) { return none(); }
  static N function(Op, const N&) { return none(); }
  static N log(const N&) { return none(); }
  static N asin(const N&) { return none(); }
  static N acos(const N&) { return none(); }
  static N atan2(const N&, const N&) { return none(); }
  static int sign(const N& a) { return cln::minusp(a) ? -1 : cln::plusp(a) ? 1 : 0; }

 private:
  static N none() { throw std::domain_error("the value is not a rational number"); }
};

/// CLN's floating-point numbers of one precision. The precision is part of every number; `digits`
/// decimal digits of it are held by the object.
template <>
struct Arithmetic<cln::cl_F> {
  using N = cln::cl_F;
  explicit Arithmetic(int digits) : format(cln::float_format(static_cast<uintE>(digits))) {}
  N from(const cln::cl_RA& value) const { return cln::cl_float(value, format); }
  N from(const cln::cl_R& value) const { return cln::cl_float(value, format); }
  N pi() const { return cln::pi(format); }
  N divide(const N& a, const N& b) const {
    if (cln::zerop(b)) throw std::domain_error("division by zero");
    return a / b;
  }
  N sqrt(const N& a) const {
    if (cln::minusp(a)) throw std::domain_error("square root of a negative number");
    return cln::sqrt(a);
  }
  N power(const N& a, const N& e) const {
    if (!cln::plusp(a)) throw std::domain_error("broken power of a number that is not positive");
    return cln::exp(cln::ln(a) * e);
  }
  N function(Op op, const N& a) const {
    switch (op) {
      case Op::sin:
        return from(cln::sin(a));
      case Op::cos:
        return from(cln::cos(a));
      case Op::tan:
        return divide(from(cln::sin(a)), from(cln::cos(a)));
      case Op::sinh:
        return from(cln::sinh(a));
      case Op::cosh:
        return from(cln::cosh(a));
      case Op::tanh:
        return from(cln::tanh(a));
      default:
        return from(cln::exp(a));
    }
  }
  N log(const N& a) const {
    if (!cln::plusp(a)) throw std::domain_error("logarithm of a number that is not positive");
    return cln::cl_float(cln::ln(a), format);
  }
  N asin(const N& a) const { return atan2(a, sqrt(from(cln::cl_RA(1)) - a * a)); }
  N acos(const N& a) const { return atan2(sqrt(from(cln::cl_RA(1)) - a * a), a); }
  /// The angle of the point (x, y).
  N atan2(const N& y, const N& x) const {
    if (cln::zerop(y) && cln::zerop(x)) throw std::domain_error("the angle of the origin");
    return cln::cl_float(cln::atan(x, y), format);
  }
  static int sign(const N& a) { return cln::minusp(a) ? -1 : cln::plusp(a) ? 1 : 0; }

  cln::float_format_t format;
};

}  // namespace casimir
