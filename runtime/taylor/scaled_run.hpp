#pragma once

#include <vector>

#include "runtime/module_abi.h"

namespace casimir {

/// A run in other units: the states of the kernel are those of the caller divided by a power of
/// two, so that products of states stay in the range of numbers. The observer sees the caller's
/// states. It ends where these, unlike the kernel's, are no numbers any more.
class ScaledRun {
 public:
  /// \param states  their number
  ScaledRun(const casimir_run& run, double scale, std::size_t states);
  ScaledRun(const ScaledRun&) = delete;
  ScaledRun& operator=(const ScaledRun&) = delete;

  const casimir_run& run() const { return scaled_; }
  /// Makes the kernel's end state and outcome those of the caller.
  void finish(double* x, casimir_outcome* out) const;

  /// The unit for a state: 1 unless squares of its entries come near the ends of the range.
  static double scale_for(const double* x, std::size_t states);

 private:
  static int observe(void* self, const casimir_step* seen);
  static void dense(const casimir_step* step, double t, double* x);

  const casimir_run& run_;
  casimir_run scaled_;
  const double scale_;
  std::vector<double> x0_, x1_;
  const casimir_step* seen_ = nullptr;
  bool left_range_ = false;
  double t0_ = 0;  ///< where the step begins that leaves it
};

}  // namespace casimir
