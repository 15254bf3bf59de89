// Certificates: what a file of them proves.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <sstream>

#include "symbolic/algebra/number_text.hpp"
#include "tools/analysis/certificate/certificate_file.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/boxes.hpp"
#include "tools/python/core/guard.hpp"
#include "tools/text/runs/certificate_report.hpp"

namespace casimir::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

/// Asked by a check whether to give up: after Ctrl-C, and when the time is over.
using GiveUp = std::function<bool()>;

py::dict fact(const std::string& of_case, bool holds, const std::string& reason,
              const std::string& equations) {
  return py::dict("of_case"_a = of_case, "holds"_a = holds, "reason"_a = reason,
                  "equations"_a = equations);
}

py::list checked_run(const RunCertificate& certificate, const GiveUp& give_up) {
  const CheckedCertificate checked = check_certificate(certificate, give_up);
  std::ostringstream time;
  time << checked.duration;
  const py::gil_scoped_acquire python;
  const bool holds = checked.holds();
  py::dict facts =
      fact(certificate.of_case, holds, tools::CertificateReport{certificate, checked}.reason(),
           certificate.equations);
  facts["time"] = time.str();
  facts["integrals"] = checked.integrals;
  facts["steps"] = certificate.trace.steps.size();
  if (holds) facts["enclosure"] = exact_ends(checked.names, checked.check.end);
  py::list list;
  list.append(facts);
  return list;
}

py::list checked_horseshoe(const HorseshoeCertificate& certificate, const GiveUp& give_up) {
  const CheckedHorseshoe checked = check_horseshoe(certificate, give_up);
  const py::gil_scoped_acquire python;
  py::dict facts =
      fact(certificate.of_case, checked.holds(), checked.reason, certificate.equations);
  facts["integrals"] = checked.level_names;
  facts["sets"] = certificate.sets.size();
  if (checked.holds()) {
    facts["entropy"] = rational_text(checked.entropy);
    facts["levels"] = exact_ends(checked.level_names, checked.levels);
  }
  py::list list;
  list.append(facts);
  return list;
}

py::list checked_cycles(const std::vector<CycleCertificate>& certificates, const GiveUp& give_up) {
  std::vector<CheckedCycle> checked;
  for (const CycleCertificate& certificate : certificates)
    checked.push_back(check_cycle(certificate, give_up));
  const py::gil_scoped_acquire python;
  py::list list;
  for (std::size_t k = 0; k < checked.size(); ++k) {
    const CheckedCycle& one = checked[k];
    py::dict facts =
        fact(certificates[k].of_case, one.holds(), one.reason, certificates[k].equations);
    if (one.holds()) {
      facts["enclosure"] = exact_ends(one.names, one.state);
      facts["period"] = exact_ends(one.period);
      facts["levels"] = exact_ends(one.level_names, one.levels);
    }
    list.append(facts);
  }
  return list;
}

/// \returns  what it is of: "run", "horseshoe" or "cycles", and what came of each.
py::tuple checked(const std::string& text, const std::string& file, double seconds) {
  Interrupt interrupt;
  const auto late = time_limit(seconds);
  const GiveUp give_up = [&] { return interrupt() || (late && late()); };
  py::tuple result;
  {
    const ExactAlgebra guard;
    const CertificateFile read = read_certificate(text, file);
    const char* kind = read.run ? "run" : read.horseshoe ? "horseshoe" : "cycles";
    const auto found = [&] {
      if (read.run) return checked_run(*read.run, give_up);
      if (read.horseshoe) return checked_horseshoe(*read.horseshoe, give_up);
      return checked_cycles(read.cycles, give_up);
    };
    py::list list = found();
    const py::gil_scoped_acquire python;
    result = py::make_tuple(kind, std::move(list));
  }
  interrupt.raise();
  return result;
}

}  // namespace

void bind_certificates(py::module_& module) { module.def("checked", &checked); }

}  // namespace casimir::python
