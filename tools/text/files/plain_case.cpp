#include "tools/text/files/plain_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/show/notation.hpp"

namespace casimir::tools {
namespace {

/// A TOML string on one line.
std::string toml_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + "\"";
}

GiNaC::ex function_named(const Model& model, const std::string& name) {
  for (const auto* list : {&model.casimirs, &model.integrals}) {
    const auto found = std::ranges::find(*list, name, &NamedExpression::name);
    if (found != list->end()) return found->value;
  }
  return *model.hamiltonian;
}

}  // namespace

std::string plain_case(const Model& model, const Scene& scene,
                       const std::vector<std::string>& moving,
                       const std::vector<std::string>& states,
                       const std::vector<std::string>& integrals) {
  Notation notation(model);
  GiNaC::exmap values;
  std::vector<std::string> variables, equations, initial;
  const auto is_in = [](const std::vector<std::string>& list, const std::string& name) {
    return std::ranges::find(list, name) != list.end();
  };
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    if (!is_in(moving, model.parameters[i].get_name()))
      values[model.parameters[i]] = scene.parameters[i];
  const auto text_of = [&](const GiNaC::ex& e) {
    return toml_string(notation.case_text(e.subs(values, GiNaC::subs_options::no_pattern)));
  };
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    const std::string name = model.variables[i].get_name();
    if (!is_in(states, name)) continue;
    variables.push_back(toml_string(name));
    equations.push_back(fmt::format("{} = {}\n", name, text_of(model.field[i])));
    initial.push_back(fmt::format("{} = {}", name, text_of(scene.initial[i])));
  }
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const std::string name = model.parameters[i].get_name();
    if (!is_in(moving, name)) continue;
    variables.push_back(toml_string(name));
    equations.push_back(fmt::format("{} = \"0\"\n", name));
    initial.push_back(fmt::format("{} = {}", name, text_of(scene.parameters[i])));
  }
  std::string text = fmt::format("title = {}\n\n[phase_space]\nvariables = [{}]\n",
                                 toml_string(model.title.empty() ? model.name : model.title),
                                 fmt::join(variables, ", "));
  if (model.time) text += fmt::format("time = {}\n", toml_string(model.time->get_name()));
  text += fmt::format("\n[equations]\n{}", fmt::join(equations, ""));
  if (!integrals.empty()) text += "\n[integrals]\n";
  for (const std::string& name : integrals) {
    // The energy is called H also where that is a variable.
    const std::string key = is_in(states, name) || is_in(moving, name) ? name + "_energy" : name;
    text += fmt::format("{} = {}\n", key, text_of(function_named(model, name)));
  }
  return text + fmt::format("\n[[scene]]\nname = {}\ninitial = {{ {} }}\nduration = {}\n",
                            toml_string(scene.name), fmt::join(initial, ", "),
                            text_of(*scene.duration));
}

}  // namespace casimir::tools
