#pragma once

#include <vector>

#include "runtime/module_abi.h"
#include "runtime/section.hpp"
#include "runtime/section/section_roots.hpp"
#include "runtime/taylor/jet_layout.hpp"

namespace casimir {

struct PlaneOfOrbit {
  bool upwards = true;
  double period = 0;
  const JetLayout& function;
  std::size_t states = 0;  ///< of the system, without deviations
};

/// What a step is to the orbit in one of its lanes.
struct LaneOfStep {
  const casimir_lane_step& step;
  int lane;
  const double* series;  ///< coefficients of the section function, in all lanes
  const casimir_jet_range& range;

  double coefficient(int k) const { return series[k * step.lanes + lane]; }
  double taken() const { return step.taken[lane]; }
  /// State i at s units after the beginning.
  double state(std::size_t i, double s) const;
};

/// An orbit on its way: on which side of the plane it is, and what has been found of it.
class RunningOrbit {
 public:
  explicit RunningOrbit(std::vector<double> seed) : start_(std::move(seed)) {}

  /// Where it is to be continued from.
  const std::vector<double>& start() const { return start_; }
  std::size_t found() const { return result_.size(); }

  /// Takes the crossings of a step. Whether the orbit is to leave its lane: complete, not coming
  /// back, or with a deviation that has grown large.
  bool see(const LaneOfStep& step, const PlaneOfOrbit& plane, const SectionSettings& settings);

  /// The next step has no convergent series of the function.
  void doubt() { result_.uncertain = true; }

  /// Takes the state in which it left its lane. Whether it is to go on from `start`.
  bool leave(const double* x, const casimir_outcome& outcome, const SectionSettings& settings);

  SectionOrbit result() && { return std::move(result_); }

 private:
  /// Whether it has not crossed for too long.
  bool gone(const SectionSettings& settings);
  void begin(const LaneOfStep& step, const PlaneOfOrbit& plane);
  /// Makes the values of this step those that follow the last one's.
  void join(const LaneOfStep& step, const PlaneOfOrbit& plane);
  std::vector<PolynomialRoot> passages_in(const LaneOfStep& step, const PlaneOfOrbit& plane) const;
  /// The place where the function itself is `value`, next to where its series is.
  double exact_place(const LaneOfStep& step, const PlaneOfOrbit& plane, double at,
                     double value) const;
  double off_plane(const LaneOfStep& step, const PlaneOfOrbit& plane, double at,
                   double value) const;
  double place_of_sign(const LaneOfStep& step, const PlaneOfOrbit& plane, double at,
                       double value) const;
  void record(const LaneOfStep& step, double at, const SectionSettings& settings);
  double size_of_deviation(const double* deviation, const SectionSettings& settings) const;

  std::vector<double> start_;
  SectionOrbit result_;
  double offset_ = 0;  ///< time at `start`
  double log_growth_ = 0;
  bool begun_ = false, goes_on_ = false;
  /// The function is shift + what the series says. It is above level k, which is k * period, where
  /// k <= cell.
  double shift_ = 0, last_ = 0;
  long long cell_ = 0;
  unsigned long long since_ = 0;  ///< steps since the last crossing
};

}  // namespace casimir
