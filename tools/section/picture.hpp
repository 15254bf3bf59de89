#pragma once

#include <array>
#include <string>
#include <vector>

#include "tools/analysis/frequency/rotation.hpp"
#include "tools/analysis/section/cycles.hpp"
#include "tools/analysis/section/orbits.hpp"
#include "tools/plot/sheet.hpp"

namespace casimir::tools {

/// A number for each orbit that its colour shows.
struct OrbitColours {
  std::string what;            ///< the label of the scale; empty: no such colours
  std::vector<double> values;  ///< one for each orbit; not a number: grey
};

/// What `--colour` asks for.
/// \param what  "megno", "exponent", "rotation" or empty
/// \param rotations  one for each orbit where they are asked for
OrbitColours colours_by(const std::string& what, const std::vector<OrbitReport>& orbits,
                        const std::vector<Rotation>& rotations);

/// Draws a section with gnuplot. Chaotic orbits are a fine grey dust,
/// regular ones darker marks that are larger, each orbit in one of a few colours; cycles are rings
/// and crosses. An angle is drawn over one period, in units of pi.
/// \throws SystemError  without gnuplot.
void draw_section(const std::array<PlottedFunction, 2>& plotted, const std::string& title,
                  const std::vector<OrbitReport>& orbits, const std::vector<Cycle>& cycles,
                  const Sheet& sheet, const OrbitColours& colours = {});

}  // namespace casimir::tools
