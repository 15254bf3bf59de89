// Cycles that a symmetry of the equations makes of a part of themselves.
#include "tools/analysis/section/symmetric_cycle.hpp"

#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/case.hpp"
#include "tools/python/core/guard.hpp"
#include "tools/python/core/requests.hpp"

namespace casimir::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

/// \throws CaseError  with the nearest name for one that is no variable
std::vector<std::pair<std::string, GiNaC::ex>> images_of(const Model& model, const Values& images) {
  Names known;
  for (const GiNaC::symbol& x : model.variables) known.push_back(x.get_name());
  std::vector<std::pair<std::string, GiNaC::ex>> result;
  for (const auto& [name, image] : images) {
    if (std::ranges::find(known, name) == known.end())
      throw typed(name, "symmetry")
          .error("there is no variable '" + printable(name) + "'", 0, suggest_or_list(name, known));
    result.emplace_back(name, model.parse(typed(image, "symmetry")));
  }
  return result;
}

/// \param period  a guess; without it the duration of the scene
py::dict symmetric_cycle_of(const Case& self, const std::string& scene, const Values& images,
                            std::optional<double> period, bool keep_period, double tolerance,
                            double seconds) {
  Interrupt interrupt;
  const auto late = time_limit(seconds);
  SymmetricCycle cycle;
  Names states;
  int order = 0;
  {
    const ExactAlgebra guard;
    const Model& model = self.model();
    const Scene& of = model.scene(scene);
    if (period && !(std::isfinite(*period) && *period > 0))
      throw RequestError("the period must be a positive finite number");
    const PreparedScene run = prepare(model, of, {.observe = Names{}});
    const PhaseSymmetry symmetry = phase_symmetry(model, of, images_of(model, images));
    SymmetricCycleRequest request{.guess = period ? *period : duration_of(run),
                                  .keep_period = keep_period,
                                  .tolerance = tolerance};
    request.give_up = [&] { return interrupt() || (late && late()); };
    cycle = settled([&] { return symmetric_cycle(model, of, run, symmetry, request); });
    states = run.specialisation.states;
    order = symmetry.order;
  }
  interrupt.raise();
  py::object stable = py::none();
  if (!cycle.found || cycle.stability() != SpectralStability::undecided)
    stable = py::bool_(cycle.found && cycle.stability() == SpectralStability::stable);
  return py::dict(
      "found"_a = cycle.found, "reason"_a = cycle.reason, "names"_a = states, "order"_a = order,
      "state"_a =
          py::array_t<double>(static_cast<py::ssize_t>(cycle.state.size()), cycle.state.data()),
      "period"_a = cycle.period, "state_error"_a = cycle.state_error,
      "period_error"_a = cycle.period_error, "residual"_a = cycle.residual,
      "closure"_a = cycle.closure, "multipliers"_a = cycle.multipliers, "stable"_a = stable,
      "stability"_a = to_string(cycle.stability()),
      "warnings"_a = cycle.found ? cycle.warnings() : Names{});
}

}  // namespace

void bind_symmetric_cycle(py::module_& module) {
  module.def("symmetric_cycle", &symmetric_cycle_of);
}

}  // namespace casimir::python
