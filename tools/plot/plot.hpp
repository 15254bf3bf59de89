#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/plot/gnuplot.hpp"
#include "tools/plot/sheet.hpp"

namespace casimir::tools {

/// One curve of a plot. Points without finite positive coordinates are left out of log axes.
struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;
  enum class Style {
    plain,
    line,      ///< marks at a few of many points
    path,      ///< a line that may cross itself, without marks
    mark,      ///< one filled point
    far_mark,  ///< one open point
    guide,     ///< thin and grey, outside the legend: what helps the eye
    faint,     ///< thin and dotted, in the colour of the curve after it: what is behind
    outside,   ///< dashed, with open marks: what others offer
    variant,   ///< of the curve before it: the same colour, larger open marks, no line of its own
  };
  Style style = Style::plain;
};

struct Plot {
  std::string title = {}, x_label = {}, y_label = {};
  bool log_x = false, log_y = false;
  std::string y_unit = {};         ///< "s": the labels of the axis say "100 us", "1 ms", ..
  bool square = false;             ///< the same unit on both axes, which are left out
  std::vector<Curve> curves = {};  ///< one without points stays out of the legend
};

/// Draws with gnuplot, which is run directly, not through a shell.
/// \throws SystemError  if gnuplot is missing (saying what to install), fails, or the file cannot
///                      be written.
void draw(const Plot& plot, const Sheet& sheet);

/// The same picture as the text of an SVG element, to stand inside a page: without the lines before
/// it, and with `name` (letters, digits and '-') before every identifier, so that several of them
/// can stand in one page. Temporary files are made beside the file `beside`.
/// \throws SystemError  as `draw`.
std::string svg_element(const Plot& plot, const std::string& name, const std::string& beside);

/// The same for a page in light or dark colours, on a screen as narrow as a telephone's: the legend
/// is below, letters are large, and colours are the variables --plot-ink, --plot-paper, --plot-grid
/// and --plot-1 to --plot-12 of the page. Its attribute `data-axes` says where the frame is (left,
/// right, bottom and top, from the lower left corner), the values there, and which axes are
/// logarithmic (1) or not (0); a picture without axes has none.
std::string page_svg(const Plot& plot, const std::string& name, const std::string& beside);

/// Declarations of these variables.
/// \param dark  for a dark page
std::string plot_variables(bool dark);

}  // namespace casimir::tools
