#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "runtime/digits/root_zeros.hpp"
#include "runtime/integrate.hpp"
#include "runtime/program/interpreter.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// Watches along a run in double precision whether it comes to a place from which more than one
/// solution may go on: where the argument u of a root is zero at which the equations are not
/// Lipschitz continuous (RootZeros), and du/dt goes to zero with u, and more slowly than u. A
/// motion with du/dt != 0 there has u for its time, and is the only one; x' = -sqrt|x| may stay at
/// 0, or go on. A place that is touched between two steps, and not passed, is not seen.
class PartingSolutions {
 public:
  explicit PartingSolutions(const PreparedScene& run);

  /// Has a run that these settings are for watched beside what they do already. Borrowed by them.
  void watch(Settings& settings);
  /// The time of the first such place, if there was one.
  const std::optional<double>& time() const { return time_; }

 private:
  void see(double t, const double* x);
  std::vector<double> speeds(double part, const RootZeros::StateAt& at, double time);
  bool parts_at(double part, const RootZeros::StateAt& at, double duration);

  RootZeros roots_;
  std::optional<Interpreter> rates_;  ///< none where there are no such roots
  double last_time_ = 0;              ///< the end of the last step ..
  std::vector<double> last_;          ///< .. and the state there
  std::vector<double> inputs_;        ///< of the right-hand side
  std::optional<double> time_;
};

}  // namespace casimir
