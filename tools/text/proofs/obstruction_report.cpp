// What `obstruct` prints.
#include "tools/text/proofs/obstruction_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "tools/text/text_layout.hpp"

namespace casimir::tools {
namespace {

using obstruction::Examined;
using obstruction::Obstruction;

nlohmann::ordered_json to_json(const Examined& examined) {
  nlohmann::ordered_json json{
      {"along", examined.along},     {"level", examined.level},
      {"curve", examined.curve},     {"nve", examined.nve},
      {"reduced", examined.reduced}, {"singular_points", examined.exponents}};
  json["cases"] = nlohmann::ordered_json::array();
  for (const auto& [what, outcome] : examined.cases)
    json["cases"].push_back({{"case", what}, {"outcome", outcome}});
  if (!examined.solution.empty()) json["solution"] = examined.solution;
  json["group"] = examined.outcome;
  json["order"] = examined.order;
  if (!examined.where.empty()) json["where"] = examined.where;
  return json;
}

void print_line(const std::string& label, const std::string& text) {
  constexpr std::size_t kLabel = 12;
  const std::vector<std::string> lines =
      wrapped(text, std::max<std::size_t>(output_width() - kLabel - 2, 40));
  for (std::size_t i = 0; i < lines.size(); ++i)
    fmt::print("  {}{}\n", padded(i == 0 ? label : "", kLabel), lines[i]);
}

void print_evidence(const Examined& examined) {
  print_line("along", examined.along);
  print_line("level", examined.level);
  if (!examined.curve.empty()) print_line("curve", examined.curve);
  print_line("NVE", examined.nve);
  print_line("reduced", examined.reduced);
  for (const std::string& point : examined.exponents) print_line("", point);
  for (const auto& [what, outcome] : examined.cases)
    print_line("", fmt::format("{}: {}", what, outcome));
  if (!examined.solution.empty()) {
    const std::string unknown = examined.expressions ? examined.expressions->unknown : "y";
    print_line(fmt::format("w = {0}'/{0}", unknown), examined.solution);
  }
  print_line("group", examined.outcome);
  if (!examined.where.empty()) print_line("where", examined.where);
}

std::string parameters_text(const Obstruction& answer) {
  std::string result;
  for (const auto& [name, value] : answer.parameters)
    result += fmt::format("{}{} = {}", result.empty() ? "" : ", ", name, value);
  return result;
}

/// What survives of a free parameter.
void print_survivors(const Obstruction& answer) {
  for (const obstruction::FreeValue& value : answer.values) {
    print_line(value.excluded ? "alone" : "survives",
               fmt::format("{} = {}: {}", answer.free, value.value,
                           value.excluded        ? value.outcome
                           : value.only_rational ? value.why + "; " + value.outcome
                                                 : value.why));
  }
  for (const obstruction::FreeSequence& sequence : answer.sequences) {
    std::string conditions;
    for (const std::string& condition : sequence.conditions)
      conditions += (conditions.empty() ? "" : "; and ") + condition;
    print_line("survive", fmt::format("with {}: {}", sequence.range, conditions));
  }
  if (answer.values.empty() && answer.sequences.empty())
    print_line("survives", fmt::format("no real {}", answer.free));
}

nlohmann::ordered_json survivors_json(const Obstruction& answer) {
  nlohmann::ordered_json json{{"parameter", answer.free}};
  if (!answer.assumed.empty()) json["assumed"] = answer.assumed;
  json["survivors"] = nlohmann::ordered_json::array();
  json["excluded_alone"] = nlohmann::ordered_json::array();
  for (const obstruction::FreeValue& value : answer.values)
    json[value.excluded ? "excluded_alone" : "survivors"].push_back(
        {{"value", value.value}, {"why", value.why}, {"outcome", value.outcome}});
  json["sequences"] = nlohmann::ordered_json::array();
  for (const obstruction::FreeSequence& sequence : answer.sequences)
    json["sequences"].push_back({{"range", sequence.range}, {"conditions", sequence.conditions}});
  return json;
}

}  // namespace

nlohmann::ordered_json to_json(const Model& model, const Obstruction& answer, double seconds) {
  nlohmann::ordered_json json{{"case", model.name},
                              {"verdict", answer.proved ? "proved" : "undecided"}};
  json["parameters"] = nlohmann::ordered_json::object();
  for (const auto& [name, value] : answer.parameters) json["parameters"][name] = value;
  if (!answer.free.empty() && answer.proved) {
    json["free"] = survivors_json(answer);
    json["theorem"] = answer.theorem;
    json["excluded"] = answer.excluded;
  } else if (answer.proved || answer.rational) {
    const Examined& decisive =
        answer.rational ? answer.examined[*answer.rational] : answer.examined.back();
    json["along"] = decisive.along;
    json["level"] = decisive.level;
    json["nve"] = decisive.nve;
    json["theorem"] = answer.theorem;
    json["excluded"] = answer.excluded;
  }
  if (answer.rational) json["rational"] = "proved";
  if (!answer.proved) json["reason"] = answer.reason;
  json["examined"] = nlohmann::ordered_json::array();
  for (const Examined& examined : answer.examined) json["examined"].push_back(to_json(examined));
  json["left_out"] = answer.left_out;
  json["seconds"] = seconds;
  return json;
}

namespace {

/// " For every real c with c > 0".
std::string free_text(const Obstruction& answer) {
  if (answer.free.empty()) return "";
  return fmt::format(" For every real {}{}{}", answer.free, answer.assumed.empty() ? "" : " with ",
                     fmt::join(answer.assumed, ", "));
}

}  // namespace

void print(const Model& model, const Obstruction& answer, double seconds, bool all) {
  const std::string parameters = parameters_text(answer);
  fmt::print("{}: further integrals excluded?{}{}{}\n", model.name,
             parameters.empty() ? "" : " At ", parameters, free_text(answer));
  for (const Examined& examined : answer.examined) {
    if (examined.decisive || all) {
      print_evidence(examined);
    } else {
      print_line("tried",
                 fmt::format("{}, {}: {}", examined.along, examined.level, examined.outcome));
    }
  }
  if (!answer.proved || all)
    for (const std::string& line : answer.left_out) print_line("left out", line);
  if (answer.proved && !answer.free.empty()) print_survivors(answer);
  if (answer.proved || answer.rational) {
    print_line("theorem", answer.theorem);
    print_line("excluded", answer.excluded);
  }
  if (answer.proved) {
    fmt::print("not integrable by meromorphic integrals{}: proved, {:.3f} s\n",
               answer.free.empty() ? "" : " where nothing survives", seconds);
  } else {
    fmt::print("undecided: {}, {:.3f} s\n", answer.reason, seconds);
  }
}

}  // namespace casimir::tools
