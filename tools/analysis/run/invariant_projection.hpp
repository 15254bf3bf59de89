#pragma once

#include <string>
#include <vector>

#include "runtime/integrate.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/analysis/run_request.hpp"

namespace casimir {

/// Lets every step of a run end on the level of its invariants, as `options` asks: of all that are
/// proved to be integrals of the case, or of those named.
/// \param doubts  gets a sentence about each invariant that is left out because it is not proved.
/// \return        the names of those projected onto; empty where nothing was asked for.
/// \throws RequestError  for a name that is no invariant of the run, one that is named but not
/// proved,
///                     and where none is left.
std::vector<std::string> set_projection(const RunRequest& options, const Model& model,
                                        const Scene& scene, const PreparedScene& run,
                                        Settings& settings, std::vector<std::string>& doubts);

}  // namespace casimir
