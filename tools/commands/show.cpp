// casimir show: the system itself: bracket, Hamiltonian, equations of motion, claims, scenes.
#include <iostream>

#include "tools/case_library.hpp"
#include "tools/cli.hpp"
#include "tools/show.hpp"

namespace casimir::tools {
namespace {

struct Options {
  Common common;
  std::string case_name;
  std::string format = "text";
};

int show(const Options& options) {
  const Model model = model_of(load_case(options.case_name), options.common.parameter_values());
  if (options.common.json || options.format == "json") {
    std::cout << show_json(model).dump(2) << '\n';
  } else if (options.format == "latex") {
    show_latex(model);
  } else if (!options.common.quiet) {
    show_text(model);
  }
  return kDone;
}

}  // namespace

void register_show(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "show", "The bracket, the Hamiltonian, the equations, what is claimed");
  add_common(*command, options->common);
  command
      ->add_option("CASE", options->case_name,
                   "A bundled case, a case file, or - for standard input")
      ->required();
  command->add_option("--format", options->format, "text, latex or json")
      ->check(CLI::IsMember({"text", "latex", "json"}));
  command->callback([options, &action] { action = [options] { return show(*options); }; });
}

}  // namespace casimir::tools
