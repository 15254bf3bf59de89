#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "tools/analysis/run/validated.hpp"

namespace casimir {

/// The crossings of a surface by the solutions of a scene, as theorems.
struct ProvedCrossings {
  std::vector<std::string> names;   ///< of the states
  ValidatedRun run;                 ///< with the crossings in both directions
  std::vector<std::string> doubts;  ///< as of ValidatedMotion
};

/// Encloses every crossing of the surface `plane` = 0 from the start of a scene to its duration:
/// its time and the state at it. No crossing is missed and none is there twice: on each part of the
/// way the function is certain not to vanish, or it is certain to be monotone, and has different
/// signs at both ends of the stretch (see runtime/validated/crossings.hpp). Where neither is
/// certain, as where an orbit touches the surface, the status says so, and the crossings before are
/// told.
/// \param plane  over the variables and parameters of the model.
/// \throws as `enclose`.
ProvedCrossings enclose_crossings(const Model& model, const Scene& scene, const GiNaC::ex& plane,
                                  const ValidatedOptions& options = {});

}  // namespace casimir
