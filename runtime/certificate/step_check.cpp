#include "runtime/certificate/step_check.hpp"

#include <algorithm>
#include <cmath>
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
        ArbBall& sum = sums[row * n + l];
        arb_dot(sum.raw(), sum.raw(), 0, entry[0].raw(), 1, tangents[column * n + l][at].raw(), -1,
                length, bits);
      }
    }
    ArbBall share(1.);  // one division in the place of many
    arb_div_si(share.raw(), share.raw(), forwards ? k + 1 : -(k + 1), bits);
    for (std::size_t i = 0; i < sums.size(); ++i)
      arb_mul(tangents[i][at + 1].raw(), sums[i].raw(), share.raw(), bits);
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
  tube_.expand(times_of(claim), tube_box_, forwards_);
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

/// The order up to which derivatives are worth having. From the p-th on the coefficients over the
/// box do as well,
///   x(h; x0) in sum_{k <= N} m_k h^k + (sum_{k <= p} V_k h^k) (x0 - m)
///               + sum_{p < k <= N} (x_k(X) - m_k) h^k + x_{N+1}(D) h^{N+1}
/// for every x0 and the m of the box X, since x_k(x0) is in x_k(X): what their radii add has to be
/// far below the room of the next set in each of its coordinates that no integral bounds. That any
/// p is right leaves the choice to doubles.
int StepCheck::order_of_derivatives(const StepClaim& claim) const {
  if (tube_jacobian_) return order_;
  constexpr double kShare = 0x1p-22;
  const std::size_t n = claim.before.dimension();
  std::vector<double> off(n), room(n);
  for (std::size_t j = 0; j < n; ++j)
    room[j] = std::ranges::count(claim.columns, static_cast<int>(j)) > 0
                  ? INFINITY
                  : kShare * validated::magnitude(claim.after.rest[j]);
  const double h = validated::approximate(claim.length);
  int order = order_;
  for (; order > 0; --order) {
    const auto k = static_cast<std::size_t>(order);
    for (std::size_t i = 0; i < n; ++i)
      off[i] += validated::radius_of(box_.state(i)[k]) * std::pow(h, order);
    for (std::size_t j = 0; j < n; ++j) {
      double along = 0;
      for (std::size_t i = 0; i < n; ++i)
        along += std::abs(validated::approximate(claim.after.frame(i, j))) * off[i];
      if (!(along <= room[j])) return order;
    }
  }
  return order;
}

/// sum_k V_k h^k over the box, for k up to `derivative_order_`.
void StepCheck::find_derivatives(const ArbBall& length) {
  const std::vector<Vector> tangents =
      tangents_along(flow_, box_, derivative_order_, bits_, forwards_);
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
  tube_jacobian_->expand(times_of(claim), tube_box_, forwards_);
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
/// \param order  up to which derivatives, and the series of the middle, are used: see
///               `order_of_derivatives`
TraceFault StepCheck::leads_inside(const StepClaim& claim, const ArbBall& time, int order) {
  derivative_order_ = order;
  point_.expand(time, claim.before.middle, forwards_, order);
  find_derivatives(claim.length);
  if (tube_jacobian_) find_whole_derivatives(claim);
  const BallSet &from = claim.before, &to = claim.after;
  const std::size_t n = from.dimension();
  BallMatrix inverse;
  if (!invert(to.frame, inverse)) return TraceFault::frame;
  BallSet image = to;  // around the same middle; of its coordinates those are found now
  Vector shift(n);
  for (std::size_t i = 0; i < n; ++i) {
    ArbBall sum;
    const Vector &series = point_.state(i), &over_box = box_.state(i);
    const auto last = static_cast<std::size_t>(derivative_order_);
    for (std::size_t k = series.size(); k-- > 1;)
      sum = (sum + (k > last ? over_box[k] : series[k])) * claim.length;
    // The middles are near each other: what they differ by is hardly rounded.
    shift[i] = (from.middle[i] - to.middle[i]) + (sum + remainder_[i]);
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
  const ArbBall after = time_of(claim.elapsed + claim.length);
  for (std::size_t a = 0; a < bounds_.size(); ++a) {
    if (claim.columns[a] < 0) continue;
    if (!bounds_[a].bound(image, static_cast<std::size_t>(claim.columns[a]), hull, after))
      return TraceFault::level;
  }
  for (std::size_t i = 0; i < n; ++i)
    if (!validated::is_usable(image.rest[i]) || !validated::contains(to.rest[i], image.rest[i]))
      return TraceFault::outside;
  return TraceFault::none;
}

ArbBall StepCheck::times_of(const StepClaim& claim) const {
  return time_of(claim.elapsed + validated::from_zero_to(claim.length));
}

/// All solutions at the times within the step: sum_{k <= N} X_k t^k + x_{N+1}(D) t^{N+1}.
Vector StepCheck::states_at(const ArbBall& elapsed) const {
  Vector result;
  for (std::size_t i = 0; i < remainder_.size(); ++i) {
    const Vector& series = box_.state(i);
    ArbBall sum;
    for (auto k = static_cast<std::size_t>(order_) + 1; k-- > 0;) sum = sum * elapsed + series[k];
    result.push_back(sum + validated::from_zero_to(remainder_[i]));
  }
  return result;
}

/// \param on_box  whether something holds on a box and at some times.
template <class OnBox>
bool StepCheck::holds_all_along(const OnBox& on_box, const StepClaim& claim) const {
  if (on_box(tube_box_, times_of(claim))) return true;
  constexpr int kParts = 16;
  const ArbBall length = claim.length * ArbBall(1. / kParts);
  for (int k = 0; k < kParts; ++k) {
    const ArbBall t = length * ArbBall(static_cast<double>(k)) + validated::from_zero_to(length);
    if (!on_box(states_at(t), time_of(claim.elapsed + t))) return false;
  }
  return true;
}

bool StepCheck::is_analytic(validated::BallFunction<ArbBall>& function,
                            const StepClaim& claim) const {
  const auto has_value_on = [&](const Vector& box, const ArbBall& time) {
    try {
      return validated::is_usable(function(box, time)[0]);
    } catch (const std::domain_error&) {
      return false;
    }
  };
  return holds_all_along(has_value_on, claim);
}

TraceFault StepCheck::operator()(const StepClaim& claim) {
  try {
    const Vector hull = hull_of(claim.before);
    const ArbBall time = time_of(claim.elapsed);
    box_.expand(time, hull, forwards_);
    if (!stays_in_tube(claim, hull)) return TraceFault::not_enclosed;
    for (LevelBound& bound : bounds_) {
      const auto on_box = [&](const Vector& box, const ArbBall& at) {
        return bound.is_analytic_on(box, at);
      };
      if (bound.usable() && !holds_all_along(on_box, claim)) bound.give_up();
    }
    const TraceFault fault = leads_inside(claim, time, order_of_derivatives(claim));
    if (fault == TraceFault::none || derivative_order_ == order_) return fault;
    return leads_inside(claim, time, order_);
  } catch (const std::domain_error&) {
    return TraceFault::no_value;
  }
}

}  // namespace casimir::certificate
