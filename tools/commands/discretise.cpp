// casimir discretise: a map made of a flow, as a case file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/output.hpp"
#include "tools/text/files/discretised_case.hpp"

namespace casimir::tools {
namespace {

struct DiscretiseArguments {
  Common common;
  std::string case_name, output;
  std::array<CLI::Option*, kDiscretisations.size()> methods{};
  std::array<std::string, kDiscretisations.size()> steps;
};

/// The step that was typed after a method; none where it is to stay a symbol.
std::optional<Text> step_of(const std::string& value, const std::string& name) {
  if (value.empty()) return std::nullopt;
  return Text{value, {name, 1, 1}, value};
}

std::optional<GiNaC::ex> value_of(const std::optional<Text>& step, const Limits& limits) {
  if (!step) return std::nullopt;
  const GiNaC::ex value = parse_real_constant(*step, limits);
  if (value.is_zero()) throw step->error("a step of 0 leaves every point where it is");
  return value;
}

/// The place of the one that was asked for.
std::size_t method_of(const DiscretiseArguments& options) {
  const auto is_given = [](const CLI::Option* option) { return option->count() > 0; };
  if (std::ranges::count_if(options.methods, is_given) != 1)
    throw UsageError("discretise needs one method: --kahan, --midpoint or --moser-veselov");
  return static_cast<std::size_t>(std::ranges::find_if(options.methods, is_given) -
                                  options.methods.begin());
}

int discretise(const DiscretiseArguments& options) {
  const std::size_t chosen = method_of(options);
  const Discretisation& method = kDiscretisations[chosen];

  const Model flow = model_of(load_case(options.case_name, options.common.limits),
                              options.common.parameter_values());
  const std::optional<Text> step = step_of(options.steps[chosen], std::string(method.option));
  const RationalMapText map = method.map(flow, value_of(step, flow.limits));
  const std::string text = discretised_case(flow, map, std::string(method.name),
                                            step ? std::optional(step->value) : std::nullopt);
  const bool to_file = !options.output.empty() && options.output != "-";
  if (to_file) {
    OutputFile file(options.output);
    file.stream() << text;
    file.commit();
  }
  if (options.common.json) {
    nlohmann::ordered_json json{{"case", flow.name}, {"method", method.key()}};
    if (to_file) json["file"] = printable(options.output, 1000);
    json["step"] = step ? step->value : map.step;
    const auto variable = [&, n = flow.variables.size()](std::size_t i) {
      return i < n ? flow.variables[i].get_name() : map.added[i - n];
    };
    for (std::size_t i = 0; i < map.next.size(); ++i) json["map"][variable(i)] = map.next[i];
    for (std::size_t k = 0; k < map.steps.size(); ++k) {
      for (const std::size_t i : map.steps[k]) json["steps"][k].push_back(variable(i));
    }
    for (const auto& [name, definition] : map.definitions) json["definitions"][name] = definition;
    if (!to_file) json["toml"] = text;
    print_json(json);
  } else if (!to_file) {
    std::cout << text;
  } else if (!options.common.quiet) {
    fmt::print("{}: {} written to {}\n", flow.name, method.name, printable(options.output, 200));
  }
  return kDone;
}

}  // namespace

void register_discretise(CLI::App& program, Action& action) {
  auto options = std::make_shared<DiscretiseArguments>();
  CLI::App* command = program.add_subcommand(
      "discretise",
      "A flow's map as a case file: Kahan's, the midpoint rule, or Moser's and Veselov's");
  add_common(*command, options->common);
  add_case(*command, options->case_name);
  constexpr std::array kMethodTexts{
      "Kahan's map of quadratic equations; without EPS the step is a parameter",
      "The implicit midpoint rule, which is a map in this sense for linear equations",
      "Moser's and Veselov's map of a free rigid body, with variables for the solution of its "
      "equation"};
  for (std::size_t i = 0; i < kDiscretisations.size(); ++i)
    options->methods[i] = command
                              ->add_option(std::string(kDiscretisations[i].option),
                                           options->steps[i], kMethodTexts[i])
                              ->expected(0, 1)
                              ->type_name("EPS");
  command->add_option("-o,--output", options->output, "Write the case here instead of printing it")
      ->type_name("FILE.toml");
  command->callback([options, &action] { action = action_of(options, discretise); });
}

}  // namespace casimir::tools
