#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace casimir::tools {

/// A picture that is drawn for a page, as small as it can be: letters are legible on a telephone,
/// colours are variables of the page, and points that would coincide are one.
struct Chart {
  struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points;
    int colour = 0;  ///< 1 to 12; 0: one after the other; negative: grey
  };
  std::string name;  ///< letters, digits and '-': before every identifier
  std::string title, x_label = {}, y_label = {};
  std::vector<Curve> curves = {};
  bool dots = false;    ///< points that no line joins
  bool legend = true;   ///< the names of the curves above it
  double height = 150;  ///< of the frame; the width is kChartWidth
  std::optional<std::array<double, 2>> x_range = {}, y_range = {};  ///< else that of the points
};

/// Units of the picture: of it, and of the letters in it.
inline constexpr double kChartWidth = 460, kChartLetters = 13;

/// As an SVG element.
std::string chart_svg(const Chart& chart);

/// A picture without words, of 120 by 90: for a list.
std::string thumbnail_svg(const Chart& chart);

/// Round values between two, some five of them.
std::vector<double> round_values(double from, double to);

}  // namespace casimir::tools
