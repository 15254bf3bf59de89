#pragma once

#include <string>
#include <vector>

#include "tools/plot/sheet.hpp"

namespace casimir::tools {

/// A quantity over a grid of two others, a colour in each cell.
struct ColourMap {
  std::string title, x_label, y_label, quantity;
  std::vector<double> x, y;  ///< in ascending order, at least two of each: the middles of the cells
  /// values[i * y.size() + j] at x[i], y[j]. One that is not finite has no colour.
  std::vector<double> values;
};

/// Refuses more than 40,000 cells that are not of one size, since each of these is drawn by itself:
/// before any work is done for them.
/// \param x, y  as in `ColourMap`
/// \throws UsageError
void check_cells(const std::vector<double>& x, const std::vector<double>& y);

/// Draws with gnuplot: equal cells as one bitmap, which is small whatever their number, others one
/// by one. Colours go from dark to light as the quantity grows, legible without colour vision and
/// in grey.
/// \throws UsageError   as `check_cells`
/// \throws SystemError  as `draw` of a plot
void draw(const ColourMap& map, const Sheet& sheet);

}  // namespace casimir::tools
