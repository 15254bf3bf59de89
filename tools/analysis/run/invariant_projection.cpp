#include "tools/analysis/run/invariant_projection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "codegen/optimise/differentiate.hpp"
#include "runtime/projection.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/run/drift_check.hpp"

namespace casimir {

std::vector<std::string> set_projection(const RunRequest& options, const Model& model,
                                        const Scene& scene, const PreparedScene& run,
                                        Settings& settings, std::vector<std::string>& doubts) {
  if (!options.projects()) return {};
  const Specialisation& s = run.specialisation;
  const std::vector<std::string>& known = s.invariant_names;
  for (const std::string& name : options.project_onto) {
    if (std::ranges::count(known, name)) continue;
    const std::string hint = suggest_or_list(name, known);
    throw RequestError(fmt::format("cannot project: no invariant of this run is called '{}'{}",
                                   printable(name), hint.empty() ? "" : "; " + hint));
  }
  std::vector<std::string> names;
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const bool named = std::ranges::count(options.project_onto, known[k]) != 0;
    if (!options.project_onto.empty() && !named) continue;
    const KnownInvariant invariant = known_invariant(model, scene, known[k]);
    if (invariant.proof.verdict != Verdict::proved) {
      const std::string said = fmt::format("{} is {}", known[k], words_of(invariant));
      if (named) throw RequestError("cannot project: " + said);
      doubts.push_back("not projected onto: " + said);
      continue;
    }
    names.push_back(known[k]);
    chosen.push_back(k);
  }
  if (names.empty())
    throw RequestError("cannot project: the run has no invariant that is proved to be an integral");
  const SparseProgram gradients = codegen::gradients(s.invariants, s.states.size());
  const auto projector = std::make_shared<Projector>(
      s.invariants, chosen, gradients.program, gradients.entries, run.initial, run.parameters);
  settings.project = [projector](double t, double* x, double* carry) { (*projector)(t, x, carry); };
  return names;
}

}  // namespace casimir
