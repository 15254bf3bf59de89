#include "tools/text/proofs/structure_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/cli/output.hpp"
#include "tools/text/proofs/proof_report.hpp"
#include "tools/text/proofs/search_report.hpp"

namespace casimir::tools {
namespace {

using structure::Bracket;
using structure::BracketReport;
using structure::Tensor;
using structure::TensorReport;
using structure::TensorType;

using Texts = std::vector<std::pair<std::string, std::string>>;

nlohmann::ordered_json object_of(const Texts& texts) {
  nlohmann::ordered_json result = nlohmann::ordered_json::object();
  for (const auto& [label, text] : texts) result[label] = text;
  return result;
}

nlohmann::ordered_json to_json(const Bracket& bracket) {
  nlohmann::ordered_json own{{"brackets", object_of(bracket.texts)},
                             {"degree", bracket.degree},
                             {"jacobi", to_string(bracket.jacobi)}};
  if (bracket.hamiltonian) {
    own["hamiltonian"] = bracket.hamiltonian_text;
    own["motion"] = to_string(bracket.motion);
  }
  own["casimirs"] = bracket.casimirs;
  if (!bracket.compatible.empty()) own["compatible_with"] = bracket.compatible;
  if (!bracket.chains.empty()) own["chains"] = bracket.chains;
  return own;
}

/// A component with its basis vector: "d/dM1", "{M1,M2}" or "dM1^dM2".
std::string component_text(TensorType type, const std::string& label, const std::string& text) {
  if (!type.form && type.rank == 2) return fmt::format("{{{}}} = {}", label, text);
  std::string basis = (type.form ? "d" : "d/d") + label;
  const std::string next = type.form ? "^d" : "^d/d";
  for (std::size_t comma = basis.find(','); comma != std::string::npos; comma = basis.find(','))
    basis.replace(comma, 1, next);
  return fmt::format("({}) {}", text, basis);
}

std::string tensor_text(TensorType type, const Texts& texts) {
  std::string result;
  const std::string between = !type.form && type.rank == 2 ? ", " : " + ";
  for (const auto& [label, text] : texts)
    result += (result.empty() ? "" : between) + component_text(type, label, text);
  return result;
}

std::string generic_text(const std::vector<std::string>& names) {
  return names.empty() ? "" : fmt::format(", for generic values of {}", fmt::join(names, ", "));
}

void print_bracket(const Bracket& bracket, bool colour) {
  fmt::print("  degree {}   {}\n", bracket.degree, tensor_text({2, false}, bracket.texts));
  fmt::print("    Jacobi identity   {}\n", verdict_text(bracket.jacobi, colour));
  if (bracket.hamiltonian)
    fmt::print("    H = {}   {}\n", bracket.hamiltonian_text, verdict_text(bracket.motion, colour));
  for (const std::string& casimir : bracket.casimirs)
    fmt::print("    Casimir function {}   {}\n", casimir, verdict_text(Verdict::proved, colour));
  for (const std::vector<std::string>& chain : bracket.chains) {
    if (chain.size() == 1)
      fmt::print("    Casimir function of both: {}\n", chain[0]);
    else
      fmt::print("    chain {}\n", fmt::join(chain, " -> "));
  }
  if (!bracket.compatible.empty()) {
    std::vector<std::size_t> numbers;
    for (const std::size_t i : bracket.compatible) numbers.push_back(i + 1);
    fmt::print("    compatible with number {}\n", fmt::join(numbers, ", "));
  }
}

/// What was found with factors, into a list of the document, and how the search ended.
template <class Report>
void add_with_factors(nlohmann::ordered_json& json, const char* list, const Report& report,
                      double seconds) {
  for (const auto& own : report.found) {
    json[list].push_back({{"components", object_of(own.texts)},
                          {"factor", own.factor_text},
                          {"degree", own.degree},
                          {"verdict", to_string(own.verdict)}});
  }
  if (!report.reason.empty()) json["reason"] = report.reason;
  json["seconds"] = seconds;
}

/// What a search for tensors takes as known.
const char* makers_of(structure::TensorType type) {
  if (type.form)
    return type.rank == 1 ? "the differentials of the integrals"
                          : "the differentials of the integrals and invariant forms of lower rank";
  return type.rank == 1
             ? "the motion, the bracket and the integrals"
             : "the motion, the bracket, the integrals and invariant tensors of lower rank";
}

}  // namespace

nlohmann::ordered_json to_json(const Model& model, int degree, const TensorReport& report,
                               double seconds) {
  nlohmann::ordered_json json{{"case", model.name},
                              {"degree", degree},
                              {"kind", structure::name_of(report.type)},
                              {"rank", report.type.rank},
                              {"dimensions", report.dimensions},
                              {"tensors", nlohmann::ordered_json::array()},
                              {"verdict", report.complete ? "proved" : "undecided"},
                              {"generic", report.generic},
                              {"functions", report.functions}};
  for (const Tensor& tensor : report.found) {
    json["tensors"].push_back({{"components", object_of(tensor.texts)},
                               {"degree", tensor.degree},
                               {"verdict", to_string(tensor.verdict)}});
  }
  if (!report.reason.empty()) json["reason"] = report.reason;
  json["seconds"] = seconds;
  return json;
}

void print(const Model& model, int degree, const TensorReport& report, double seconds) {
  const bool colour = may_colour(1);
  const std::string name = structure::name_of(report.type);
  fmt::print("{}: invariant {} T, L_X T = 0, with components of degree {} at most{}\n", model.name,
             name, degree, in_functions(report.functions));
  fmt::print("dimension up to degree 0, 1, ..: {}\n", fmt::join(report.dimensions, " "));
  fmt::print("beside those that are made of {}:{}\n", makers_of(report.type),
             report.found.empty() ? " none" : "");
  for (const Tensor& tensor : report.found) {
    fmt::print("  degree {:<3} {}   {}\n", tensor.degree, tensor_text(report.type, tensor.texts),
               verdict_text(tensor.verdict, colour));
  }
  if (report.complete)
    fmt::print("No others up to degree {}{}{}: {}\n", degree, in_functions(report.functions),
               generic_text(report.generic), verdict_text(Verdict::proved, colour));
  else
    fmt::print("Whether there are others is {}: {}\n", verdict_text(Verdict::undecided, colour),
               report.reason);
  fmt::print("{} found, {:.3f} s\n", report.found.size(), seconds);
}

nlohmann::ordered_json to_json(const Model& model, int degree,
                               const structure::OrbitalReport& report, double seconds) {
  nlohmann::ordered_json json{{"case", model.name},
                              {"degree", degree},
                              {"kind", "orbital symmetries"},
                              {"trivial", report.trivial},
                              {"fields", nlohmann::ordered_json::array()},
                              {"verdict", report.complete ? "proved" : "undecided"},
                              {"generic", report.generic}};
  add_with_factors(json, "fields", report, seconds);
  return json;
}

void print(const Model& model, int degree, const structure::OrbitalReport& report, double seconds) {
  const bool colour = may_colour(1);
  fmt::print("{}: fields Y with [X, Y] = g*X, polynomial g and components of degree {} at most\n",
             model.name, degree);
  fmt::print("a basis, modulo the fields h*X with polynomials h{}\n",
             report.found.empty() ? ": none" : ":");
  for (const structure::OrbitalSymmetry& own : report.found) {
    fmt::print("  degree {:<3} {}   g = {}   {}\n", own.degree, tensor_text({1, false}, own.texts),
               own.factor_text, verdict_text(own.verdict, colour));
  }
  if (report.complete)
    fmt::print("No others than combinations of these{}: {}\n", generic_text(report.generic),
               verdict_text(Verdict::proved, colour));
  else
    fmt::print("Whether there are others is {}: {}\n", verdict_text(Verdict::undecided, colour),
               report.reason);
  fmt::print("{} found, {:.3f} s\n", report.found.size(), seconds);
}

nlohmann::ordered_json to_json(const Model& model, int degree,
                               const structure::ConformalReport& report, double seconds) {
  nlohmann::ordered_json json{
      {"case", model.name},
      {"degree", degree},
      {"kind", "conformal " + structure::name_of(report.type)},
      {"rank", report.type.rank},
      {"trivial", report.trivial},
      {"tensors", nlohmann::ordered_json::array()},
      {"verdict", report.complete ? "proved" : "undecided"},
      {"rational", report.complete_rational ? "proved" : "undecided"},
      {"constant_factors", report.complete_constants ? "proved" : "undecided"},
      {"generic", report.generic}};
  add_with_factors(json, "tensors", report, seconds);
  return json;
}

void print(const Model& model, int degree, const structure::ConformalReport& report,
           double seconds) {
  const bool colour = may_colour(1);
  fmt::print(
      "{}: conformal {} T, L_X T = f*T with a polynomial f that is not 0, with components of "
      "degree "
      "{} at most\n",
      model.name, structure::name_of(report.type), degree);
  fmt::print(
      "beside invariant ones and products of others with integrals and Darboux polynomials{}\n",
      report.found.empty() ? ": none" : ":");
  for (const structure::ConformalTensor& own : report.found) {
    fmt::print("  degree {:<3} {}   f = {}   {}\n", own.degree, tensor_text(report.type, own.texts),
               own.factor_text, verdict_text(own.verdict, colour));
  }
  const std::string generic = generic_text(report.generic);
  if (report.complete)
    fmt::print("No others up to degree {}{}: {}\n", degree, generic,
               verdict_text(Verdict::proved, colour));
  else
    fmt::print("Whether there are others is {}: {}\n", verdict_text(Verdict::undecided, colour),
               report.reason);
  if (!report.complete && report.complete_constants)
    fmt::print("No others with coefficients that are rational in the parameters{}{}: {}\n",
               report.complete_rational ? "" : " and with a constant f", generic,
               verdict_text(Verdict::proved, colour));
  fmt::print("{} found, {} dimensions of products, {:.3f} s\n", report.found.size(), report.trivial,
             seconds);
}

nlohmann::ordered_json to_json(const Model& model, int degree, const BracketReport& report,
                               double seconds) {
  nlohmann::ordered_json json{{"case", model.name},
                              {"degree", degree},
                              {"hamiltonian_degree", report.hamiltonian_degree},
                              {"invariant_bivectors", report.invariant}};
  if (report.first) json["first"] = to_json(*report.first);
  json["brackets"] = nlohmann::ordered_json::array();
  for (const Bracket& bracket : report.found) json["brackets"].push_back(to_json(bracket));
  json["families"] = report.families;
  json["spanned"] = report.spanned;
  json["verdict"] = report.complete ? "proved" : "undecided";
  if (report.complete && report.found.empty() && report.whatever_hamiltonian)
    json["excluded"] = "any_hamiltonian";
  json["generic"] = report.generic;
  if (!report.reason.empty()) json["reason"] = report.reason;
  json["seconds"] = seconds;
  return json;
}

void print(const Model& model, int degree, const BracketReport& report, double seconds) {
  const bool colour = may_colour(1);
  const std::string second = report.first ? "second " : "";
  fmt::print("{}: {}Poisson brackets of degree {} at most that the motion keeps\n", model.name,
             second, degree);
  if (report.first) {
    fmt::print("first:\n");
    print_bracket(*report.first, colour);
  }
  fmt::print("{}\n", report.found.empty() ? "found: none" : "found:");
  for (const Bracket& bracket : report.found) print_bracket(bracket, colour);
  const std::string generic = generic_text(report.generic);
  if (!report.complete) {
    fmt::print("Whether there are others is {}: {}\n", verdict_text(Verdict::undecided, colour),
               report.reason);
  } else if (!report.first && report.whatever_hamiltonian) {
    fmt::print("No Poisson bracket up to degree {}, whatever the Hamiltonian{}: {}\n", degree,
               generic, verdict_text(Verdict::proved, colour));
  } else {
    const std::string kind = report.first
                                 ? "that is compatible with the first"
                                 : fmt::format("with a polynomial Hamiltonian up to degree {}",
                                               report.hamiltonian_degree);
    const std::string what = report.found.empty() ? "No other"
                             : report.spanned
                                 ? "No other, beside linear combinations of these,"
                                 : fmt::format("No other than in the {} famil{} of these",
                                               report.families, report.families == 1 ? "y" : "ies");
    fmt::print("{} up to degree {} {}{}: {}\n", what, degree, kind, generic,
               verdict_text(Verdict::proved, colour));
  }
  fmt::print("{} found among {} invariant bivectors, {:.3f} s\n", report.found.size(),
             report.invariant, seconds);
}

}  // namespace casimir::tools
