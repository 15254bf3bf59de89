#include "runtime/digits/cancellation.hpp"

#include <cln/float.h>
#include <cln/rational.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "runtime/evaluate.hpp"
#include "runtime/validated/arb_ball.hpp"

namespace casimir {
namespace {

using validated::ArbBall;

constexpr double kDigitsOfBit = 0.30102999566398120;

/// log2 of what a rate is beside, or nothing where it is beside nothing: it, or what changes it by
/// itself in the time of the run.
std::optional<double> log2_scale(const ArbBall& rate, const ArbBall& state,
                                 const ArbBall& duration) {
  std::optional<double> scale;
  if (!validated::contains_zero(rate)) scale = validated::log2_magnitude(rate);
  if (!validated::contains_zero(state)) {
    const double own = validated::log2_magnitude(state) - validated::log2_magnitude(duration);
    scale = std::max(scale.value_or(own), own);
  }
  return scale;
}

/// What a number of digits loses; nothing where these are too few to tell.
std::optional<double> lost_of(const Program& rates, const std::vector<cln::cl_R>& at,
                              const cln::cl_R& duration, int digits) {
  const double bits = digits / kDigitsOfBit;
  const validated::BallPrecision precision(static_cast<slong>(bits));
  std::vector<ArbBall> inputs;
  for (const cln::cl_R& value : at) inputs.emplace_back(cln::rational(value));
  const ArbBall time(cln::rational(duration));
  if (validated::contains_zero(time)) return 0;
  std::vector<ArbBall> values;
  try {
    values = evaluate(rates, inputs);
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
  double lost = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!validated::is_usable(values[i])) return std::nullopt;
    if (validated::is_exact(values[i])) continue;
    const std::optional<double> scale = log2_scale(values[i], inputs[i], time);
    if (!scale) return std::nullopt;
    const double radius = validated::log2_magnitude(validated::deviation_of(values[i]));
    lost = std::max(lost, bits + radius - *scale);
  }
  return lost < bits ? std::optional(lost) : std::nullopt;
}

}  // namespace

int cancelled_digits(const Program& rates, const std::vector<cln::cl_R>& at,
                     const cln::cl_R& duration, int digits) {
  constexpr int kMostBallDigits = 20000;
  constexpr double kUsual = 3;  // of the rounding of a few operations
  for (int with = digits; with <= kMostBallDigits; with *= 2) {
    const auto lost = lost_of(rates, at, duration, with);
    if (!lost) continue;
    const double tens = *lost * kDigitsOfBit;
    return tens > kUsual ? static_cast<int>(std::ceil(tens)) : 0;
  }
  return 0;
}

}  // namespace casimir
