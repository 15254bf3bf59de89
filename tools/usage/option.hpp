#pragma once

#include <string>
#include <vector>

#include "tools/cli/cli_names.hpp"

namespace casimir::tools {

/// An option or a positional argument of a command, as it was declared: what manuals and completion
/// say cannot differ from what the program reads.
struct DeclaredOption {
  std::vector<std::string> names;  ///< "-o", "--output"; none of a positional argument
  std::string positional;          ///< "CASE", or empty
  std::string value;               ///< "FILE", "A,B"; empty for a flag
  std::string description;
  std::vector<std::string> choices;  ///< the only values there are, if they can be listed
  bool repeatable = false;
  bool required = false;

  bool takes_value() const { return !value.empty(); }
};

/// In the order of the help.
std::vector<DeclaredOption> declared_options(const CLI::App& command);

/// The subcommands, in the order of the help.
std::vector<const CLI::App*> declared_commands(const CLI::App& program);

}  // namespace casimir::tools
