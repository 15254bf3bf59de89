#pragma once

#include <string>

#include "tools/cli/output.hpp"

namespace casimir::tools {

/// Text for gnuplot, in its quotation marks: on one line and without characters that mean something
/// there, so that nothing of a case file is a command. It needs `noenhanced` behind it where the
/// terminal is not.
std::string quoted(const std::string& text);

/// The same in lines of so many letters.
std::string quoted_lines(const std::string& text, std::size_t letters);

/// A path in gnuplot's quotation marks.
/// \throws UsageError
std::string quoted_path(const std::string& path);

/// Runs gnuplot, directly and not through a shell, on a script that writes to the temporary name of
/// `picture`.
/// \throws SystemError  if gnuplot is missing (saying what to install) or fails.
void draw_script(const std::string& script, OutputFile& picture);

}  // namespace casimir::tools
