// Poincare sections and equilibria.
#include "tools/analysis/section/section.hpp"

#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "tools/analysis/equilibria/equilibria.hpp"
#include "tools/analysis/error.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/case.hpp"
#include "tools/python/core/guard.hpp"

namespace casimir::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

py::array_t<double> matrix(std::size_t rows, std::size_t width, const double* values) {
  py::array_t<double> result({rows, width});
  std::copy_n(values, rows * width, result.mutable_data());
  return result;
}

py::dict to_python(const OrbitReport& orbit) {
  const std::size_t count = orbit.places.size();
  const std::size_t width = count == 0 ? 0 : orbit.orbit.states.size() / orbit.orbit.times.size();
  return py::dict(
      "points"_a = matrix(count, 2, count == 0 ? nullptr : orbit.places[0].data()),
      "times"_a = py::array_t<double>(static_cast<py::ssize_t>(count), orbit.orbit.times.data()),
      "states"_a = matrix(count, width, orbit.orbit.states.data()),
      "seed"_a = py::array_t<double>(orbit.seed.size(), orbit.seed.data()),
      "exponent"_a = orbit.judged ? py::object(py::float_(orbit.exponent)) : py::none(),
      "chaotic"_a = orbit.judged ? py::object(py::bool_(orbit.chaotic)) : py::none(),
      "leaves_level"_a = orbit.leaves_level, "returns"_a = orbit.orbit.returns,
      "status"_a = to_string(orbit.orbit.status));
}

py::dict section(const Case& self, const std::string& scene,
                 const std::optional<std::string>& plane, const std::optional<bool>& upwards,
                 const Names& pair, std::optional<double> energy,
                 const std::vector<std::pair<std::string, double>>& casimirs, std::size_t orbits,
                 std::size_t points, double tolerance, int jobs, const py::object& progress) {
  if (!pair.empty() && pair.size() != 2)
    throw RequestError("a section shows two functions of the state");
  Interrupt interrupt(progress);
  PoincareOptions options;
  options.orbits = orbits;
  options.points = points;
  options.tolerance = tolerance;
  options.jobs = jobs;
  options.give_up = [&] { return interrupt(); };
  if (interrupt.told()) options.progress = [&](double share) { interrupt.show(share); };
  py::dict result;
  {
    const ExactAlgebra guard;
    const Model& model = self.model();
    const auto function = [&](const std::string& text) {
      return FunctionText{model.parse(typed(text, "section")), text};
    };
    if (plane) options.request.plane = function(*plane);
    options.request.upwards = upwards;
    for (const std::string& text : pair) options.request.pair.push_back(function(text));
    options.request.energy = energy;
    options.request.casimirs = casimirs;
    const PoincareSection cut = casimir::section(model, model.scene(scene), options);
    const py::gil_scoped_acquire python;
    py::list list;
    for (const OrbitReport& orbit : cut.orbits) list.append(to_python(orbit));
    result = py::dict(
        "orbits"_a = list, "plane"_a = cut.problem->plane_text,
        "level"_a = cut.problem->level_text(),
        "labels"_a = py::make_tuple(cut.problem->plotted[0].label, cut.problem->plotted[1].label),
        "names"_a = cut.problem->run.specialisation.states);
  }
  interrupt.finish();
  return result;
}

py::dict equilibria(const Case& self, const std::string& scene) {
  const ExactAlgebra guard;
  const Model& model = self.model();
  const EquilibriumReport report = find_equilibria(model, model.scene(scene), [](double) {});
  const py::gil_scoped_acquire python;
  py::list list;
  for (const Equilibrium& one : report.equilibria)
    list.append(py::dict(
        "state"_a =
            py::array_t<double>(static_cast<py::ssize_t>(one.state.size()), one.state.data()),
        "velocities"_a = one.velocities, "eigenvalues"_a = one.eigenvalues, "family"_a = one.family,
        "degenerate"_a = one.degenerate, "growth"_a = one.growth(), "residual"_a = one.residual));
  return py::dict("symmetries"_a = report.symmetries, "level"_a = report.level,
                  "equilibria"_a = list, "starts"_a = report.starts);
}

}  // namespace

void bind_section(py::module_& module) {
  module.def("section", &section);
  module.def("equilibria", &equilibria);
}

}  // namespace casimir::python
