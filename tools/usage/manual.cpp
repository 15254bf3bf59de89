#include "tools/usage/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "tools/usage/option.hpp"
#include "tools/usage/roff.hpp"

namespace casimir::tools {
namespace {

using roff::bold;
using roff::heading;
using roff::italic;
using roff::paragraph;

/// Text whose lines are laid out already stays as it is; other text is filled.
std::string prose(const std::string& text) {
  const bool laid_out = text.find("\n  ") != std::string::npos;
  return laid_out ? ".nf\n" + paragraph(text) + ".fi\n" : paragraph(text);
}

/// A tagged paragraph.
std::string item(const std::string& tag, const std::string& text) {
  return ".TP\n" + tag + "\n" + paragraph(text);
}

std::string sentence_of(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.ends_with('.') ? line.substr(0, line.size() - 1) : line;
}

std::string shown_names(const DeclaredOption& option) {
  std::string result;
  for (const std::string& name : option.names) result += (result.empty() ? "" : ", ") + bold(name);
  return option.takes_value() ? result + " " + italic(option.value) : result;
}

std::string options_section(const std::vector<DeclaredOption>& options) {
  std::string text = ".SH OPTIONS\n";
  for (const DeclaredOption& option : options) {
    if (!option.names.empty()) text += item(shown_names(option), option.description);
  }
  return text;
}

const std::vector<std::pair<const char*, const char*>> kExitStatuses = {
    {"0", "done; everything asked for holds"},
    {"1", "a claim is refuted, or a numeric check fails"},
    {"2", "bad input: usage, TOML, expression, unknown name; the message says where"},
    {"3", "undecided: neither proved nor refuted, also when a time limit was reached"},
    {"4", "the environment: no C++ compiler, cannot write, out of memory or time"},
    {"5", "the numerical solution could not be continued; the message says when and why"},
    {"130", "interrupted by Ctrl-C"},
    {"143", "ended by SIGTERM"}};

const std::vector<std::pair<const char*, const char*>> kVariables = {
    {"CASIMIR_CASES",
     "folders with case files, separated by colons, that come before the bundled "
     "ones"},
    {"CASIMIR_CACHE",
     "where compiled modules are kept; otherwise casimir in XDG_CACHE_HOME or in "
     "~/.cache"},
    {"CASIMIR_INSTRUCTIONS",
     "the instruction set of kernels and of generated code, avx512, avx2 or sse2; otherwise the "
     "widest that the processor has"},
    {"CXX", "the C++ compiler, with its first arguments; otherwise c++, g++ or clang++"},
    {"NO_COLOR", "when set and not empty, nothing is coloured"}};

std::string manual_table(const std::string& title,
                         const std::vector<std::pair<const char*, const char*>>& rows) {
  std::string text = ".SH " + title + "\n";
  for (const auto& [name, meaning] : rows) text += item(bold(name), meaning);
  return text;
}

std::string see_also(const std::vector<const CLI::App*>& commands, const CLI::App* but) {
  std::vector<std::string> names;
  if (but) names.emplace_back("\\fBcasimir\\fR(1)");
  for (const CLI::App* command : commands) {
    if (command != but) names.push_back(bold("casimir-" + command->get_name()) + "(1)");
  }
  names.emplace_back("\\fBcasimir\\-case\\fR(5)");
  return fmt::format(".SH SEE ALSO\n{}\n", fmt::join(names, ",\n"));
}

std::string command_page(const CLI::App& program, const CLI::App& command,
                         const std::string& version, const std::string& date) {
  const std::vector<DeclaredOption> options = declared_options(command);
  const std::string description = command.get_description();
  std::string text =
      heading("casimir-" + command.get_name(), sentence_of(description), 1, version, date);
  text += ".SH SYNOPSIS\n" + bold("casimir " + command.get_name()) + " [" + italic("OPTIONS") + "]";
  std::string arguments;
  for (const DeclaredOption& option : options) {
    if (option.positional.empty()) continue;
    const std::string shown = italic(option.positional) + (option.repeatable ? " ..." : "");
    text += option.required ? " " + shown : " [" + shown + "]";
    arguments += item(italic(option.positional), option.description);
  }
  text += "\n.SH DESCRIPTION\n" + prose(description);
  if (!arguments.empty()) text += ".SH ARGUMENTS\n" + arguments;
  text += options_section(options);
  if (!command.get_footer().empty()) text += ".SH NOTES\n" + prose(command.get_footer());
  return text + manual_table("EXIT STATUS", kExitStatuses) +
         see_also(declared_commands(program), &command);
}

std::string main_page(const CLI::App& program, const std::string& version,
                      const std::string& date) {
  std::string text =
      heading("casimir", "an integrability workbench for Hamiltonian systems", 1, version, date);
  text += ".SH SYNOPSIS\n" + bold("casimir") + " " + italic("COMMAND") + " [" + italic("CASE") +
          "] [" + italic("OPTIONS") + "]\n";
  text += ".SH DESCRIPTION\n" + paragraph(program.get_description());
  text += ".PP\n" + italic("CASE") + "\n" +
          paragraph(
              "is the name of a bundled case (see casimir-list(1)), a path to a case file, "
              "which contains a slash or ends in .toml, or - for a case file on standard "
              "input.");
  text += ".SH COMMANDS\n";
  for (const CLI::App* command : declared_commands(program))
    text += item(bold(command->get_name()), sentence_of(command->get_description()));
  text += options_section(declared_options(program));
  return text + manual_table("EXIT STATUS", kExitStatuses) +
         manual_table("ENVIRONMENT", kVariables) + see_also(declared_commands(program), nullptr);
}

}  // namespace

std::map<std::string, std::string> manual_pages(const CLI::App& program, const std::string& version,
                                                const std::string& date) {
  std::map<std::string, std::string> pages{{"casimir.1", main_page(program, version, date)}};
  for (const CLI::App* command : declared_commands(program))
    pages["casimir-" + command->get_name() + ".1"] = command_page(program, *command, version, date);
  return pages;
}

}  // namespace casimir::tools
