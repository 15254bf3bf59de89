#include "tools/plot/drift_plot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace casimir::tools {
namespace {

constexpr std::size_t kIntervals = 400;
constexpr double kRoundingOfDrift = 1e-16;

/// A logarithmic axis has no zero. Where a drift only passes through it the line goes on; one that
/// is always zero is drawn at the size of rounding, so that it is seen.
Curve without_zeros(Curve curve) {
  const auto positive = [](const auto& point) { return point.second > 0; };
  if (std::ranges::any_of(curve.points, positive)) {
    std::erase_if(curve.points, [&](const auto& point) { return !positive(point); });
  } else {
    for (auto& point : curve.points) point.second = kRoundingOfDrift;
  }
  return curve;
}

}  // namespace

DriftRecord::DriftRecord(std::string method, std::vector<std::string> invariants, double duration)
    : method_(std::move(method)),
      invariants_(std::move(invariants)),
      duration_(std::abs(duration)),
      intervals_(kIntervals),
      scale_(invariants_.size(), 1) {}

void DriftRecord::follow(Settings& settings) {
  settings.invariant_changes = [this](double t, const double* changes) {
    const double share = duration_ > 0 ? std::abs(t) / duration_ : 0;
    const auto at = static_cast<std::size_t>(share * static_cast<double>(kIntervals));
    Interval& interval = intervals_[std::min(at, kIntervals - 1)];
    interval.time = t;
    interval.changes.resize(invariants_.size());
    for (std::size_t i = 0; i < invariants_.size(); ++i)
      interval.changes[i] = std::max(interval.changes[i], changes[i]);
  };
}

void DriftRecord::finish(const Trajectory& trajectory) {
  for (std::size_t i = 0; i < invariants_.size(); ++i) {
    double change = 0;
    for (const Interval& interval : intervals_)
      if (!interval.changes.empty()) change = std::max(change, interval.changes[i]);
    if (change > 0 && std::isfinite(change)) scale_[i] = trajectory.invariants[i].drift / change;
  }
}

std::vector<Curve> DriftRecord::by_invariant() const {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < invariants_.size(); ++i) {
    Curve curve{invariants_[i], {}, Curve::Style::line};
    for (const Interval& interval : intervals_) {
      if (!interval.changes.empty())
        curve.points.emplace_back(interval.time, interval.changes[i] * scale_[i]);
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

Curve DriftRecord::largest() const {
  Curve all{method_, {}, Curve::Style::line};
  for (const Curve& curve : by_invariant()) {
    if (all.points.empty()) all.points = curve.points;
    for (std::size_t i = 0; i < curve.points.size(); ++i)
      all.points[i].second = std::max(all.points[i].second, curve.points[i].second);
  }
  return all;
}

Plot drift_picture(const std::string& title, const std::vector<DriftRecord>& records) {
  Plot plot{.title = title,
            .x_label = "time",
            .y_label = "relative drift of an invariant",
            .log_y = true};
  if (records.size() == 1) {
    plot.title += ", " + records.front().method();
    for (Curve& curve : records.front().by_invariant())
      plot.curves.push_back(without_zeros(std::move(curve)));
    return plot;
  }
  plot.y_label = "largest relative drift of the invariants";
  for (const DriftRecord& record : records) plot.curves.push_back(without_zeros(record.largest()));
  return plot;
}

}  // namespace casimir::tools
