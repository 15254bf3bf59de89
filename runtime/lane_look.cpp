#include "runtime/lane_look.hpp"

namespace casimir {
namespace {

/// What a step is in one of its lanes.
struct Seen {
  const casimir_lane_step& step;
  int lane;
  std::size_t states;

  double unit() const { return step.unit[lane]; }

  /// The state at s units after the beginning.
  void state(double s, double* x) const {
    for (std::size_t i = 0; i < states; ++i) {
      const double* const row = step.rows[i] + lane;
      double sum = 0;
      for (int k = step.order; k >= 0; --k) sum = sum * s + row[k * step.lanes];
      x[i] = sum;
    }
  }
};

void state_at(const casimir_step* step, double t, double* x) {
  const Seen& seen = *static_cast<const Seen*>(step->data);
  seen.state((t - step->t0) / seen.unit(), x);
}

}  // namespace

LaneLook::LaneLook(const StepWatch& watch, std::size_t states, int lanes)
    : states_(states),
      lanes_(static_cast<std::size_t>(lanes), Lane{StepLook(watch, states, nullptr)}),
      begin_(states),
      end_(states) {}

double LaneLook::operator()(const casimir_lane_step& trial, int lane, const double* parameters) {
  Lane& own = lanes_[static_cast<std::size_t>(lane)];
  if (own.member != trial.member[lane]) {
    own.member = trial.member[lane];
    own.look.begin(parameters);
  }
  const Seen seen{trial, lane, states_};
  seen.state(0, begin_.data());
  seen.state(trial.taken[lane], end_.data());
  const double t0 = trial.t[lane], t1 = t0 + trial.taken[lane] * seen.unit();
  return own.look({t0, t1, begin_.data(), end_.data(), &state_at, &seen, nullptr, nullptr});
}

}  // namespace casimir
