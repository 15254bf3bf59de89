#pragma once

#include <optional>
#include <vector>

#include "runtime/integrate.hpp"
#include "runtime/program/angle_branches.hpp"

namespace casimir {

/// Watches a run step by step: records samples and the drift of the invariants, whichever library
/// makes the steps.
class Observer {
 public:
  Observer(const Module& module, const Settings& settings, const double* parameters,
           const std::vector<double>& initial);

  /// True if there is anything to do after each step.
  bool needed() const;

  /// \param state_at  writes the state at a time inside the step.
  /// \return          whether the run shall go on.
  bool step(double t1, const double* x1, const std::function<void(double t, double* x)>& state_at);

  /// Puts samples and invariants into the trajectory, whose time and state are set.
  void finish(Trajectory& trajectory);

 private:
  void record_size(const double* x);
  void follow_angles(const std::vector<double>& initial);
  void evaluate(double t, const double* x);
  void evaluate_terms(double t, const double* x);
  void record_change(double t, const double* x);
  void record_terms(double t, const double* x);
  void record_local_error(double t, const double* x);
  double allowed_drift(std::size_t invariant, unsigned long long steps) const;

  const Module& module_;
  const Settings& settings_;
  const double* parameters_;
  std::vector<double> values_, changes_now_, scratch_, state_sizes_;
  std::vector<long double> wide_, terms_, sizes_, changes_, local_;
  bool leaves_range_ = false;  ///< of double: then the values come from Settings::invariant_terms
  std::optional<AngleFollower> angles_;  ///< of the invariants, if they have any
  std::vector<InvariantRecord> invariants_;
  std::vector<double> times_;
  std::vector<std::vector<double>> samples_;
  unsigned long long next_sample_ = 1;
  unsigned long long steps_ = 0;
};

}  // namespace casimir
