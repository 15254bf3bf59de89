#include "tools/plot/colour_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/cli/errors.hpp"
#include "tools/cli/output.hpp"
#include "tools/plot/gnuplot.hpp"

namespace casimir::tools {
namespace {

constexpr ScreenSize kScreen{760, 620, 13};

/// From dark to light in equal steps of lightness, as matplotlib's viridis (van der Walt, Smith).
constexpr const char* kPalette =
    "0 '#440154', 0.125 '#472d7b', 0.25 '#3b528b', 0.375 '#2c728e', 0.5 '#21918c', 0.625 "
    "'#28ae80', 0.75 '#5ec962', 0.875 '#addc30', 1 '#fde725'";

/// White is what has no value.
constexpr const char* kGreys = "0 '#101010', 1 '#e4e4e4'";

/// Whether neighbours are equally far apart, to rounding.
bool is_even(const std::vector<double>& x) {
  constexpr double kRounding = 1e-6;
  const double step = (x.back() - x.front()) / static_cast<double>(x.size() - 1);
  for (std::size_t i = 1; i < x.size(); ++i)
    if (std::abs(x[i] - x[i - 1] - step) > kRounding * std::abs(step)) return false;
  return true;
}

/// The edges of the cells: halfway between the middles, and as far beyond the outermost.
std::vector<double> edges_of(const std::vector<double>& x) {
  std::vector<double> edges{x[0] - (x[1] - x[0]) / 2};
  for (std::size_t i = 1; i < x.size(); ++i) edges.push_back((x[i - 1] + x[i]) / 2);
  edges.push_back(x.back() + (x.back() - x[x.size() - 2]) / 2);
  return edges;
}

std::string cell_value(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : "NaN";
}

/// A line for each cell: its middle and value, or its middle, edges and value.
std::string cells(const ColourMap& map, bool even) {
  const std::vector<double> across = edges_of(map.x), up = edges_of(map.y);
  std::string text;
  for (std::size_t j = 0; j < map.y.size(); ++j) {
    for (std::size_t i = 0; i < map.x.size(); ++i) {
      const double value = map.values[i * map.y.size() + j];
      if (even)
        text += fmt::format("{:.12g} {:.12g} {}\n", map.x[i], map.y[j], cell_value(value));
      else if (std::isfinite(value))
        text +=
            fmt::format("{:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {}\n", map.x[i], map.y[j],
                        across[i], across[i + 1], up[j], up[j + 1], cell_value(value));
    }
  }
  return text;
}

/// The range of the colours: from the least to the largest, or about the only value.
std::string colour_range(const ColourMap& map) {
  double least = HUGE_VAL, largest = -HUGE_VAL;
  for (const double value : map.values) {
    if (!std::isfinite(value)) continue;
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
  if (!(least < largest)) {
    const double middle = std::isfinite(least) ? least : 0;
    const double beside = std::max(std::abs(middle) / 10, 1e-3);
    least = middle - beside;
    largest = middle + beside;
  }
  return fmt::format("set cbrange [{:.9g}:{:.9g}]\n", least, largest);
}

std::string script(const ColourMap& map, const Sheet& sheet, const std::string& output) {
  const Print& print = sheet.print;
  const bool even = is_even(map.x) && is_even(map.y);
  const std::vector<double> across = edges_of(map.x), up = edges_of(map.y);
  std::string text = fmt::format("set encoding utf8\nset terminal {}\nset output {}\nunset key\n",
                                 terminal_of(sheet, kScreen), quoted_path(output));
  if (!map.title.empty() && print.title)
    text += fmt::format("set title {} noenhanced\n",
                        quoted_lines(map.title, letters_across(print, 0.8), sheet));
  text += fmt::format(
      "set xlabel {} noenhanced\nset ylabel {} noenhanced\nset cblabel {} noenhanced\n",
      quoted(map.x_label, sheet), quoted(map.y_label, sheet), quoted(map.quantity, sheet));
  text += fmt::format("set palette defined ({})\n", print.monochrome ? kGreys : kPalette);
  // gnuplot leaves no room for what stands beside long numbers.
  if (is_narrow(print)) text += "set rmargin at screen 0.74\n";
  text += fmt::format("set xrange [{:.12g}:{:.12g}]\nset yrange [{:.12g}:{:.12g}]\n{}",
                      across.front(), across.back(), up.front(), up.back(), colour_range(map));
  text += "set tics out nomirror\n$cells << EOD\n" + cells(map, even) + "EOD\n";
  const bool any =
      std::ranges::any_of(map.values, [](double value) { return std::isfinite(value); });
  if (!any)
    text += "plot 1/0\n";
  else if (even)
    text += "plot $cells using 1:2:3 with image\n";
  else
    text += "plot $cells using 1:2:3:4:5:6:7 with boxxyerror fillstyle solid noborder lc palette\n";
  return text;
}

}  // namespace

void check_cells(const std::vector<double>& x, const std::vector<double>& y) {
  constexpr std::size_t kMostUnequalCells = 40'000;
  const std::size_t cells = x.size() * y.size();
  if (cells > kMostUnequalCells && !(is_even(x) && is_even(y)))
    throw UsageError(fmt::format(
        "a picture of {} cells needs values at equal distances, as NAME=FROM:TO:N has them",
        cells));
}

void draw(const ColourMap& map, const Sheet& sheet) {
  check_cells(map.x, map.y);
  draw_sheet(sheet, [&](const std::string& output) { return script(map, sheet, output); });
}

}  // namespace casimir::tools
