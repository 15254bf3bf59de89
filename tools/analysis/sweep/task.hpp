#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/integrate.hpp"
#include "tools/analysis/sweep/grid_point.hpp"

namespace casimir {

/// What was found at one point of a grid: a status, and a number for each column of the task.
struct PointResult {
  Status status = Status::stopped;
  std::vector<double> values;
};

/// What a sweep does at each of its points. An implementation is a file beside this one and a name
/// in `sweep --do`. What it finds at a point must not depend, by a single bit, on the others, on
/// their number, or on the number of threads.
class SweepTask {
 public:
  virtual ~SweepTask() = default;

  /// Names of the numbers that it finds at a point.
  virtual std::vector<std::string> columns() const = 0;

  /// The one that a picture shows where none is named; empty where none is more than the others.
  virtual std::string principal_column() const { return {}; }

  /// Everything that the results follow from, besides the points: a sweep goes on only from results
  /// of the same text.
  virtual std::string fingerprint() const = 0;

  /// Why a point could not be done to the end: a sentence.
  virtual std::string reason(Status status) const { return reason_of(status); }

  /// Where it is done.
  virtual const GridPoints& places() const = 0;

  /// Results for these points, in their order.
  /// \param give_up  true ends it: the points that are not done are `stopped`
  virtual std::vector<PointResult> run(const std::vector<std::size_t>& points, int threads,
                                       const std::function<bool()>& give_up) const = 0;
};

/// What results follow from that are made by integrating this system so: its code, the values that
/// are the same at all points, the method and all that steers it.
std::string run_fingerprint(const PreparedScene& run, const Method& method,
                            const Settings& settings);

}  // namespace casimir
