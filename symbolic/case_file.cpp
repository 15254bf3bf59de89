#include "symbolic/case_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

namespace casimir {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{16} << 20;

using Keys = std::vector<std::string>;

/// Walks the TOML document and turns it into text with places.
class Reader {
 public:
  Reader(const std::string& toml, std::string file) : file_(std::move(file)) {
    std::istringstream stream(toml);
    for (std::string line; std::getline(stream, line);) lines_.push_back(line);
  }

  CaseFile read(const toml::table& root);

  std::string line(int number) const {
    return number >= 1 && number <= static_cast<int>(lines_.size()) ? lines_[number - 1] : "";
  }

 private:
  Location place(const toml::source_region& region) const {
    return {file_, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
  }

  [[noreturn]] void fail(const toml::source_region& region, const std::string& what,
                         const std::string& hint = {}) const {
    const Location where = place(region);
    throw CaseError(where, what, line(where.line), hint);
  }

  Text key_text(const toml::key& key) const {
    const Location where = place(key.source());
    return {std::string(key.str()), where, line(where.line)};
  }

  /// A string value. Integers are accepted too, since they are exact.
  Text text(const toml::node& node, const std::string& what) const {
    const Location where = place(node.source());
    if (const auto integer = node.value_exact<int64_t>()) {
      return {std::to_string(*integer), where, line(where.line)};
    }
    if (node.is_floating_point()) {
      fail(node.source(), what + " must be a string, so that it stays exact",
           "write it in quotes: \"0.5\" is read as 1/2");
    }
    const auto value = node.value_exact<std::string>();
    if (!value) fail(node.source(), what + " must be a string");
    return inside_quotes({*value, where, line(where.line)});
  }

  /// Moves the place from the opening quote to the first character, where the string stands in the
  /// file as it is; otherwise (escapes, several lines) positions inside it are not known.
  static Text inside_quotes(Text text) {
    const std::size_t start = static_cast<std::size_t>(std::max(text.where.column, 1));
    if (text.excerpt.compare(std::min(start, text.excerpt.size()), text.value.size(), text.value) ==
        0) {
      text.where.column += 1;
    }
    return text;
  }

  void allow(const toml::table& table, const std::string& where, const Keys& keys) const {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (std::find(keys.begin(), keys.end(), name) == keys.end()) {
        std::string hint = suggest(name, keys);
        if (hint.empty()) hint = fmt::format("known keys: {}", fmt::join(keys, ", "));
        fail(key.source(), fmt::format("unknown key '{}' in {}", printable(name), where), hint);
      }
    }
  }

  const toml::node& required(const toml::table& table, const char* key,
                             const std::string& where) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) fail(table.source(), fmt::format("{} needs a key '{}'", where, key));
    return *node;
  }

  const toml::table& as_table(const toml::node& node, const std::string& what) const {
    if (!node.is_table()) fail(node.source(), what + " must be a table");
    return *node.as_table();
  }

  const toml::array& as_array(const toml::node& node, const std::string& what) const {
    if (!node.is_array()) fail(node.source(), what + " must be an array");
    return *node.as_array();
  }

  bool boolean(const toml::table& table, const char* key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) return false;
    if (!node->is_boolean()) fail(node->source(), fmt::format("'{}' must be true or false", key));
    return node->as_boolean()->get();
  }

  std::optional<Text> optional_text(const toml::table& table, const char* key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) return std::nullopt;
    return text(*node, fmt::format("'{}'", key));
  }

  std::string plain(const toml::table& table, const char* key) const {
    const std::optional<Text> value = optional_text(table, key);
    return value ? value->value : "";
  }

  std::vector<Text> texts(const toml::table& table, const char* key) const {
    std::vector<Text> result;
    const toml::node* node = table.get(key);
    if (node == nullptr) return result;
    for (const toml::node& item : as_array(*node, fmt::format("'{}'", key))) {
      result.push_back(text(item, fmt::format("each entry of '{}'", key)));
    }
    return result;
  }

  std::vector<std::vector<Text>> matrix(const toml::table& table, const char* key) const {
    std::vector<std::vector<Text>> rows;
    for (const toml::node& item :
         as_array(required(table, key, "[[lax]]"), fmt::format("'{}'", key))) {
      std::vector<Text> row;
      for (const toml::node& entry : as_array(item, fmt::format("each row of '{}'", key))) {
        row.push_back(text(entry, fmt::format("each entry of '{}'", key)));
      }
      rows.push_back(std::move(row));
    }
    for (const std::vector<Text>& row : rows) {
      if (row.size() != rows.size())
        fail(table.get(key)->source(), fmt::format("'{}' must be square", key));
    }
    return rows;
  }

  /// The key-value pairs of a table of strings, in the order of the file.
  std::vector<Entry> entries(const toml::node& node, const std::string& what) const {
    std::vector<Entry> result;
    for (const auto& [key, value] : as_table(node, what)) {
      result.emplace_back(key_text(key),
                          text(value, fmt::format("'{}'", printable(std::string(key.str())))));
    }
    std::sort(result.begin(), result.end(), [](const Entry& a, const Entry& b) {
      return std::pair(a.first.where.line, a.first.where.column) <
             std::pair(b.first.where.line, b.first.where.column);
    });
    return result;
  }

  std::vector<Entry> optional_entries(const toml::table& table, const char* key) const {
    const toml::node* node = table.get(key);
    return node == nullptr ? std::vector<Entry>{} : entries(*node, fmt::format("'{}'", key));
  }

  /// Calls `read` for each table of the array of tables `key`.
  template <class Read>
  void each(const toml::table& root, const char* key, Read read) const {
    const toml::node* node = root.get(key);
    if (node == nullptr) return;
    const std::string what = fmt::format("[[{}]]", key);
    for (const toml::node& item : as_array(*node, what)) read(as_table(item, what), what);
  }

  PhaseSpaceText phase_space(const toml::table& table, const std::string& what) const;
  VectorFieldText vector_field(const Text& momentum, const toml::node& node,
                               const std::vector<Text>& coordinates) const;
  VectorFieldsText vector_fields(const toml::table& table) const;
  LevelText level(const toml::table& table, const std::string& what) const;
  MapText map(const toml::table& table, const std::string& what) const;
  SceneText scene(const toml::table& table, const std::string& what) const;
  std::vector<ParameterText> parameters(const toml::table& root) const;

  std::string file_;
  std::vector<std::string> lines_;
};

PhaseSpaceText Reader::phase_space(const toml::table& table, const std::string& what) const {
  allow(table, what,
        {"variables", "algebra", "canonical", "brackets", "structure_constants", "sign", "domain",
         "vector_fields", "time"});
  PhaseSpaceText space;
  space.where = place(table.source());
  if (const toml::node* fields = table.get("vector_fields"))
    space.vector_fields = vector_fields(as_table(*fields, "[phase_space.vector_fields]"));
  if (table.contains("variables") || !space.vector_fields) {
    required(table, "variables", what);
    space.variables = texts(table, "variables");
  } else {
    space.variables = space.vector_fields->coordinates;
    space.variables.insert(space.variables.end(), space.vector_fields->momenta.begin(),
                           space.vector_fields->momenta.end());
  }
  space.algebra = optional_text(table, "algebra");
  space.canonical = boolean(table, "canonical");
  if (table.contains("brackets")) space.brackets = optional_entries(table, "brackets");
  if (table.contains("structure_constants")) {
    space.structure_constants = optional_entries(table, "structure_constants");
  }
  space.sign = optional_text(table, "sign");
  space.domain = texts(table, "domain");
  space.time = optional_text(table, "time");
  return space;
}

/// A field by its components in the order of the coordinates, or by the names of coordinates.
VectorFieldText Reader::vector_field(const Text& momentum, const toml::node& node,
                                     const std::vector<Text>& coordinates) const {
  const std::string what = fmt::format("the field of '{}'", printable(momentum.value));
  if (node.is_table()) return {momentum, entries(node, what)};
  const toml::array& list = as_array(node, what);
  if (list.size() != coordinates.size()) {
    fail(node.source(), fmt::format("{} has {} components for {} coordinates", what, list.size(),
                                    coordinates.size()));
  }
  VectorFieldText field{momentum, {}};
  for (std::size_t i = 0; i < list.size(); ++i)
    field.components.emplace_back(coordinates[i], text(list[i], "each component of " + what));
  return field;
}

VectorFieldsText Reader::vector_fields(const toml::table& table) const {
  const std::string what = "[phase_space.vector_fields]";
  VectorFieldsText result;
  result.where = place(table.source());
  required(table, "coordinates", what);
  required(table, "momenta", what);
  result.coordinates = texts(table, "coordinates");
  result.momenta = texts(table, "momenta");
  result.velocities = texts(table, "velocities");
  if (const toml::node* frame = table.get("frame")) {
    const toml::array& rows = as_array(*frame, "'frame'");
    if (rows.size() != result.momenta.size())
      fail(frame->source(),
           fmt::format("'frame' has {} rows for {} momenta", rows.size(), result.momenta.size()));
    for (std::size_t s = 0; s < rows.size(); ++s)
      result.fields.push_back(vector_field(result.momenta[s], rows[s], result.coordinates));
  }
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (name == "coordinates" || name == "momenta" || name == "velocities" || name == "frame")
      continue;
    std::vector<std::string> known{"coordinates", "momenta", "velocities", "frame"};
    for (const Text& momentum : result.momenta) known.push_back(momentum.value);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      fail(key.source(),
           fmt::format("'{}' is neither a key of {} nor one of its momenta", printable(name), what),
           suggest(name, known));
    }
    result.fields.push_back(vector_field(key_text(key), node, result.coordinates));
  }
  return result;
}

LevelText Reader::level(const toml::table& table, const std::string& what) const {
  allow(table, what, {"name", "expression", "on"});
  return {text(required(table, "name", what), "'name'"),
          text(required(table, "expression", what), "'expression'"), texts(table, "on")};
}

MapText Reader::map(const toml::table& table, const std::string& what) const {
  allow(table, what, {"name", "to", "expressions", "on", "sign"});
  MapText result;
  result.name = text(required(table, "name", what), "'name'");
  const toml::node& to = required(table, "to", what);
  if (to.is_table()) {
    result.to_table = phase_space(*to.as_table(), "'to'");
  } else {
    result.to = text(to, "'to'");
  }
  result.expressions = entries(required(table, "expressions", what), "'expressions'");
  result.on = texts(table, "on");
  result.sign = optional_text(table, "sign");
  return result;
}

SceneText Reader::scene(const toml::table& table, const std::string& what) const {
  allow(table, what,
        {"name", "parameters", "initial", "duration", "observe", "extreme", "reference"});
  SceneText result;
  result.name = text(required(table, "name", what), "'name'");
  result.parameters = optional_entries(table, "parameters");
  result.initial = entries(required(table, "initial", what), "'initial'");
  result.duration = text(required(table, "duration", what), "'duration'");
  result.observe = texts(table, "observe");
  result.extreme = optional_text(table, "extreme");
  result.reference = optional_entries(table, "reference");
  return result;
}

std::vector<ParameterText> Reader::parameters(const toml::table& root) const {
  std::vector<ParameterText> result;
  const toml::node* node = root.get("parameters");
  if (node == nullptr) return result;
  for (const auto& [key, value] : as_table(*node, "[parameters]")) {
    const std::string what = fmt::format("parameter '{}'", printable(std::string(key.str())));
    const toml::table& table = as_table(value, what);
    allow(table, what, {"assume"});
    ParameterText parameter{key_text(key), {}};
    const toml::node* assume = table.get("assume");
    if (assume != nullptr && assume->is_array()) {
      parameter.assume = texts(table, "assume");
    } else if (assume != nullptr) {
      parameter.assume = {text(*assume, "'assume'")};
    }
    result.push_back(std::move(parameter));
  }
  std::sort(result.begin(), result.end(), [](const ParameterText& a, const ParameterText& b) {
    return std::pair(a.name.where.line, a.name.where.column) <
           std::pair(b.name.where.line, b.name.where.column);
  });
  return result;
}

CaseFile Reader::read(const toml::table& root) {
  allow(root, "the case file", {"title",       "source",
                                "tags",        "integrable",
                                "hamiltonian", "lagrangian",
                                "phase_space", "parameters",
                                "definitions", "casimirs",
                                "integrals",   "equations",
                                "conditional", "invariant_relation",
                                "lax",         "map",
                                "measure",     "identity",
                                "section",     "scene"});
  CaseFile result;
  result.file = file_;
  result.name = std::filesystem::path(file_).stem().string();
  result.title = plain(root, "title");
  result.source = plain(root, "source");
  for (const Text& tag : texts(root, "tags")) result.tags.push_back(tag.value);
  result.integrable = boolean(root, "integrable");
  result.hamiltonian = optional_text(root, "hamiltonian");
  result.lagrangian = optional_text(root, "lagrangian");
  const toml::node* space = root.get("phase_space");
  if (space == nullptr) {
    throw CaseError({file_, 1, 1}, "the case file needs a table [phase_space]", line(1));
  }
  result.phase_space = phase_space(as_table(*space, "[phase_space]"), "[phase_space]");
  result.parameters = parameters(root);
  result.definitions = optional_entries(root, "definitions");
  result.casimirs = optional_entries(root, "casimirs");
  result.integrals = optional_entries(root, "integrals");
  if (root.contains("equations")) result.equations = optional_entries(root, "equations");

  each(root, "conditional", [&](const toml::table& table, const std::string& what) {
    result.conditionals.push_back(level(table, what));
    required(table, "on", what);
  });
  each(root, "invariant_relation", [&](const toml::table& table, const std::string& what) {
    result.invariant_relations.push_back(level(table, what));
  });
  each(root, "lax", [&](const toml::table& table, const std::string& what) {
    allow(table, what, {"spectral", "L", "A"});
    result.lax.push_back(
        {optional_text(table, "spectral"), matrix(table, "L"), matrix(table, "A")});
  });
  each(root, "map", [&](const toml::table& table, const std::string& what) {
    result.maps.push_back(map(table, what));
  });
  each(root, "measure", [&](const toml::table& table, const std::string& what) {
    allow(table, what, {"density", "every_hamiltonian"});
    result.measures.push_back(
        {text(required(table, "density", what), "'density'"), boolean(table, "every_hamiltonian")});
  });
  each(root, "identity", [&](const toml::table& table, const std::string& what) {
    allow(table, what, {"name", "left", "right", "on"});
    result.identities.push_back({text(required(table, "name", what), "'name'"),
                                 text(required(table, "left", what), "'left'"),
                                 optional_text(table, "right"), texts(table, "on")});
  });
  if (const toml::node* section = root.get("section")) {
    const toml::table& table = as_table(*section, "[section]");
    allow(table, "[section]", {"function", "direction", "plot"});
    result.section = SectionText{text(required(table, "function", "[section]"), "'function'"),
                                 optional_text(table, "direction"), texts(table, "plot")};
  }
  each(root, "scene", [&](const toml::table& table, const std::string& what) {
    result.scenes.push_back(scene(table, what));
  });
  return result;
}

std::string read_text(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw CaseError({path.string()}, "this is a folder; a case file was expected");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw CaseError({path.string()}, "the case file does not exist or cannot be read");
  std::string text;
  char chunk[1 << 14];
  while (text.size() <= kMaxFileBytes && (stream.read(chunk, sizeof chunk), stream.gcount() > 0))
    text.append(chunk, static_cast<std::size_t>(stream.gcount()));
  return text;
}

}  // namespace

CaseError Text::error(const std::string& what, std::size_t offset, const std::string& hint) const {
  if (where.line <= 0) return CaseError(where, what, {}, hint);
  Location at = where;
  // Inside a string with escapes or line breaks only the start of the string is known.
  const std::size_t start = static_cast<std::size_t>(std::max(where.column - 1, 0));
  const bool verbatim = excerpt.compare(std::min(start, excerpt.size()), value.size(), value) == 0;
  if (verbatim) at.column += static_cast<int>(std::min(offset, value.size()));
  return CaseError(at, what, excerpt, hint);
}

CaseFile parse_case(const std::string& toml, const std::string& file) {
  if (toml.size() > kMaxFileBytes) {
    throw CaseError({file}, fmt::format("the file is larger than {} MiB", kMaxFileBytes >> 20));
  }
  Reader reader(toml, file);
  try {
    return reader.read(toml::parse(toml, std::string_view(file)));
  } catch (const toml::parse_error& problem) {
    const auto begin = problem.source().begin;
    const int number = std::max(1, static_cast<int>(begin.line));
    throw CaseError({file, number, std::max(1, static_cast<int>(begin.column))},
                    "this is not TOML: " + printable(std::string(problem.description()), 200),
                    reader.line(number));
  }
}

CaseFile read_case(const std::filesystem::path& path) {
  return parse_case(read_text(path), path.string());
}

}  // namespace casimir
