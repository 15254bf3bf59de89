#pragma once

#include <limits>
#include <string>

#include "runtime/integrate.hpp"

namespace casimir {

/// What became of a measured run, beyond how its integration ended.
enum class RowEnd {
  ran,             ///< it ended as `Row::status` says
  wrong,           ///< it says ok, and its error has no explanation
  too_slow,        ///< it was given up, for the sake of the others
  refused,         ///< it did not begin
  crashed,         ///< its process ended without an answer
  does_not_split,  ///< the method splits the Hamiltonian, and this one does not split
  drifted,         ///< an invariant drifted beyond `Row::bound`
  lost,            ///< an invariant has no value at some state; `Row::reason` is its name
  changes,  ///< no invariant drifted, and one has another rate than zero; `Row::reason` is its name
  changes_in_step,  ///< the same of a map: another value at the next point
};

/// One scene by one method: a row of the tables of measured runs.
struct Row {
  std::string case_name, scene, method;
  std::string code = "specialised";  ///< or "general": parameters at run time, nothing left out
  double tolerance = 0;
  double error = std::numeric_limits<double>::quiet_NaN();  ///< not a number: there is no reference
  double drift = 0;                                         ///< not a number: there is no invariant
  double seconds = 0;
  double spread = 0;  ///< half the distance of the quartiles of repeated runs
  int rounds = 1;     ///< in which the time was taken; 0: it is that of a run that did not arrive
  unsigned long long steps = 0, evaluations = 0;
  RowEnd end = RowEnd::ran;
  Status status = Status::ok;  ///< of the integration
  double bound = 0;            ///< what a row that `drifted` went beyond
  std::string reason = {};     ///< a sentence, where the end needs one
  bool refused = false;        ///< it did not arrive, and may do so
  bool failed = false;         ///< it counts as a failure

  /// Whether it arrived, and nothing is wrong with it.
  bool ok() const { return end == RowEnd::ran && status == Status::ok; }
};

}  // namespace casimir
