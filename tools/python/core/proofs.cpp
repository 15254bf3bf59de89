// Cases: reading, proofs, searches, code.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "codegen/emit_cpp.hpp"
#include "symbolic/certificate.hpp"
#include "symbolic/obstruction/certificate/coq_linear_algebra.hpp"
#include "symbolic/obstruction/obstruct.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/darboux.hpp"
#include "symbolic/search/exponents.hpp"
#include "symbolic/search/search.hpp"
#include "tools/analysis/equilibria/numeric_balances.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/case.hpp"
#include "tools/python/core/exact_work.hpp"
#include "tools/python/core/guard.hpp"
#include "tools/show/system_view.hpp"
#include "tools/text/proofs/constraints_note.hpp"
#include "tools/typeset/latex.hpp"

namespace casimir::python {
namespace py = pybind11;
using namespace py::literals;

search::Watch watched(Interrupt& interrupt, double seconds, double memory) {
  search::Watch watch;
  const std::function<bool()> late = time_limit(seconds);
  watch.tick = [&interrupt, late](double) {
    if (interrupt()) throw Interrupted();
    if (late && late()) throw search::TimeUp();
  };
  if (memory > 0) watch.memory_limit = memory;
  return watch;
}

py::object to_python(const std::optional<SpectrumCount>& count) {
  if (!count) return py::none();
  return py::dict("involution"_a = to_string(count->involution), "leaf"_a = count->leaf,
                  "independent_on_leaves"_a = count->on_leaves,
                  "verdict"_a = to_string(count->verdict), "where"_a = count->where,
                  "at"_a = count->at, "reason"_a = count->reason);
}

py::dict to_python(const Proof& proof) {
  py::object witness = py::none();
  if (proof.witness) {
    py::dict point;
    for (const auto& [name, value] : proof.witness->point) point[py::str(name)] = value;
    witness = py::dict("point"_a = point, "value"_a = proof.witness->value);
  }
  py::list findings;
  for (const Proof& finding : proof.findings) findings.append(to_python(finding));
  return py::dict("kind"_a = to_string(proof.kind), "name"_a = proof.name,
                  "verdict"_a = to_string(proof.verdict), "fact"_a = proof.fact,
                  "note"_a = proof.note, "seconds"_a = proof.seconds, "on"_a = proof.on,
                  "evidence"_a = proof.evidence, "residual"_a = proof.residual,
                  "reason"_a = proof.reason, "witness"_a = witness, "where"_a = proof.where,
                  "integrals"_a = proof.integrals, "spectrum"_a = to_python(proof.spectrum),
                  "findings"_a = findings);
}

Candidates candidates_of(const Names& integrals, const Names& casimirs, const Names& relations,
                         const Names& identities, const Names& on) {
  Candidates candidates;
  candidates.integrals = typed(integrals, "integral");
  candidates.casimirs = typed(casimirs, "casimir");
  candidates.invariant_relations = typed(relations, "invariant_relation");
  candidates.identities = typed(identities, "identity");
  candidates.on = typed(on, "on");
  return candidates;
}

namespace {

/// \param certify  whether a file for Coq is wanted, where everything is proved: `certificate` is its
///                 text then, and `left_out` says which claims are not in it.
py::object verify(const Case& self, const Names& integrals, const Names& casimirs,
                  const Names& relations, const Names& identities, const Names& on, bool certify,
                  double seconds) {
  const Candidates candidates = candidates_of(integrals, casimirs, relations, identities, on);
  return verified(
      self.model(), self.model(), candidates, seconds,
      [](const auto&... arguments) { return prove(arguments...); },
      [&](py::dict& facts, const std::vector<Proof>& proofs, Verdict verdict) {
        if (!certify || verdict != Verdict::proved) return;
        const Certificate certificate = coq_certificate(self.model(), candidates, proofs);
        Names left_out;
        for (const Uncertified& claim : certificate.left_out)
          left_out.push_back(to_string(claim.kind) + (" " + claim.name + ": ") + claim.reason);
        facts["certificate"] = certificate.text;
        facts["left_out"] = left_out;
      });
}

py::dict to_python(const Case& self, const search::Found& found) {
  return py::dict("text"_a = found.text, "latex"_a = latex(self.shown(found.value).math),
                  "degree"_a = found.degree, "verdict"_a = to_string(found.verdict),
                  "independent"_a = found.independent);
}

py::list to_python(const Case& self, const std::vector<search::Found>& list) {
  py::list result;
  for (const search::Found& found : list) result.append(to_python(self, found));
  return result;
}

py::dict to_python(const Case& self, const search::Report& report) {
  return py::dict(
      "found"_a = to_python(self, report.found), "casimirs"_a = to_python(self, report.casimirs),
      "trivial"_a = report.trivial, "complete"_a = report.complete, "reason"_a = report.reason,
      "generic"_a = report.generic, "functions"_a = report.functions,
      "weights"_a = py::dict(py::cast(report.weights)), "degree_in"_a = report.degree_in);
}

std::vector<std::pair<Text, Text>> weights_of(const Values& weights) {
  std::vector<std::pair<Text, Text>> result;
  for (const auto& [name, weight] : weights)
    result.emplace_back(typed(name, "weights"), typed(weight, "weights"));
  return result;
}

std::vector<search::DegreeIn> degree_in_of(const DegreesIn& limits) {
  std::vector<search::DegreeIn> result;
  for (const auto& [names, degree] : limits)
    result.push_back({typed(names, "degree_in"), typed(std::to_string(degree), "degree_in")});
  return result;
}

search::Request request_of(int degree, const Names& functions, const Values& weights,
                           bool own_weights, const DegreesIn& degree_in) {
  search::Request request;
  request.degree = degree;
  request.functions = typed(functions, "functions");
  request.weights = weights_of(weights);
  request.own_weights = own_weights;
  request.degree_in = degree_in_of(degree_in);
  return request;
}

py::object find_integrals(const Case& self, int degree, bool casimirs, const Names& on,
                          const Names& functions, const Values& weights, bool own_weights,
                          const DegreesIn& degree_in, double seconds, double memory) {
  search::Request request = request_of(degree, functions, weights, own_weights, degree_in);
  request.casimirs = casimirs;
  request.on = typed(on, "on");
  request.denominators = true;
  Interrupt interrupt;
  return exactly(
      interrupt,
      [&] {
        return search::find_integrals(self.model(), request, watched(interrupt, seconds, memory));
      },
      [&](const search::Report& report) { return to_python(self, report); });
}

py::object find_conditions(const Case& self, int degree, const Names& free, const Names& functions,
                           const Values& weights, const DegreesIn& degree_in, double seconds,
                           double memory) {
  const search::Request request = request_of(degree, functions, weights, false, degree_in);
  Interrupt interrupt;
  const auto find = [&] {
    return search::find_conditions(self.model(), request, typed(free, "free"),
                                   watched(interrupt, seconds, memory));
  };
  return exactly(interrupt, find, [&](const search::ConditionReport& report) {
    py::list conditions;
    for (const search::Condition& condition : report.conditions) {
      py::dict parameters;
      for (const auto& [name, value] : condition.parameters) parameters[py::str(name)] = value;
      conditions.append(py::dict("parameters"_a = parameters, "relation"_a = condition.relation,
                                 "found"_a = to_python(self, condition.found),
                                 "verdict"_a = to_string(condition.verdict)));
    }
    return py::dict("generic"_a = to_python(self, report.generic), "conditions"_a = conditions,
                    "complete"_a = report.complete, "reason"_a = report.reason);
  });
}

py::object find_darboux(const Case& self, int degree, double seconds, double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    return search::find_darboux(self.model(), degree, watched(interrupt, seconds, memory));
  };
  return exactly(interrupt, find, [&](const search::DarbouxReport& report) {
    py::list found;
    for (const search::DarbouxPolynomial& polynomial : report.found)
      found.append(py::dict("text"_a = polynomial.text, "cofactor"_a = polynomial.cofactor,
                            "relations"_a = polynomial.relations, "degree"_a = polynomial.degree,
                            "verdict"_a = to_string(polynomial.verdict)));
    return py::dict("found"_a = found, "complete"_a = report.complete, "reason"_a = report.reason,
                    "generic"_a = report.generic);
  });
}

py::dict to_python(const search::Exponent& exponent) {
  return py::dict("text"_a = exponent.text, "is_root"_a = exponent.is_root,
                  "multiplicity"_a = exponent.multiplicity, "values"_a = exponent.values);
}

/// \param numeric  balances by Newton's iteration in place of the exact analysis
py::object exponents(const Case& self, const Values& weights, bool numeric, double seconds,
                     double memory) {
  Interrupt interrupt;
  std::size_t starts = 0;
  const auto find = [&] {
    const search::Watch watch = watched(interrupt, seconds, memory);
    if (!numeric) return search::kovalevskaya_exponents(self.model(), weights_of(weights), watch);
    search::ExponentReport report = search::leading_terms(self.model(), weights_of(weights));
    if (!report.leading) throw RequestError("numeric=True needs numbers for all parameters");
    report.reason = "exact ones were not asked for";
    starts = take_numeric_balances(report, [&](double share) { watch.tick(share); });
    return report;
  };
  return exactly(interrupt, find, [&](const search::ExponentReport& report) {
    py::list balances;
    for (const search::Balance& balance : report.balances) {
      py::list list;
      for (const search::Exponent& exponent : balance.exponents) list.append(to_python(exponent));
      balances.append(py::dict("coefficients"_a = balance.coefficients,
                               "relations"_a = balance.relations, "free"_a = balance.free,
                               "exponents"_a = list, "decided"_a = balance.decided));
    }
    return py::dict("weights"_a = report.weights, "left_out"_a = report.left_out,
                    "balances"_a = balances, "complete"_a = report.complete,
                    "reason"_a = report.reason, "generic"_a = report.generic,
                    "conclusions"_a = report.conclusions, "starts"_a = starts);
  });
}

/// The linear algebra of a proof as a file for Coq, or why there is none.
py::dict certificate_of(const obstruction::Obstruction& result) {
  try {
    const obstruction::LinearCertificate certificate = obstruction::linear_certificate(result);
    return py::dict("certificate"_a = certificate.text, "left_out"_a = certificate.left_out,
                    "uncertified"_a = "");
  } catch (const obstruction::NoCertificate& problem) {
    return py::dict("certificate"_a = "", "left_out"_a = Names{},
                    "uncertified"_a = std::string(problem.what()));
  }
}

py::object obstruct(const Case& self, const std::string& scene, const Names& along,
                    const std::string& free, bool certify, double seconds, double memory) {
  Interrupt interrupt;
  const auto find = [&] {
    return obstruction::find_obstruction(self.model(), {scene, typed(along, "along"), free},
                                         watched(interrupt, seconds, memory));
  };
  return exactly(interrupt, find, [&](const obstruction::Obstruction& result) {
    py::list examined;
    for (const obstruction::Examined& one : result.examined)
      examined.append(py::dict("along"_a = one.along, "level"_a = one.level, "curve"_a = one.curve,
                               "nve"_a = one.nve, "exponents"_a = one.exponents,
                               "cases"_a = one.cases, "solution"_a = one.solution,
                               "outcome"_a = one.outcome, "decisive"_a = one.decisive));
    py::list survivors;
    for (const obstruction::FreeValue& one : result.values)
      survivors.append(py::dict("value"_a = one.value, "why"_a = one.why,
                                "excluded"_a = one.excluded, "outcome"_a = one.outcome));
    py::list sequences;
    for (const obstruction::FreeSequence& one : result.sequences)
      sequences.append(py::dict("range"_a = one.range, "conditions"_a = one.conditions));
    py::dict facts("proved"_a = result.proved, "rational"_a = result.rational.has_value(),
                   "parameters"_a = result.parameters, "survivors"_a = survivors,
                   "sequences"_a = sequences, "theorem"_a = result.theorem,
                   "excluded"_a = result.excluded, "reason"_a = result.reason,
                   "examined"_a = examined);
    if (certify && result.proved) facts.attr("update")(certificate_of(result));
    return facts;
  });
}

/// A system as `show` tells it, in one markup.
py::dict show(const Case& self, const std::string& format) {
  const ExactAlgebra guard;
  const bool paper = format == "latex";
  tools::Notation notation(self.model());
  const tools::SystemView view = view_of(self.model(), notation);
  const py::gil_scoped_acquire python;
  const auto shown = [&](const tools::Written& one) { return paper ? latex(one.math) : one.text; };
  const auto all = [&](const std::vector<tools::Written>& formulas) {
    Names list;
    for (const tools::Written& one : formulas) list.push_back(shown(one));
    return list;
  };
  const auto pairs = [&](const std::vector<tools::Formula>& formulas) {
    py::list list;
    for (const tools::Formula& formula : formulas)
      list.append(py::make_tuple(shown(formula.left), shown(formula.right)));
    return list;
  };
  std::vector<Names> matrix;
  for (const std::vector<tools::Written>& row : view.structure_matrix) matrix.push_back(all(row));
  py::list claims;
  for (const tools::FormulaGroup& group : view.claims)
    claims.append(py::make_tuple(group.title, pairs(group.formulas)));
  return py::dict("variables"_a = all(view.variables), "structure_matrix"_a = matrix,
                  "brackets"_a = pairs(view.brackets),
                  "hamiltonian"_a = view.hamiltonian ? shown(*view.hamiltonian) : "",
                  "equations"_a = pairs(view.equations), "claims"_a = claims);
}

std::string generate(const Case& self, const std::string& scene, const Names& keep,
                     const std::optional<Names>& observe, bool jacobian, bool variational,
                     bool taylor, const std::string& language,
                     const std::optional<std::string>& name) {
  const ExactAlgebra guard;
  SpecialiseOptions what;
  what.keep_parameters = keep;
  what.observe = observe;
  what.jacobian = jacobian;
  what.variational = variational;
  what.taylor = taylor;
  HeaderOptions how;
  how.language = language == "c" ? Language::c : Language::cpp;
  how.name = name;
  const Model& model = self.model();
  return emit_header(specialise(model, model.scene(scene), what), how);
}

Names names(const std::vector<GiNaC::symbol>& symbols) {
  Names result;
  for (const GiNaC::symbol& symbol : symbols) result.push_back(symbol.get_name());
  return result;
}

Names scenes(const Case& self) {
  Names result;
  for (const Scene& scene : self.model().scenes) result.push_back(scene.name);
  return result;
}

/// The constraints that a search is not about. \param on  functions, on whose zero level it is
Names constraints_left_out(const Case& self, const Names& on) {
  const ExactAlgebra guard;
  std::vector<GiNaC::ex> level;
  for (const std::string& text : on) level.push_back(self.model().parse(typed(text, "on")));
  return tools::constraints_left_out(self.model(), level);
}

/// An expression over the names of a case: as case files have it, and in LaTeX.
std::pair<std::string, std::string> expression(const Case& self, const std::string& text) {
  const ExactAlgebra guard;
  const GiNaC::ex value = self.model().parse(typed(text, "expression"));
  const tools::Written shown = self.shown(value);
  return {shown.text, latex(shown.math)};
}

Values named(const Case& self, const std::vector<NamedExpression>& list) {
  const ExactAlgebra guard;
  Values result;
  for (const NamedExpression& f : list) result.emplace_back(f.name, self.shown(f.value).text);
  return result;
}

}  // namespace

void bind_case(py::module_& module) {
  module.def("add_case_folder", [](const std::string& folder) { tools::add_case_folder(folder); });
  module.def("bundled", [] {
    Names names;
    for (const std::filesystem::path& path : tools::bundled_flows({}, {}))
      names.push_back(path.stem().string());
    return names;
  });
  py::class_<Case, std::shared_ptr<Case>>(module, "Case")
      .def_static("load", &Case::load)
      .def_static("from_text", &Case::from_text)
      .def("with_values", &Case::with)
      .def("in_variables", &Case::in_variables)
      .def_property_readonly("set", &Case::set)
      .def_property_readonly("text", &Case::text)
      .def_property_readonly("file", &Case::file)
      .def_property_readonly("changed_parameters", &Case::parameters)
      .def_property_readonly("changed_initial", &Case::initial)
      .def_property_readonly("rounded", &Case::rounded)
      .def_property_readonly("name", [](const Case& self) { return self.model().name; })
      .def_property_readonly("title", [](const Case& self) { return self.model().title; })
      .def_property_readonly("source", [](const Case& self) { return self.model().source; })
      .def_property_readonly("phase_space",
                             [](const Case& self) { return self.model().phase_space; })
      .def_property_readonly("variables",
                             [](const Case& self) { return names(self.model().variables); })
      .def_property_readonly("parameters",
                             [](const Case& self) { return names(self.model().parameters); })
      .def_property_readonly("scenes", &scenes)
      .def_property_readonly("casimirs",
                             [](const Case& self) { return named(self, self.model().casimirs); })
      .def_property_readonly("integrals",
                             [](const Case& self) { return named(self, self.model().integrals); })
      .def("expression", &expression)
      .def("show", &show)
      .def("constraints_left_out", &constraints_left_out)
      .def("verify", &verify)
      .def("search", &find_integrals)
      .def("conditions", &find_conditions)
      .def("darboux", &find_darboux)
      .def("exponents", &exponents)
      .def("obstruct", &obstruct)
      .def("generate", &generate);
}

}  // namespace casimir::python
