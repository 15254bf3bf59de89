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
  static N sqrt(N a) { return {std::sqrt(a.value), std::sqrt(a.size)}; }
  static N power(N a, N e) {
    return {std::pow(a.value, e.value), std::pow(std::max(a.size, std::abs(a.value)), e.value)};
  }
  static N function(Op op, N a) { return plain(Arithmetic<long double>::function(op, a.value)); }
  static N log(N a) { return plain(std::log(a.value)); }
  static N asin(N a) { return plain(std::asin(a.value)); }
  static N acos(N a) { return plain(std::acos(a.value)); }
  static N atan2(N y, N x) { return plain(std::atan2(y.value, x.value)); }
  static int sign(N a) { return Arithmetic<long double>::sign(a.value); }
};

}  // namespace casimir
