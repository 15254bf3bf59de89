#include "tools/runs/conserve_run.hpp"

#include <optional>

namespace casimir::tools {

Row conserve_scene(const Model& model, const Scene& scene, const Method& method,
                   const ConservationOptions& options, std::vector<DriftRecord>* drifts) {
  ConservationOptions watched = options;
  std::optional<DriftRecord> drift;
  if (drifts)
    watched.watch = [&](Settings& settings, const std::vector<std::string>& invariants) {
      drift.emplace(std::string(method.name), invariants, settings.duration);
      drift->follow(settings);
    };
  const Conservation result = conserve(model, scene, method, watched);
  if (drift && result.trajectory) {
    drift->finish(*result.trajectory);
    drifts->push_back(*drift);
  }
  return result.row;
}

}  // namespace casimir::tools
