#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/analysis/section/level_set.hpp"

namespace casimir {

/// A point of the level set with its place in the picture.
struct PlacedPoint {
  LevelSet::Vector x;
  std::array<double, 2> place;
};

/// Which of these points an orbit returns from.
using Returning = std::function<std::vector<bool>(const std::vector<PlacedPoint>&)>;

/// Points all over the domain of possible motion, as the section shows it, that orbits return from.
///
/// Random points are moved to the level set; from those that lie in the sparsest parts of the
/// picture so far, others are sought in random directions along the level set. The same in every
/// run. They are of the scene's size; where orbits return from none of these, of other powers of
/// ten: a level of another energy may lie far away.
/// \param known  points of the level set, or near it, to begin with.
std::vector<PlacedPoint> points_of_domain(const LevelSet& level, const Returning& returning,
                                          const std::vector<LevelSet::Vector>& known);

/// Places in the picture: values of the plotted pair.
using PicturePlaces = std::vector<std::array<double, 2>>;

/// So many of the points, each as far as possible from those chosen before it, by their places in
/// the picture. The first is in the middle, or as far as possible from what is `taken`.
std::vector<PlacedPoint> spread_out(const LevelSet& level, const std::vector<PlacedPoint>& points,
                                    std::size_t count, const PicturePlaces& taken = {});

/// The same number of points, each moved to the middle of the part of the domain that is nearest to
/// it (Lloyd's iteration): away from the rim, where a section shows little.
std::vector<PlacedPoint> centred(const LevelSet& level, const std::vector<PlacedPoint>& points,
                                 std::vector<PlacedPoint> chosen);

/// Why no points were found, a sentence: no motion of this level crosses the plane, and which
/// energies occur where the plane meets the Casimir level; or motions do where the plotted pair has
/// no values.
std::string why_no_points(const LevelSet& level);

}  // namespace casimir
