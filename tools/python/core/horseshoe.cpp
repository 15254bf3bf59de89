// Chaos as a theorem.
#include "tools/analysis/horseshoe/horseshoe.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "tools/analysis/certificate/certificate_file.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/boxes.hpp"
#include "tools/python/core/case.hpp"
#include "tools/python/core/guard.hpp"
#include "tools/python/core/section_request.hpp"
#include "tools/runs/certified_horseshoe.hpp"
#include "tools/text/runs/horseshoe_report.hpp"

namespace casimir::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

py::dict to_python(const tools::HorseshoeReport& report) {
  const Horseshoe& answer = report.answer;
  const horseshoe::SectionSystem& system = answer.system;
  py::dict sets;
  for (const horseshoe::HSet& set : answer.sets) sets[py::str(set.name)] = set.centre;
  py::list coverings;
  for (const auto& [from, to] : answer.coverings)
    coverings.append(py::make_tuple(answer.sets[from].name, answer.sets[to].name));
  return py::dict(
      "proved"_a = answer.proved, "reason"_a = answer.reason, "plane"_a = system.plane_text,
      "upwards"_a = system.upwards, "levels"_a = exact_ends(system.level_names, system.levels),
      "names"_a = system.names, "sets"_a = sets, "coverings"_a = coverings,
      "radius"_a = rational_text(answer.radius), "entropy"_a = rational_text(answer.entropy),
      "theorem"_a = answer.proved ? report.theorem() : "", "cycles"_a = answer.cycles,
      "connections"_a = answer.connections);
}

/// The certificate as a file, or why there is none.
std::pair<std::string, std::string> certificate_or_reason(const HorseshoeCertificate& certificate,
                                                          const std::function<bool()>& give_up) {
  const CheckedHorseshoe checked = check_horseshoe(certificate, give_up);
  if (checked.holds()) return {certificate_text(certificate), {}};
  return {{}, checked.reason};
}

/// \param longest  the length of cycles that h-sets are put around; 0: as the search has it
/// \param certify  whether a theorem is certified: `certificate` then is the text of a file, or
///                 empty, with the reason.
py::dict horseshoe_of(const Case& self, const std::string& scene,
                      const std::optional<std::string>& plane, const std::optional<bool>& upwards,
                      std::optional<double> energy,
                      const std::vector<std::pair<std::string, double>>& casimirs,
                      std::size_t longest, bool certify, double seconds,
                      const py::object& progress) {
  Interrupt interrupt(progress);
  const auto late = time_limit(seconds);
  HorseshoeOptions options;
  if (longest > 0) options.longest_cycle = longest;
  options.give_up = [&] { return interrupt() || (late && late()); };
  if (interrupt.told())
    options.progress = [&](const std::string& /*stage*/, double share) { interrupt.show(share); };
  py::dict result;
  {
    const ExactAlgebra guard;
    const Model& model = self.model();
    options.request = section_request(model, plane, upwards, energy, casimirs);
    const Scene& of = model.scene(scene);
    const Horseshoe answer = find_horseshoe(model, of, options);
    std::pair<std::string, std::string> written;
    if (certify && answer.proved)
      written = certificate_or_reason(
          tools::certified_horseshoe(answer, model, of, options.request), options.give_up);
    const py::gil_scoped_acquire python;
    interrupt.raise();
    result = to_python({model.name, of.name, answer});
    result["certificate"] = written.first;
    result["uncertified"] = written.second;
  }
  interrupt.finish();
  return result;
}

}  // namespace

void bind_horseshoe(py::module_& module) { module.def("horseshoe", &horseshoe_of); }

}  // namespace casimir::python
