#include "symbolic/case_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <fstream>

#include "symbolic/case/limits.hpp"
#include "symbolic/case/toml_keys.hpp"
#include "symbolic/case/toml_reader.hpp"
#include "symbolic/discrete/map_case.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/spelling.hpp"

namespace casimir {
namespace {

/// The tables of a case file.
class Reader : private TomlReader {
 public:
  using TomlReader::line;
  using TomlReader::TomlReader;

  AnyCaseFile read(const toml::table& root);

 private:
  CaseFile read_common(const toml::table& root);
  void read_claims(const toml::table& root, CaseFile& result) const;
  MapCaseFile map_case(const toml::table& root, CaseFile file) const;
  PhaseSpaceText phase_space(const toml::table& table, const std::string& what) const;
  VectorFieldText vector_field(const Text& momentum, const toml::node& node,
                               const std::vector<Text>& coordinates) const;
  VectorFieldsText vector_fields(const toml::table& table) const;
  LevelText level(const toml::table& table, const std::string& what) const;
  MapText map(const toml::table& table, const std::string& what) const;
  SceneText scene(const toml::table& table, const std::string& what) const;
  std::vector<ParameterText> parameters(const toml::table& root) const;
  std::vector<ParameterText> functions(const toml::table& root) const;
};

PhaseSpaceText Reader::phase_space(const toml::table& table, const std::string& what) const {
  allow(table, what,
        {"variables", "algebra", "canonical", "brackets", "structure_constants", "sign", "domain",
         "constraints", "dirac", "vector_fields", "time"});
  PhaseSpaceText space;
  space.where = place(table.source());
  if (const toml::node* fields = table.get("vector_fields"))
    space.vector_fields = vector_fields(as_table(*fields, "[phase_space.vector_fields]"));
  if (table.contains("variables") || !space.vector_fields) {
    required(table, "variables", what);
    space.variables = name_list(table, "variables");
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
  space.constraints = texts(table, "constraints");
  if (boolean(table, "dirac")) {
    const Location where = place(table.get("dirac")->source());
    space.dirac = {"dirac", where, line(where.line)};
  }
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
  result.coordinates = name_list(table, "coordinates");
  result.momenta = name_list(table, "momenta");
  result.velocities = name_list(table, "velocities");
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
  return {name(table, what), text(required(table, "expression", what), "'expression'"),
          texts(table, "on")};
}

MapText Reader::map(const toml::table& table, const std::string& what) const {
  allow(table, what, {"name", "to", "expressions", "on", "sign", "image", "inverse"});
  MapText result;
  result.name = name(table, what);
  const toml::node& to = required(table, "to", what);
  if (to.is_table()) {
    result.to_table = phase_space(*to.as_table(), "'to'");
  } else {
    result.to = text(to, "'to'");
  }
  result.expressions = entries(required(table, "expressions", what), "'expressions'");
  result.on = texts(table, "on");
  result.sign = optional_text(table, "sign");
  result.image = texts(table, "image");
  each(table, "inverse", [&](const toml::table& inverse, const std::string& where) {
    allow(inverse, where, {"expressions", "domain"});
    result.inverses.push_back({entries(required(inverse, "expressions", where), "'expressions'"),
                               texts(inverse, "domain")});
  });
  return result;
}

SceneText Reader::scene(const toml::table& table, const std::string& what) const {
  allow(table, what,
        {"name", "parameters", "functions", "initial", "on", "duration", "observe", "extreme",
         "reference"});
  SceneText result;
  result.name = name(table, what);
  result.parameters = optional_entries(table, "parameters");
  for (auto& [key, value] : optional_entries(table, "functions")) {
    check_name(key, "a function");
    key.value = function_parameter_name({key.value, {}});
    result.parameters.emplace_back(key, value);
  }
  result.initial = entries(required(table, "initial", what), "'initial'");
  result.duration = optional_text(table, "duration");
  result.on = texts(table, "on");
  result.observe = name_list(table, "observe");
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
    if (!value.is_table()) {
      std::string hint = root_key_hint(key.str());
      if (hint.empty())
        hint = fmt::format(
            "write {0} = {{}} or {0} = {{ assume = \"{0} != 0\" }}; its value stands "
            "in a scene",
            printable(std::string(key.str())));
      fail(value.source(), what + " must be a table", hint);
    }
    const toml::table& table = *value.as_table();
    allow(table, what, {"assume"});
    std::vector<Text> assumptions;
    const toml::node* assume = table.get("assume");
    if (assume != nullptr && assume->is_array()) {
      assumptions = texts(table, "assume");
    } else if (assume != nullptr) {
      assumptions = {text(*assume, "'assume'")};
    }
    for (FamilyMember& member : members_of(key_text(key), integers_, limits_)) {
      // So is the name of an arbitrary function written, and it comes from [functions] alone.
      if (function_name(member.name.value)) check_name(member.name, "a parameter");
      const auto indices = std::make_shared<const Indices>(std::move(member.indices));
      for (Text& assumption : assumptions) assumption.indices = indices;
      result.push_back({std::move(member.name), assumptions});
    }
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const ParameterText& a, const ParameterText& b) {
                     return std::pair(a.name.where.line, a.name.where.column) <
                            std::pair(b.name.where.line, b.name.where.column);
                   });
  return result;
}

/// Arbitrary functions with the names of their arguments, each as the parameter that it is.
std::vector<ParameterText> Reader::functions(const toml::table& root) const {
  std::vector<ParameterText> result;
  const toml::node* node = root.get("functions");
  if (node == nullptr) return result;
  for (const auto& [key, value] : as_table(*node, "[functions]")) {
    const std::string what = fmt::format("function '{}'", printable(std::string(key.str())));
    const Text name = key_text(key);
    check_name(name, "a function");
    FunctionName function{name.value, {}};
    if (!value.is_array())
      fail(value.source(), what + " must be a list of the names of its arguments",
           fmt::format("write {0} = [\"r\"]; what {0} is stands in a scene: functions = {{ {0} = "
                       "\"..\" }}",
                       name.value));
    for (const toml::node& item : *value.as_array()) {
      const Text argument = text(item, "each argument of " + what);
      check_name(argument, "an argument");
      if (std::ranges::count(function.arguments, argument.value) != 0)
        throw argument.error(fmt::format("'{}' is an argument twice", argument.value));
      function.arguments.push_back(argument.value);
    }
    if (function.arguments.empty())
      fail(value.source(), what + " has no argument: a constant is a parameter");
    if (function.arguments.size() > kMostArguments)
      fail(value.source(), fmt::format("{} has more than {} arguments", what, kMostArguments));
    Text parameter = name;
    parameter.value = function_parameter_name(function);
    result.push_back({parameter, {}});
  }
  return result;
}

/// Whether `[map]` or `[[map_step]]` give next values. With the keys of `[[map]]` the first one is
/// that one, misspelt.
bool gives_next_values(const toml::table& root) {
  const toml::node* map = root.get("map");
  if (map == nullptr) return root.contains("map_step");
  return map->is_table() && map->as_table()->get_as<toml::table>("expressions") == nullptr;
}

MapCaseFile Reader::map_case(const toml::table& root, CaseFile file) const {
  MapCaseFile result;
  const toml::node* table = root.get("map");
  const toml::node* steps = root.get("map_step");
  const Location where = place((table ? table : steps)->source());
  result.map = {table ? "[map]" : "[[map_step]]", where, line(where.line)};
  if (table && steps)
    fail(steps->source(), "a map is given either by [map] or by [[map_step]], not by both");
  const auto refuse = [&](const char* key) {
    if (const toml::node* node = root.get(key))
      fail(node->source(),
           fmt::format("'{}' is about a flow, and the table {} makes this the case of a map", key,
                       result.map.value));
  };
  for (const char* key : {"hamiltonian", "lagrangian", "equations", "lax", "superintegrable"})
    refuse(key);
  if (table) result.next = entries(*table, "[map]");
  each(root, "map_step", [&](const toml::table& step, const std::string& what) {
    allow(step, what, {"expressions"});
    result.steps.push_back(entries(required(step, "expressions", what), "'expressions'"));
  });
  result.sign = optional_text(root, "map_sign");
  each(root, "symmetry", [&](const toml::table& symmetry, const std::string& what) {
    allow(symmetry, what, {"name", "expressions", "reverses"});
    result.symmetries.push_back({name(symmetry, what),
                                 entries(required(symmetry, "expressions", what), "'expressions'"),
                                 boolean(symmetry, "reverses")});
  });
  each(root, "conjugacy", [&](const toml::table& conjugacy, const std::string& what) {
    allow(conjugacy, what, {"name", "expressions", "map", "reverses"});
    result.conjugacies.push_back(
        {name(conjugacy, what), entries(required(conjugacy, "expressions", what), "'expressions'"),
         entries(required(conjugacy, "map", what), "'map'"), boolean(conjugacy, "reverses")});
  });
  result.file = std::move(file);
  return result;
}

AnyCaseFile Reader::read(const toml::table& root) {
  read_integers(root);
  CaseFile file = read_common(root);
  if (gives_next_values(root)) return map_case(root, std::move(file));
  for (const char* key : {"map_sign", "symmetry", "conjugacy"}) {
    if (const toml::node* node = root.get(key))
      fail(node->source(), fmt::format("'{}' needs a table [map] with the next values", key));
  }
  return file;
}

void Reader::read_claims(const toml::table& root, CaseFile& result) const {
  each(root, "conditional", [&](const toml::table& table, const std::string& what) {
    result.conditionals.push_back(level(table, what));
    required(table, "on", what);
  });
  each(root, "invariant_relation", [&](const toml::table& table, const std::string& what) {
    result.invariant_relations.push_back(level(table, what));
  });
  each(root, "lax", [&](const toml::table& table, const std::string& what) {
    allow(table, what, {"spectral", "L", "A", "on"});
    result.lax.push_back({optional_text(table, "spectral"), matrix(table, "L"), matrix(table, "A"),
                          texts(table, "on")});
  });
  if (!gives_next_values(root))
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
    result.identities.push_back({name(table, what), text(required(table, "left", what), "'left'"),
                                 optional_text(table, "right"), texts(table, "on")});
  });
}

CaseFile Reader::read_common(const toml::table& root) {
  allow(root, "the case file", root_keys());
  CaseFile result;
  result.file = file_;
  result.name = printable(std::filesystem::path(file_).stem().string(), 200);
  result.title = plain(root, "title");
  result.source = plain(root, "source");
  result.book = plain(root, "book");
  for (const Text& tag : texts(root, "tags")) result.tags.push_back(one_line(tag.value));
  result.integrable = boolean(root, "integrable");
  result.superintegrable = boolean(root, "superintegrable");
  result.hamiltonian = optional_text(root, "hamiltonian");
  result.lagrangian = optional_text(root, "lagrangian");
  const toml::node* space = root.get("phase_space");
  if (space == nullptr) {
    throw CaseError({file_, 1, 1}, "the case file needs a table [phase_space]", line(1).text());
  }
  result.phase_space = phase_space(as_table(*space, "[phase_space]"), "[phase_space]");
  result.parameters = parameters(root);
  for (ParameterText& function : functions(root)) result.parameters.push_back(std::move(function));
  result.definitions = optional_entries(root, "definitions");
  result.casimirs = optional_entries(root, "casimirs");
  result.integrals = optional_entries(root, "integrals");
  if (root.contains("equations")) result.equations = optional_entries(root, "equations");

  read_claims(root, result);
  if (const toml::node* section = root.get("section")) {
    const toml::table& table = as_table(*section, "[section]");
    allow(table, "[section]", {"function", "direction", "plot", "labels", "energy", "casimirs"});
    result.section = SectionText{text(required(table, "function", "[section]"), "'function'"),
                                 optional_text(table, "direction"),
                                 texts(table, "plot"),
                                 texts(table, "labels"),
                                 optional_text(table, "energy"),
                                 optional_entries(table, "casimirs")};
  }
  if (result.section) {
    for (Text& label : result.section->labels) label.value = one_line(label.value);
  }
  each(root, "scene", [&](const toml::table& table, const std::string& what) {
    result.scenes.push_back(scene(table, what));
  });
  return result;
}

std::string read_text(const std::filesystem::path& path, const Limits& limits) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw CaseError({path.string()}, "this is a folder; a case file was expected");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw CaseError({path.string()}, "the case file does not exist or cannot be read");
  std::string text;
  char chunk[1 << 14];
  while (static_cast<double>(text.size()) <= limits.file_bytes &&
         (stream.read(chunk, sizeof chunk), stream.gcount() > 0))
    text.append(chunk, static_cast<std::size_t>(stream.gcount()));
  return text;
}

/// Whether a line gives one of the keys whose values are words: Appendix I is no number.
bool is_line_of_words(const std::string& toml, std::size_t begin) {
  for (const std::string key : {"title", "source", "book", "tags"})
    if (toml.compare(begin, key.size(), key) == 0 && begin + key.size() < toml.size() &&
        (toml[begin + key.size()] == ' ' || toml[begin + key.size()] == '='))
      return true;
  return false;
}

/// Whether the text has I as a word of its own, outside of comments and of what is said of the
/// case.
bool speaks_of_imaginary_unit(const std::string& toml) {
  const auto is_part = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  };
  bool comment = false;
  bool quoted = false;
  for (std::size_t i = 0; i < toml.size(); ++i) {
    if (toml[i] == '\n') comment = quoted = false;
    if ((i == 0 || toml[i - 1] == '\n') && is_line_of_words(toml, i)) comment = true;
    if (toml[i] == '"') quoted = !quoted;
    comment = comment || (toml[i] == '#' && !quoted);
    if (comment || toml[i] != 'I') continue;
    const bool starts = i == 0 || !is_part(toml[i - 1]);
    const bool ends = i + 1 == toml.size() || !is_part(toml[i + 1]);
    if (starts && ends) return true;
  }
  return false;
}

/// What people write who think of their formulas and not of TOML.
std::string hint_for(const toml::parse_error& problem, const std::string& line) {
  const auto column = static_cast<std::size_t>(problem.source().begin.column);
  const std::string quotes = unquoted_hint(line, column);
  return quotes.empty() ? spelling_of_escape("", line) : quotes;
}

}  // namespace

CaseError Text::error(const std::string& what, std::size_t offset, const std::string& hint,
                      double Limits::*limit) const {
  if (where.line <= 0) return CaseError(where, what, {}, hint, limit);
  Location at = where;
  // Inside a string with escapes or line breaks only the start of the string is known.
  const std::size_t start = static_cast<std::size_t>(std::max(where.column - 1, 0));
  const std::string& line = excerpt.text();
  const bool verbatim =
      flat(line.substr(std::min(start, line.size()), value.size())) == flat(value);
  if (verbatim) at.column += static_cast<int>(std::min(offset, value.size()));
  return CaseError(at, what, line, hint, limit);
}

const CaseFile& common_part(const AnyCaseFile& any) {
  if (const auto* map = std::get_if<MapCaseFile>(&any)) return map->file;
  return std::get<CaseFile>(any);
}

CaseError MapCaseFile::not_a_flow() const {
  return map.error(
      "this is the case of a map, and a flow is needed here: equations or a hamiltonian", 0,
      "show, verify, search, degrees, generate, integrate, conserve and section work with maps; "
      "[[map]] with double brackets claims that a map to another phase space is Poisson");
}

CaseFile parse_case(const std::string& toml, const std::string& file, const Limits& limits) {
  AnyCaseFile any = parse_any_case(toml, file, limits);
  if (const auto* map = std::get_if<MapCaseFile>(&any)) throw map->not_a_flow();
  return std::get<CaseFile>(std::move(any));
}

AnyCaseFile parse_any_case(const std::string& toml, const std::string& file, const Limits& limits) {
  if (static_cast<double>(toml.size()) > limits.file_bytes)
    throw CaseError({file},
                    fmt::format("the file is larger than {:g} MiB", limits.file_bytes / (1 << 20)),
                    {}, limits.hint(&Limits::file_bytes), &Limits::file_bytes);
  Reader reader(toml, file, limits);
  if (const std::optional<int> number = line_of_deep_key(toml))
    throw CaseError({file, *number, 1}, "a key has too many parts", reader.line(*number).text());
  try {
    AnyCaseFile result = reader.read(toml::parse(toml, std::string_view(file)));
    CaseFile& common = std::visit(
        [](auto& part) -> CaseFile& {
          if constexpr (std::is_same_v<std::decay_t<decltype(part)>, CaseFile>)
            return part;
          else
            return part.file;
        },
        result);
    common.complex_numbers = speaks_of_imaginary_unit(toml);
    common.limits = limits;
    return result;
  } catch (const toml::parse_error& problem) {
    const auto begin = problem.source().begin;
    const int number = std::max(1, static_cast<int>(begin.line));
    throw CaseError({file, number, std::max(1, static_cast<int>(begin.column))},
                    "this is not TOML: " + printable(std::string(problem.description()), 200),
                    reader.line(number).text(), hint_for(problem, reader.line(number).text()));
  }
}

CaseFile read_case(const std::filesystem::path& path, const Limits& limits) {
  return parse_case(read_text(path, limits), path.string(), limits);
}

AnyCaseFile read_any_case(const std::filesystem::path& path, const Limits& limits) {
  return parse_any_case(read_text(path, limits), path.string(), limits);
}

}  // namespace casimir
