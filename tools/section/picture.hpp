#pragma once

#include <string>
#include <vector>

#include "tools/analysis/section/cycles.hpp"
#include "tools/analysis/section/orbits.hpp"

namespace casimir::tools {

/// Draws a section with gnuplot to a .svg or .png file. Chaotic orbits are a fine grey dust,
/// regular ones darker marks that are larger, each orbit in one of a few colours; cycles are rings
/// and crosses. An angle is drawn over one period, in units of Pi.
/// \throws SystemError  without gnuplot.
void draw_section(const SectionProblem& problem, const std::string& title,
                  const std::vector<OrbitReport>& orbits, const std::vector<Cycle>& cycles,
                  const std::string& path);

/// The same as a script for gnuplot.
/// \param terminal  of gnuplot
/// \param output  what it shall write
std::string section_script(const SectionProblem& problem, const std::string& title,
                           const std::vector<OrbitReport>& orbits, const std::vector<Cycle>& cycles,
                           const std::string& terminal, const std::string& output);

}  // namespace casimir::tools
