#include "tools/analysis/estimate/parting_start.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/program/interpreter.hpp"

namespace casimir {
namespace {

using Vector = Eigen::VectorXd;

/// The equations about the start of a run.
class Surroundings {
 public:
  Surroundings(const PreparedScene& run, double begin)
      : rates_(run.specialisation.rhs),
        begin_(begin),
        start_(Eigen::Map<const Vector>(run.initial.data(),
                                        static_cast<Eigen::Index>(run.initial.size()))),
        inputs_(run.initial) {
    inputs_.insert(inputs_.end(), run.parameters.begin(), run.parameters.end());
    inputs_.push_back(0);
    size_ = start_.norm() > 0 ? start_.norm() : 1;
  }

  Eigen::Index states() const { return start_.size(); }

  /// How much faster the rates change with a coordinate near the start than farther away from it; 0
  /// where they have no values or do not change there.
  double steepening(Eigen::Index i, double side) {
    constexpr double kFar = 1e-4, kNear = 1e-8;
    const double far = slope(i, side * kFar), near = slope(i, side * kNear);
    return std::isfinite(far) && far > 0 ? near / far : 0;
  }

  /// How far a solution from beside the start is from the one that begins there.
  double distance_after(double time, Eigen::Index i, double aside) {
    Vector beside = start_;
    beside(i) += aside * size_;
    return (end_of(beside, time) - end_of(start_, time)).norm();
  }

 private:
  Vector rates(const Vector& x, double time) {
    std::copy(x.data(), x.data() + x.size(), inputs_.begin());
    inputs_.back() = begin_ + time;
    Vector result(x.size());
    rates_(inputs_.data(), result.data());
    return result;
  }

  double slope(Eigen::Index i, double aside) {
    Vector beside = start_;
    beside(i) += aside * size_;
    return (rates(beside, 0) - rates(start_, 0)).norm() / std::abs(aside);
  }

  /// By Runge's and Kutta's method.
  Vector end_of(Vector x, double duration) {
    constexpr int kStepsBeside = 200;
    const double h = duration / kStepsBeside;
    for (int step = 0; step < kStepsBeside; ++step) {
      const double t = step * h;
      const Vector a = rates(x, t), b = rates(x + h / 2 * a, t + h / 2),
                   c = rates(x + h / 2 * b, t + h / 2), d = rates(x + h * c, t + h);
      x += h / 6 * (a + 2 * b + 2 * c + d);
    }
    return x;
  }

  Interpreter rates_;
  double begin_;
  Vector start_;
  std::vector<double> inputs_;
  double size_ = 1;
};

}  // namespace

bool may_part_at_start(const PreparedScene& run, double begin, double duration) {
  // Of a root the slope grows like a power of the distance, of a logarithm twice.
  constexpr double kSteeper = 4, kFirst = 1e-10, kSecond = 1e-13, kAsFar = 0.5, kShort = 0.03;
  Surroundings surroundings(run, begin);
  for (Eigen::Index i = 0; i < surroundings.states(); ++i) {
    for (const double side : {-1., 1.}) {
      if (!(surroundings.steepening(i, side) > kSteeper)) continue;
      const double first = surroundings.distance_after(kShort * duration, i, side * kFirst);
      const double second = surroundings.distance_after(kShort * duration, i, side * kSecond);
      if (std::isfinite(first) && second > kAsFar * first) return true;
    }
  }
  return false;
}

}  // namespace casimir
