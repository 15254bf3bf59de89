#include "tools/usage/helpers.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "symbolic/error.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/output.hpp"
#include "tools/usage/case_page.hpp"
#include "tools/usage/completion.hpp"
#include "tools/usage/manual.hpp"

namespace casimir::tools {
namespace {

constexpr const char* kFirstSteps = R"(casimir: an integrability workbench for Hamiltonian systems

  casimir list                       the bundled cases
  casimir verify kovalevskaya        prove or refute every claim of a case
  casimir integrate kovalevskaya     integrate it, with an estimate of the error
  casimir new my-case                start a case file of your own

  casimir help [COMMAND]             all commands, or the options of one
)";

/// The help of the program, or of one command; nothing where there is no such command.
std::optional<std::string> help_of(const CLI::App& program, const std::vector<std::string>& words) {
  if (words.empty()) return program.help();
  if (words.size() > 1) return std::nullopt;
  for (const CLI::App* command : program.get_subcommands(nullptr))
    if (command->get_name() == words[0]) return command->help("casimir");
  return std::nullopt;
}

}  // namespace

std::optional<int> run_helper(const CLI::App& program, const std::vector<std::string>& words,
                              const std::string& version) {
  if (words.empty()) {
    std::cout << kFirstSteps;
    return kDone;
  }
  if (words[0] == "help") {
    const std::vector<std::string> asked(words.begin() + 1, words.end());
    const std::optional<std::string> text = help_of(program, asked);
    if (!text) {
      std::vector<std::string> names;
      for (const CLI::App* command : program.get_subcommands(nullptr))
        names.push_back(command->get_name());
      throw UsageError(fmt::format("there is no command '{}' to help with; {}",
                                   printable(asked.back()), suggest_or_list(asked.back(), names)));
    }
    std::cout << *text;
    return kDone;
  }
  if (words[0] == "complete") {
    for (const std::string& line : completions(program, {words.begin() + 1, words.end()}))
      std::cout << line << '\n';
    return kDone;
  }
  if ((words.size() == 3 || words.size() == 4) && words[0] == "manual") {
    auto pages = manual_pages(program, version, words[2]);
    if (words.size() == 4) {
      std::ifstream markdown(words[3], std::ios::binary);
      if (!markdown) throw SystemError("cannot read the reference of case files");
      pages["casimir-case.5"] =
          case_page({std::istreambuf_iterator<char>(markdown), {}}, version, words[2]);
    }
    for (const auto& [name, text] : pages) {
      OutputFile file(std::filesystem::path(words[1]) / name);
      file.stream() << text;
      file.commit();
    }
    return kDone;
  }
  return std::nullopt;
}

}  // namespace casimir::tools
