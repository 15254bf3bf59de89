#include "tools/analysis/section/validated_crossings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "codegen/optimise/lower.hpp"
#include "tools/analysis/error.hpp"

namespace casimir {
namespace {

constexpr const char *kPlaneName = "casimir_plane", *kPlaneRateName = "casimir_plane_rate";

/// The function and its derivative along the flow, over the inputs of the rates.
Program plane_program(const Model& model, const Scene& scene, const GiNaC::ex& plane) {
  Model extended = model;
  extended.casimirs.clear();
  extended.integrals = {{kPlaneName, plane, {}}, {kPlaneRateName, model.rate(plane), {}}};
  SpecialiseOptions what;
  what.observe = std::vector<std::string>{};
  what.jacobian = false;
  const Specialisation s = specialise(extended, scene, what);
  Program both = s.invariants;
  both.outputs.clear();
  both.output_names.clear();
  for (const char* name : {kPlaneName, kPlaneRateName}) {
    const auto place = std::ranges::find(s.invariant_names, name);
    if (place == s.invariant_names.end())
      throw RequestError("the function of the surface has no program");
    const auto k = static_cast<std::size_t>(place - s.invariant_names.begin());
    both.outputs.push_back(s.invariants.outputs[k]);
    both.output_names.emplace_back(name);
  }
  return codegen::without_dead_code(both);
}

}  // namespace

ProvedCrossings enclose_crossings(const Model& model, const Scene& scene, const GiNaC::ex& plane,
                                  const ValidatedOptions& options) {
  ValidatedOptions all = options;
  all.observe = std::vector<std::string>{};
  PreparedEnclosure prepared = prepare_enclosure(model, scene, all);
  prepared.problem.plane = plane_program(model, scene, plane);
  if (prepared.problem.plane.inputs != prepared.problem.rates.inputs)
    throw RequestError("the surface is no function of the states that are enclosed");
  ProvedCrossings result;
  result.names = std::move(prepared.names);
  result.doubts = std::move(prepared.doubts);
  try {
    result.run = validated_run(prepared.problem, all.run);
  } catch (const std::domain_error& problem) {
    throw ModelError(fmt::format("scene \"{}\": its data have no certain value: {}",
                                 printable(scene.name), problem.what()));
  }
  return result;
}

}  // namespace casimir
