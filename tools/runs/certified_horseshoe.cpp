// A horseshoe with the equations that it is of, for others to verify.
#include "tools/runs/certified_horseshoe.hpp"

#include "tools/show/notation.hpp"
#include "tools/text/files/plain_case.hpp"

namespace casimir::tools {

HorseshoeCertificate certified_horseshoe(const Horseshoe& proof, const Model& model, Scene scene,
                                         const SectionRequest& request) {
  // The theorem is about no time, and a scene need not have one.
  if (!scene.duration) scene.duration = 1;
  std::vector<std::string> states;
  for (const GiNaC::symbol& x : model.variables) states.push_back(x.get_name());
  const GiNaC::ex plane =
      model.at_parameters(request.plane ? request.plane->function : model.section->function, scene);
  return certificate_of(
      proof, model.name, plain_case(model, scene, {}, states, proof.system.level_names),
      Notation(model).case_text(proof.system.upwards ? plane : -plane), model.limits);
}

}  // namespace casimir::tools
