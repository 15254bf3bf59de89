#include "tests/traps/fixed.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace casimir::traps {
namespace {

std::string text_at(const toml::node_view<const toml::node>& node) {
  return node.value<std::string>().value_or("");
}

Texts in_order(const Texts& names, const toml::node_view<const toml::node>& table) {
  Texts values;
  for (const std::string& name : names) {
    values.push_back(text_at(table[name]));
    if (values.back().empty()) throw std::runtime_error("nothing for " + name);
  }
  return values;
}

/// The entries of a table in the order of the file.
Named entries(const toml::node_view<const toml::node>& node) {
  std::vector<std::pair<toml::source_position, std::pair<std::string, std::string>>> found;
  if (const toml::table* table = node.as_table())
    for (const auto& [key, value] : *table)
      found.push_back(
          {key.source().begin, {std::string(key.str()), value.value<std::string>().value_or("")}});
  std::ranges::sort(found, [](const auto& a, const auto& b) { return a.first < b.first; });
  Named result;
  for (const auto& entry : found) result.push_back(entry.second);
  return result;
}

/// What stands in a comment `# name: value`.
std::string remark(const std::filesystem::path& file, const std::string& name) {
  std::ifstream stream(file);
  const std::string begin = "# " + name + ": ";
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(begin)) return line.substr(begin.size());
  return {};
}

Scene scene_in(const std::filesystem::path& file) {
  const toml::table parsed = toml::parse_file(file.string());
  const toml::node_view<const toml::node> all(static_cast<const toml::node*>(&parsed));
  const auto scene = all["scene"][0];
  Scene s;
  s.kind = text_at(all["tags"][0]);
  s.shape = file.stem().string();
  if (const toml::array* names = all["phase_space"]["variables"].as_array())
    for (const toml::node& name : *names) s.variables.push_back(name.value<std::string>().value());
  s.time = text_at(all["phase_space"]["time"]);
  s.parameters = entries(scene["parameters"]);
  s.definitions = entries(all["definitions"]);
  s.equations = in_order(s.variables, all["equations"]);
  s.initial = in_order(s.variables, scene["initial"]);
  s.duration = text_at(scene["duration"]);
  s.limit = remark(file, "limit");
  if (const std::string at = remark(file, "singular_at"); !at.empty()) s.singular_at = constant(at);
  if (scene["reference"]) {
    s.exact.emplace();
    for (const std::string& text : in_order(s.variables, scene["reference"]))
      s.exact->push_back(constant(text));
  }
  return s;
}

}  // namespace

Scene read_scene(const std::filesystem::path& file) {
  try {
    return scene_in(file);
  } catch (const std::exception& problem) {
    throw std::runtime_error(file.string() + ": " + problem.what());
  }
}

std::vector<Scene> read_scenes(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<Scene> scenes;
  for (const std::filesystem::path& file : files) scenes.push_back(read_scene(file));
  return scenes;
}

}  // namespace casimir::traps
