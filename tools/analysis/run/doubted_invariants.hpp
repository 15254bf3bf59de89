#pragma once

#include <string>
#include <vector>

#include "runtime/ensemble.hpp"
#include "symbolic/discrete/map_model.hpp"
#include "symbolic/prove.hpp"
#include "tools/analysis/run/drift_check.hpp"
#include "tools/analysis/run/iterate.hpp"

namespace casimir {

/// The sentence about an invariant that changed and is not proved to be an integral.
/// \param change  relative to its size
std::string doubt_of_invariant(const std::string& name, double change, const KnownInvariant& known);

/// Sentences about the invariants that changed by much more than the tolerance allows, and are not
/// proved to be integrals.
/// \param drifts  the largest drift of each
std::vector<std::string> doubts_of_drifts(const Model& model, const Scene& scene,
                                          const std::vector<std::string>& names,
                                          const std::vector<double>& drifts, double rtol);

/// The same of the members of an ensemble.
std::vector<std::string> doubts_of_members(const Model& model, const Scene& scene,
                                           const std::vector<std::string>& names,
                                           const EnsembleResult& result, double rtol);

/// The same of an orbit of a map: much more than rounding does to its states.
std::vector<std::string> doubts_of_orbit(const MapModel& map, const Iterated& orbit);

/// The sentence about an orbit whose end is lost in rounding, or of which that is not known; empty
/// for others.
std::string doubt_of_end(const Iterated& orbit);

}  // namespace casimir
