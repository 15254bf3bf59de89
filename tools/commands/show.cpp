// casimir show: the system itself: bracket, Hamiltonian, equations of motion, claims, scenes.
#include <fmt/format.h>
#include <fmt/ostream.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "tools/analysis/conversion.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/options/choices.hpp"
#include "tools/cli/search_watch.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/show/nve_view.hpp"
#include "tools/show/show.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

struct ShowArguments {
  Common common;
  std::string case_name;
  std::string in;
  std::string as;
  std::string format = "text";
  bool standalone = false, nve = false;
};

/// The initial states of the scenes in other variables, exactly and as numbers.
int show_scenes_as(const Model& model, const ShowArguments& options) {
  const Conversion conversion(model, bundled_atlas(model.limits), options.as);
  nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
  for (const Scene& scene : model.scenes) {
    if (options.common.scene_given && &scene != &model.scene(options.common.scene)) continue;
    model.scene(scene.name);
    const std::vector<GiNaC::ex> state = conversion.exact(scene);
    nlohmann::ordered_json exact, numbers;
    if (!options.common.json && !options.common.quiet)
      fmt::print("{}, scene '{}' as {}\n", model.name, printable(scene.name), options.as);
    for (std::size_t i = 0; i < state.size(); ++i) {
      const std::string text = fmt::format("{}", fmt::streamed(state[i]));
      const std::string number =
          exact_text(GiNaC::ex_to<GiNaC::numeric>(state[i].evalf()).to_double());
      exact[conversion.names()[i]] = text;
      numbers[conversion.names()[i]] = number;
      if (!options.common.json && !options.common.quiet)
        fmt::print("  {:<10} {:>25}   {}\n", conversion.names()[i], number, text);
    }
    scenes.push_back({{"scene", scene.name}, {"state", numbers}, {"exact", exact}});
  }
  if (options.common.json) {
    print_json(
        nlohmann::ordered_json{{"case", model.name}, {"as", options.as}, {"scenes", scenes}});
  }
  return kDone;
}

/// \param motion  a model, or a map
template <class Motion>
int show_motion(const Motion& model, const ShowArguments& options) {
  if (options.common.json || options.format == "json") {
    print_json(show_json(model));
  } else if (options.format == "latex") {
    show_latex(model, options.standalone ? LatexUse::document : LatexUse::displays);
  } else if (!options.common.quiet) {
    show_text(model);
  }
  return kDone;
}

/// The curves of motion that `obstruct` finds, and their normal variational equations.
int show_nve(const Model& model, const ShowArguments& options) {
  if (options.standalone) throw UsageError("--standalone is no option of --nve");
  if (options.common.scene_given) model.scene(options.common.scene);
  return with_search_errors(options.common, options.case_name, [&] {
    SearchWatch watch(options.common, model.name);
    const obstruction::Obstruction answer = obstruction::find_obstruction(
        model, {.scene = options.common.scene, .along = {}}, watch.watch());
    watch.end();
    if (options.common.json || options.format == "json")
      print_json(nve_json(model, answer));
    else if (options.format == "latex")
      nve_latex(model, answer);
    else if (!options.common.quiet)
      nve_text(model, answer);
    return kDone;
  });
}

int show(const ShowArguments& options) {
  if (options.standalone && options.format != "latex")
    throw UsageError("--standalone is a whole document of LaTeX: it needs --format latex");
  const AnyCaseFile file = load_any_case(options.case_name, options.common.limits);
  const ParameterValues fixed = options.common.parameter_values();
  if (const auto* map = std::get_if<MapCaseFile>(&file)) {
    if (!options.in.empty() || !options.as.empty())
      throw UsageError("--in and --as change the variables of a flow, not of a map");
    if (options.nve) throw UsageError("--nve is about flows: a map has no curves of motion");
    return show_motion(map_model_of(*map, fixed), options);
  }
  const Model model = in_variables(model_of(std::get<CaseFile>(file), fixed), options.in);
  if (options.nve) return show_nve(model, options);
  if (!options.as.empty()) return show_scenes_as(model, options);
  return show_motion(model, options);
}

}  // namespace

void register_show(CLI::App& program, Action& action) {
  auto options = std::make_shared<ShowArguments>();
  CLI::App* command = program.add_subcommand(
      "show", "The bracket, the Hamiltonian, the equations, what is claimed");
  add_common(*command, options->common);
  add_in(*command, options->in);
  add_as(*command, options->as);
  add_case(*command, options->case_name);
  command->add_option("--format", options->format, "text, latex or json")
      ->check(one_of({"text", "latex", "json"}));
  command->add_flag("--nve", options->nve,
                    "Curves of motion and the normal variational equations along them, instead");
  command->add_flag("--standalone", options->standalone,
                    "With --format latex: a document that compiles as it is");
  command->callback([options, &action] { action = action_of(options, show); });
}

}  // namespace casimir::tools
