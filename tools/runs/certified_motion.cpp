#include "tools/runs/certified_motion.hpp"

#include <string>
#include <vector>

#include "tools/text/files/plain_case.hpp"

namespace casimir::tools {

ValidatedMotion certified_motion(const Model& model, const Scene& given,
                                 const ValidatedOptions& asked, RunCertificate& certificate) {
  const PreparedEnclosure prepared = prepare_enclosure(model, given, asked);
  Scene scene = given;
  if (asked.duration) scene.duration = asked.duration;
  std::vector<std::string> moving, integrals;
  for (const auto& [name, radius] : asked.ranges) moving.push_back(name);
  for (const KnownIntegral& known : prepared.problem.integrals) integrals.push_back(known.name);
  certificate.of_case = model.name;
  certificate.limits = model.limits;
  certificate.scene = scene.name;
  certificate.radii = prepared.problem.radii;
  ValidatedOptions options;
  options.radii = certificate.radii;
  options.run = asked.run;
  options.run.trace = &certificate.trace;
  for (;;) {
    certificate.equations =
        plain_case(model, scene, moving, prepared.specialisation.states, integrals);
    const Model plain = model_of_certificate(certificate);
    ValidatedMotion motion = enclose(plain, plain.scenes.front(), options);
    // What needs the assumptions of the case is not proved without them: it is left out.
    if (motion.doubts.empty()) {
      motion.doubts = prepared.doubts;
      return motion;
    }
    const PreparedEnclosure bare = prepare_enclosure(plain, plain.scenes.front(), options);
    integrals.clear();
    for (const KnownIntegral& known : bare.problem.integrals) integrals.push_back(known.name);
  }
}

}  // namespace casimir::tools
