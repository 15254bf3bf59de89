#pragma once

#include <string>
#include <utility>
#include <vector>

namespace casimir::tools {

/// One curve of a plot. Points without finite positive coordinates are left out of log axes.
struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;
  /// A variant of the curve before it: the same colour, larger open marks, no line of its own.
  bool variant = false;
};

struct Plot {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  std::vector<Curve> curves;
};

/// Throws UsageError unless the name ends in .svg or .png: before any work is done for it.
void check_plot_name(const std::string& path);

/// Draws with gnuplot, which is run directly, not through a shell.
/// \throws SystemError  if gnuplot is missing (saying what to install), fails, or the file cannot
///                      be written.
void draw(const Plot& plot, const std::string& path);

}  // namespace casimir::tools
