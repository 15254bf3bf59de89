#pragma once

#include <string>
#include <vector>

#include "tools/analysis/sweep/grid.hpp"
#include "tools/analysis/sweep/task.hpp"

namespace casimir::tools {

/// The results of a sweep: a row for each point of the grid, in its order.
struct SweepTable {
  std::string case_name, scene, method;
  double tolerance = 0;
  const Grid& grid;
  std::vector<std::string> columns;
  std::vector<PointResult> rows;
};

/// Refuses, before any work is done for it, what this program cannot write.
/// \throws UsageError   for a name that ends in none of .csv, .npz, .h5 and .hdf5
/// \throws SystemError  where it was built without the library for it
void check_sweep_output(const std::string& path);

/// One line a point: its number from 1, the values of the axes (an initial value as `M1(0)`), the
/// status, then the columns. Or, if the name says so, arrays: one of the grid's shape for each.
/// \throws SystemError
void write_sweep(const std::string& path, const SweepTable& table);

/// `M1(0)` for an axis of initial values; else its name.
std::string axis_title(const Axis& axis);

}  // namespace casimir::tools
