#include "tools/runs/atlas.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "symbolic/case/limits.hpp"
#include "tools/cli/case_library.hpp"

namespace casimir::tools {

Atlas bundled_atlas(const Limits& limits) {
  Atlas atlas;
  for (const std::filesystem::path& path : bundled_cases()) {
    const AnyCaseFile any = read_any_case(path, limits);
    if (!std::holds_alternative<CaseFile>(any)) continue;
    const CaseFile& file = std::get<CaseFile>(any);
    const bool changes = std::any_of(file.maps.begin(), file.maps.end(),
                                     [](const MapText& map) { return !map.inverses.empty(); });
    if (changes) atlas.add(model_of(file), file.phase_space.canonical);
  }
  return atlas;
}

void add_in(CLI::App& command, std::string& set) {
  command
      .add_option("--in", set,
                  "The case in other variables, such as euler-angles or quaternions: equations, "
                  "integrals and scenes are carried along the maps of the bundled cases")
      ->type_name("SET");
}

void add_as(CLI::App& command, std::string& set) {
  command.add_option("--as", set, "Answer in other variables, such as euler-angles or andoyer")
      ->type_name("SET");
}

Model in_variables(Model model, const std::string& set) {
  if (set.empty()) return model;
  return in_coordinates(model, bundled_atlas(model.limits), set);
}

}  // namespace casimir::tools
