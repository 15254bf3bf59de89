#include "tools/analysis/stress/scene_truth.hpp"

#include "tools/analysis/estimate/reference_state.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

SceneReference reference_state_of_scene(const Model& model, const Scene& scene, double longest) {
  const PreparedScene run = prepare(model, scene);
  const ReferenceStateOrReason known = reference_state_of(scene, run, {.longest = longest});
  SceneReference result{.states = run.specialisation.states};
  result.source = known.truth ? known.source : known.reason;
  result.singular_time = known.singular_time;
  const bool called_so = scene.extreme == Extreme::blowup && scene.reference.empty();
  result.has_end = !called_so;
  if (known.singular_time || !result.has_end || !known.truth) return result;
  result.truth = known.truth;
  result.growth = growth_of(run, *known.truth);
  return result;
}

}  // namespace casimir
