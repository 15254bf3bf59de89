// Where steps end behind branches: |u|, sign(u) and the cut of an angle.
#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/step/between_places.hpp"
#include "runtime/step/step_look.hpp"

namespace casimir {
namespace {

/// Of the largest argument in a step: what counts as zero, and where a step behind a branch ends.
constexpr double kZeroOfSamples = 1e-11, kBehind = 1e-12, kRoundingOfSamples = 2e-15;

}  // namespace

double StepLook::up_to_branch(const casimir_step& trial, const StepWatch::Watched& watched) {
  const bool turns = watched.kind == StepWatch::Kind::turn;
  // A jump on whose wrong side rounding has put the start comes at once.
  const double relative = watched.kind == StepWatch::Kind::side ? kZeroOfSamples : 0;
  const Values sampled = sampled_at(watched);
  const auto at = [&](std::size_t i) { return sampled[i]; };
  double size = 0;
  for (std::size_t i = 0; i + 1 < kPlaces; ++i) {
    size = std::max({size, std::abs(at(i)), std::abs(at(i + 1))});
    // The cut of an angle is where the other argument is negative.
    if (turns && !(sampled_[i][watched.place + 1] < 0 || sampled_[i + 1][watched.place + 1] < 0))
      continue;
    if (i == 0 && at(0) == 0) {
      // Rounding has put the end of the last step on the zero: it may come back soon.
      constexpr double kLeastAside = 0x1p-40, kWider = 64;
      for (double aside = kLeastAside; aside < places_[1]; aside *= kWider) {
        if (value(trial, watched, aside) * at(1) < 0)
          return landing(trial, watched, aside, places_[1], size);
      }
    }
    const double zero = relative * size;
    if (at(i) * at(i + 1) < 0 && std::abs(at(i)) > zero && std::abs(at(i + 1)) > zero)
      return landing(trial, watched, places_[i], places_[i + 1], size);
    // One that is zero to rounding at the start, and passes zero behind it, is seen at the next
    // place.
    if (i + 2 >= kPlaces || std::abs(at(i + 1)) <= zero) continue;
    const double a = places_[i], b = places_[i + 1], c = places_[i + 2];
    const auto dip = dip_at(places_, sampled, i);
    if (!dip) continue;
    const auto [vertex, least] = *dip;
    // Near zero for what is one of the places may be next to it already.
    constexpr double kFar = 0.5, kNear = 0.05;
    const double around = std::max(std::abs(at(i)), std::abs(at(i + 2)));
    if (least * at(i + 1) > 0 && std::abs(least) > kFar * std::abs(at(i + 1)) &&
        std::abs(least) > kNear * around)
      continue;
    double reached = vertex, u = value(trial, watched, vertex);
    for (int round = 0; round < 3 && u * at(i + 1) > 0; ++round) {
      constexpr double kAside = 0.05;
      const double aside = kAside * (c - a);
      const double low = value(trial, watched, reached - aside);
      const double high = value(trial, watched, reached + aside);
      const double curve = low - 2 * u + high;
      if (!(curve * u > 0)) break;
      reached = std::clamp(reached + aside * (low - high) / (2 * curve), a, c);
      u = value(trial, watched, reached);
    }
    if (u * at(i + 1) < 0 && std::abs(u) > zero)
      return landing(trial, watched, reached > b ? b : a, reached, size);
  }
  return 1;
}

/// Just behind the zero between two parts of the step, at which the signs are different.
double StepLook::landing(const casimir_step& trial, const StepWatch::Watched& watched,
                         double before, double behind, double size) {
  double first = value(trial, watched, before), last = value(trial, watched, behind);
  if (!(first * last < 0)) return 1;  // cubic interpolation said so, and was wrong
  const double sign = last > 0 ? 1 : -1;
  // What rounding makes of it: in its own terms, and in the time.
  const double slope = std::abs((last - first) / ((behind - before) * (trial.t1 - trial.t0)));
  double rounding = 4 * std::numeric_limits<double>::epsilon() * std::abs(trial.t0) * slope;
  for (std::size_t i = 0; i < kPlaces && places_[i] <= before; ++i)
    rounding = std::max(rounding, kRoundingOfSamples * std::abs(sampled_[i][watched.place]));
  const double far = behind;
  constexpr int kMostRounds = 60;
  int side = 0;
  for (int round = 0; round < kMostRounds && behind - before > 1e-15 * behind; ++round) {
    // Regula falsi, which halves the value at an end that stays (the Illinois rule), and bisection.
    double middle = (before * last - behind * first) / (last - first);
    if (round % 4 == 3 || !(middle > before && middle < behind)) middle = (before + behind) / 2;
    const double u = value(trial, watched, middle);
    if (u * sign > 0) {
      behind = middle;
      last = u;
      if (side == 1) first /= 2;
      side = 1;
    } else {
      before = middle;
      first = u;
      if (side == -1) last /= 2;
      side = -1;
    }
  }
  // Far enough for rounding not to undo it; where there is no jump, that may be farther.
  const double enough =
      further_ * (watched.kind == StepWatch::Kind::side ? kBehind * size : rounding);
  // No farther than that, as the slope there says: two runs, one of which lands further, are to
  // tell how much it matters.
  constexpr double kAside = 1e-5, kBeyondEnough = 1.01;
  const double aside = std::min(kAside, (far - behind) / 2);
  const double rise =
      (value(trial, watched, behind + aside) - value(trial, watched, behind)) * sign / aside;
  double beyond = 4 * std::numeric_limits<double>::epsilon() * behind;
  if (rise > 0) beyond = std::max(beyond, kBeyondEnough * enough / rise);
  for (; behind + beyond < far; beyond *= 4) {
    if (value(trial, watched, behind + beyond) * sign > enough) return behind + beyond;
  }
  return far < 1 ? far : 1;
}

}  // namespace casimir
