#pragma once

#include <vector>

namespace casimir {

/// One measured run of a method: what it took and how far off it ended.
struct Measured {
  double error = 0;    ///< finite; zero counts as the smallest number above it
  double seconds = 0;  ///< positive
};

/// What a method needs for an error, from its runs at several tolerances.
///
/// Only runs count that no other run beats in both error and time: between two neighbours of those
/// the time is interpolated in the logarithms. An error larger than all of them costs what the
/// fastest run costs; one smaller than all of them is out of reach.
class WorkPrecision {
 public:
  /// In any order.
  explicit WorkPrecision(std::vector<Measured> runs);

  /// Seconds for this error or a smaller one; not a number where the method does not reach it.
  double seconds_at(double error) const;

  /// The smallest error reached; infinity where there is no run.
  double best_error() const;

  /// The runs that no other one beats, by falling error and so by rising time.
  const std::vector<Measured>& envelope() const { return envelope_; }

 private:
  std::vector<Measured> envelope_;
};

/// The geometric mean; not a number for none.
double geometric_mean(const std::vector<double>& values);

}  // namespace casimir
