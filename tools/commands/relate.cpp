// casimir relate: whether one case is another in linear coordinates; linear symmetries of one.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "symbolic/structure/relate/relate.hpp"
#include "symbolic/structure/relate/symmetries.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/search_watch.hpp"
#include "tools/text/proofs/constraints_note.hpp"
#include "tools/text/proofs/proof_report.hpp"

namespace casimir::tools {
namespace {

using structure::LinearSymmetry;
using structure::Relation;
using structure::SymmetryReport;

struct RelateArguments {
  Common common;
  std::string first, second;
  std::vector<std::string> second_params;
  bool bracket = false;
};

/// Those of the values whose parameters the case has; the others are added to `unused`.
ParameterValues own_values(const ParameterValues& values, const CaseFile& file,
                           std::vector<Text>& unused) {
  ParameterValues own;
  for (const auto& [name, value] : values) {
    const std::string& wanted = name.value;  // clang 14 cannot capture a structured binding
    const bool has = std::any_of(file.parameters.begin(), file.parameters.end(),
                                 [&](const ParameterText& p) { return p.name.value == wanted; });
    if (has)
      own.emplace_back(name, value);
    else
      unused.push_back(name);
  }
  return own;
}

nlohmann::ordered_json object_of(const std::vector<std::pair<std::string, std::string>>& texts) {
  nlohmann::ordered_json result = nlohmann::ordered_json::object();
  for (const auto& [name, text] : texts) result[name] = text;
  return result;
}

/// Those of both: what is said of the spaces of all variables need not be true of them.
std::vector<std::string> constraints_of(const Model& a, const Model& b) {
  std::vector<std::string> names = names_of(a.constraints);
  for (const std::string& name : names_of(b.constraints)) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

nlohmann::ordered_json relation_json(const Model& a, const Model& b, const Relation& relation,
                                     double seconds) {
  nlohmann::ordered_json json{{"case", a.name},
                              {"to", b.name},
                              {"asked", relation.with_hamiltonian ? "hamiltonian" : "bracket"},
                              {"verdict", to_string(relation.verdict)}};
  if (relation.verdict == Verdict::proved) {
    json["map"] = object_of(relation.map);
    if (relation.with_hamiltonian) {
      json["factor"] = relation.factor;
      json["casimir_part"] = relation.casimir_part;
    }
  }
  json["differences"] = nlohmann::ordered_json::array();
  for (const structure::Difference& d : relation.differences)
    json["differences"].push_back({{"name", d.name}, {"case", d.first}, {"to", d.second}});
  if (!relation.reason.empty()) json["reason"] = relation.reason;
  const std::vector<std::string> beside = constraints_of(a, b);
  if (!beside.empty()) json["not_on"] = beside;
  json["seconds"] = seconds;
  return json;
}

void print_relation(const Model& a, const Model& b, const Relation& relation, double seconds) {
  const bool colour = may_colour(1);
  fmt::print(
      "{} and {}: a regular linear map that takes the bracket of the one to that of the "
      "other{}\n",
      a.name, b.name,
      relation.with_hamiltonian
          ? ", and the Hamiltonian to c*H + F, F a function of Casimir functions"
          : "");
  switch (relation.verdict) {
    case Verdict::proved:
      for (const auto& [name, text] : relation.map) fmt::print("  {} = {}\n", name, text);
      if (relation.with_hamiltonian)
        fmt::print("  H of {} = ({})*H of {} + {}\n", b.name, relation.factor, a.name,
                   relation.casimir_part);
      fmt::print("this map: {}\n", verdict_text(relation.verdict, colour));
      break;
    case Verdict::refuted:
      fmt::print("there is none: {}\n", verdict_text(Verdict::proved, colour));
      if (relation.differences.empty()) fmt::print("  {}\n", relation.reason);
      for (const structure::Difference& d : relation.differences)
        fmt::print("  {}: {} and {}\n", d.name, d.first, d.second);
      break;
    case Verdict::undecided:
      fmt::print("whether there is one is {}: {}\n", verdict_text(relation.verdict, colour),
                 relation.reason);
      break;
  }
  fmt::print("{}{:.3f} s\n", whole_space_note(constraints_of(a, b)), seconds);
}

int relate_two(const RelateArguments& options) {
  const ParameterValues values = options.common.parameter_values();
  Common second = options.common;
  second.params = options.second_params;
  const CaseFile file_a = load_case(options.first, options.common.limits),
                 file_b = load_case(options.second, options.common.limits);
  std::vector<Text> not_in_a, not_in_b;
  ParameterValues of_a = own_values(values, file_a, not_in_a),
                  of_b = own_values(values, file_b, not_in_b);
  for (const Text& name : not_in_a) {
    const bool nowhere = std::any_of(not_in_b.begin(), not_in_b.end(),
                                     [&](const Text& other) { return other.value == name.value; });
    if (nowhere)
      throw name.error(fmt::format("'{}' is a parameter of neither case", printable(name.value)));
  }
  for (const auto& [name, value] : second.parameter_values()) {
    std::erase_if(of_b, [&, own = name.value](const auto& p) { return p.first.value == own; });
    of_b.emplace_back(name, value);
  }
  const Model a = model_of(file_a, of_a), b = model_of(file_b, of_b);
  const bool with_hamiltonian = !options.bracket && a.hamiltonian && b.hamiltonian;
  SearchWatch watch(options.common, a.name);
  const Relation relation = structure::relate(a, b, with_hamiltonian, watch.watch());
  const double seconds = watch.end();
  if (options.common.json)
    print_json(relation_json(a, b, relation, seconds));
  else if (!options.common.quiet)
    print_relation(a, b, relation, seconds);
  if (relation.verdict == Verdict::undecided) return kUndecided;
  return relation.verdict == Verdict::proved ? kDone : kFailed;
}

std::string field_text(const LinearSymmetry& symmetry) {
  std::string result;
  for (const auto& [name, text] : symmetry.field)
    result += fmt::format("{}{}' = {}", result.empty() ? "" : ", ", name, text);
  return result;
}

int symmetries(const RelateArguments& options) {
  if (options.bracket || !options.second_params.empty())
    throw UsageError("--bracket and --param-b compare two cases, and one is given");
  const Model model =
      model_of(load_case(options.first, options.common.limits), options.common.parameter_values());
  SearchWatch watch(options.common, model.name);
  const SymmetryReport report = structure::linear_symmetries(model, watch.watch());
  const double seconds = watch.end();
  if (options.common.json) {
    nlohmann::ordered_json json{{"case", model.name},
                                {"symmetries", nlohmann::ordered_json::array()}};
    for (const LinearSymmetry& symmetry : report.found) {
      nlohmann::ordered_json own{{"field", object_of(symmetry.field)}};
      if (!symmetry.integral.empty()) own["integral"] = symmetry.integral;
      own["verdict"] = to_string(symmetry.verdict);
      json["symmetries"].push_back(own);
    }
    json["verdict"] = report.complete ? "proved" : "undecided";
    if (!report.reason.empty()) json["reason"] = report.reason;
    json["generic"] = report.generic;
    if (!model.constraints.empty()) json["not_on"] = names_of(model.constraints);
    json["seconds"] = seconds;
    print_json(json);
  } else if (!options.common.quiet) {
    const bool colour = may_colour(1);
    fmt::print("{}: linear fields that keep the bracket and the Hamiltonian, by their flows\n",
               model.name);
    for (const LinearSymmetry& symmetry : report.found) {
      fmt::print("  {}\n", field_text(symmetry));
      fmt::print("    {}   {}\n",
                 symmetry.integral.empty() ? "with no integral of degree 1 or 2"
                                           : "integral " + symmetry.integral,
                 verdict_text(symmetry.verdict, colour));
    }
    const std::string generic =
        report.generic.empty()
            ? ""
            : fmt::format(", for generic values of {}", fmt::join(report.generic, ", "));
    if (report.complete)
      fmt::print("No others but their linear combinations{}: {}\n", generic,
                 verdict_text(Verdict::proved, colour));
    else
      fmt::print("Whether there are others is {}: {}\n", verdict_text(Verdict::undecided, colour),
                 report.reason);
    fmt::print("{}{} found, {:.3f} s\n", whole_space_note(names_of(model.constraints)),
               report.found.size(), seconds);
  }
  return report.complete ? kDone : kUndecided;
}

int relate(const RelateArguments& options) {
  return with_search_errors(options.common, options.first, [&] {
    return options.second.empty() ? symmetries(options) : relate_two(options);
  });
}

}  // namespace

void register_relate(CLI::App& program, Action& action) {
  auto options = std::make_shared<RelateArguments>();
  CLI::App* command = program.add_subcommand(
      "relate", "Linear isomorphisms between two cases; the linear symmetries of one");
  add_common(*command, options->common);
  add_case(*command, options->first);
  command->add_option("OTHER", options->second,
                      "The case to compare with; without it the linear symmetries are found");
  command->add_flag("--bracket", options->bracket,
                    "Compare the brackets alone and not the Hamiltonians");
  command
      ->add_option("--param-b", options->second_params,
                   "A number for a parameter of the second case alone (repeatable)")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  command->callback([options, &action] { action = action_of(options, relate); });
}

}  // namespace casimir::tools
