#pragma once

#include <string>
#include <vector>

#include "runtime/integrate.hpp"
#include "tools/plot/plot.hpp"

namespace casimir::tools {

/// The drift of every invariant along one run, as the largest in each of a few hundred intervals of
/// time: how many steps there are does not matter.
class DriftRecord {
 public:
  /// \param duration  of the run; its sign does not matter.
  DriftRecord(std::string method, std::vector<std::string> invariants, double duration);

  /// Lets the run report to this record, which has to outlive it.
  void follow(Settings& settings);

  /// After the run: its invariants tell what the changes are relative to.
  void finish(const Trajectory& trajectory);

  const std::string& method() const { return method_; }

  /// A curve for each invariant, called like it.
  std::vector<Curve> by_invariant() const;

  /// The largest of all, called like the method.
  Curve largest() const;

 private:
  struct Interval {
    double time = 0;
    std::vector<double> changes;  ///< empty: no step ended in it
  };

  std::string method_;
  std::vector<std::string> invariants_;
  double duration_;
  std::vector<Interval> intervals_;
  std::vector<double> scale_;
};

/// Drift against time: one curve an invariant, or with several methods one curve a method.
Plot drift_picture(const std::string& title, const std::vector<DriftRecord>& records);

}  // namespace casimir::tools
