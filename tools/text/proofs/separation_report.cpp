#include "tools/text/proofs/separation_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/cli/output.hpp"
#include "tools/text/proofs/proof_report.hpp"

namespace casimir::tools {
namespace {

using structure::Separation;
using structure::SeparationReport;

/// The discriminant of three roots fills a page.
std::string beginning_of(const std::string& text) {
  constexpr std::size_t kLongest = 160;
  if (text.size() <= kLongest) return text;
  return text.substr(0, text.rfind(' ', kLongest)) + " .. (whole with --json)";
}

nlohmann::ordered_json json_of(const Separation& own) {
  nlohmann::ordered_json brackets = nlohmann::ordered_json::object();
  for (const auto& [label, text] : own.bivector) brackets[label] = text;
  nlohmann::ordered_json result{
      {"integrals", own.integrals},
      {"bivector", brackets},
      {"degree", own.degree},
      {"tangent", to_string(own.tangent)},
      {"compatible", to_string(own.compatible)},
      {"jacobi", to_string(own.jacobi)},
      {"involution", to_string(own.involution)},
      {"variable", own.names.root},
      {"names",
       {{"sum", own.names.sum}, {"rate", own.names.rate}, {"integral", own.names.integral}}},
      {"coefficients", own.coefficients},
      {"polynomial", own.polynomial},
      {"commuting", to_string(own.commuting)},
      {"distinct", to_string(own.distinct)},
      {"real", own.real},
      {"point", own.point},
      {"nonzero", own.nonzero},
      {"separated", to_string(own.separated)},
      {"staeckel", to_string(own.staeckel)}};
  nlohmann::ordered_json relations = nlohmann::ordered_json::array();
  for (const Separation::Relation& one : own.relations) {
    relations.push_back({{"multipliers", one.multipliers}, {"sum", one.sum}});
    if (!one.root.empty()) relations.back()["root"] = one.root;
    if (!one.equation.empty()) relations.back()["equation"] = one.equation;
    relations.back()["may_vanish"] = one.may_vanish;
  }
  result["relations"] = relations;
  if (!own.map_case.empty()) {
    result["map"] = to_string(own.map);
    result["map_case"] = own.map_case;
  } else if (!own.no_map.empty()) {
    result["no_map"] = own.no_map;
  }
  if (!own.reason.empty()) result["reason"] = own.reason;
  return result;
}

/// Of the bivector that the roots come from.
void print_bivector(const Separation& own) {
  const bool colour = may_colour(1);
  std::vector<std::string> parts;
  for (const auto& [label, text] : own.bivector)
    parts.push_back(fmt::format("{{{}}}' = {}", label, text));
  fmt::print("second bivector P', degree {}: {}\n", own.degree, fmt::join(parts, ", "));
  fmt::print("  tangent to the leaves   {}\n", verdict_text(own.tangent, colour));
  fmt::print("  compatible, [P, P'] = 0   {}\n", verdict_text(own.compatible, colour));
  fmt::print("  Jacobi identity, [P', P'] = 0   {}\n", verdict_text(own.jacobi, colour));
  fmt::print("  {{{0}_i, {0}_j}}' = 0   {1}\n", own.names.integral,
             verdict_text(own.involution, colour));
}

void print_relations(const Separation& own) {
  const std::string& u = own.names.root;
  for (const Separation::Relation& one : own.relations) {
    fmt::print("    {} = {} for {}{}\n", own.names.sum, one.sum,
               one.root.empty() ? "each root " + u : fmt::format("the root {} = {}", u, one.root),
               one.may_vanish ? ", where its coefficients are not all zero" : "");
    if (!one.equation.empty())
      fmt::print("    {{{}, {}}}^2 = {}\n", u, own.names.sum, one.equation);
  }
}

void print_separation(const Separation& own) {
  const bool colour = may_colour(1);
  const auto line = [&](const std::string& what, Verdict verdict) {
    fmt::print("  {}   {}\n", what, verdict_text(verdict, colour));
  };
  for (std::size_t j = 0; j < own.integrals.size(); ++j)
    fmt::print("{}{} = {}{}\n", own.names.integral, j + 1, own.integrals[j],
               j == 0 ? "  (the Hamiltonian)" : "");
  if (!own.bivector.empty()) print_bivector(own);
  const std::string& u = own.names.root;
  fmt::print("variables: the roots of {} = 0\n", own.polynomial);
  if (own.distinct == Verdict::proved)
    line(fmt::format("distinct and coordinates on the tori at {}, {}", own.point,
                     own.real ? "and real" : "where they are complex"),
         own.distinct);
  line(fmt::format("they commute, {{{0}_i, {0}_j}} = 0", u), own.commuting);
  line("the integrals separate in them and their momenta", own.separated);
  if (!own.reason.empty()) fmt::print("    {}\n", own.reason);
  if (own.separated != Verdict::proved) return;
  std::vector<std::string> nonzero;
  for (const std::string& one : own.nonzero) nonzero.push_back(beginning_of(one));
  fmt::print("    near each point of the leaves where these are not zero: {}\n",
             fmt::join(nonzero, "; "));
  line(own.staeckel == Verdict::proved
           ? "Staeckel form: a sum of the integrals is a function of one root and its momentum"
           : "Staeckel form with polynomials in one root (none was found)",
       own.staeckel);
  print_relations(own);
  if (!own.map_case.empty())
    line(fmt::format("the [[map]] to {0}, {1} and {2} = {{{0}, {1}}} of all roots (--output FILE "
                     "writes it)",
                     u, own.names.sum, own.names.rate),
         own.map);
}

}  // namespace

Verdict verdict_of(const SeparationReport& report) {
  if (!report.found.empty()) return report.found.front().separated;
  return report.none || report.freedom == 1U ? Verdict::proved : Verdict::undecided;
}

nlohmann::ordered_json to_json(const Model& model, const SeparationReport& report, double seconds) {
  nlohmann::ordered_json json{{"case", model.name},
                              {"degree", report.degree},
                              {"degrees_of_freedom", nullptr},
                              {"on", report.on},
                              {"integrals", report.integrals},
                              {"examined", report.examined},
                              {"separations", nlohmann::ordered_json::array()}};
  if (report.freedom) json["degrees_of_freedom"] = *report.freedom;
  if (report.bracket_of_motion) json["bracket"] = *report.bracket_of_motion;
  for (const Separation& own : report.found) json["separations"].push_back(json_of(own));
  json["none"] = report.none;
  if (report.none) json["involved"] = report.involved;
  if (!report.not_used.empty()) json["constraints_not_used"] = report.not_used;
  json["verdict"] = to_string(verdict_of(report));
  json["generic"] = report.generic;
  if (!report.reason.empty()) json["reason"] = report.reason;
  json["seconds"] = seconds;
  return json;
}

void print(const Model& model, const SeparationReport& report, double seconds) {
  const bool colour = may_colour(1);
  if (!report.found.empty() && report.found.front().bivector.empty())
    fmt::print("{}: whether the integrals separate in the roots of a polynomial\n", model.name);
  else
    fmt::print("{}: variables that separate, by a second bivector of degree {} at most\n",
               model.name, report.degree);
  if (report.bracket_of_motion) fmt::print("bracket found: {}\n", *report.bracket_of_motion);
  if (report.freedom)
    fmt::print(
        "{}{} degree{} of freedom{}\n", report.found.empty() ? "at most " : "", *report.freedom,
        *report.freedom == 1 ? "" : "s",
        report.on.empty() ? "" : fmt::format(" on the level {} = 0", fmt::join(report.on, " = ")));
  if (!report.not_used.empty())
    fmt::print("not used: the constraint{} {} = 0 of the case; --on takes a level\n",
               report.not_used.size() == 1 ? "" : "s", fmt::join(report.not_used, " = 0, "));
  for (const Separation& own : report.found) print_separation(own);
  if (report.found.empty()) {
    const std::vector<std::string>& listed = report.none ? report.involved : report.integrals;
    if (!listed.empty())
      fmt::print("{}: {}\n",
                 report.none ? "integrals" : "integrals that commute with the Hamiltonian",
                 fmt::join(listed, "; "));
    if (report.none)
      fmt::print(
          "No such bivector with polynomial components up to degree {} for which these integrals "
          "are in involution{}: {}\n",
          report.degree,
          report.generic.empty()
              ? ""
              : fmt::format(", for generic values of {}", fmt::join(report.generic, ", ")),
          verdict_text(Verdict::proved, colour));
    else if (report.freedom == 1U)
      fmt::print("Nothing to do: {}\n", report.reason);
    else
      fmt::print("None found ({}): {}\n", verdict_text(Verdict::undecided, colour), report.reason);
  }
  fmt::print("{} found, {:.3f} s\n",
             report.found.empty() || verdict_of(report) != Verdict::proved ? 0 : 1, seconds);
}

}  // namespace casimir::tools
