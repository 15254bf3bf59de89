#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/work_precision.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// Why there is no reference state.
enum class NoReference {
  none,           ///< there is one
  contradicted,   ///< that of the case file is not what our own run ends in
  took_too_long,  ///< our own run did
  not_reached,    ///< our own run did not reach the end, or not well enough
};

/// The state that errors are measured against, and how good it is.
struct ReferenceStateOrReason {
  std::optional<ReferenceState> truth = {};
  std::string source = {};  ///< "the case file, checked by our own run with 40 digits", ..
  double error_bound = 0;   ///< of any state, relative to its size along the run
  int digits = 0;           ///< significant ones: of the file's numbers, or of our own run
  std::string reason = {};  ///< why there is none
  NoReference failure = NoReference::none;
  /// Where the motion has no value at the end: the time after which our own run found none.
  std::optional<double> singular_time = {};
};

/// How a reference state is found.
struct ReferenceOptions {
  int digits = 30;              ///< of a run of our own
  bool check_the_file = false;  ///< by a run of our own, if it does not take too long
  bool only_the_file = false;   ///< no run of our own where the file has no state for this one
  double longest = 60;          ///< seconds that a run of our own may take
  std::function<bool()> give_up = {};
};

/// The reference state of the case file where it belongs to this run, otherwise one of a
/// multiprecision run of our own; where that takes too long, the middle of an enclosure in double
/// precision (see validated_run), if its half width is below 1e-9 of the sizes of the states, which
/// is then the error bound, a proved one.
///
/// Its error bound is that of our own run, and for a state from the file the difference to our own
/// run on top of it; where that was not made, half a unit in the last of the file's digits. A state
/// in the file that our own run contradicts is no truth.
ReferenceStateOrReason reference_state_of(const Scene& scene, const PreparedScene& run,
                                          const ReferenceOptions& options);

/// The largest value that each state takes along a run in double precision, at 200 times; at least
/// a millionth of the largest of all. What errors are measured against.
std::vector<double> state_sizes(const PreparedScene& run);

/// A method that reaches the end of a scene in double precision in a bearable number of steps, with
/// its module: Taylor series, or a method for stiff equations where these take too many.
struct GoodRun {
  const Method* method;
  CompiledModule compiled;
  Trajectory trajectory;  ///< at the tolerance asked for
};

/// The first method that does; the first of all where none does, with a trajectory that is not ok.
GoodRun good_run(const PreparedScene& run, const Settings& settings);

/// How much small changes of the state grow along the run: see runtime/work_precision.hpp. By the
/// method that reaches the end. Infinite where that takes more than a few seconds.
double growth_of(const PreparedScene& run, const ReferenceState& truth);

}  // namespace casimir
