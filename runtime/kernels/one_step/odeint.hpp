#pragma once

// Boost.Odeint's steppers on the same generated right-hand side, as a yardstick.

#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_fehlberg78.hpp>
#include <boost/numeric/odeint/stepper/generation/make_controlled.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include "runtime/kernels/one_step/control.hpp"

namespace casimir_kernel::odeint {

using boost::numeric::odeint::runge_kutta_dopri5;
using boost::numeric::odeint::runge_kutta_fehlberg78;

template <class System, template <class...> class Stepper>
struct Peer {
  static constexpr int n = System::n;
  using State = std::array<double, n>;

  struct Equations {
    const double* p;
    unsigned long long* evaluations;
    void operator()(const State& x, State& dx, double t) const {
      ++*evaluations;
      System::rhs(t, x.data(), p, dx.data());
    }
  };

  /// Odeint has no dense output for all of its steppers: one plain step from the last state.
  static void dense(const casimir_step* step, double t, double* at) {
    Equations equations = *static_cast<const Equations*>(step->data);
    State x;
    for (int i = 0; i < n; ++i) x[i] = step->x0[i];
    if (t != step->t0) Stepper<State>().do_step(equations, x, step->t0, t - step->t0);
    for (int i = 0; i < n; ++i) at[i] = x[i];
  }

  static void integrate(const casimir_run* run, double* start, casimir_outcome* out) {
    using boost::numeric::odeint::make_controlled;
    *out = casimir_outcome{};
    const Equations equations{run->parameters, &out->evaluations};
    auto stepper = make_controlled(run->atol, run->rtol, Stepper<State>());
    State x, before;
    for (int i = 0; i < n; ++i) x[i] = start[i];
    double t = run->t_begin, h = (run->t_end - run->t_begin) * 1e-3;
    out->status = all_finite<n>(x.data()) ? CASIMIR_OK : CASIMIR_NON_FINITE;
    while (out->status == CASIMIR_OK && t != run->t_end) {
      if (run->max_steps && out->steps + out->rejected >= run->max_steps) {
        out->status = CASIMIR_MAX_STEPS;
        break;
      }
      const bool last = magnitude(h) >= magnitude(run->t_end - t);
      if (last) h = run->t_end - t;
      if (!(magnitude(h) > larger(16 * kEpsilon * magnitude(t), 16 * kSmallest)) && !last) {
        out->status = CASIMIR_STEP_UNDERFLOW;
        break;
      }
      before = x;
      const double t0 = t;
      if (stepper.try_step(equations, x, t, h) != boost::numeric::odeint::success) {
        ++out->rejected;
        continue;
      }
      if (!all_finite<n>(x.data())) {
        x = before;
        t = t0;
        out->status = CASIMIR_NON_FINITE;
        break;
      }
      ++out->steps;
      if (last) t = run->t_end;
      const casimir_step seen = {t0,     t,          before.data(), x.data(),
                                 &dense, &equations, nullptr,       nullptr};
      if (run->observe && run->observe(run->observer, &seen) && t != run->t_end)
        out->status = CASIMIR_STOPPED;
    }
    for (int i = 0; i < n; ++i) start[i] = x[i];
    out->t = t;
  }
};

template <class System, template <class...> class Stepper>
void integrate(const casimir_run* run, double* x, casimir_outcome* out) {
  Peer<System, Stepper>::integrate(run, x, out);
}

}  // namespace casimir_kernel::odeint
