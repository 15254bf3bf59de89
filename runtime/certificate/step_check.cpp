#include "runtime/certificate/step_check.hpp"

#include <stdexcept>

namespace casimir::certificate {

using validated::widened;

namespace {

/// V_0 = I and (k + 1) V_{k+1} = +- sum_j J_j V_{k-j} up to V_order, entry by entry.
std::vector<Vector> tangents_along(const validated::FlowProgram& flow, const ArbSeries& series,
                                   int order, slong bits, bool forwards) {
  const std::size_t n = flow.dimension();
  std::vector<Vector> tangents(n * n, Vector(static_cast<std::size_t>(order) + 1));
  for (std::size_t i = 0; i < n; ++i) tangents[i * n + i][0] = ArbBall(1.);
  std::vector<ArbBall> sums(n * n);
  ArbBall part;
  for (int k = 0; k < order; ++k) {
    const auto at = static_cast<std::size_t>(k);
    for (ArbBall& sum : sums) arb_zero(sum.raw());
    for (std::size_t e = 0; e < flow.entries.size(); ++e) {
      const auto row = static_cast<std::size_t>(flow.entries[e].first);
      const auto column = static_cast<std::size_t>(flow.entries[e].second);
      const int line = flow.entry_lines[e];
      const Vector& entry = series.line(line);
      const slong length = series.is_constant(line) ? 1 : k + 1;
      for (std::size_t l = 0; l < n; ++l) {
        arb_dot(part.raw(), nullptr, 0, entry[0].raw(), 1, tangents[column * n + l][at].raw(), -1,
                length, bits);
        arb_add(sums[row * n + l].raw(), sums[row * n + l].raw(), part.raw(), bits);
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
      arb_div_si(tangents[i][at + 1].raw(), sums[i].raw(), forwards ? k + 1 : -(k + 1), bits);
  }
  return tangents;
}

}  // namespace

StepCheck::StepCheck(const validated::FlowProgram& flow, std::vector<LevelBound>& bounds, int order,
                     slong bits, bool forwards, bool with_derivatives)
    : flow_(flow),
      bounds_(bounds),
      order_(order),
      bits_(bits),
      forwards_(forwards),
      point_(flow.rates, order, bits),
      box_(flow.both, order, bits),
      tube_(flow.rates, order + 1, bits),
      derivatives_(flow.dimension(), flow.dimension()) {
  if (with_derivatives) tube_jacobian_.emplace(flow.both, order + 1, bits);
}

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

/// sum_k V_k h^k over the box
void StepCheck::find_derivatives(const ArbBall& length) {
  const std::vector<Vector> tangents = tangents_along(flow_, box_, order_, bits_, forwards_);
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    ArbBall value = tangents[i].back();
    for (std::size_t k = tangents[i].size() - 1; k-- > 0;) {
      arb_mul(value.raw(), value.raw(), length.raw(), bits_);
      arb_add(value.raw(), value.raw(), tangents[i][k].raw(), bits_);
    }
    derivatives_.entries[i] = value;
  }
}

/// The same with the remainder. The derivatives W of the flow satisfy dW/dt = J(x(t)) W and
/// W(t + s) = V(s) W(t), where V are the derivatives from x(t) on; so the Taylor coefficient N + 1
/// of W at t is V_{N+1}(x(t)) W(t), with x(t) in the rough enclosure D. Of each column |W(t)| <=
/// e^{L h} in the maximum norm by Gronwall's lemma, where L bounds the row sums of |J| over D.
void StepCheck::find_whole_derivatives(const StepClaim& claim) {
  const std::size_t n = flow_.dimension();
  tube_jacobian_->expand(time_of(claim.elapsed + validated::from_zero_to(claim.length)), tube_box_,
                         forwards_);
  const std::vector<Vector> tangents =
      tangents_along(flow_, *tube_jacobian_, order_ + 1, bits_, forwards_);
  std::vector<ArbBall> rows(n);
  for (std::size_t e = 0; e < flow_.entries.size(); ++e) {
    ArbBall size;
    arb_abs(size.raw(), tube_jacobian_->line(flow_.entry_lines[e])[0].raw());
    ArbBall& row = rows[static_cast<std::size_t>(flow_.entries[e].first)];
    row = row + size;
  }
  ArbBall largest, power(1.);
  for (const ArbBall& row : rows) arb_max(largest.raw(), largest.raw(), row.raw(), bits_);
  ArbBall growth = largest * claim.length;
  arb_exp(growth.raw(), growth.raw(), bits_);
  for (int k = 0; k <= order_; ++k) power = power * claim.length;
  const ArbBall factor = validated::symmetric(growth * power);
  whole_derivatives_ = derivatives_;
  for (std::size_t i = 0; i < n; ++i) {
    ArbBall rest;
    for (std::size_t k = 0; k < n; ++k) rest = rest + tangents[i * n + k].back() * factor;
    for (std::size_t l = 0; l < n; ++l)
      whole_derivatives_(i, l) = whole_derivatives_(i, l) + validated::symmetric(rest);
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
  image.rest =
      validated::sum(validated::product(turned, from.rest), validated::product(inverse, shift));
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
    if (tube_jacobian_) find_whole_derivatives(claim);
    return leads_inside(claim);
  } catch (const std::domain_error&) {
    return TraceFault::no_value;
  }
}

}  // namespace casimir::certificate
