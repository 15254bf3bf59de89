// casimir obstruct: proofs that a case has no further integral.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "symbolic/obstruction/obstruct.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/options/search_options.hpp"
#include "tools/cli/search_watch.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/text/proofs/obstruction_report.hpp"

namespace casimir::tools {
namespace {

struct ObstructArguments {
  Common common;
  std::string case_name, in, free;
  std::vector<std::string> along;
  bool evidence = false;
};

bool is_parameter(const Model& model, const std::string& name) {
  return std::any_of(model.parameters.begin(), model.parameters.end(),
                     [&](const GiNaC::symbol& p) { return p.get_name() == name; });
}

int obstruct(const ObstructArguments& options) {
  const Model model = in_variables(
      model_of(load_case(options.case_name), options.common.parameter_values()), options.in);
  if (options.common.scene_given) model.scene(options.common.scene);
  if (!options.free.empty() && !is_parameter(model, options.free))
    throw UsageError(
        fmt::format("--free: {} is no parameter of {} without a value", options.free, model.name));
  return with_search_errors(options.common, options.case_name, [&] {
    SearchWatch watch(options.common, model.name);
    const obstruction::Obstruction answer = obstruction::find_obstruction(
        model, {options.common.scene, texts_of(options.along, "--along"), options.free},
        watch.watch());
    const double seconds = watch.end();
    if (options.common.json)
      print_json(to_json(model, answer, seconds));
    else if (!options.common.quiet)
      print(model, answer, seconds, options.evidence);
    return answer.proved ? kDone : kUndecided;
  });
}

}  // namespace

void register_obstruct(CLI::App& program, Action& action) {
  auto options = std::make_shared<ObstructArguments>();
  CLI::App* command = program.add_subcommand(
      "obstruct", "Prove that there is no further integral, for the parameters of a scene");
  add_common(*command, options->common);
  add_in(*command, options->in);
  add_case(*command, options->case_name);
  command
      ->add_option("--along", options->along,
                   "An equation of the invariant surface with the curve, such as \"x = 0\" "
                   "(repeatable); what follows from it is added")
      ->allow_extra_args(false)
      ->type_name("EQ");
  command
      ->add_option("--free", options->free,
                   "A parameter that keeps its symbol: which of its real values are not excluded?")
      ->type_name("NAME");
  command->add_flag("--evidence", options->evidence, "The evidence of what did not decide, too");
  command->callback([options, &action] { action = [options] { return obstruct(*options); }; });
}

}  // namespace casimir::tools
