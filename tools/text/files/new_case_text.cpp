// How a case file to start from is written: every key once, with a word about it.
#include <cln/rational_io.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "symbolic/algebra/number_text.hpp"
#include "tools/runs/new_case.hpp"
#include "tools/text/text_layout.hpp"

namespace casimir::tools {
namespace {

constexpr std::size_t kCommentColumn = 30;
constexpr std::size_t kWidthOfCase = 100;

/// Code and what is said about it, in columns; a comment that does not fit stands before.
std::string line(const std::string& code, const std::string& comment) {
  if (code.size() + 2 > kCommentColumn) return fmt::format("# {}:\n{}\n", comment, code);
  return fmt::format("{:<{}}# {}\n", code, kCommentColumn, comment);
}

/// `before` items `after`, on as many lines as it takes: arrays may be broken in TOML.
std::string list(const std::string& before, const std::vector<std::string>& items,
                 const std::string& after) {
  const std::string all = fmt::format("{}", fmt::join(items, ", "));
  if (before.size() + all.size() + after.size() <= kWidthOfCase) return before + all + after + "\n";
  std::string text = before + "\n";
  for (const std::string& part : wrapped(all, kWidthOfCase - 2)) text += "  " + part + "\n";
  return text + after + "\n";
}

std::string names_and_values(const std::vector<NewQuantity>& quantities) {
  std::vector<std::string> items;
  for (const NewQuantity& quantity : quantities) {
    items.push_back(fmt::format("{} = \"{}\"", quantity.name, rational_text(quantity.value)));
  }
  return items.empty() ? "{}" : fmt::format("{{ {} }}", fmt::join(items, ", "));
}

std::vector<std::string> quoted(const std::vector<std::string>& names) {
  std::vector<std::string> result;
  for (const std::string& name : names) result.push_back('"' + name + '"');
  return result;
}

std::string heading(const std::string& name, const std::string& file) {
  return fmt::format(
      R"(# A case file: a system, what is claimed about it, and scenes to integrate.
#   casimir verify {1}      proves or refutes every claim
#   casimir conserve {1}    integrates every scene and watches what has to stay constant
# Expressions are strings: + - * / ^, exact numbers (0.5 is 1/2), sqrt sin cos tan cot sinh
# cosh tanh exp log atan atan2 asin acos abs sign, Pi; {{F, G}} is the Poisson bracket, rate(F) is
# dF/dt, diff(F, x) a derivative.
# Keys that are commented out show how they are written.
title = "{0}"
source = "where the formulas come from"
)",
      name, file);
}

std::string phase_space(const NewCase& system) {
  std::vector<std::string> names;
  for (const NewQuantity& variable : system.variables) names.push_back(variable.name);
  std::string text = "\n[phase_space]\n" + list("variables = [", quoted(names), "]");
  if (!system.phase_space.empty()) {
    text += line(system.phase_space, system.phase_space.starts_with("algebra")
                                         ? "in the book's sign; sign = \"+\" is the other one"
                                         : "the variables are q1..qn, then p1..pn");
  }
  const std::string& first = names.front();
  text += line(fmt::format("# domain = [\"{} != 0\"]", first),
               "where the claims are meant: signs that roots depend on");
  text += line(fmt::format("# constraints = [\"{}\"]", system.levels.front()),
               "vanish at the start of every scene, exactly");
  return text;
}

std::string parameters(const NewCase& system) {
  std::string text = "\n[parameters]                  # symbolic in proofs, numbers in scenes\n";
  bool explained = false;
  for (const NewQuantity& parameter : system.parameters) {
    if (!parameter.positive) {
      text += parameter.name + " = {}\n";
    } else {
      const std::string code = fmt::format("{0} = {{ assume = \"{0} > 0\" }}", parameter.name);
      text += explained ? code + "\n" : line(code, "what proofs may use and scenes must satisfy");
      explained = true;
    }
  }
  return text;
}

std::string table(const std::string& head, const std::string& comment,
                  const std::vector<NamedText>& entries) {
  std::string text = "\n" + line(head, comment);
  for (const auto& [name, value] : entries) text += fmt::format("{} = \"{}\"\n", name, value);
  return text;
}

std::string claims(const NewCase& system) {
  std::string text;
  if (system.equations.empty())
    text += table("[casimirs]", "{x, F} = 0 for every variable x", system.casimirs);
  text += table("[integrals]",
                system.equations.empty() ? "constant along the flow; that H is, is known"
                                         : "constant along the flow",
                system.integrals);
  const std::string known =
      (system.integrals.empty() ? system.casimirs : system.integrals).front().first;
  text += line(fmt::format("# K = \"{}^2\"", known),
               "try it first: casimir verify FILE --integral EXPR");
  text += "\n" + line("# [[conditional]]", "constant where the functions 'on' vanish, only there");
  text += fmt::format("# name = \"G\"\n# expression = \"{}^2\"\n# on = [\"{}\"]\n", known,
                      system.levels.front());
  text +=
      "\n# Further tables, see man 5 casimir-case: [definitions], [[invariant_relation]], "
      "[[lax]],\n"
      "# as well as [[map]], [[measure]] and [[identity]].\n";
  return text;
}

std::string scene(const NewCase& system) {
  std::string text = "\n[[scene]]\nname = \"default\"\n";
  text += fmt::format("parameters = {}\n", names_and_values(system.parameters));
  text += fmt::format("initial = {}\n", names_and_values(system.variables));
  text += "duration = \"100\"\n";
  text += line(fmt::format("on = [{}]", fmt::join(quoted(system.levels), ", ")),
               "vanish at the start: checked exactly when the file is read");
  text += line(fmt::format("# observe = [\"{}\"]", system.variables.front().name),
               "what this does not need is left out of the code");
  return text;
}

}  // namespace

std::string to_toml(const NewCase& system, const std::string& name, const std::string& file) {
  std::string text = heading(name, file);
  text += line("# book = \"2.4\"", "section or appendix of the book, if the system is there");
  text += line("tags = []", "words for 'casimir list --tag'");
  if (system.equations.empty()) {
    text += line("# integrable = true", "claims that the integrals suffice (Liouville)");
    text += fmt::format("\n# {}\nhamiltonian = \"{}\"\n", system.about, system.hamiltonian);
  } else {
    text += fmt::format("\n# {}\n", system.about);
  }
  text += phase_space(system);
  if (!system.equations.empty())
    text += table("[equations]", "the time derivatives, instead of a bracket and a Hamiltonian",
                  system.equations);
  text += parameters(system) + claims(system) + scene(system);
  return text;
}

}  // namespace casimir::tools
