#pragma once

#include <string>

namespace casimir {

/// What a run's answer is worth, beside the truth.
enum class Judgement {
  right,       ///< says ok, and the error is one that tolerance and rounding explain
  warned,      ///< says ok and that its end state is not to be trusted, which is true
  refused,     ///< says that it is not ok: the end was not reached, or not as asked
  inaccurate,  ///< says ok with few digits; a thousand times the tolerance, each step, explain it
  wrong,       ///< says ok and is not: a silent wrong answer
  unknown,     ///< says ok, and nobody knows the truth
};

/// "right", ..
std::string to_string(Judgement judgement);

/// What a run has said and what is known about it.
struct Answer {
  bool ok = true;           ///< that it reached the end as asked
  bool warned = false;      ///< it said that its end state is not to be trusted
  bool finite = true;       ///< every number that it gave: states and drifts
  bool has_end = true;      ///< the exact motion reaches the end time
  bool meets_pole = false;  ///< of the equations, on the way; perhaps one that can be removed
  double error = 0;         ///< see `error_of`; not a number: there is no truth to compare with
  double explained = 0;     ///< see `explained_error`; infinite where that is not known
  double tolerance = 1e-8;  ///< relative, that was asked for
};

/// The judgement of one run.
///
/// A run that is not ok is refused, whatever its state. One that is ok although the exact motion
/// does not reach the end, or with a number that is not finite, is wrong whatever it warns of; one
/// that went over a pole of the equations is wrong unless it warned.
/// Otherwise an error is wrong that is more than `explained`, or a tenth of the states' size: such
/// an end state has nothing to do with the motion. An error that leaves less than three digits,
/// where the tolerance asks for more than that, is inaccurate. Whoever warned is not blamed.
Judgement judge(const Answer& answer);

}  // namespace casimir
