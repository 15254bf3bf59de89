// What a motion conserves, its frequencies, and methods compared by error and run time.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "tools/analysis/benchmark/method_comparison.hpp"
#include "tools/analysis/frequency/analysed_motion.hpp"
#include "tools/analysis/run/conservation.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/case.hpp"
#include "tools/python/core/guard.hpp"
#include "tools/python/core/requests.hpp"
#include "tools/text/runs/run_report.hpp"
#include "tools/text/runs/trust_report.hpp"

namespace casimir::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

/// What became of a measured run, in a word: that of the integration where nothing else is wrong.
std::string end_of(const Row& row) {
  switch (row.end) {
    case RowEnd::ran:
      return to_string(row.status);
    case RowEnd::wrong:
      return "wrong";
    case RowEnd::too_slow:
      return "too_slow";
    case RowEnd::refused:
      return "refused";
    case RowEnd::crashed:
      return "crashed";
    case RowEnd::does_not_split:
      return "does_not_split";
    case RowEnd::drifted:
      return "drifted";
    case RowEnd::lost:
      return "no_value";
    case RowEnd::changes:
    case RowEnd::changes_in_step:
      return "not_kept";
  }
  return {};
}

py::dict to_python(const Row& row) {
  return py::dict("method"_a = row.method, "code"_a = row.code, "tolerance"_a = row.tolerance,
                  "error"_a = row.error, "drift"_a = row.drift, "seconds"_a = row.seconds,
                  "spread"_a = row.spread, "steps"_a = row.steps, "evaluations"_a = row.evaluations,
                  "status"_a = end_of(row), "ok"_a = row.ok(), "failed"_a = row.failed,
                  "reason"_a = row.reason);
}

py::object conserved(const Case& self, const std::string& scene, const Names& methods, double bound,
                     Choice duration, Choice tolerance, double seconds,
                     const py::object& progress) {
  Interrupt interrupt(progress);
  const auto late = time_limit(seconds);
  const Names& named = methods.empty() ? conserving_methods() : methods;
  py::list result;
  {
    const ExactAlgebra guard;
    const Model& model = self.model();
    double done = 0;
    for (const std::string& name : named) {
      ConservationOptions options{.run = request(duration, tolerance), .bound = bound};
      options.give_up = [&] { return interrupt() || (late && late()); };
      const double share = 1 / static_cast<double>(named.size());
      if (interrupt.told())
        options.progress = [&](double part) { interrupt.show((done + part) * share); };
      const Conservation one =
          settled([&] { return conserve(model, model.scene(scene), method_named(name), options); });
      ++done;
      const py::gil_scoped_acquire python;
      py::dict row = to_python(one.row), drift;
      for (std::size_t i = 0; one.trajectory && i < one.invariants.size(); ++i)
        drift[py::str(one.invariants[i])] = one.trajectory->invariants[i].drift;
      row["drifts"] = drift;
      result.append(row);
    }
  }
  interrupt.finish();
  return result;
}

py::dict to_python(const MotionLine& line) {
  return py::dict("frequency"_a = line.frequency, "amplitude"_a = line.amplitude,
                  "phase"_a = line.phase, "error"_a = line.error, "settled"_a = line.settled,
                  "combination"_a = line.combination);
}

py::dict to_python(const AnalysedMotion& motion) {
  const MotionFrequencies& found = motion.found;
  py::dict variables;
  for (const VariableSpectrum& variable : found.variables) {
    py::list lines;
    for (const MotionLine& line : variable.lines) lines.append(to_python(line));
    variables[py::str(variable.name)] =
        py::dict("angle"_a = variable.angle, "lines"_a = lines, "rest"_a = variable.rest);
  }
  Names warnings = tools::words_of(motion.run).warnings;
  warnings.insert(warnings.end(), found.warnings.begin(), found.warnings.end());
  return py::dict("base"_a = found.base, "errors"_a = found.base_errors,
                  "quasi_periodic"_a = found.settled, "variables"_a = variables,
                  "samples"_a = found.samples, "interval"_a = found.interval,
                  "warnings"_a = warnings);
}

py::object frequencies(const Case& self, const std::string& scene, const std::string& method,
                       std::size_t lines, Choice duration, Choice tolerance, double seconds,
                       const py::object& progress) {
  Interrupt interrupt(progress);
  py::object result;
  {
    const ExactAlgebra guard;
    const Model& model = self.model();
    SceneOptions code;
    const PreparedScene run = prepare(model, model.scene(scene), code);
    AssessmentOptions how{.method = method, .run = request(duration, tolerance)};
    how.time_limit = seconds;
    how.around = [&](Settings& settings, const std::function<void()>& run_it) {
      settings.give_up = [&, before = settings.give_up] {
        return interrupt() || (before && before());
      };
      if (interrupt.told())
        settings.progress = [&, whole = std::abs(settings.duration)](double t) {
          interrupt.show(std::min(std::abs(t) / whole, 1.));
        };
      run_it();
    };
    const AnalysedMotion motion =
        settled([&] { return analysed_motion(model, model.scene(scene), run, how, lines); });
    const Trajectory& trajectory = motion.run.trajectory;
    const py::gil_scoped_acquire python;
    interrupt.raise();
    if (trajectory.status != Status::ok)
      throw RequestError("the integration stopped at t = " + std::to_string(trajectory.time) +
                         ": " + trajectory.reason +
                         "; there are no frequencies of a part of a motion");
    result = to_python(motion);
  }
  interrupt.finish();
  return result;
}

py::object compared(const Case& self, const std::string& scene, const Names& methods,
                    const std::vector<double>& tolerances, double budget, bool quick,
                    Choice duration, double seconds, const py::object& progress) {
  Interrupt interrupt(progress);
  const auto late = time_limit(seconds);
  py::object result;
  {
    const ExactAlgebra guard;
    const Model& model = self.model();
    ComparisonOptions options{.methods = methods, .tolerances = tolerances, .budget = budget};
    options.run = request(duration, {});
    options.quick = quick;
    options.give_up = [&] { return interrupt() || (late && late()); };
    if (interrupt.told())
      options.progress = [&](const std::string&, double share) { interrupt.show(share); };
    const MethodComparison comparison =
        settled([&] { return compare_methods(model, model.scene(scene), options); });
    const py::gil_scoped_acquire python;
    interrupt.raise();
    if (!comparison.no_reference.empty()) throw RequestError(comparison.no_reference);
    py::list rows, outside;
    for (const Row& row : comparison.rows) rows.append(to_python(row));
    for (const ComparedMethod& one : comparison.contenders)
      if (!one.own()) outside.append(one.label());
    result = py::dict("rows"_a = rows, "outside"_a = outside, "scene"_a = comparison.scene,
                      "reference"_a = comparison.reference, "bound"_a = comparison.error_bound,
                      "conditioning"_a = comparison.conditioning, "notes"_a = comparison.notes);
  }
  interrupt.finish();
  return result;
}

}  // namespace

void bind_measured(py::module_& module) {
  module.def("conserved", &conserved);
  module.def("frequencies", &frequencies);
  module.def("compared", &compared);
}

}  // namespace casimir::python
