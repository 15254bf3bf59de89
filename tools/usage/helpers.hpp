#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/cli/cli_names.hpp"

namespace casimir::tools {

/// What is asked of the program without any command that computes:
///
///   casimir                        the first steps
///   casimir help [COMMAND]         as --help
///   casimir complete WORD..        what may stand in place of the last word, for shells
///   casimir manual FOLDER DATE     writes the manual, one page a command, for the build
///
/// \param words  those behind the program's name
/// \return the exit status; nothing if it is none of these
/// \throws UsageError  for help with a command that is not there.
std::optional<int> run_helper(const CLI::App& program, const std::vector<std::string>& words,
                              const std::string& version);

}  // namespace casimir::tools
