#pragma once

#include <acb.h>

#include <utility>

namespace casimir::adversary {

/// A complex number with a radius, of Arb, at 60 digits and some more.
class Ball {
 public:
  static constexpr slong kBits = 256;

  Ball() { acb_init(value_); }
  Ball(long value) : Ball() { acb_set_si(value_, value); }
  Ball(const Ball& other) : Ball() { acb_set(value_, other.value_); }
  Ball(Ball&& other) noexcept : Ball() { acb_swap(value_, other.value_); }
  Ball& operator=(Ball other) noexcept {
    acb_swap(value_, other.value_);
    return *this;
  }
  ~Ball() { acb_clear(value_); }

  /// numerator / denominator.
  static Ball ratio(long numerator, long denominator);

  acb_ptr get() { return value_; }
  acb_srcptr get() const { return value_; }
  arb_srcptr real() const { return acb_realref(value_); }

  bool is_real() const { return arb_is_zero(acb_imagref(value_)) != 0; }
  bool is_finite() const { return acb_is_finite(value_) != 0; }
  /// It is not zero, whatever was rounded.
  bool is_nonzero() const { return acb_contains_zero(value_) == 0; }
  /// It may be zero, and is known to 40 digits: zero as far as 60 digits can tell.
  bool is_tiny() const;
  /// It is known to 40 digits. An angle next to the cut of atan2 is not.
  bool is_sharp() const;
  bool is_exact_zero() const { return acb_is_zero(value_) != 0; }
  bool is_positive() const { return arb_is_positive(real()) != 0; }
  bool is_negative() const { return arb_is_negative(real()) != 0; }
  /// The midpoint, without a radius.
  Ball middle() const;
  double as_double() const;

 private:
  acb_t value_;
};

Ball operator+(const Ball& a, const Ball& b);
Ball operator-(const Ball& a, const Ball& b);
Ball operator*(const Ball& a, const Ball& b);
Ball operator/(const Ball& a, const Ball& b);

}  // namespace casimir::adversary
