#pragma once

#include <array>
#include <string>
#include <vector>

#include "tools/analysis/section/orbits.hpp"
#include "tools/plot/motion_plot.hpp"
#include "tools/report/chart.hpp"

namespace casimir::tools {

/// States against time, a panel for each group of names: as SVG elements below each other, over the
/// first part of the motion that can be read.
std::string motion_svg(const Motion& motion);

/// How many samples that shows: up to where the state that swings fastest has turned so often.
std::size_t legible_samples(const Motion& motion);

/// The crossings of orbits: chaotic ones grey. An angle is drawn over one period, in units of pi.
Chart section_chart(const std::array<PlottedFunction, 2>& plotted,
                    const std::vector<OrbitReport>& orbits);

/// The first two states against each other, or the only one against time: for a list.
Chart thumbnail_of(const Motion& motion);

}  // namespace casimir::tools
