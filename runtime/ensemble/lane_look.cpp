#include "runtime/ensemble/lane_look.hpp"

#include <algorithm>
#include <array>

namespace casimir {
namespace {

/// The states of all lanes, each at a time of its own: x[i * lanes + lane].
template <int lanes>
void states_at(const casimir_lane_step& step, const double* s, std::size_t states, double* x) {
  for (std::size_t i = 0; i < states; ++i) {
    const double* row = step.rows[i] + step.order * lanes;
    std::array<double, lanes> sum;
    for (std::size_t l = 0; l < lanes; ++l) sum[l] = row[l];
    for (int k = step.order; k > 0; --k) {
      row -= lanes;
      for (std::size_t l = 0; l < lanes; ++l) sum[l] = sum[l] * s[l] + row[l];
    }
    std::copy_n(sum.begin(), lanes, x + i * lanes);
  }
}

void states_at(const casimir_lane_step& step, const double* s, std::size_t states, double* x) {
  if (step.lanes == 8)
    states_at<8>(step, s, states, x);
  else if (step.lanes == 4)
    states_at<4>(step, s, states, x);
  else
    states_at<2>(step, s, states, x);
}

/// What a step is in one of its lanes.
struct SeenLane {
  const casimir_lane_step& step;
  int lane;
  std::size_t states;
};

void lane_state_at(const casimir_step* step, double t, double* x) {
  const auto& [all, lane, states] = *static_cast<const SeenLane*>(step->data);
  const double s = (t - step->t0) / all.unit[lane];
  std::fill_n(x, states, 0.);
  for (int k = all.order; k >= 0; --k) {
    const int place = k * all.lanes + lane;
    // The states do not wait for each other.
    for (std::size_t i = 0; i < states; ++i) x[i] = x[i] * s + all.rows[i][place];
  }
}

}  // namespace

LaneLook::LaneLook(const StepWatch& watch, std::size_t states, int lanes, Parameters parameters)
    : states_(states),
      parameters_(std::move(parameters)),
      lanes_(static_cast<std::size_t>(lanes), Lane{StepLook(watch, states, nullptr, nullptr)}),
      places_(lanes_.size()),
      middle_(states * lanes_.size()),
      end_(middle_.size()),
      x0_(states),
      xm_(states),
      x1_(states) {
  for (Lane& lane : lanes_) lane.look.end_at_poles();
}

void LaneLook::end_before_poles() {
  for (Lane& lane : lanes_) lane.look.end_before_poles();
}

bool LaneLook::at_pole(long long member) const {
  return std::ranges::any_of(
      lanes_, [&](const Lane& lane) { return lane.member == member && lane.look.at_pole(); });
}

/// What `looks` says of the step of a lane, whose end is known.
template <class Look>
auto LaneLook::look(const casimir_lane_step& trial, std::size_t lane, const Look& looks) {
  for (std::size_t i = 0; i < states_; ++i) {
    x0_[i] = trial.rows[i][lane];
    x1_[i] = end_[i * lanes_.size() + lane];
  }
  const SeenLane seen{trial, static_cast<int>(lane), states_};
  const double t0 = trial.t[lane], t1 = t0 + trial.taken[lane] * trial.unit[lane];
  return looks(
      casimir_step{t0, t1, x0_.data(), x1_.data(), &lane_state_at, &seen, nullptr, nullptr});
}

void LaneLook::operator()(const casimir_lane_step& trial, double* parts) {
  const std::size_t lanes = lanes_.size();
  states_at(trial, trial.taken, states_, end_.data());
  bool all_quiet = true;
  for (std::size_t l = 0; l < lanes; ++l) {
    Lane& own = lanes_[l];
    if (!trial.held[l]) continue;
    if (own.member != trial.member[l]) {
      own.member = trial.member[l];
      for (std::size_t i = 0; i < states_; ++i) x0_[i] = trial.rows[i][l];
      own.look.begin(parameters_(own.member), x0_.data());
    }
    parts[l] = 1;
    own.quiet = look(trial, l, [&](const casimir_step& seen) { return own.look.is_quiet(seen); });
    all_quiet = all_quiet && own.quiet;
  }
  if (all_quiet) return;
  for (std::size_t l = 0; l < lanes; ++l)
    places_[l] = lanes_[l].look.place_within() * trial.taken[l];
  states_at(trial, places_.data(), states_, middle_.data());
  for (std::size_t l = 0; l < lanes; ++l) {
    if (!trial.held[l] || lanes_[l].quiet) continue;
    for (std::size_t i = 0; i < states_; ++i) xm_[i] = middle_[i * lanes + l];
    parts[l] = look(trial, l, [&](const casimir_step& seen) {
      return lanes_[l].look.within(seen, xm_.data());
    });
  }
}

double LaneLook::of_lane(const casimir_lane_step& trial, int lane) {
  const auto place = static_cast<std::size_t>(lane);
  for (std::size_t i = 0; i < states_; ++i) x0_[i] = trial.rows[i][lane];
  Lane& own = lanes_[place];
  if (own.member != trial.member[lane]) {
    own.member = trial.member[lane];
    own.look.begin(parameters_(own.member), x0_.data());
  }
  const SeenLane seen{trial, lane, states_};
  const double t0 = trial.t[lane], t1 = t0 + trial.taken[lane] * trial.unit[lane];
  const casimir_step step{t0, t1, x0_.data(), x1_.data(), &lane_state_at, &seen, nullptr, nullptr};
  lane_state_at(&step, t1, x1_.data());
  return own.look(step);
}

}  // namespace casimir
