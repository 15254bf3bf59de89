#include "runtime/certificate/level_bound.hpp"

#include <stdexcept>

namespace casimir::certificate {

using validated::BallPrecision;

LevelBound::LevelBound(const KnownIntegral& integral, slong bits)
    : integral_(integral),
      bits_(bits),
      polynomial_(validated::is_polynomial(integral.value)),
      value_(integral.value),
      gradient_(integral.gradient) {}

void LevelBound::begin(const Vector& point, const BallSet& first, bool wide) {
  try {
    if (wide) first_gradient_ = gradient_over(hull_of(first), ArbBall());
    const BallPrecision precise(bits_);
    exact_value_.emplace(integral_.value);
    level_ = (*exact_value_)(wide ? first.middle : point, ArbBall())[0];
  } catch (const std::domain_error&) {
    usable_ = false;
  }
}

bool LevelBound::is_analytic_on(const Vector& box, const ArbBall& time) {
  if (polynomial_) return true;
  try {
    return validated::is_usable(value_(box, time)[0]);
  } catch (const std::domain_error&) {
    return false;
  }
}

Vector LevelBound::gradient_over(const Vector& box, const ArbBall& time) {
  const Vector& entries = gradient_(box, time);
  Vector gradient(box.size());
  for (std::size_t k = 0; k < entries.size(); ++k)
    gradient[static_cast<std::size_t>(integral_.states[k])] = entries[k];
  return gradient;
}

bool LevelBound::bound(BallSet& set, std::size_t which, const Vector& hull, const ArbBall& time) {
  if (!usable_ || !is_analytic_on(hull, time)) return true;
  Vector gradient;
  ArbBall right, divisor;
  try {
    gradient = gradient_over(hull, time);
    const BallPrecision precise(bits_);
    right = level_ - (*exact_value_)(set.middle, time)[0];
  } catch (const std::domain_error&) {
    return true;
  }
  const std::size_t n = set.dimension();
  for (std::size_t k = 0; k < set.start.size(); ++k) {
    ArbBall factor = first_gradient_[k];
    for (std::size_t i = 0; i < n; ++i) factor = factor - gradient[i] * set.carried(i, k);
    right = right + factor * set.start[k];
  }
  for (std::size_t j = 0; j < n; ++j) {
    ArbBall factor;
    for (std::size_t i = 0; i < n; ++i) factor = factor + gradient[i] * set.frame(i, j);
    if (j == which)
      divisor = factor;
    else
      right = right - factor * set.rest[j];
  }
  if (!validated::is_usable(right) || !validated::is_usable(divisor) ||
      validated::contains_zero(divisor))
    return true;
  const ArbBall known = right / divisor;
  if (!arb_overlaps(set.rest[which].raw(), known.raw())) return false;
  if (arb_contains(set.rest[which].raw(), known.raw()) != 0) {
    set.rest[which] = known;
    bounded_ = true;
  } else {
    ArbBall both;
    arb_intersection(both.raw(), set.rest[which].raw(), known.raw(), ArbBall::precision());
    bounded_ = true;
    if (mag_cmp(arb_radref(both.raw()), arb_radref(set.rest[which].raw())) < 0)
      set.rest[which] = both;
  }
  return true;
}

}  // namespace casimir::certificate
