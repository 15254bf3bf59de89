#pragma once

#include <cstddef>

#include "symbolic/model.hpp"
#include "tools/analysis/frequency/motion_frequencies.hpp"
#include "tools/analysis/run/assessed_run.hpp"

namespace casimir {

/// A motion, and what frequency analysis says of it.
struct AnalysedMotion {
  AssessedRun run;
  /// Nothing where the run did not reach its end: there are no frequencies of a part of a motion.
  MotionFrequencies found;
};

/// Integrates a scene, more densely until its spectrum ends before the highest frequency that the
/// samples can tell, and finds the strongest lines of each variable. Their errors are those of the
/// spectrum and of the method together. An end state that is not known
/// well enough for frequencies is a warning of `found`.
/// \param run  must outlive the result
/// \param how  its `sample_every` is not used
/// \param lines  of each variable
/// \throws RequestError  for a duration of 0, and as `integrate_assessed`
AnalysedMotion analysed_motion(const Model& model, const Scene& scene, const PreparedScene& run,
                               const AssessmentOptions& how, std::size_t lines);

}  // namespace casimir
