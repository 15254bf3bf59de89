#pragma once

// Arb's names stay inside this stage, as FLINT's do.
#include <acb.h>
#include <cln/rational.h>

#include <optional>
#include <string>

namespace casimir {

/// A complex number known to lie in a rectangle around a midpoint: Arb's, with value semantics.
/// What is computed with balls holds for every number in them, so that a ball without zero proves
/// that a number is not zero, whatever algebraic relations it has.
class Ball {
 public:
  Ball() { acb_init(value_); }
  Ball(const cln::cl_RA& number, long bits);
  Ball(const Ball& other) : Ball() { acb_set(value_, other.value_); }
  Ball(Ball&& other) noexcept : Ball() { acb_swap(value_, other.value_); }
  Ball& operator=(const Ball& other) {
    acb_set(value_, other.value_);
    return *this;
  }
  Ball& operator=(Ball&& other) noexcept {
    acb_swap(value_, other.value_);
    return *this;
  }
  ~Ball() { acb_clear(value_); }

  /// The imaginary part is zero.
  bool is_real() const { return acb_is_real(value_) != 0; }
  bool is_finite() const { return acb_is_finite(value_) != 0; }
  bool contains_zero() const { return acb_contains_zero(value_) != 0; }
  /// Proved to be zero, or not to be; empty where the ball leaves it open.
  std::optional<bool> is_zero() const;
  /// Of a real number: -1, 0 or 1; empty where the ball leaves it open.
  std::optional<int> sign() const;
  /// As many decimal digits as are certain, 20 at most.
  std::string text() const;

  acb_ptr raw() { return value_; }
  acb_srcptr raw() const { return value_; }

 private:
  acb_t value_;
};

}  // namespace casimir
