#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "tools/cli/output.hpp"
#include "tools/plot/sheet.hpp"

namespace casimir::tools {

/// Text for gnuplot, in its quotation marks: on one line and without characters that mean something
/// there, so that nothing of a case file is a command, of gnuplot or on a LaTeX sheet of LaTeX. It
/// needs `noenhanced` behind it where the terminal is not.
std::string quoted(const std::string& text, const Sheet& sheet);

/// The same in lines of so many letters.
std::string quoted_lines(const std::string& text, std::size_t letters, const Sheet& sheet);

/// A path in gnuplot's quotation marks.
/// \throws UsageError
std::string quoted_path(const std::string& path);

/// Runs gnuplot, directly and not through a shell, on a script that writes to this file.
/// \throws SystemError  if gnuplot is missing (saying what to install) or fails.
void draw_script(const std::string& script, const std::filesystem::path& file);

/// Makes the file of a sheet by a script. Of a LaTeX sheet the PDF with its lines is made beside
/// it.
/// \param script    the script that writes to this file
/// \param finished  what is done to the file before it gets its name
/// \throws UsageError   for a name that is no picture's, or that LaTeX could not include
/// \throws SystemError  as `draw_script`, and if it cannot be written.
void draw_sheet(const Sheet& sheet, const std::function<std::string(const std::string&)>& script,
                const std::function<void(const std::filesystem::path&)>& finished = {});

}  // namespace casimir::tools
