#include "tools/cli/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "symbolic/case/limits.hpp"

namespace casimir::tools {

CommandLine::CommandLine()
    : app_(
          "Proves the integrals of Hamiltonian systems, writes their equations as C++ and "
          "integrates them.",
          "casimir") {
  app_.set_version_flag("--version", CASIMIR_VERSION);
  app_.require_subcommand(1);
  app_.failure_message(CLI::FailureMessage::simple);
  for (const Register add : kCommands) add(app_, action_);
  for (CLI::App* command : app_.get_subcommands(nullptr)) add_resources(*command, resources_);
}

std::function<int()> CommandLine::read(int argc, const char* const* argv) {
  app_.parse(argc, argv);
  return [resources = resources_, action = action_] {
    const Limits limits = limits_of(resources);
    limit_memory(resources);
    return action(limits);
  };
}

namespace {

/// CLI11 reports an unknown option, with its value, as extra arguments; a near name helps more.
std::string extra_message(const std::vector<std::string>& extras, const CLI::App& command) {
  const auto option = std::find_if(extras.begin(), extras.end(), [](const std::string& word) {
    return word.size() > 1 && word[0] == '-';
  });
  if (option == extras.end())
    return fmt::format("casimir: error: unexpected argument '{}'",
                       extras.empty() ? "" : printable(extras[0], 200));
  const std::string name = option->substr(0, option->find('='));
  std::vector<std::string> names;
  for (const CLI::Option* known : command.get_options()) {
    for (const std::string& word : known->get_lnames()) names.push_back("--" + word);
  }
  const std::string hint = suggest(name, names);
  return fmt::format("casimir: error: '{}' has no option '{}'{}", command.get_name(),
                     printable(name, 200), hint.empty() ? "" : "\n  hint: " + hint);
}

}  // namespace

/// CLI11 reports an unknown command as an extra argument; a near name helps more.
std::string CommandLine::usage_message(const CLI::ParseError& problem, int argc,
                                       const char* const* argv) {
  std::string message = fmt::format("casimir: error: {}", printable(problem.what(), 500));
  const auto chosen = app_.get_subcommands();
  if (dynamic_cast<const CLI::ConversionError*>(&problem) != nullptr)
    message += ": a number was expected, and not too long a one";
  if (dynamic_cast<const CLI::ExtrasError*>(&problem) != nullptr && !chosen.empty())
    message = extra_message(app_.remaining(true), *chosen.front());
  if (!chosen.empty())
    return message + fmt::format("\n  see 'casimir {} --help'", chosen.front()->get_name());
  if (argc > 1) {
    std::vector<std::string> names;
    for (const CLI::App* command : app_.get_subcommands(nullptr))
      names.push_back(command->get_name());
    message = fmt::format("casimir: error: there is no command '{}'", printable(argv[1]));
    const std::string hint = suggest(argv[1], names);
    if (!hint.empty()) message += "\n  hint: " + hint;
  }
  return message + "\n  see 'casimir --help'";
}

}  // namespace casimir::tools
