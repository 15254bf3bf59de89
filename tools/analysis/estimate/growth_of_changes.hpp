#pragma once

#include <optional>
#include <vector>

#include "runtime/integrate.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// How small changes of the state grow along a run, from the variational equations: the derivative
/// of the flow from the start, column by column, and along one direction each from a few later
/// times. Relative to the sizes of the states; where all states are less than a tenth of these at
/// the time at which a change is made, to that part of them: rounding makes no larger ones, nor
/// does the absolute tolerance.
struct Conditioning {
  /// A change has grown so many times by then.
  struct Growth {
    double time = 0, factor = 1;
  };
  /// What a change made at any time has grown to at most, up to each of these times; where it has
  /// doubled.
  std::vector<Growth> growth;
  double at_end = 1;  ///< growth up to the end, of whatever change grows most
  double on_the_way() const { return growth.back().factor; }  ///< the same, up to any time
  std::vector<double> columns;  ///< growth up to the end of a change of each initial value
  double followed = 0;          ///< up to this time; what follows is extrapolated

  /// The last time before a growth of `factor`; nothing if it is not reached.
  std::optional<double> time_of(double factor) const;
};

/// The sizes of states that growth and errors are measured against: their largest values in a run,
/// and no less than a billionth of the largest of them, which is all that is left of a zero.
std::vector<double> sizes_of(const Trajectory& trajectory);

/// The states whose own sizes are smaller than that, though they do not begin at 0: an estimate of
/// the error says nothing of them.
std::vector<std::size_t> smaller_states(const Trajectory& trajectory,
                                        const std::vector<double>& initial);

/// Integrates the variational equations along a run of `duration` by Taylor series, without a
/// compiler, at the tolerance of the run or a tighter one; in a limited number of steps. Beyond,
/// growth is extrapolated: by the power of time, or exponentially, that fits its second half.
/// Nothing where that run does not get anywhere.
/// \param stiff  the steps heed the changes as well, which an explicit method makes explode in
///               equations that are stiff.
std::optional<Conditioning> conditioning(const PreparedScene& run, const Settings& settings,
                                         double duration, const std::vector<double>& sizes,
                                         bool stiff = false);

}  // namespace casimir
