#include "tests/traps/scene.hpp"

#include <fmt/format.h>

namespace casimir::traps {
namespace {

std::string table(const Named& entries) {
  std::string inner;
  for (const auto& [name, value] : entries)
    inner += fmt::format("{}{} = \"{}\"", inner.empty() ? "" : ", ", name, value);
  return "{ " + inner + " }";
}

std::string lines(const std::string& title, const Named& entries) {
  std::string text = "[" + title + "]\n";
  for (const auto& [name, value] : entries) text += fmt::format("{} = \"{}\"\n", name, value);
  return text;
}

Named pairs(const Texts& names, const Texts& values) {
  Named result;
  for (std::size_t i = 0; i < names.size(); ++i) result.emplace_back(names[i], values[i]);
  return result;
}

}  // namespace

std::string Scene::text() const {
  std::string text = fmt::format("title = \"{}\"\n", shape);
  if (!hamiltonian.empty()) text += fmt::format("hamiltonian = \"{}\"\n", hamiltonian);
  text += "[phase_space]\nvariables = [";
  for (const std::string& name : variables)
    text += fmt::format("{}\"{}\"", &name == &variables.front() ? "" : ", ", name);
  text += "]\n";
  if (!time.empty()) text += fmt::format("time = \"{}\"\n", time);
  if (!hamiltonian.empty()) text += "canonical = true\n";
  if (!parameters.empty()) {
    text += "[parameters]\n";
    for (const auto& [name, value] : parameters) text += name + " = {}\n";
  }
  if (!definitions.empty()) text += lines("definitions", definitions);
  if (hamiltonian.empty()) text += lines("equations", pairs(variables, equations));
  text += "[[scene]]\nname = \"default\"\n";
  if (!parameters.empty()) text += "parameters = " + table(parameters) + "\n";
  text += "initial = " + table(pairs(variables, initial)) + "\n";
  return text + fmt::format("duration = \"{}\"\n", duration);
}

}  // namespace casimir::traps
