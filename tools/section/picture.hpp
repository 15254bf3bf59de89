#pragma once

#include <array>
#include <string>
#include <vector>

#include "tools/analysis/section/cycles.hpp"
#include "tools/analysis/section/orbits.hpp"
#include "tools/plot/sheet.hpp"

namespace casimir::tools {

/// Draws a section with gnuplot. Chaotic orbits are a fine grey dust,
/// regular ones darker marks that are larger, each orbit in one of a few colours; cycles are rings
/// and crosses. An angle is drawn over one period, in units of pi.
/// \throws SystemError  without gnuplot.
void draw_section(const std::array<PlottedFunction, 2>& plotted, const std::string& title,
                  const std::vector<OrbitReport>& orbits, const std::vector<Cycle>& cycles,
                  const Sheet& sheet);

/// The same as a script for gnuplot.
/// \param terminal  of gnuplot, in its enhanced mode
/// \param output  what it shall write
std::string section_script(const std::array<PlottedFunction, 2>& plotted, const std::string& title,
                           const std::vector<OrbitReport>& orbits, const std::vector<Cycle>& cycles,
                           const Print& print, const std::string& terminal,
                           const std::string& output);

}  // namespace casimir::tools
