#include "tools/analysis/scene_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression.hpp"

namespace casimir {
namespace {

bool differ(const Text& a, const Text& b, const Limits& limits) {
  return !(parse_real_constant(a, limits) - parse_real_constant(b, limits)).expand().is_zero();
}

}  // namespace

void set_in_scenes(CaseFile& file, std::vector<Entry> SceneText::*table, const Text& name,
                   const Text& value) {
  for (SceneText& scene : file.scenes) {
    std::vector<Entry>& entries = scene.*table;
    const auto own = std::ranges::find_if(
        entries, [&](const Entry& entry) { return entry.first.value == name.value; });
    if (own == entries.end() || differ(own->second, value, file.limits)) {
      scene.reference.clear();
      scene.altered = true;
    }
    if (own != entries.end()) entries.erase(own);
    entries.emplace_back(name, value);
  }
}

CaseFile with_initial_values(CaseFile file, const std::vector<Entry>& values, bool rounded) {
  if (rounded)
    for (SceneText& scene : file.scenes) scene.rounded = true;
  std::vector<std::string> known;
  for (const Text& variable : file.phase_space.variables) known.push_back(variable.value);
  for (const auto& [name, value] : values) {
    if (std::ranges::count(known, name.value) == 0) {
      throw name.error(fmt::format("'{}' is not a variable of this case", printable(name.value)), 0,
                       suggest_or_list(name.value, known, "variables"));
    }
    set_in_scenes(file, &SceneText::initial, name, value);
  }
  return file;
}

}  // namespace casimir
