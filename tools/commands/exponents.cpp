// casimir exponents: balances and Kovalevskaya exponents of a case.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "symbolic/search/exponents.hpp"
#include "tools/analysis/equilibria/numeric_balances.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/options/search_options.hpp"
#include "tools/cli/search_watch.hpp"
#include "tools/runs/atlas.hpp"

namespace casimir::tools {
namespace {

using search::Balance;
using search::Exponent;

struct ExponentsArguments {
  Common common;
  std::string case_name, in;
  std::vector<std::string> weights;
  bool numeric = false;
};

const char* kind_name(Exponent::Kind kind) {
  switch (kind) {
    case Exponent::Kind::integer:
      return "integer";
    case Exponent::Kind::rational:
      return "rational";
    case Exponent::Kind::parametric:
      return "parametric";
    case Exponent::Kind::algebraic:
      return "algebraic";
    case Exponent::Kind::numeric:
      break;
  }
  return "numeric";
}

nlohmann::ordered_json exponents_json(const Exponent& e) {
  nlohmann::ordered_json json{
      {"kind", kind_name(e.kind)}, {"value", e.text}, {"multiplicity", e.multiplicity}};
  if (e.solutions > 1) json["solutions"] = e.solutions;
  for (const auto& [real, imaginary] : e.values)
    json["numeric"].push_back({fmt::format("{:.17g}", real), fmt::format("{:.17g}", imaginary)});
  return json;
}

nlohmann::ordered_json exponents_json(const Model& model, const search::ExponentReport& report,
                                      std::size_t starts, double seconds) {
  nlohmann::ordered_json json{{"case", model.name}, {"weights", nlohmann::ordered_json::object()}};
  for (const auto& [name, weight] : report.weights) json["weights"][name] = weight;
  json["left_out"] = report.left_out;
  json["balances"] = nlohmann::ordered_json::array();
  for (const Balance& balance : report.balances) {
    nlohmann::ordered_json own{{"coefficients", nlohmann::ordered_json::object()}};
    for (const auto& [name, value] : balance.coefficients) own["coefficients"][name] = value;
    own["relations"] = balance.relations;
    own["free"] = balance.free;
    if (balance.family > 0) own["family"] = balance.family;
    own["exponents"] = nlohmann::ordered_json::array();
    for (const Exponent& e : balance.exponents) own["exponents"].push_back(exponents_json(e));
    json["balances"].push_back(own);
  }
  json["conclusions"] = report.conclusions;
  if (!model.constraints.empty()) json["not_on"] = names_of(model.constraints);
  json["generic"] = report.generic;
  json["verdict"] = report.complete ? "proved" : "undecided";
  if (starts > 0) json["starts"] = starts;
  if (!report.reason.empty()) json["reason"] = report.reason;
  json["seconds"] = seconds;
  return json;
}

/// The unique numbers of an exponent: itself, or the roots of its polynomial with their values.
std::string exponent_text(const Exponent& e) {
  std::string text = e.text;
  if (e.kind == Exponent::Kind::algebraic) {
    text = fmt::format("roots of {} (", e.text);
    for (std::size_t i = 0; i < e.values.size(); ++i) {
      const auto& [real, imaginary] = e.values[i];
      text += (i > 0 ? ", " : "") + fmt::format("{:.6g}", real);
      if (imaginary != 0) text += fmt::format("{:+.6g}i", imaginary);
    }
    text += ")";
  } else if (e.is_root) {
    text = fmt::format("roots of {}", e.text);
  }
  if (e.solutions > 1)
    text += fmt::format(" ({} time{} in the {} solutions together)", e.multiplicity,
                        e.multiplicity > 1 ? "s" : "", e.solutions);
  else if (e.multiplicity > 1)
    text += fmt::format(" ({} times)", e.multiplicity);
  return text;
}

void print_exponents(const Model& model, const search::ExponentReport& report, std::size_t starts,
                     double seconds) {
  fmt::print("{}: solutions x_i = c_i/(t - t0)^g_i\n", model.name);
  std::string line;
  for (const auto& [name, weight] : report.weights)
    line += (line.empty() ? "" : ", ") + fmt::format("{} {}", name, weight);
  fmt::print("weights g: {}\n", line);
  for (const std::string& term : report.left_out)
    fmt::print("of lower weight, left out: {}\n", term);
  std::size_t number = 0;
  for (const Balance& balance : report.balances) {
    fmt::print("balance {}\n", ++number);
    for (const auto& [name, value] : balance.coefficients)
      if (value != "0") fmt::print("  {} = {}\n", name, value);
    for (const std::string& relation : balance.relations) fmt::print("  where {}\n", relation);
    for (const std::string& name : balance.free) fmt::print("  {} is arbitrary\n", name);
    if (balance.family > 0) fmt::print("  one of a family of {} dimensions\n", balance.family);
    line.clear();
    for (const Exponent& e : balance.exponents)
      line += (line.empty() ? "" : ", ") + exponent_text(e);
    fmt::print("  exponents: {}\n", line);
  }
  if (!report.generic.empty())
    fmt::print("for generic values of {}\n", fmt::join(report.generic, ", "));
  if (!report.complete) fmt::print("not all balances are known: {}\n", report.reason);
  if (starts > 0)
    fmt::print(
        "numeric, from {} random starts: no proof, and others are not excluded; of balances with "
        "the same exponents one is shown\n",
        starts);
  for (const std::string& conclusion : report.conclusions) fmt::print("- {}\n", conclusion);
  fmt::print("{} balances, {:.3f} s\n", report.balances.size(), seconds);
}

/// Numeric ones in place of exact ones that are not all, if the equations have numbers only.
/// \return  the starts of the iteration; 0 if it was not done
std::size_t complete_numerically(search::ExponentReport& report, const search::Watch& watch) {
  if (!report.leading) {
    report.reason += "; with numbers for all parameters (--param) they are sought numerically";
    return 0;
  }
  watch.begin("numeric balances");
  return take_numeric_balances(report, [&](double share) { watch.tick(share); });
}

int exponents(const ExponentsArguments& options) {
  const Model model = in_variables(model_of(load_case(options.case_name, options.common.limits),
                                            options.common.parameter_values()),
                                   options.in);
  if (options.common.scene_given) model.scene(options.common.scene);
  return with_search_errors(options.common, options.case_name, [&] {
    SearchWatch watch(options.common, model.name);
    const auto weights = weights_of(options.weights);
    search::ExponentReport report =
        options.numeric ? search::leading_terms(model, weights)
                        : search::kovalevskaya_exponents(model, weights, watch.watch());
    if (options.numeric) {
      if (!report.leading) throw UsageError("--numeric needs numbers for all parameters (--param)");
      report.reason = "exact ones were not asked for";
    }
    const std::size_t starts = report.complete ? 0 : complete_numerically(report, watch.watch());
    const double seconds = watch.end();
    if (options.common.json)
      print_json(exponents_json(model, report, starts, seconds));
    else if (!options.common.quiet)
      print_exponents(model, report, starts, seconds);
    return report.complete || starts > 0 ? kDone : kUndecided;
  });
}

}  // namespace

void register_exponents(CLI::App& program, Action& action) {
  auto options = std::make_shared<ExponentsArguments>();
  CLI::App* command = program.add_subcommand(
      "exponents", "Kovalevskaya-Painleve analysis: balances and Kovalevskaya exponents");
  add_common(*command, options->common);
  add_in(*command, options->in);
  add_case(*command, options->case_name);
  add_weights(*command, options->weights);
  command->add_flag("--numeric", options->numeric,
                    "Numeric balances only, in place of the exact analysis");
  command->callback([options, &action] { action = action_of(options, exponents); });
}

}  // namespace casimir::tools
