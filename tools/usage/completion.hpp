#pragma once

#include <string>
#include <vector>

#include "tools/cli/cli_names.hpp"

namespace casimir::tools {

/// What may stand in place of the word that is being typed. The shells' scripts beside this file
/// print it, or ask for files where a line says `:files`.
/// \param words  those behind the program's name, the last of them the one being typed
/// \return lines, each a whole word, and behind a tab what it is
std::vector<std::string> completions(const CLI::App& program, std::vector<std::string> words);

}  // namespace casimir::tools
