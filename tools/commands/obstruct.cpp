// casimir obstruct: proofs that a case has no further integral.
#include <CLI/CLI.hpp>
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

struct Options {
  Common common;
  std::string case_name, in;
  std::vector<std::string> along;
  bool evidence = false;
};

int obstruct(const Options& options) {
  const Model model = in_variables(
      model_of(load_case(options.case_name), options.common.parameter_values()), options.in);
  if (options.common.scene_given) model.scene(options.common.scene);
  return with_search_errors(options.common, options.case_name, [&] {
    SearchWatch watch(options.common, model.name);
    const obstruction::Obstruction answer = obstruction::find_obstruction(
        model, {options.common.scene, texts_of(options.along, "--along")}, watch.watch());
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
  auto options = std::make_shared<Options>();
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
  command->add_flag("--evidence", options->evidence, "The evidence of what did not decide, too");
  command->callback([options, &action] { action = [options] { return obstruct(*options); }; });
}

}  // namespace casimir::tools
