#include "tools/analysis/certificate/run_certificate.hpp"

#include <algorithm>

#include "tools/analysis/estimate/cancelled_parts.hpp"

namespace casimir {
namespace {

constexpr const char* kEquationsFile = "equations.toml";

/// Only equations, integrals and a scene: nothing that would read another file, nor any claim.
bool is_plain(const CaseFile& file) {
  const PhaseSpaceText& space = file.phase_space;
  const bool bare = !file.hamiltonian && !file.lagrangian && !space.algebra && !space.canonical &&
                    !space.brackets && !space.structure_constants && !space.vector_fields &&
                    space.domain.empty() && space.constraints.empty();
  const bool silent = file.parameters.empty() && file.definitions.empty() &&
                      file.casimirs.empty() && file.conditionals.empty() &&
                      file.invariant_relations.empty() && file.lax.empty() && file.maps.empty() &&
                      file.measures.empty() && file.identities.empty() && !file.section;
  return bare && silent && file.equations && file.scenes.size() == 1 &&
         file.scenes.front().observe.empty();
}

}  // namespace

Model model_of_certificate(const RunCertificate& certificate) {
  CaseFile file = parse_case(certificate.equations, kEquationsFile, certificate.limits);
  if (!is_plain(file))
    throw CaseError({kEquationsFile},
                    "expected variables, equations, integrals and one scene, and nothing else");
  file.name = certificate.of_case;
  return build_model(file);
}

bool has_lost_parts(const Model& model, const std::string& plane) {
  const auto has_domain = [](const NamedExpression& f) { return !f.domain.empty(); };
  return !unwatched_parts(model, model.scenes.front()).empty() ||
         std::ranges::any_of(model.integrals, has_domain) ||
         has_domain(model.parse_named({plane, {"plane", 1, 1}, plane}));
}

CheckedCertificate check_certificate(const RunCertificate& certificate,
                                     const std::function<bool()>& give_up) {
  const Model model = model_of_certificate(certificate);
  ValidatedOptions options;
  options.radii = certificate.radii;
  const PreparedEnclosure prepared = prepare_enclosure(model, model.scenes.front(), options);
  CheckedCertificate result;
  result.names = prepared.names;
  result.duration = model.scenes.front().duration.value_or(0);
  for (const KnownIntegral& known : prepared.problem.integrals)
    result.integrals.push_back(known.name);
  TraceCheckSettings settings;
  settings.give_up = give_up;
  for (const NamedExpression& integral : model.integrals) {
    if (std::ranges::find(result.integrals, integral.name) != result.integrals.end()) continue;
    result.unproved = integral.name;
    break;
  }
  if (!result.unproved.empty()) return result;
  if (!certificate.radii.empty() && certificate.radii.size() != prepared.names.size()) {
    result.check.fault = TraceFault::shape;
    return result;
  }
  result.check = check_trace(prepared.problem, certificate.trace, settings);
  for (const RationalInterval& x : result.check.end)
    result.radius = std::max(result.radius, cln::cl_RA((x.high - x.low) / 2));
  return result;
}

}  // namespace casimir
