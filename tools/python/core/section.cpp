// Poincare sections and equilibria.
#include "tools/analysis/section/section.hpp"

#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "tools/analysis/certificate/certificate_file.hpp"
#include "tools/analysis/equilibria/equilibria.hpp"
#include "tools/analysis/equilibria/validated_equilibria.hpp"
#include "tools/analysis/error.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/boxes.hpp"
#include "tools/python/core/case.hpp"
#include "tools/python/core/guard.hpp"
#include "tools/python/core/section_request.hpp"
#include "tools/runs/certified_cycles.hpp"

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

py::object to_python(const Rotation& rotation) {
  const bool none = rotation.kind == Rotation::Kind::none;
  const bool islands = rotation.kind == Rotation::Kind::islands;
  const auto known = [](bool is, double value) {
    return is ? py::object(py::float_(value)) : py::object(py::none());
  };
  return py::dict("kind"_a = to_string(rotation.kind), "number"_a = known(!none, rotation.number),
                  "error"_a = known(!none, rotation.error), "parts"_a = rotation.parts,
                  "inner"_a = known(islands, rotation.inner_number),
                  "inner_error"_a = known(islands, rotation.inner_error),
                  "directed"_a = rotation.directed, "reason"_a = rotation.reason);
}

/// What a proof of an equilibrium and one of a cycle have in common.
template <class Proof>
py::dict facts_of(const Proof& proof, const Names& states) {
  py::dict result("proved"_a = proof.proved, "reason"_a = proof.reason);
  if (!proof.proved) return result;
  result["enclosure"] = exact_ends(states, proof.state);
  result["radius"] = rational_text(proof.radius);
  return result;
}

py::dict to_python(const ProvedCycle& proof, const Names& states) {
  py::dict result = facts_of(proof, states);
  if (!proof.proved) return result;
  result["period"] = exact_ends(proof.period);
  result["trace"] = exact_ends(proof.trace);
  result["kind"] = proof.kind();
  return result;
}

/// None where it is not decided.
py::object is_stable(const Cycle& cycle) {
  const SpectralStability stability = cycle.stability();
  if (stability == SpectralStability::undecided) return py::none();
  return py::bool_(stability == SpectralStability::stable);
}

py::list cycles_of(const PoincareSection& cut) {
  const Names& states = cut.problem->run.specialisation.states;
  py::list list;
  for (std::size_t k = 0; k < cut.cycles.cycles.size(); ++k) {
    const Cycle& cycle = cut.cycles.cycles[k];
    py::array_t<double> points({cycle.length(), std::size_t{2}}),
        at({cycle.length(), states.size()});
    for (std::size_t i = 0; i < cycle.length(); ++i) {
      std::ranges::copy(cycle.points[i].place, points.mutable_data() + 2 * i);
      std::copy_n(cycle.points[i].x.data(), states.size(), at.mutable_data() + i * states.size());
    }
    py::dict one("points"_a = points, "states"_a = at, "period"_a = cycle.period,
                 "trace"_a = cycle.trace, "residual"_a = cycle.residual, "kind"_a = cycle.kind(),
                 "stable"_a = is_stable(cycle), "stability"_a = to_string(cycle.stability()),
                 "multipliers"_a = cycle.multipliers(), "proof"_a = py::none());
    if (!cut.proofs.empty()) one["proof"] = to_python(cut.proofs[k], states);
    list.append(one);
  }
  return list;
}

py::dict section(const Case& self, const std::string& scene,
                 const std::optional<std::string>& plane, const std::optional<bool>& upwards,
                 const Names& pair, std::optional<double> energy,
                 const std::vector<std::pair<std::string, double>>& casimirs, std::size_t orbits,
                 const std::vector<std::vector<double>>& seeds, std::size_t points,
                 std::size_t cycles, bool proved, bool certify, bool rotation, double tolerance,
                 int jobs, const py::object& progress) {
  if (!pair.empty() && pair.size() != 2)
    throw RequestError("a section shows two functions of the state");
  Interrupt interrupt(progress);
  PoincareOptions options;
  options.orbits = orbits;
  options.points = points;
  options.seeds = seeds;
  options.longest_cycle = cycles;
  options.prove_cycles = proved;
  options.rotation = rotation;
  options.tolerance = tolerance;
  options.jobs = jobs;
  options.give_up = [&] { return interrupt(); };
  if (interrupt.told()) options.progress = [&](double share) { interrupt.show(share); };
  py::dict result;
  {
    const ExactAlgebra guard;
    const Model& model = self.model();
    options.request = section_request(model, plane, upwards, energy, casimirs);
    for (const std::string& text : pair)
      options.request.pair.push_back({model.parse(typed(text, "section")), text});
    const PoincareSection cut = casimir::section(model, model.scene(scene), options);
    const py::gil_scoped_acquire python;
    py::list list;
    for (std::size_t k = 0; k < cut.orbits.size(); ++k) {
      py::dict orbit = to_python(cut.orbits[k]);
      orbit["rotation"] =
          cut.rotations.empty() ? py::object(py::none()) : to_python(cut.rotations[k]);
      list.append(orbit);
    }
    result = py::dict(
        "orbits"_a = list, "cycles"_a = cycles_of(cut),
        "degenerate_cycles"_a = cut.cycles.degenerate, "plane"_a = cut.problem->plane_text,
        "level"_a = cut.problem->level_text(),
        "labels"_a = py::make_tuple(cut.problem->plotted[0].label, cut.problem->plotted[1].label),
        "names"_a = cut.problem->run.specialisation.states);
    if (certify) {
      const std::vector<CycleCertificate> certificates =
          tools::certified_cycles(model, model.scene(scene), *cut.problem, cut.proofs);
      result["certificate"] = certificates.empty() ? "" : certificate_text(certificates);
      result["certified"] = certificates.size();
    }
  }
  interrupt.finish();
  return result;
}

py::dict to_python(const ProvedEquilibrium& proof, const Names& states) {
  py::dict result = facts_of(proof, states);
  if (!proof.proved) return result;
  result["velocities"] = exact_ends(proof.velocities);
  result["stability"] = to_string(proof.stability);
  return result;
}

/// \param proved  each is enclosed as well
py::dict equilibria(const Case& self, const std::string& scene, bool proved) {
  const ExactAlgebra guard;
  const Model& model = self.model();
  EquilibriumReport report = find_equilibria(model, model.scene(scene), [](double) {});
  std::vector<ProvedEquilibrium> proofs;
  if (proved) proofs = enclose_equilibria(model, model.scene(scene), report);
  take_proved(proofs, report);
  Names states;
  for (const GiNaC::symbol& x : model.variables) states.push_back(x.get_name());
  const py::gil_scoped_acquire python;
  py::list list;
  for (std::size_t k = 0; k < report.equilibria.size(); ++k) {
    const Equilibrium& one = report.equilibria[k];
    list.append(py::dict(
        "state"_a =
            py::array_t<double>(static_cast<py::ssize_t>(one.state.size()), one.state.data()),
        "velocities"_a = one.velocities, "eigenvalues"_a = one.eigenvalues, "family"_a = one.family,
        "degenerate"_a = one.degenerate, "stability"_a = to_string(one.stability),
        "growth"_a = one.growth(), "residual"_a = one.residual,
        "proof"_a = proofs.empty() ? py::object(py::none()) : to_python(proofs[k], states)));
  }
  return py::dict("symmetries"_a = report.symmetries, "level"_a = report.level,
                  "equilibria"_a = list, "starts"_a = report.starts);
}

}  // namespace

void bind_section(py::module_& module) {
  module.def("section", &section);
  module.def("equilibria", &equilibria);
}

}  // namespace casimir::python
