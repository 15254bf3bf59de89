// Invariant tensors, Poisson brackets, rational integrals, isomorphisms.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "symbolic/search/conditions/darboux_conditions.hpp"
#include "symbolic/search/darboux.hpp"
#include "symbolic/structure/brackets.hpp"
#include "symbolic/structure/conformal.hpp"
#include "symbolic/structure/orbital.hpp"
#include "symbolic/structure/relate/relate.hpp"
#include "symbolic/structure/relate/symmetries.hpp"
#include "symbolic/structure/separation.hpp"
#include "symbolic/structure/tensors.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/exact_work.hpp"

namespace casimir::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

const char* verdict_of(bool complete) { return complete ? "proved" : "undecided"; }

py::dict table_of(const std::vector<std::pair<std::string, std::string>>& entries) {
  py::dict result;
  for (const auto& [name, text] : entries) result[py::str(name)] = text;
  return result;
}

/// Fields and tensors that the motion multiplies by a function.
template <class Found>
py::list with_factors(const std::vector<Found>& list) {
  py::list result;
  for (const Found& own : list)
    result.append(py::dict("components"_a = table_of(own.texts), "factor"_a = own.factor_text,
                           "degree"_a = own.degree, "verdict"_a = to_string(own.verdict)));
  return result;
}

py::object rational(const Case& self, int degree, double seconds, double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    return search::find_rational(self.model(), degree, watched(interrupt, seconds, memory));
  };
  return exactly(interrupt, find, [](const search::RationalReport& report) {
    Names found;
    for (const search::DarbouxCombination& own : report.integrals) found.push_back(own.text);
    return py::dict("found"_a = found, "verdict"_a = verdict_of(report.complete),
                    "reason"_a = report.reason, "generic"_a = report.generic);
  });
}

py::object tensors(const Case& self, int rank, bool forms, int degree, double seconds,
                   double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    return structure::find_tensors(self.model(), {rank, forms}, degree,
                                   watched(interrupt, seconds, memory));
  };
  return exactly(interrupt, find, [](const structure::TensorReport& report) {
    py::list found;
    for (const structure::Tensor& own : report.found)
      found.append(py::dict("components"_a = table_of(own.texts), "degree"_a = own.degree,
                            "verdict"_a = to_string(own.verdict)));
    return py::dict("found"_a = found, "dimensions"_a = report.dimensions,
                    "verdict"_a = verdict_of(report.complete), "reason"_a = report.reason,
                    "generic"_a = report.generic, "functions"_a = report.functions);
  });
}

py::object conformal_tensors(const Case& self, int rank, bool forms, int degree, double seconds,
                             double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    return structure::find_conformal_tensors(self.model(), {rank, forms}, degree,
                                             watched(interrupt, seconds, memory));
  };
  return exactly(interrupt, find, [](const structure::ConformalReport& report) {
    return py::dict("found"_a = with_factors(report.found), "trivial"_a = report.trivial,
                    "verdict"_a = verdict_of(report.complete),
                    "rational"_a = verdict_of(report.complete_rational),
                    "constant_factors"_a = verdict_of(report.complete_constants),
                    "reason"_a = report.reason, "generic"_a = report.generic);
  });
}

/// Fields that take orbits to orbits.
py::object orbital_symmetries(const Case& self, int degree, double seconds, double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    return structure::find_orbital_symmetries(self.model(), degree,
                                              watched(interrupt, seconds, memory));
  };
  return exactly(interrupt, find, [](const structure::OrbitalReport& report) {
    return py::dict("found"_a = with_factors(report.found), "trivial"_a = report.trivial,
                    "verdict"_a = verdict_of(report.complete), "reason"_a = report.reason,
                    "generic"_a = report.generic);
  });
}

/// Values of parameters with additional Darboux polynomials.
py::object darboux_conditions(const Case& self, int degree, const Names& free, double seconds,
                              double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    return search::find_darboux_conditions(self.model(), degree, typed(free, "free"),
                                           watched(interrupt, seconds, memory));
  };
  return exactly(interrupt, find, [](const search::DarbouxConditionReport& report) {
    py::list found;
    for (const search::DarbouxCondition& own : report.conditions) {
      py::list additional;
      for (const search::DarbouxPolynomial& polynomial : own.found)
        additional.append(py::dict("text"_a = polynomial.text, "cofactor"_a = polynomial.cofactor));
      found.append(py::dict("parameters"_a = table_of(own.parameters),
                            "relations"_a = own.relations, "found"_a = additional,
                            "verdict"_a = to_string(own.verdict)));
    }
    return py::dict("found"_a = found, "verdict"_a = verdict_of(report.complete),
                    "coefficients"_a = report.has_conjugates ? "rational" : "algebraic",
                    "reason"_a = report.reason);
  });
}

py::dict to_python(const structure::Bracket& own) {
  return py::dict("brackets"_a = table_of(own.texts), "hamiltonian"_a = own.hamiltonian_text,
                  "casimirs"_a = own.casimirs, "chains"_a = own.chains,
                  "compatible"_a = own.compatible, "degree"_a = own.degree,
                  "jacobi"_a = to_string(own.jacobi), "motion"_a = to_string(own.motion));
}

/// \param second  of the case's own bracket; else brackets of its equations alone
py::object brackets(const Case& self, int degree, bool second, double seconds, double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    const search::Watch watch = watched(interrupt, seconds, memory);
    return second ? structure::find_second_brackets(self.model(), degree, watch)
                  : structure::find_brackets(self.model(), degree, watch);
  };
  return exactly(interrupt, find, [](const structure::BracketReport& report) {
    py::list found;
    for (const structure::Bracket& own : report.found) found.append(to_python(own));
    return py::dict("found"_a = found, "families"_a = report.families, "spanned"_a = report.spanned,
                    "verdict"_a = verdict_of(report.complete), "reason"_a = report.reason,
                    "generic"_a = report.generic);
  });
}

py::dict to_python(const structure::Separation& own) {
  py::list relations;
  for (const structure::Separation::Relation& one : own.relations)
    relations.append(py::dict("root"_a = one.root, "multipliers"_a = one.multipliers,
                              "sum"_a = one.sum, "equation"_a = one.equation,
                              "may_vanish"_a = one.may_vanish));
  return py::dict("integrals"_a = own.integrals, "bivector"_a = table_of(own.bivector),
                  "variable"_a = own.names.root, "coefficients"_a = own.coefficients,
                  "polynomial"_a = own.polynomial, "separated"_a = to_string(own.separated),
                  "staeckel"_a = to_string(own.staeckel), "relations"_a = relations,
                  "nonzero"_a = own.nonzero, "point"_a = own.point, "real"_a = own.real,
                  "reason"_a = own.reason, "map"_a = to_string(own.map),
                  "map_case"_a = own.map_case, "no_map"_a = own.no_map);
}

/// \param roots  a polynomial, or none
py::object separation(const Case& self, int degree, const Names& on, const Names& roots,
                      double seconds, double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    structure::SeparationRequest request{degree, typed(on, "on"), {}};
    if (!roots.empty()) request.roots = typed(roots, "roots").front();
    return structure::find_separation(self.model(), request, watched(interrupt, seconds, memory));
  };
  return exactly(interrupt, find, [](const structure::SeparationReport& report) {
    py::list found;
    for (const structure::Separation& own : report.found) found.append(to_python(own));
    const std::string verdict = report.found.empty()
                                    ? verdict_of(report.none || report.freedom == 1U)
                                    : to_string(report.found.front().separated);
    return py::dict("found"_a = found, "degrees_of_freedom"_a = report.freedom, "on"_a = report.on,
                    "integrals"_a = report.integrals, "none"_a = report.none, "verdict"_a = verdict,
                    "reason"_a = report.reason, "generic"_a = report.generic);
  });
}

py::object relate(const Case& a, const Case& b, bool with_hamiltonian, double seconds,
                  double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    const bool both = a.model().hamiltonian && b.model().hamiltonian;
    return structure::relate(a.model(), b.model(), with_hamiltonian && both,
                             watched(interrupt, seconds, memory));
  };
  return exactly(interrupt, find, [](const structure::Relation& relation) {
    py::list differences;
    for (const structure::Difference& own : relation.differences)
      differences.append(py::make_tuple(own.name, own.first, own.second));
    return py::dict("verdict"_a = to_string(relation.verdict), "map"_a = table_of(relation.map),
                    "factor"_a = relation.factor, "casimir_part"_a = relation.casimir_part,
                    "differences"_a = differences, "reason"_a = relation.reason);
  });
}

py::object symmetries(const Case& self, double seconds, double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    return structure::linear_symmetries(self.model(), watched(interrupt, seconds, memory));
  };
  return exactly(interrupt, find, [](const structure::SymmetryReport& report) {
    py::list found;
    for (const structure::LinearSymmetry& own : report.found)
      found.append(py::dict("field"_a = table_of(own.field), "integral"_a = own.integral,
                            "verdict"_a = to_string(own.verdict)));
    return py::dict("found"_a = found, "verdict"_a = verdict_of(report.complete),
                    "reason"_a = report.reason, "generic"_a = report.generic);
  });
}

}  // namespace

void bind_structure(py::module_& module) {
  module.def("rational", &rational);
  module.def("tensors", &tensors);
  module.def("conformal_tensors", &conformal_tensors);
  module.def("orbital_symmetries", &orbital_symmetries);
  module.def("darboux_conditions", &darboux_conditions);
  module.def("brackets", &brackets);
  module.def("separation", &separation);
  module.def("relate", &relate);
  module.def("symmetries", &symmetries);
}

}  // namespace casimir::python
