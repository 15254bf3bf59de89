#pragma once

#include <string>

#include "tools/cli/output.hpp"

namespace casimir::tools {

/// Text for gnuplot: plain characters only, so that nothing of a case file is a command there.
std::string quoted(const std::string& text);

/// A path in gnuplot's quotation marks.
/// \throws UsageError
std::string quoted_path(const std::string& path);

/// Throws UsageError unless the name ends in .svg or .png: before any work is done for it.
void check_plot_name(const std::string& path);

/// Runs gnuplot, directly and not through a shell, on a script that writes to the temporary name of
/// `picture`.
/// \throws SystemError  if gnuplot is missing (saying what to install) or fails.
void draw_script(const std::string& script, OutputFile& picture);

}  // namespace casimir::tools
