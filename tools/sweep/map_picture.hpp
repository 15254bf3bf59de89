#pragma once

#include <string>

#include "tools/analysis/sweep/task.hpp"
#include "tools/plot/sheet.hpp"
#include "tools/sweep/table.hpp"

namespace casimir::tools {

/// What is drawn of a sweep over two axes: one column of its task.
struct MapPicture {
  std::string column;
  Sheet sheet;
};

/// Checks, before any point is done, that the grid has two axes with two or more different values
/// each, and that the task has the column.
/// \param column  empty: the task's own, if it has one
/// \throws UsageError
MapPicture map_picture(const Grid& grid, const SweepTask& task, const std::string& column,
                       Sheet sheet);

/// Draws the first axis across and the second one up. Points that were not done to the end have no
/// colour, and the title counts them.
/// \throws UsageError, SystemError  as `draw` of a colour map
void draw_map(const MapPicture& picture, const SweepTable& sweep);

}  // namespace casimir::tools
