#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "tools/cli/cli.hpp"
#include "tools/cli/resources.hpp"

namespace casimir::tools {

/// The command line of casimir with all its commands.
class CommandLine {
 public:
  CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Reads a command line, and runs nothing.
  /// \throws CLI::ParseError, also for --help
  std::function<int()> read(int argc, const char* const* argv);

  /// What to say of a command line that could not be read.
  std::string usage_message(const CLI::ParseError& problem, int argc, const char* const* argv);

  CLI::App& app() { return app_; }

 private:
  CLI::App app_;
  Resources resources_;
  Action action_;
};

}  // namespace casimir::tools
