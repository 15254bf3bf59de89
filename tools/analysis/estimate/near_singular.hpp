#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/program/interpreter.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// Watches what the equations divide by: where it comes near zero, digits are lost and steps become
/// short, though the motion itself may be harmless, as in Euler angles near the vertical.
class NearSingular {
 public:
  /// \param run  must outlive this object.
  explicit NearSingular(const PreparedScene& run);

  /// Whether there is anything to watch.
  bool divides() const { return !ranges_.empty(); }
  /// Looks at the state after a step.
  void see(double t, const double* x);

  /// A sentence, if a divisor changed its sign, or came down to less than a thousandth of its
  /// largest value: when, and in which state.
  std::optional<std::string> finding() const;
  /// Whether a divisor changed its sign.
  bool crossed() const;
  /// Whether the run goes to and fro over a zero of a divisor, near it and in steps that are tiny
  /// beside those before: a solution ends there, as that of x' = -1/x does, and an error of the
  /// size of the tolerance takes each step to the other side.
  bool goes_to_and_fro() const { return to_and_fro_; }

 private:
  struct Range {
    double least = 0, largest = 0;
    double time = 0;
    double last = 0;                ///< its value after the last step
    std::optional<double> crossed;  ///< the first time at which it has another sign
    std::vector<double> state;
  };
  void count(double t, std::optional<double> crosses);

  const PreparedScene& run_;
  unsigned long long steps_ = 0;
  double step_before_ = 0;  ///< the mean one up to the first change of sign
  unsigned long long window_begins_ = 0, changes_ = 0;
  double window_time_ = 0;
  double farthest_ = 0;  ///< from zero at a change of sign, as a part of the largest value
  bool to_and_fro_ = false;
  std::optional<Interpreter> divisors_;
  std::vector<std::vector<std::size_t>> states_;  ///< that each divisor depends on
  std::vector<double> inputs_, values_;
  std::vector<Range> ranges_;
};

}  // namespace casimir
