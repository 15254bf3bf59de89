#pragma once

#include <functional>
#include <vector>

#include "runtime/module_abi.h"

namespace casimir {

/// Takes a solution past a place at which the equations are continuous and have no derivatives, as
/// sqrt(t) at 0 or |x|^(2/3) at x = 0: there a solution has no Taylor series, and a step of that
/// method shrinks to nothing.
///
/// It is Gragg's midpoint rule, extrapolated (Hairer, Norsett, Wanner: Solving Ordinary
/// Differential Equations I, 1993, II.9), whose steps shrink towards the place and grow behind it.
/// A pole is not passed, nor an end of the domain, nor a place from which solutions part: small
/// changes of the start are followed as well, and none may grow more than a thousand times.
class Passage {
 public:
  /// Writes dx/dt at a time and a state.
  using Rates = std::function<void(double t, const double* x, double* rates)>;

  /// \param run  the tolerances; where it begins, its observer and what looks at steps.
  Passage(Rates rates, const casimir_run& run, std::size_t states);

  /// Goes from the time `t` and the state `x` on, at most up to `furthest`, as one step that is
  /// looked at and observed.
  /// \return  whether that was possible; `t` and `x` are then those behind the place.
  bool pass(double& t, double* x, double furthest);

  /// Whether the observer asked for the end.
  bool stopped() const { return stopped_; }
  unsigned long long evaluations() const { return evaluations_; }

 private:
  using State = std::vector<double>;

  bool goes(double t, State& x, double end);
  double attempt(double t, const State& x, double end);
  bool midpoint(double t, const State& x, double end, int pieces, State& gain);
  bool is_the_only_one(double t, const State& x, double end, const State& there);
  static void state_at(const casimir_step* step, double t, double* x);

  const Rates rates_;
  const casimir_run& run_;
  const std::size_t states_;
  State rate_, gain_;             ///< of the last trial
  double moved_ = 0, apart_ = 0;  ///< the largest of what it adds, and of what is in doubt of that
  bool stopped_ = false;
  unsigned long long evaluations_ = 0;
};

}  // namespace casimir
