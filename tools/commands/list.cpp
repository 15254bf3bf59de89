// casimir list: the bundled cases.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "tools/cli/case_library.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/show/book_order.hpp"

namespace casimir::tools {
namespace {

struct ListArguments {
  Common common;
  std::string tag;
};

std::string claims_of(const Model& model) {
  std::vector<std::string> names;
  for (const auto* list : {&model.casimirs, &model.integrals}) {
    for (const NamedExpression& f : *list) names.push_back(f.name);
  }
  for (const auto* list : {&model.conditionals, &model.invariant_relations}) {
    for (const LevelClaim& claim : *list)
      names.push_back(claim.expression.name + (claim.on.empty() ? "" : "|"));
  }
  if (!model.lax_pairs.empty()) names.emplace_back("Lax pair");
  return fmt::format("{}", fmt::join(names, " "));
}

std::vector<std::string> scene_names(const Model& model) {
  std::vector<std::string> names;
  for (const Scene& scene : model.scenes) names.push_back(scene.name);
  return names;
}

int list(const ListArguments& options) {
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  for (const std::filesystem::path& path : listed_cases(options.tag, options.common.limits)) {
    const AnyCaseFile file = read_any_case(path, options.common.limits);
    const auto* map = std::get_if<MapCaseFile>(&file);
    const Model model = map ? map_model_of(*map).base : model_of(std::get<CaseFile>(file));
    if (options.common.json) {
      cases.push_back({{"name", model.name},
                       {"title", model.title},
                       {"source", model.source},
                       {"book", model.book},
                       {"tags", model.tags},
                       {"dimension", model.variables.size()},
                       {"phase_space", model.phase_space},
                       {"scenes", scene_names(model)}});
    } else if (!options.common.quiet) {
      const std::string where =
          model.book.empty() ? "" : fmt::format(" ({})", book_text(model.book));
      fmt::print("{:<22} {}{}\n{:<22} {}, {} variables; claims {}\n{:<22} scenes: {}\n", model.name,
                 model.title, where, "", model.phase_space, model.variables.size(),
                 claims_of(model), "", fmt::join(scene_names(model), "; "));
    }
  }
  std::vector<std::string> maps;
  if (options.tag.empty())
    for (const std::filesystem::path& path : bundled_maps(options.common.limits))
      maps.push_back(path.stem().string());
  if (options.common.json) {
    nlohmann::ordered_json json{{"cases", cases}};
    if (options.tag.empty()) json["maps"] = maps;
    print_json(json);
  } else if (!options.common.quiet && !maps.empty()) {
    fmt::print("and {} map{}, see 'casimir list --tag map': {}\n", maps.size(),
               maps.size() == 1 ? "" : "s", fmt::join(maps, ", "));
  }
  return kDone;
}

}  // namespace

void register_list(CLI::App& program, Action& action) {
  auto options = std::make_shared<ListArguments>();
  CLI::App* command = program.add_subcommand("list", "The bundled cases");
  add_common(*command, options->common);
  command->add_option("--tag", options->tag, "Only cases with this tag")->type_name("TAG");
  command->callback([options, &action] { action = action_of(options, list); });
}

}  // namespace casimir::tools
