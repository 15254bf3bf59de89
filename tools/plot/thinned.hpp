#pragma once

#include <string>
#include <utility>
#include <vector>

namespace casimir::tools {

/// Points of a curve in a picture.
using PicturePoints = std::vector<std::pair<double, double>>;

/// The same curve with fewer points: none of those left out is further than `apart` from the line
/// that stands for it.
PicturePoints thinned(const PicturePoints& points, double apart);

/// An SVG picture with its curves thinned so, and in coordinates of one decimal.
std::string with_thinned_paths(const std::string& svg, double apart);

/// An SVG picture of gnuplot in which many round marks of one colour and size are one path: each
/// place of a raster of half a unit has one.
std::string with_joined_marks(const std::string& svg);

}  // namespace casimir::tools
