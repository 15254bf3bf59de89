#pragma once

#include <functional>
#include <optional>
#include <string>

#include "runtime/ensemble.hpp"
#include "runtime/methods.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// What integrates an ensemble: a kernel with one member in each lane or, for other methods, a
/// module for each thread.
struct EnsembleKernel {
  std::optional<LaneKernel> lanes;
  std::function<Module()> module_for_thread;
  double seconds = 0;  ///< to compile, fetch or lay it out
  bool compiled = false, from_cache = false;
  std::string warning = {};
};

/// \param members  how many there are: for a few nothing is compiled that need not be. That changes
///                 no result by a bit.
/// \param lanes  false: member by member, whatever the method.
EnsembleKernel ensemble_kernel(const PreparedScene& run, const Method& method, std::size_t members,
                               bool lanes);

/// Integrates an ensemble with its kernel. A member that has no motion, as UndefinedMotion finds
/// out, has the status `at_jump`.
/// \throws std::invalid_argument  as `integrate` does.
EnsembleResult integrate_ensemble(const Ensemble& ensemble, const PreparedScene& run,
                                  const EnsembleKernel& kernel, const Method& method,
                                  const Settings& settings, int jobs = 0);

}  // namespace casimir
