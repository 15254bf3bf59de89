#pragma once

#include <algorithm>
#include <cmath>

#include "runtime/program/number.hpp"

namespace casimir {

/// A number and the size of the largest term that went into it: the sum 1e8 - 1e8 is 0 and has the
/// size 1e8. What an error or a drift of the sum is to be measured against. The range is that of
/// long double, so that squares and fourth powers of any double fit in.
struct SizedNumber {
  long double value;
  long double size;

  friend SizedNumber operator+(SizedNumber a, SizedNumber b) {
    return {a.value + b.value, std::max(a.size, b.size)};
  }
  friend SizedNumber operator-(SizedNumber a, SizedNumber b) {
    return {a.value - b.value, std::max(a.size, b.size)};
  }
  friend SizedNumber operator*(SizedNumber a, SizedNumber b) {
    return {a.value * b.value, a.size * b.size};
  }
  SizedNumber operator-() const { return {-value, size}; }
};

template <>
struct Arithmetic<SizedNumber> {
  using N = SizedNumber;
  static N plain(long double v) { return {v, std::abs(v)}; }
  static N from(const cln::cl_RA& v) { return plain(Arithmetic<long double>::from(v)); }
  static N pi() { return plain(Arithmetic<long double>::pi()); }
  static N divide(N a, N b) { return {a.value / b.value, a.size / std::abs(b.value)}; }
  static N sqrt(N a) {
    const long double value = std::sqrt(edge(a, 0));
    const long double steep = value > 0 ? std::min(1 / (2 * value), kSteepest) : kSteepest;
    return {value, std::max(std::sqrt(a.size), steep * a.size)};
  }
  static N power(N a, N e) {
    return {std::pow(a.value, e.value), std::pow(std::max(a.size, std::abs(a.value)), e.value)};
  }
  /// A function f of a changes by as much as its value, or as f'(a) times what a is measured
  /// against: log(a) is 0 at 1, and its terms are not.
  static N function(Op op, N a) {
    const long double value = Arithmetic<long double>::function(op, a.value);
    return {value, std::max(std::abs(value), std::abs(slope(op, a.value, value)) * a.size)};
  }
  static N log(N a) {
    const long double value = std::log(a.value);
    return {value, std::max(std::abs(value), a.size / std::abs(a.value))};
  }
  static N asin(N a) { return arc(std::asin(inside(a)), a); }
  static N acos(N a) { return arc(std::acos(inside(a)), a); }
  static N atan2(N y, N x) {
    const long double value = std::atan2(y.value, x.value);
    const long double square = y.value * y.value + x.value * x.value;
    const long double change = std::abs(x.value) * y.size + std::abs(y.value) * x.size;
    return {value, square > 0 ? std::max(std::abs(value), change / square) : std::abs(value)};
  }
  static int sign(N a) { return Arithmetic<long double>::sign(a.value); }

 private:
  /// By as much of its size an argument may be beyond the edge of a domain through errors of a run:
  /// it is on the edge then.
  static constexpr long double kBeyond = 1e-6L;

  /// The value, or the edge where it is a little less.
  static long double edge(N a, long double least) {
    return a.value < least && a.value >= least - kBeyond * a.size ? least : a.value;
  }
  /// The value, or 1 or -1 where it is a little beyond.
  static long double inside(N a) { return edge({-edge({-a.value, a.size}, -1), a.size}, -1); }
  /// Roots and inverse functions are steep beside the edges of their domains: no steeper than where
  /// the rounding of doubles is seen.
  static constexpr long double kSteepest = 1e8L;
  static N arc(long double value, N a) {
    const long double square = 1 - a.value * a.value;
    const long double steep = square > 0 ? std::min(1 / std::sqrt(square), kSteepest) : kSteepest;
    return {value, std::max(std::abs(value), steep * a.size)};
  }
  static long double slope(Op op, long double a, long double value) {
    switch (op) {
      case Op::sin:
        return std::cos(a);
      case Op::cos:
        return std::sin(a);
      case Op::tan:
        return 1 + value * value;
      case Op::sinh:
        return std::cosh(a);
      case Op::cosh:
        return std::sinh(a);
      case Op::tanh:
        return 1 - value * value;
      default:
        return value;  // exp
    }
  }
};

}  // namespace casimir
