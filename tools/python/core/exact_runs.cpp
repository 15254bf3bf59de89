// Runs whose numbers are right: with any number of digits, and enclosed by boxes.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "runtime/digits/agreed_run.hpp"
#include "symbolic/algebra/number_text.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression.hpp"
#include "tools/analysis/certificate/certificate_file.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/run/exact_values.hpp"
#include "tools/analysis/run/validated.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/boxes.hpp"
#include "tools/python/core/case.hpp"
#include "tools/python/core/guard.hpp"
#include "tools/python/core/requests.hpp"
#include "tools/runs/certified_motion.hpp"
#include "tools/text/runs/certificate_report.hpp"
#include "tools/text/runs/sure_decimals.hpp"

namespace casimir::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

/// Double precision has the lower number of digits.
constexpr int kFewestDigits = 17, kMostOfDigits = 5000;

cln::cl_RA rational_of(const std::string& text, const char* what, const Limits& limits) {
  const GiNaC::ex value = parse_constant(typed(text, what), limits);
  if (!GiNaC::is_a<GiNaC::numeric>(value) || !GiNaC::ex_to<GiNaC::numeric>(value).is_rational())
    throw RequestError(std::string(what) + ": expected a rational number");
  return cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
}

py::dict to_python(const Specialisation& s, const AgreedRun& agreed, int digits) {
  const bool enough = agreed.run.status != Status::ok || agreed.digits >= digits;
  const Status status = enough ? agreed.run.status : Status::no_convergence;
  const std::vector<cln::cl_F>* const check = agreed.checked ? &agreed.check.state : nullptr;
  const Names texts = tools::sure_texts(agreed.run.state, check, digits);
  py::dict state;
  for (std::size_t i = 0; i < texts.size(); ++i) state[py::str(s.states[i])] = texts[i];
  const std::string reason =
      enough ? agreed.run.reason
             : "two runs agree in " + std::to_string(agreed.digits) + " digits only";
  return py::dict("status"_a = to_string(status), "reason"_a = reason,
                  "time"_a = tools::decimal_text(agreed.run.time, digits), "state"_a = state,
                  "digits"_a = agreed.checked ? py::object(py::int_(agreed.digits)) : py::none(),
                  "lost"_a = agreed.lost, "steps"_a = agreed.run.steps, "runs"_a = agreed.runs);
}

py::object precise(const Case& self, const std::string& scene, int digits,
                   const std::optional<std::string>& duration, double seconds,
                   const py::object& progress) {
  if (digits < kFewestDigits || digits > kMostOfDigits)
    throw RequestError("digits are " + std::to_string(kFewestDigits) + " to " +
                       std::to_string(kMostOfDigits) + "; double precision has fewer");
  Interrupt interrupt(progress);
  const auto late = time_limit(seconds);
  py::object result;
  {
    const ExactAlgebra guard;
    const Model& model = self.model();
    Scene of = model.scene(scene);
    if (duration) of.duration = parse_real_constant(typed(*duration, "duration"), model.limits);
    require_exact_values(model, of, "a run with more digits");
    require_duration(of);
    SpecialiseOptions what;
    what.jacobian = false;
    const Specialisation s = specialise(model, of, what);
    PreciseProblem problem;
    problem.rhs = &s.rhs;
    problem.invariants = s.invariant_names.empty() ? nullptr : &s.invariants;
    problem.start = [&](int with) {
      const std::vector<cln::cl_F> values = start_values(s, with);
      return std::vector<cln::cl_R>(values.begin(), values.end());
    };
    problem.give_up = [&](double share) {
      interrupt.show(share);
      return interrupt() || (late && late());
    };
    const AgreedRun agreed = agreed_run(std::move(problem), digits);
    const std::string doubt = unwatched_parts(model, of);
    const py::gil_scoped_acquire python;
    interrupt.raise();
    py::dict facts = to_python(s, agreed, digits);
    Names warnings;
    if (!doubt.empty()) warnings.push_back(doubt);
    facts["warnings"] = warnings;
    result = facts;
  }
  interrupt.finish();
  return result;
}

py::dict to_python(const StateBox& box) {
  return py::dict("time"_a = rational_text(box.time), "box"_a = exact_ends(box.states));
}

std::string to_string(ValidatedStatus status) {
  switch (status) {
    case ValidatedStatus::ok:
      return "ok";
    case ValidatedStatus::no_enclosure:
      return "no_enclosure";
    case ValidatedStatus::contradiction:
      return "contradiction";
    case ValidatedStatus::touching:
      return "touching";
    case ValidatedStatus::max_steps:
      return "max_steps";
    case ValidatedStatus::stopped:
      return "stopped";
  }
  return {};
}

py::dict to_python(const ValidatedMotion& motion) {
  const ValidatedRun& run = motion.run;
  py::list samples;
  for (const StateBox& box : run.samples) samples.append(to_python(box));
  return py::dict("names"_a = motion.names, "status"_a = to_string(run.status),
                  "reason"_a = run.reason, "end"_a = to_python(run.end), "samples"_a = samples,
                  "radius"_a = run.radius(), "contracted_by"_a = run.contracted_by,
                  "doubts"_a = motion.doubts, "steps"_a = run.steps, "seconds"_a = run.seconds);
}

/// The certificate as a file, or why there is none.
std::pair<std::string, std::string> certificate_or_reason(const RunCertificate& certificate,
                                                          const std::function<bool()>& give_up) {
  const CheckedCertificate checked = check_certificate(certificate, give_up);
  if (checked.holds()) return {certificate_text(certificate), {}};
  return {{}, tools::CertificateReport{certificate, checked}.reason()};
}

/// \param ranges  each parameter with the ends of its interval
/// \param certify  whether what is enclosed is certified: `certificate` then is the text of a file, or
///                 empty, with the reason.
py::object enclosed(
    const Case& self, const std::string& scene, const std::optional<std::string>& duration,
    const std::string& initial_radius,
    const std::vector<std::pair<std::string, std::pair<std::string, std::string>>>& ranges,
    int digits, const std::optional<std::string>& sample_every, bool certify, double seconds,
    const py::object& progress) {
  Interrupt interrupt(progress);
  const auto late = time_limit(seconds);
  py::object result;
  {
    const ExactAlgebra guard;
    ValidatedOptions options;
    Values middles;
    for (const auto& [name, ends] : ranges) {
      const cln::cl_RA low = rational_of(ends.first, "ranges", self.model().limits),
                       high = rational_of(ends.second, "ranges", self.model().limits);
      if (low > high) throw RequestError("a range goes from the lower end to the higher one");
      middles.emplace_back(name, rational_text((low + high) / 2));
      options.ranges.emplace_back(name, (high - low) / 2);
    }
    const std::shared_ptr<const Case> centred =
        middles.empty() ? nullptr : self.with_scene_parameters(middles);
    const Model& model = centred ? centred->model() : self.model();
    options.initial_radius = rational_of(initial_radius, "initial_radius", model.limits);
    if (cln::minusp(options.initial_radius))
      throw RequestError("initial_radius: expected a number that is not negative");
    if (duration)
      options.duration = parse_real_constant(typed(*duration, "duration"), model.limits);
    if (sample_every) {
      options.run.sample_every = rational_of(*sample_every, "sample_every", model.limits);
      if (!cln::plusp(options.run.sample_every))
        throw RequestError("sample_every: expected a positive number");
    }
    options.run.digits = digits;
    options.run.give_up = [&](double share) {
      interrupt.show(share);
      return interrupt() || (late && late());
    };
    RunCertificate certificate;
    const ValidatedMotion motion = settled([&] {
      return certify ? tools::certified_motion(model, model.scene(scene), options, certificate)
                     : enclose(model, model.scene(scene), options);
    });
    std::pair<std::string, std::string> written;
    if (certify && motion.run.status == ValidatedStatus::ok)
      written = certificate_or_reason(certificate, [&] { return interrupt() || (late && late()); });
    const py::gil_scoped_acquire python;
    interrupt.raise();
    py::dict facts = to_python(motion);
    facts["certificate"] = written.first;
    facts["uncertified"] = written.second;
    result = facts;
  }
  interrupt.finish();
  return result;
}

}  // namespace

void bind_exact_runs(py::module_& module) {
  module.def("precise", &precise);
  module.def("enclosed", &enclosed);
}

}  // namespace casimir::python
