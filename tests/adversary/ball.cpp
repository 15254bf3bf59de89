#include "tests/adversary/ball.hpp"

namespace casimir::adversary {

Ball Ball::ratio(long numerator, long denominator) {
  Ball result(numerator);
  acb_div_si(result.value_, result.value_, denominator, kBits);
  return result;
}

namespace {

constexpr slong kDigitsInBits = 133;  // 40 digits

}  // namespace

bool Ball::is_tiny() const {
  if (!is_finite() || is_nonzero()) return false;
  mag_t size;
  mag_init(size);
  acb_get_mag(size, value_);
  const bool tiny = mag_cmp_2exp_si(size, -kDigitsInBits) < 0;
  mag_clear(size);
  return tiny;
}

bool Ball::is_sharp() const {
  return is_finite() && (is_tiny() || acb_rel_accuracy_bits(value_) > kDigitsInBits);
}

Ball Ball::middle() const {
  Ball result;
  acb_get_mid(result.value_, value_);
  return result;
}

double Ball::as_double() const { return arf_get_d(arb_midref(real()), ARF_RND_NEAR); }

Ball operator+(const Ball& a, const Ball& b) {
  Ball result;
  acb_add(result.get(), a.get(), b.get(), Ball::kBits);
  return result;
}

Ball operator-(const Ball& a, const Ball& b) {
  Ball result;
  acb_sub(result.get(), a.get(), b.get(), Ball::kBits);
  return result;
}

Ball operator*(const Ball& a, const Ball& b) {
  Ball result;
  acb_mul(result.get(), a.get(), b.get(), Ball::kBits);
  return result;
}

Ball operator/(const Ball& a, const Ball& b) {
  Ball result;
  acb_div(result.get(), a.get(), b.get(), Ball::kBits);
  return result;
}

}  // namespace casimir::adversary
