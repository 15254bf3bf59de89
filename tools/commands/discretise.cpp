// casimir discretise: a map made of a flow, as a case file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "symbolic/case/limits.hpp"
#include "symbolic/discrete/kahan.hpp"
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
  CLI::Option* kahan = nullptr;
  CLI::Option* midpoint = nullptr;
  bool moser_veselov = false;
  std::string kahan_step, midpoint_step;
};

/// The step that was typed after a method; none where it is to stay a symbol.
std::optional<Text> step_of(const std::string& value, const char* name) {
  if (value.empty()) return std::nullopt;
  return Text{value, {name, 1, 1}, value};
}

std::optional<GiNaC::ex> value_of(const std::optional<Text>& step, const Limits& limits) {
  if (!step) return std::nullopt;
  const GiNaC::ex value = parse_real_constant(*step, limits);
  if (value.is_zero()) throw step->error("a step of 0 leaves every point where it is");
  return value;
}

int discretise(const DiscretiseArguments& options) {
  const std::size_t chosen =
      options.kahan->count() + options.midpoint->count() + (options.moser_veselov ? 1 : 0);
  if (chosen != 1)
    throw UsageError("discretise needs one method: --kahan, --midpoint or --moser-veselov");
  const Model flow = model_of(load_case(options.case_name, options.common.limits),
                              options.common.parameter_values());
  if (options.moser_veselov)
    throw UsageError(
        "Moser's and Veselov's map solves a quadratic matrix equation in every step: it is no "
        "rational function, and this version has no other form of it; --kahan makes a rational map "
        "of quadratic equations, and the cases discrete-lagrange and discrete-neumann are tops of "
        "this "
        "kind that have formulas");
  const bool is_kahan = options.kahan->count() > 0;
  const std::optional<Text> step = is_kahan ? step_of(options.kahan_step, "--kahan")
                                            : step_of(options.midpoint_step, "--midpoint");
  const std::optional<GiNaC::ex> value = value_of(step, flow.limits);
  const RationalMapText map = is_kahan ? kahan_map(flow, value) : midpoint_map(flow, value);
  const std::string text =
      discretised_case(flow, map, is_kahan ? "Kahan's map" : "Implicit midpoint rule",
                       step ? std::optional(step->value) : std::nullopt);
  const bool to_file = !options.output.empty() && options.output != "-";
  if (to_file) {
    OutputFile file(options.output);
    file.stream() << text;
    file.commit();
  }
  if (options.common.json) {
    nlohmann::ordered_json json{{"case", flow.name}, {"method", is_kahan ? "kahan" : "midpoint"}};
    if (to_file) json["file"] = printable(options.output, 1000);
    json["step"] = step ? step->value : map.step;
    for (std::size_t i = 0; i < map.next.size(); ++i)
      json["map"][flow.variables[i].get_name()] = map.next[i];
    for (const auto& [name, definition] : map.definitions) json["definitions"][name] = definition;
    if (!to_file) json["toml"] = text;
    print_json(json);
  } else if (!to_file) {
    std::cout << text;
  } else if (!options.common.quiet) {
    fmt::print("{}: {} written to {}\n", flow.name, is_kahan ? "Kahan's map" : "midpoint rule",
               printable(options.output, 200));
  }
  return kDone;
}

}  // namespace

void register_discretise(CLI::App& program, Action& action) {
  auto options = std::make_shared<DiscretiseArguments>();
  CLI::App* command = program.add_subcommand(
      "discretise", "A flow's map as a case file: Kahan's, or the midpoint rule");
  add_common(*command, options->common);
  add_case(*command, options->case_name);
  const auto add_method = [&](const char* name, std::string& step, const char* text) {
    return command->add_option(name, step, text)->expected(0, 1)->type_name("EPS");
  };
  options->kahan =
      add_method("--kahan", options->kahan_step,
                 "Kahan's map of quadratic equations; without EPS the step is a parameter");
  options->midpoint =
      add_method("--midpoint", options->midpoint_step,
                 "The implicit midpoint rule, which is a map in this sense for linear equations");
  command->add_flag("--moser-veselov", options->moser_veselov,
                    "Moser's and Veselov's map of a free body");
  command->add_option("-o,--output", options->output, "Write the case here instead of printing it")
      ->type_name("FILE.toml");
  command->callback([options, &action] { action = action_of(options, discretise); });
}

}  // namespace casimir::tools
