#include "symbolic/case/case_tables.hpp"

#include <fmt/ranges.h>

#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/expression.hpp"

namespace casimir {
namespace {

/// Whether `[map]` or `[[map_step]]` give next values. With the keys of `[[map]]` the first one is
/// that one, misspelt.
bool gives_next_values(const toml::table& root) {
  const toml::node* map = root.get("map");
  if (map == nullptr) return root.contains("map_step");
  return map->is_table() && map->as_table()->get_as<toml::table>("expressions") == nullptr;
}

}  // namespace

PhaseSpaceText CaseTables::phase_space(const toml::table& table, const std::string& what) const {
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
VectorFieldText CaseTables::vector_field(const Text& momentum, const toml::node& node,
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

VectorFieldsText CaseTables::vector_fields(const toml::table& table) const {
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

LevelText CaseTables::level(const toml::table& table, const std::string& what) const {
  allow(table, what, {"name", "expression", "on"});
  return {name(table, what), text(required(table, "expression", what), "'expression'"),
          texts(table, "on")};
}

MapText CaseTables::map(const toml::table& table, const std::string& what) const {
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

SceneText CaseTables::scene(const toml::table& table, const std::string& what) const {
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

std::vector<ParameterText> CaseTables::parameters(const toml::table& root) const {
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
std::vector<ParameterText> CaseTables::functions(const toml::table& root) const {
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

MapCaseFile CaseTables::map_case(const toml::table& root, CaseFile file) const {
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

AnyCaseFile CaseTables::read(const toml::table& root) {
  read_integers(root);
  CaseFile file = read_common(root);
  if (gives_next_values(root)) return map_case(root, std::move(file));
  for (const char* key : {"map_sign", "symmetry", "conjugacy"}) {
    if (const toml::node* node = root.get(key))
      fail(node->source(), fmt::format("'{}' needs a table [map] with the next values", key));
  }
  return file;
}

void CaseTables::read_claims(const toml::table& root, CaseFile& result) const {
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

CaseFile CaseTables::read_common(const toml::table& root) {
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

}  // namespace casimir
