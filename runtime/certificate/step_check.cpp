#include "runtime/certificate/step_check.hpp"

#include <stdexcept>

namespace casimir::certificate {

using validated::widened;

StepCheck::StepCheck(const validated::FlowProgram& flow, std::vector<LevelBound>& bounds, int order,
                     slong bits, bool forwards)
    : flow_(flow),
      bounds_(bounds),
      order_(order),
      bits_(bits),
      forwards_(forwards),
      point_(flow.rates, order, bits),
      box_(flow.both, order, bits),
      tube_(flow.rates, order + 1, bits),
      tangents_(flow.dimension() * flow.dimension(),
                Vector(static_cast<std::size_t>(order) + 1)),
      derivatives_(flow.dimension(), flow.dimension()) {}

/// The rough enclosure, and x_{N+1} h^{N+1} over it.
bool StepCheck::stays_in_tube(const StepClaim& claim, const Vector& hull) {
  const std::size_t n = hull.size();
  const ArbBall room = validated::power_of_two<ArbBall>(claim.room);
  ArbBall power(1.);
  tube_box_ = hull;
  for (ArbBall& x : tube_box_) x = widened(x, room);
  for (int k = 1; k <= order_; ++k) {
    power = power * claim.length;
    const ArbBall up_to = validated::from_zero_to(power);
    for (std::size_t i = 0; i < n; ++i)
      tube_box_[i] = tube_box_[i] + box_.state(i)[static_cast<std::size_t>(k)] * up_to;
  }
  power = power * claim.length;
  for (const ArbBall& x : tube_box_)
    if (!validated::is_usable(x)) return false;
  tube_.expand(time_of(claim.elapsed + validated::from_zero_to(claim.length)), tube_box_,
               forwards_);
  remainder_.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const ArbBall rest = tube_.state(i).back() * power;
    ArbBall size;
    arb_abs(size.raw(), rest.raw());
    if (!validated::is_usable(rest) || arb_lt(size.raw(), room.raw()) == 0) return false;
    remainder_.push_back(rest);
  }
  return true;
}

/// (k + 1) V_{k+1} = +- sum_j J_j V_{k-j}, and their sum at h.
void StepCheck::find_derivatives(const ArbBall& length) {
  const std::size_t n = flow_.dimension();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t l = 0; l < n; ++l) tangents_[i * n + l][0] = ArbBall(i == l ? 1. : 0.);
  std::vector<ArbBall> sums(n * n);
  ArbBall part;
  for (int k = 0; k < order_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    for (ArbBall& sum : sums) arb_zero(sum.raw());
    for (std::size_t e = 0; e < flow_.entries.size(); ++e) {
      const auto row = static_cast<std::size_t>(flow_.entries[e].first);
      const auto column = static_cast<std::size_t>(flow_.entries[e].second);
      const int line = flow_.entry_lines[e];
      const Vector& entry = box_.line(line);
      const slong length_of_entry = box_.is_constant(line) ? 1 : k + 1;
      for (std::size_t l = 0; l < n; ++l) {
        arb_dot(part.raw(), nullptr, 0, entry[0].raw(), 1, tangents_[column * n + l][at].raw(), -1,
                length_of_entry, bits_);
        arb_add(sums[row * n + l].raw(), sums[row * n + l].raw(), part.raw(), bits_);
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
      arb_div_si(tangents_[i][at + 1].raw(), sums[i].raw(), forwards_ ? k + 1 : -(k + 1), bits_);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    ArbBall value = tangents_[i].back();
    for (std::size_t k = tangents_[i].size() - 1; k-- > 0;) {
      arb_mul(value.raw(), value.raw(), length.raw(), bits_);
      arb_add(value.raw(), value.raw(), tangents_[i][k].raw(), bits_);
    }
    derivatives_.entries[i] = value;
  }
}

/// Where the flow takes the set, in the coordinates of the next one.
TraceFault StepCheck::leads_inside(const StepClaim& claim) {
  const BallSet &from = claim.before, &to = claim.after;
  const std::size_t n = from.dimension();
  BallMatrix inverse;
  if (!invert(to.frame, inverse)) return TraceFault::frame;
  BallSet image = to;  // of its coordinates those are found now
  Vector shift(n);
  for (std::size_t i = 0; i < n; ++i) {
    ArbBall sum;
    const Vector& series = point_.state(i);
    for (std::size_t k = series.size(); k-- > 1;) sum = (sum + series[k]) * claim.length;
    const ArbBall end = from.middle[i] + sum + remainder_[i];
    image.middle[i] = validated::middle_of(end);
    shift[i] = end - image.middle[i];
  }
  if (!from.start.empty()) {
    BallMatrix carried = validated::product(derivatives_, from.carried);
    for (std::size_t i = 0; i < carried.entries.size(); ++i)
      carried.entries[i] = carried.entries[i] - to.carried.entries[i];
    shift = validated::sum(shift, validated::product(carried, from.start));
  }
  const BallMatrix turned =
      validated::product(inverse, validated::product(derivatives_, from.frame));
  image.rest = validated::sum(validated::product(turned, from.rest),
                              validated::product(inverse, shift));
  const Vector hull = hull_of(image);
  const ArbBall time = time_of(claim.elapsed + claim.length);
  for (std::size_t a = 0; a < bounds_.size(); ++a) {
    if (claim.columns[a] < 0) continue;
    if (!bounds_[a].bound(image, static_cast<std::size_t>(claim.columns[a]), hull, time))
      return TraceFault::level;
  }
  // Around the middle of the next set.
  Vector moved(n);
  for (std::size_t i = 0; i < n; ++i) moved[i] = image.middle[i] - to.middle[i];
  const Vector rest = validated::sum(image.rest, validated::product(inverse, moved));
  for (std::size_t i = 0; i < n; ++i)
    if (!validated::is_usable(rest[i]) || !validated::contains(to.rest[i], rest[i]))
      return TraceFault::outside;
  return TraceFault::none;
}

TraceFault StepCheck::operator()(const StepClaim& claim) {
  try {
    const Vector hull = hull_of(claim.before);
    const ArbBall time = time_of(claim.elapsed);
    point_.expand(time, claim.before.middle, forwards_);
    box_.expand(time, hull, forwards_);
    if (!stays_in_tube(claim, hull)) return TraceFault::not_enclosed;
    for (LevelBound& bound : bounds_)
      bound.passes(tube_box_, time_of(claim.elapsed + validated::from_zero_to(claim.length)));
    find_derivatives(claim.length);
    return leads_inside(claim);
  } catch (const std::domain_error&) {
    return TraceFault::no_value;
  }
}

}  // namespace casimir::certificate
