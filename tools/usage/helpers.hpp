#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/cli/cli_names.hpp"

namespace casimir::tools {

/// Two commands for shells and for the build, which no help shows:
///
///   casimir complete WORD..        what may stand in place of the last word
///   casimir manual FOLDER DATE     writes the manual, one page a command
///
/// \param words  those behind the program's name
/// \return the exit status; nothing if it is neither
std::optional<int> run_helper(const CLI::App& program, const std::vector<std::string>& words,
                              const std::string& version);

}  // namespace casimir::tools
