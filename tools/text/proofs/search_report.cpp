#include "tools/text/proofs/search_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/cli/output.hpp"
#include "tools/text/proofs/claim_words.hpp"
#include "tools/text/proofs/proof_report.hpp"

namespace casimir::tools {
namespace {

using search::Found;
using search::Report;

nlohmann::ordered_json texts(const std::vector<Found>& list) {
  nlohmann::ordered_json result = nlohmann::ordered_json::array();
  for (const Found& found : list) result.push_back(found.text);
  return result;
}

nlohmann::ordered_json details(const std::vector<Found>& list) {
  nlohmann::ordered_json result = nlohmann::ordered_json::array();
  for (const Found& found : list) {
    result.push_back({{"expression", found.text},
                      {"degree", found.degree},
                      {"verdict", to_string(found.verdict)},
                      {"independent", found.independent}});
  }
  return result;
}

const char* noun(const Report& report, bool plural) {
  const ClaimWords& words = claim_words(report.kind);
  return plural ? words.many : words.one;
}

/// What a person calls it.
std::string kind_text(search::DarbouxCombination::Kind kind) {
  using Kind = search::DarbouxCombination::Kind;
  if (kind == Kind::multiplier) return "density of an invariant measure";
  return kind == Kind::integral ? "integral" : "constant in time";
}

void print_list(const std::vector<Found>& list, bool colour) {
  for (const Found& found : list) {
    fmt::print("  degree {:<3} {}{}   {}\n", found.degree, found.text,
               found.independent ? "" : "   (a function of the others)",
               verdict_text(found.verdict, colour));
  }
}

nlohmann::ordered_json relations_of(const std::vector<search::DarbouxPolynomial>& list) {
  nlohmann::ordered_json result = nlohmann::ordered_json::array();
  for (const search::DarbouxPolynomial& found : list) {
    result.push_back({{"expression", found.text},
                      {"cofactor", found.cofactor},
                      {"degree", found.degree},
                      {"verdict", to_string(found.verdict)}});
  }
  return result;
}

void print_list(const std::vector<search::DarbouxPolynomial>& list, bool colour) {
  for (const search::DarbouxPolynomial& found : list) {
    fmt::print("  F = {}   K = {}   {}\n", found.text, found.cofactor,
               verdict_text(found.verdict, colour));
  }
}

/// Of what "no others" is said.
const char* coefficients_of(bool has_conjugates) {
  return has_conjugates ? "rational" : "algebraic";
}

/// Factors with coefficients that are algebraic numbers are not among those found.
std::string no_others(const search::DarbouxReport& report) {
  if (report.found.empty())
    return report.has_conjugates ? "There are none with rational coefficients" : "There are none";
  return report.has_conjugates ? "No others that are irreducible over the rational numbers"
                               : "No others that are irreducible";
}

/// NAME = VALUE, NAME = VALUE.
std::string values_line(const std::vector<std::pair<std::string, std::string>>& parameters) {
  std::string line;
  for (const auto& [name, value] : parameters)
    line += (line.empty() ? "" : ", ") + name + " = " + value;
  return line;
}

/// Of which parameters the answer says nothing about single values.
std::string for_generic(const std::vector<std::string>& parameters) {
  if (parameters.empty()) return {};
  return fmt::format(", for generic values of {}", fmt::join(parameters, ", "));
}

/// \param of  what alone is said not to be there elsewhere
void print_end(bool complete, const std::string& reason, std::size_t conditions, double seconds,
               const std::string& of = "") {
  const bool colour = may_colour(1);
  if (complete)
    fmt::print("No other value, curve or set{}: {}\n", of, verdict_text(Verdict::proved, colour));
  else
    fmt::print("Whether there are others is {}: {}\n", verdict_text(Verdict::undecided, colour),
               reason);
  fmt::print("{} conditions, {:.3f} s\n", conditions, seconds);
}

/// `up to degree 6, 4 in M1, M2, M3 and 2 in g1`; without a degree the limits alone.
std::string up_to(int degree, const Report& report) {
  std::string text = degree >= 0 ? fmt::format("up to degree {}", degree) : "up to degree";
  const char* before = degree >= 0 ? ", " : " ";
  for (const auto& [names, most] : report.degree_in) {
    text += fmt::format("{}{} in {}", before, most, fmt::join(names, ", "));
    before = " and ";
  }
  return text;
}

/// Negative where the limits of some variables alone were given.
nlohmann::ordered_json degree_json(int degree) {
  return degree >= 0 ? nlohmann::ordered_json(degree) : nlohmann::ordered_json();
}

void add_limits(nlohmann::ordered_json& json, const Report& report) {
  for (const auto& [name, weight] : report.weights) json["weights"][name] = weight;
  for (const auto& [names, degree] : report.degree_in)
    json["degree_in"].push_back({{"variables", names}, {"degree", degree}});
}

void print_weights(const Report& report) {
  if (report.weights.empty()) return;
  std::string line;
  for (const auto& [name, weight] : report.weights)
    line += fmt::format("{}{} {}", line.empty() ? "" : ", ", name, weight);
  fmt::print("weights: {}\n", line);
}

/// The options that ask for integrals on the constraints of the case.
std::string on_constraints(const Model& model) {
  std::vector<std::string> options;
  for (const NamedExpression& f : model.constraints)
    options.push_back(fmt::format("--on '{}'", f.name));
  return fmt::format("{}", fmt::join(options, " "));
}

}  // namespace

std::string in_functions(const std::vector<std::string>& functions) {
  if (functions.empty()) return {};
  return fmt::format(" in the variables and {}", fmt::join(functions, ", "));
}

nlohmann::ordered_json to_json(const Model& model, int degree, const Report& report,
                               double seconds) {
  nlohmann::ordered_json json{{"case", model.name},
                              {"degree", degree_json(degree)},
                              {"kind", to_string(report.kind)},
                              {"integrals", texts(report.found)},
                              {"details", details(report.found)},
                              {"casimirs", texts(report.casimirs)},
                              {"hamiltonian", report.hamiltonian},
                              {"trivial", report.trivial},
                              {"verdict", report.complete ? "proved" : "undecided"},
                              {"generic", report.generic},
                              {"functions", report.functions}};
  add_limits(json, report);
  if (!report.reason.empty()) json["reason"] = report.reason;
  if (!model.constraints.empty() && report.kind == ClaimKind::integral)
    json["not_on"] = names_of(model.constraints);
  json["system"] = {{"unknowns", report.unknowns},
                    {"equations", report.equations},
                    {"blocks", report.blocks},
                    {"largest_block", report.largest_block}};
  json["seconds"] = seconds;
  return json;
}

void print(const Model& model, int degree, const Report& report, double seconds) {
  const bool colour = may_colour(1);
  fmt::print("{}: polynomial {} {}{}\n", model.name, noun(report, true), up_to(degree, report),
             in_functions(report.functions));
  print_weights(report);
  if (report.kind != ClaimKind::casimir && (report.hamiltonian || !report.casimirs.empty())) {
    fmt::print("known: {}\n", report.hamiltonian ? "the Hamiltonian" : "Casimir functions");
    print_list(report.casimirs, colour);
  }
  if (report.found.empty()) {
    fmt::print("found: none\n");
  } else {
    fmt::print("found:\n");
    print_list(report.found, colour);
  }
  if (report.complete) {
    fmt::print("No other {} {}{} that the known ones do not generate{}: {}\n", noun(report, false),
               up_to(degree, report), in_functions(report.functions), for_generic(report.generic),
               verdict_text(Verdict::proved, colour));
  } else {
    fmt::print("Whether there are others is {}: {}\n", verdict_text(Verdict::undecided, colour),
               report.reason);
  }
  if (report.kind == ClaimKind::integral && !model.constraints.empty())
    fmt::print("This is about the whole space of the variables; on its constraints alone: {}\n",
               on_constraints(model));
  fmt::print("{} unknowns, {} equations, {} blocks (largest {}), {} trivial solutions, {:.3f} s\n",
             report.unknowns, report.equations, report.blocks, report.largest_block, report.trivial,
             seconds);
}

nlohmann::ordered_json to_json(const Model& model, int degree,
                               const search::ConditionReport& report, double seconds) {
  nlohmann::ordered_json json{{"case", model.name},
                              {"degree", degree_json(degree)},
                              {"integrals", texts(report.generic.found)},
                              {"casimirs", texts(report.generic.casimirs)},
                              {"trivial", report.generic.trivial},
                              {"conditions", nlohmann::ordered_json::array()},
                              {"verdict", report.complete ? "proved" : "undecided"},
                              {"generic", report.generic.generic}};
  if (!report.generic.functions.empty()) json["functions"] = report.generic.functions;
  add_limits(json, report.generic);
  for (const search::Condition& condition : report.conditions) {
    nlohmann::ordered_json own{{"parameters", nlohmann::ordered_json::object()}};
    for (const auto& [name, value] : condition.parameters) own["parameters"][name] = value;
    own["integrals"] = texts(condition.found);
    if (!condition.relation.empty()) own["relation"] = condition.relation + " = 0";
    own["verdict"] = to_string(condition.verdict);
    json["conditions"].push_back(own);
  }
  if (report.sets_open) {
    json["surfaces"] = to_string(Verdict::proved);
    json["points"] = to_string(Verdict::undecided);
  }
  if (!report.reason.empty()) json["reason"] = report.reason;
  json["seconds"] = seconds;
  return json;
}

void print(const Model& model, int degree, const search::ConditionReport& report, double seconds) {
  const bool colour = may_colour(1);
  fmt::print("{}: where there is an additional polynomial {} {}{}\n", model.name,
             noun(report.generic, false), up_to(degree, report.generic),
             in_functions(report.generic.functions));
  print_weights(report.generic);
  if (!report.generic.found.empty()) {
    fmt::print("for generic values:\n");
    print_list(report.generic.found, colour);
  }
  for (const search::Condition& condition : report.conditions) {
    std::string line = values_line(condition.parameters);
    if (!condition.relation.empty())
      line += fmt::format("{}{} = 0", line.empty() ? "" : "   that is ", condition.relation);
    fmt::print("{}   {}\n", line, verdict_text(condition.verdict, colour));
    print_list(condition.found, colour);
  }
  if (report.conditions.empty()) fmt::print("none found\n");
  if (report.sets_open)
    fmt::print("No other curve or surface of one condition: {}\n",
               verdict_text(Verdict::proved, colour));
  print_end(report.complete, report.reason, report.conditions.size(), seconds);
}

nlohmann::ordered_json to_json(const Model& model, int degree,
                               const search::DarbouxConditionReport& report, double seconds) {
  nlohmann::ordered_json json{{"case", model.name},
                              {"degree", degree},
                              {"integrals", nlohmann::ordered_json::array()},
                              {"trivial", 0},
                              {"invariant_relations", relations_of(report.generic.found)},
                              {"conditions", nlohmann::ordered_json::array()},
                              {"verdict", report.complete ? "proved" : "undecided"},
                              {"coefficients", coefficients_of(report.has_conjugates)},
                              {"generic", report.generic.generic}};
  for (const search::DarbouxCondition& condition : report.conditions) {
    nlohmann::ordered_json own{{"parameters", nlohmann::ordered_json::object()}};
    for (const auto& [name, value] : condition.parameters) own["parameters"][name] = value;
    own["integrals"] = nlohmann::ordered_json::array();
    own["invariant_relations"] = relations_of(condition.found);
    if (!condition.relations.empty())
      own["relation"] = fmt::format("{} = 0", fmt::join(condition.relations, " = "));
    own["verdict"] = to_string(condition.verdict);
    json["conditions"].push_back(own);
  }
  if (!report.reason.empty()) json["reason"] = report.reason;
  json["seconds"] = seconds;
  return json;
}

void print(const Model& model, int degree, const search::DarbouxConditionReport& report,
           double seconds) {
  const bool colour = may_colour(1);
  fmt::print(
      "{}: where there is an additional polynomial F up to degree {} with dF/dt = K*F, which is no "
      "integral\n",
      model.name, degree);
  if (!report.generic.found.empty()) {
    fmt::print("for generic values:\n");
    print_list(report.generic.found, colour);
  }
  for (const search::DarbouxCondition& condition : report.conditions) {
    std::string line = values_line(condition.parameters);
    if (!condition.relations.empty())
      line = fmt::format("{} = 0", fmt::join(condition.relations, " = "));
    fmt::print("{}   {}\n", line, verdict_text(condition.verdict, colour));
    print_list(condition.found, colour);
  }
  if (report.conditions.empty()) fmt::print("none found\n");
  print_end(report.complete, report.reason, report.conditions.size(), seconds,
            report.has_conjugates ? " of F with rational coefficients" : "");
}

nlohmann::ordered_json to_json(const Model& model, int degree, const search::DarbouxReport& report,
                               double seconds) {
  nlohmann::ordered_json json{{"case", model.name},
                              {"degree", degree},
                              {"integrals", nlohmann::ordered_json::array()},
                              {"invariant_relations", relations_of(report.found)},
                              {"verdict", report.complete ? "proved" : "undecided"},
                              {"coefficients", coefficients_of(report.has_conjugates)},
                              {"generic", report.generic}};
  json["combinations"] = nlohmann::ordered_json::array();
  for (const search::DarbouxCombination& own : report.combinations) {
    if (own.kind == search::DarbouxCombination::Kind::integral)
      json["integrals"].push_back(own.text);
    json["combinations"].push_back({{"kind", search::to_string(own.kind)},
                                    {"expression", own.text},
                                    {"verdict", to_string(own.verdict)}});
    if (!own.evidence.empty()) json["combinations"].back()["evidence"] = own.evidence;
  }
  if (!report.reason.empty()) json["reason"] = report.reason;
  json["seconds"] = seconds;
  return json;
}

void print(const Model& model, int degree, const search::DarbouxReport& report, double seconds) {
  const bool colour = may_colour(1);
  fmt::print("{}: polynomials F up to degree {} with dF/dt = K*F, which are no integrals\n",
             model.name, degree);
  print_list(report.found, colour);
  if (report.complete)
    fmt::print("{}{}: {}\n", no_others(report), for_generic(report.generic),
               verdict_text(Verdict::proved, colour));
  else
    fmt::print("Whether there are others is {}: {}\n", verdict_text(Verdict::undecided, colour),
               report.reason);
  if (!report.combinations.empty()) fmt::print("what they give, with their absolute values:\n");
  for (const search::DarbouxCombination& own : report.combinations)
    fmt::print("  {}   {}   {}\n", kind_text(own.kind), own.text,
               verdict_text(own.verdict, colour));
  fmt::print("{} found, {:.3f} s\n", report.found.size(), seconds);
}

nlohmann::ordered_json to_json(const Model& model, int degree, const search::RationalReport& report,
                               double seconds) {
  nlohmann::ordered_json json{{"case", model.name},
                              {"degree", degree},
                              {"kind", "rational"},
                              {"integrals", nlohmann::ordered_json::array()},
                              {"trivial", 0},
                              {"verdict", report.complete ? "proved" : "undecided"},
                              {"generic", report.generic}};
  for (const search::DarbouxCombination& own : report.integrals)
    json["integrals"].push_back(own.text);
  if (!report.complete) json["reason"] = report.reason;
  json["seconds"] = seconds;
  return json;
}

void print(const Model& model, int degree, const search::RationalReport& report, double seconds) {
  const bool colour = may_colour(1);
  fmt::print("{}: integrals that are quotients of polynomials, with factors up to degree {}\n",
             model.name, degree);
  for (const search::DarbouxCombination& own : report.integrals)
    fmt::print("  {}   {}\n", own.text, verdict_text(own.verdict, colour));
  if (report.complete)
    fmt::print("No others that do not follow from these and the polynomial integrals{}: {}\n",
               for_generic(report.generic), verdict_text(Verdict::proved, colour));
  else
    fmt::print("Whether there are others is {}: {}\n", verdict_text(Verdict::undecided, colour),
               report.reason);
  fmt::print("{} found, {:.3f} s\n", report.integrals.size(), seconds);
}

}  // namespace casimir::tools
