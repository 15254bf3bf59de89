#pragma once

#include <string>

#include "symbolic/case/limits.hpp"
#include "symbolic/coordinates.hpp"
#include "tools/cli/cli_names.hpp"

namespace casimir::tools {

/// The sets of variables that the bundled cases know, and the maps between them.
Atlas bundled_atlas(const Limits& limits);

/// `--in SET`: the case in the variables of SET, in all that a command does.
void add_in(CLI::App& command, std::string& set);

/// `--as SET`: answers in the variables of SET.
void add_as(CLI::App& command, std::string& set);

/// The model itself where `set` is empty.
/// \throws ModelError, SingularPoint: see in_coordinates
Model in_variables(Model model, const std::string& set);

}  // namespace casimir::tools
