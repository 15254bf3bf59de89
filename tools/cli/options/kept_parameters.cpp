#include "tools/cli/options/kept_parameters.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "tools/runs/scene_values.hpp"

namespace casimir::tools {
void KeptParameters::add_to(CLI::App& command) {
  command.add_flag("--keep-params", text_,
                   "Keep the parameters (with =A,B: these) as arguments at run time; --param then "
                   "sets their values");
}

bool KeptParameters::all() const { return text_ == "true"; }

std::vector<std::string> KeptParameters::names() const {
  std::vector<std::string> result;
  std::istringstream stream(all() ? "" : text_);
  for (std::string name; std::getline(stream, name, ',');) result.push_back(name);
  return result;
}

KeptParameters::Chosen KeptParameters::chosen(const CaseFile& file,
                                              const ParameterValues& given) const {
  Chosen result{file, {}};
  const std::vector<std::string> kept = names();
  for (const auto& [name, value] : given) {
    const bool declared = std::any_of(
        file.parameters.begin(), file.parameters.end(),
        [&, &wanted = name](const ParameterText& p) { return p.name.value == wanted.value; });
    if (declared && (all() || std::find(kept.begin(), kept.end(), name.value) != kept.end()))
      set_in_scenes(result.file, &SceneText::parameters, name, value);
    else
      result.fixed.emplace_back(name, value);
  }
  return result;
}

Model KeptParameters::model_of(const CaseFile& file, const ParameterValues& given) const {
  const Chosen taken = chosen(file, given);
  return tools::model_of(taken.file, taken.fixed);
}

MapModel KeptParameters::map_model_of(const MapCaseFile& file, const ParameterValues& given) const {
  const Chosen taken = chosen(file.file, given);
  MapCaseFile map = file;
  map.file = taken.file;
  return tools::map_model_of(map, taken.fixed);
}

}  // namespace casimir::tools
