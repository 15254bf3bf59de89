// Maps: reading, proofs, searches, degrees, orbits.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "symbolic/discrete/confinement.hpp"
#include "symbolic/discrete/degrees.hpp"
#include "symbolic/discrete/growth.hpp"
#include "symbolic/discrete/kahan.hpp"
#include "symbolic/discrete/map_darboux.hpp"
#include "symbolic/discrete/prove_map.hpp"
#include "symbolic/discrete/search_map.hpp"
#include "symbolic/expression/expression.hpp"
#include "tools/analysis/run/doubted_invariants.hpp"
#include "tools/analysis/run/iterate.hpp"
#include "tools/analysis/scene_values.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/exact_work.hpp"
#include "tools/python/core/map_case.hpp"
#include "tools/text/files/discretised_case.hpp"

namespace casimir::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

/// \throws CaseError  for a flow
MapCaseFile map_of(const AnyCaseFile& any) {
  if (const auto* map = std::get_if<MapCaseFile>(&any)) return *map;
  const CaseFile& file = std::get<CaseFile>(any);
  throw CaseError({file.file, 1, 1}, "the case of a flow: a map has a table [map]", {},
                  "casimir.load and casimir.Case take flows");
}

std::vector<Entry> entries_of(const Values& values, const std::string& where) {
  std::vector<Entry> result;
  for (const auto& [name, value] : values)
    result.emplace_back(typed(name, where), typed(value, where));
  return result;
}

}  // namespace

std::shared_ptr<MapCase> MapCase::load(const std::string& name) {
  const ExactAlgebra guard;
  const std::shared_ptr<MapCase> result(new MapCase);
  result->source_ = map_of(tools::load_any_case(name, {}));
  result->text_ = text_of_file(result->source_.file.file);
  result->build();
  return result;
}

std::shared_ptr<MapCase> MapCase::from_text(const std::string& text, const std::string& file) {
  const ExactAlgebra guard;
  const std::shared_ptr<MapCase> result(new MapCase);
  result->source_ = map_of(parse_any_case(text, file));
  result->text_ = text;
  result->build();
  return result;
}

MapCase::~MapCase() {
  const ExactAlgebra guard;
  map_.reset();
}

std::shared_ptr<MapCase> MapCase::with(const Values& parameters, const Values& initial,
                                       bool rounded) const {
  const ExactAlgebra guard;
  const std::shared_ptr<MapCase> result(new MapCase);
  result->text_ = text_;
  result->source_ = source_;
  result->parameters_ = with_others(parameters_, parameters);
  result->initial_ = with_others(initial_, initial);
  result->rounded_ = rounded_ || rounded;
  result->build();
  return result;
}

void MapCase::build() {
  MapCaseFile changed = source_;
  changed.file = with_initial_values(source_.file, entries_of(initial_, "initial"), rounded_);
  map_ = std::make_unique<MapModel>(
      tools::map_model_of(changed, entries_of(parameters_, "parameters")));
}

namespace {

py::object verify_map(const MapCase& self, const Names& integrals, const Names& casimirs,
                      const Names& relations, const Names& identities, const Names& on,
                      double seconds) {
  return verified(self.map(), self.map().base,
                  candidates_of(integrals, casimirs, relations, identities, on), seconds,
                  [](const auto&... arguments) { return prove_map(arguments...); });
}

py::object search_of_map(const MapCase& self, int degree, double seconds, double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    return discrete::search_map(self.map(), degree, watched(interrupt, seconds, memory));
  };
  return exactly(interrupt, find, [](const discrete::MapSearch& found) {
    const auto texts = [](const std::vector<discrete::FoundOfMap>& list) {
      Names result;
      for (const discrete::FoundOfMap& f : list) result.push_back(f.text);
      return result;
    };
    Names evidence;
    for (const discrete::FoundOfMap& f : found.densities) evidence.push_back(f.evidence);
    return py::dict("integrals"_a = texts(found.integrals), "densities"_a = texts(found.densities),
                    "density_evidence"_a = evidence, "no_polynomial"_a = found.no_polynomial,
                    "no_rational"_a = found.no_fraction, "polynomials"_a = found.polynomials,
                    "relations"_a = found.relations, "density_space"_a = found.density_space,
                    "generic"_a = found.generic, "reason"_a = found.reason);
  });
}

py::object darboux_of_map(const MapCase& self, int degree, double seconds, double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    return discrete::find_map_darboux(self.map(), degree, watched(interrupt, seconds, memory));
  };
  return exactly(interrupt, find, [](const discrete::MapDarboux& report) {
    py::list found, combinations;
    Names evidence;
    for (const search::DarbouxPolynomial& own : report.found)
      found.append(py::dict("text"_a = own.text, "cofactor"_a = own.cofactor,
                            "relations"_a = own.relations, "degree"_a = own.degree,
                            "verdict"_a = to_string(own.verdict)));
    for (const search::DarbouxCombination& own : report.combinations) {
      combinations.append(py::make_tuple(search::to_string(own.kind), own.text));
      evidence.push_back(own.evidence);
    }
    return py::dict("found"_a = found, "combinations"_a = combinations,
                    "combination_evidence"_a = evidence, "factors"_a = report.factors,
                    "complete"_a = report.complete, "has_conjugates"_a = report.has_conjugates,
                    "reason"_a = report.reason);
  });
}

/// The degrees of the iterates, and what becomes of singularities.
struct DegreesOfMap {
  std::vector<int> degrees;
  discrete::Confinement singular;  ///< unclear where no time was left for it
};

template <class Degrees, class Singular>
DegreesOfMap degrees_of(const Degrees& degrees, const Singular& singular) {
  DegreesOfMap result{.degrees = degrees(), .singular = {}};
  try {
    result.singular = singular();
  } catch (const search::NoAnswer&) {  // the degrees are known
  }
  return result;
}

py::dict to_python(const DegreesOfMap& found) {
  const discrete::Growth growth = discrete::growth_of(found.degrees);
  py::list singularities;
  for (const discrete::SingularOrbit& orbit : found.singular.orbits)
    singularities.append(py::dict("lost"_a = orbit.lost, "recovered"_a = orbit.recovered,
                                  "until"_a = orbit.until, "points"_a = orbit.points));
  return py::dict("degrees"_a = found.degrees, "growth"_a = to_string(growth.kind),
                  "growth_degree"_a = growth.degree, "formula"_a = growth.formula,
                  "recurrence"_a = growth.recurrence, "ratio"_a = growth.ratio,
                  "confinement"_a = to_string(found.singular.kind),
                  "confinement_steps"_a = found.singular.steps, "singularities"_a = singularities);
}

discrete::DegreeRequest request_of(int iterates, bool kahan) {
  discrete::DegreeRequest request;
  if (iterates > 0) request.iterates = iterates;
  request.kahan = kahan;
  return request;
}

py::object degrees(const MapCase& self, int count, double seconds, double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    const search::Watch watch = watched(interrupt, seconds, memory);
    return degrees_of(
        [&] { return discrete::degrees_of_iterates(self.map(), request_of(count, false), watch); },
        [&] { return discrete::confinement_of(self.map(), watch); });
  };
  return exactly(interrupt, find, [](const DegreesOfMap& found) { return to_python(found); });
}

py::object kahan_degrees(const Case& self, int count, double seconds, double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    const search::Watch watch = watched(interrupt, seconds, memory);
    return degrees_of(
        [&] {
          return discrete::degrees_of_kahan_iterates(self.model(), request_of(count, true), watch);
        },
        [&] { return discrete::confinement_of_kahan(self.model(), watch); });
  };
  return exactly(interrupt, find, [](const DegreesOfMap& found) { return to_python(found); });
}

/// The case file of a map that is made of a flow.
std::string discretised(const Case& self, const std::string& method,
                        const std::optional<std::string>& step) {
  const ExactAlgebra guard;
  std::optional<GiNaC::ex> value;
  if (step) {
    const Text text = typed(*step, "step");
    value = parse_real_constant(text, self.model().limits);
    if (value->is_zero()) throw text.error("a step of 0 leaves every point where it is");
  }
  const auto* const chosen =
      std::ranges::find(tools::kDiscretisations, method, &tools::Discretisation::key);
  if (chosen == tools::kDiscretisations.end()) throw py::value_error("no map of this name");
  const Model& flow = self.model();
  return tools::discretised_case(flow, chosen->map(flow, value), std::string(chosen->name), step);
}

/// Orbits: the states at every so many steps, and how far the invariants drifted.
py::object iterated(const MapCase& self, const std::string& scene, std::uint64_t steps,
                    std::uint64_t every, double seconds) {
  Interrupt interrupt;
  const std::function<bool()> late = time_limit(seconds);
  const auto run = [&] {
    const MapModel& map = self.map();
    Iterated orbit = iterate(map, map.base.scene(scene), steps, every,
                             [&] { return interrupt() || (late && late()); });
    Names doubts = doubts_of_orbit(map, orbit);
    if (std::string doubt = doubt_of_end(orbit); !doubt.empty()) doubts.push_back(std::move(doubt));
    return std::pair(std::move(orbit), std::move(doubts));
  };
  return exactly(interrupt, run, [](const std::pair<Iterated, Names>& orbit) {
    const auto& [found, doubts] = orbit;
    const auto count = static_cast<py::ssize_t>(found.samples.size());
    const auto size = static_cast<py::ssize_t>(found.names.size());
    py::array_t<double> y({size, count});
    py::array_t<std::uint64_t> t(count);
    for (py::ssize_t k = 0; k < count; ++k) {
      t.mutable_at(k) = found.sample_steps[static_cast<std::size_t>(k)];
      for (py::ssize_t i = 0; i < size; ++i)
        y.mutable_at(i, k) =
            found.samples[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
    }
    py::dict drift;
    for (const Iterated::Invariant& one : found.invariants) drift[py::str(one.name)] = one.drift;
    return py::dict("t"_a = t, "y"_a = y, "steps"_a = found.steps, "names"_a = found.names,
                    "state"_a = found.state, "finite"_a = found.finite, "stopped"_a = found.stopped,
                    "drift"_a = drift, "seconds"_a = found.seconds,
                    "error_estimate"_a = found.error_estimate, "reason"_a = found.reason,
                    "warnings"_a = doubts);
  });
}

Names symbol_names(const std::vector<GiNaC::symbol>& symbols) {
  Names result;
  for (const GiNaC::symbol& symbol : symbols) result.push_back(symbol.get_name());
  return result;
}

}  // namespace

void bind_maps(py::module_& module) {
  module.def("bundled_maps", [] {
    Names names;
    for (const std::filesystem::path& path : tools::bundled_maps({}))
      names.push_back(path.stem().string());
    return names;
  });
  module.def("kahan_degrees", &kahan_degrees);
  module.def("discretised", &discretised);
  py::class_<MapCase, std::shared_ptr<MapCase>>(module, "Map")
      .def_static("load", &MapCase::load)
      .def_static("from_text", &MapCase::from_text)
      .def("with_values", &MapCase::with)
      .def_property_readonly("text", &MapCase::text)
      .def_property_readonly("file", &MapCase::file)
      .def_property_readonly("changed_parameters", &MapCase::parameters)
      .def_property_readonly("changed_initial", &MapCase::initial)
      .def_property_readonly("rounded", &MapCase::rounded)
      .def_property_readonly("name", [](const MapCase& self) { return self.map().base.name; })
      .def_property_readonly("title", [](const MapCase& self) { return self.map().base.title; })
      .def_property_readonly(
          "variables", [](const MapCase& self) { return symbol_names(self.map().base.variables); })
      .def_property_readonly(
          "parameters",
          [](const MapCase& self) { return symbol_names(self.map().base.parameters); })
      .def_property_readonly("scenes",
                             [](const MapCase& self) {
                               Names result;
                               for (const Scene& scene : self.map().base.scenes)
                                 result.push_back(scene.name);
                               return result;
                             })
      .def("verify", &verify_map)
      .def("search", &search_of_map)
      .def("darboux", &darboux_of_map)
      .def("degrees", &degrees)
      .def("iterate", &iterated);
}

}  // namespace casimir::python
