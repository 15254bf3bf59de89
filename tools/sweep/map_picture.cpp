#include "tools/sweep/map_picture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "symbolic/error.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/output.hpp"
#include "tools/plot/colour_map.hpp"
#include "tools/typeset/printed_names.hpp"

namespace casimir::tools {
namespace {

/// The places of the values in ascending order.
std::vector<std::size_t> ascending(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
  return order;
}

/// The values of an axis in ascending order.
/// \throws UsageError  for fewer than two, and for one that occurs twice
std::vector<double> middles_of(const Axis& axis) {
  std::vector<double> values = axis.values;
  std::ranges::sort(values);
  if (values.size() < 2 || std::ranges::adjacent_find(values) != values.end())
    throw UsageError(
        fmt::format("--plot draws over two axes of two or more different values; {} "
                    "has one twice, or only one",
                    axis_title(axis)));
  return values;
}

}  // namespace

MapPicture map_picture(const Grid& grid, const SweepTask& task, const std::string& column,
                       Sheet sheet) {
  if (grid.axes.size() != 2)
    throw UsageError(
        fmt::format("--plot draws a map over two axes, and this sweep has {}: give "
                    "--over NAME=FROM:TO:N twice",
                    grid.axes.size()));
  check_cells(middles_of(grid.axes[0]), middles_of(grid.axes[1]));
  const std::vector<std::string> columns = task.columns();
  const std::string drawn = column.empty() ? task.principal_column() : column;
  if (drawn.empty())
    throw UsageError(
        fmt::format("--plot needs --colour COLUMN, one of: {}", fmt::join(columns, ", ")));
  if (std::ranges::find(columns, drawn) == columns.end())
    throw UsageError(fmt::format("--colour '{}' is no column of this sweep; {}", printable(drawn),
                                 suggest_or_list(drawn, columns)));
  return {drawn, std::move(sheet)};
}

void draw_map(const MapPicture& picture, const SweepTable& sweep) {
  const Axis &across = sweep.grid.axes[0], &up = sweep.grid.axes[1];
  const auto column = static_cast<std::size_t>(std::ranges::find(sweep.columns, picture.column) -
                                               sweep.columns.begin());
  ColourMap map{
      "", printed_names(axis_title(across)), printed_names(axis_title(up)), picture.column, {}, {},
      {}};
  std::size_t failed = 0;
  const std::vector<std::size_t> columns_of_cells = ascending(across.values);
  const std::vector<std::size_t> rows_of_cells = ascending(up.values);
  for (const std::size_t j : rows_of_cells) map.y.push_back(up.values[j]);
  for (const std::size_t i : columns_of_cells) {
    map.x.push_back(across.values[i]);
    for (const std::size_t j : rows_of_cells) {
      const PointResult& point = sweep.rows[i * up.values.size() + j];
      const bool done = point.status == Status::ok;
      failed += done ? 0 : 1;
      map.values.push_back(done ? point.values[column] : NAN);
    }
  }
  map.title = fmt::format("{}, scene {}: {} of {} by {} points, {} at tolerance {:g}",
                          sweep.case_name, sweep.scene, picture.column, map.x.size(), map.y.size(),
                          sweep.method, sweep.tolerance);
  if (failed > 0) map.title += fmt::format("; {} not done to the end are white", failed);
  draw(map, picture.sheet);
}

}  // namespace casimir::tools
