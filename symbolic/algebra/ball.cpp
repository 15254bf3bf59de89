#include "symbolic/algebra/ball.hpp"

#include "symbolic/algebra/flint_conversion.hpp"

namespace casimir {

Ball::Ball(const cln::cl_RA& number, long bits) : Ball() {
  Rational exact(number);
  acb_set_fmpq(value_, exact.get(), bits);
}

std::optional<bool> Ball::is_zero() const {
  if (acb_is_zero(value_) != 0) return true;
  if (!is_finite() || contains_zero()) return std::nullopt;
  return false;
}

std::optional<int> Ball::sign() const {
  if (!is_real()) return std::nullopt;
  const auto* real = acb_realref(value_);
  if (arb_is_zero(real) != 0) return 0;
  if (arb_is_positive(real) != 0) return 1;
  if (arb_is_negative(real) != 0) return -1;
  return std::nullopt;
}

std::string Ball::text() const {
  constexpr slong kDigits = 20;
  const auto part = [](const arb_t number) {
    char* digits = arb_get_str(number, kDigits, ARB_STR_NO_RADIUS);
    std::string result = digits;
    flint_free(digits);
    return result;
  };
  const std::string real = part(acb_realref(value_));
  if (is_real()) return real;
  return real + " + (" + part(acb_imagref(value_)) + ")*I";
}

}  // namespace casimir
