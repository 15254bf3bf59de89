#pragma once

#include <CLI/CLI.hpp>

#include "tools/section/request.hpp"

namespace casimir::tools {

/// Adds what a section lies on to a command: level, surface, direction, and the plotted pair.
void add_plane_options(CLI::App& command, SectionOptions& request);

}  // namespace casimir::tools
