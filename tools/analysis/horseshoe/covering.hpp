#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/analysis/horseshoe/h_set.hpp"

namespace casimir::horseshoe {

// Covering relations of h-sets with one unstable direction (Zgliczynski & Gidea, J. Differential
// Equations 202 (2004) 32, definition 6 with u = s = 1).
//
// Let N and M be h-sets on the surface S (the plane on the level, where s increases), P the first
// return map, and F(a, b) = (y_1, y_2) the first two coordinates of P(the point of a, b of N) in
// the frame of M. What is asked of N => M:
//   (1) P is defined and continuous on all of N;
//   (2) y_1 < -1 on the edge a = -1 and y_1 > 1 on a = 1, or the other way round;
//   (3) at every point of N, |y_1| > 1 or |y_2| < 1;
//   (4) where |y_1| <= 1 may be, the other coordinates of P are in the box of M's sheet.
//
// (2) and (3) make F: [-1,1]^2 -> R^2 cover: the homotopy that first multiplies y_2 by a number
// that falls from 1 to 0, and then moves y_1 linearly to +-2 a, never meets [-1,1]^2 with an edge a
// = +-1 (there |y_1| > 1 throughout), and never meets [-1,1] x {-1, 1} with any point (where |y_1|
// <= 1, |y_2| < 1 throughout), and ends with the linear map a -> +-2 a. So it is a covering in the
// sense of the definition, of degree +-1. (4) says that a point of which F is in [-1,1]^2 is mapped
// into M itself and not to another sheet of S over the same coordinates: it is on S, and M has the
// only point with these coordinates in the box.
//
// Where each is checked: (1) by validated::SectionReturn, for the whole of each part; (2) to (4) by
// `Coverings::check`, which divides edges and sets into parts until each is decided.

/// How the proof of the coverings of one h-set ended.
struct CoveringOutcome {
  bool proved = false;
  std::string reason;     ///< where not: a sentence
  std::size_t parts = 0;  ///< images that were enclosed
};

/// What coverings are sought with.
struct CoveringSettings {
  std::size_t most_parts = 3000;  ///< of a set and its edges
  validated::ReturnSettings returns = {};
  std::function<bool()> give_up = {};
  /// Only for tests that have to see a false covering: leaves (2) out.
  bool without_edges = false;
  /// The same: leaves (4) out.
  bool without_sheet = false;
};

/// Proves covering relations, in balls of doubles, or of Arb's at the precision of the thread.
template <class Ball = validated::MidRad>
class Coverings {
 public:
  /// The system and the map must outlive this.
  Coverings(const SectionSystem& system, const NumericReturn& map, CoveringSettings settings = {});

  /// Whether an h-set covers all of these.
  CoveringOutcome check(const HSet& set, const std::vector<const HSet*>& targets);

  SurfaceChart<Ball>& chart() { return chart_; }

 private:
  /// What is certain of a part's image and a target.
  enum class Place { left, right, inside, unknown, missed };
  struct Image;
  struct Work;
  bool enclose(const HSet& set, const Patch& patch);
  Image image_in(const HSet& target) const;
  Place place_of(const Image& image, const HSet& target) const;
  bool edge(const HSet& set, const std::vector<const HSet*>& targets, double a, Work& work);
  bool body(const HSet& set, const std::vector<const HSet*>& targets, Work& work);
  bool may_go_on(Work& work) const;

  const NumericReturn& map_;
  CoveringSettings settings_;
  validated::FlowProgram flow_;
  std::vector<validated::Integral> integrals_;
  SurfaceChart<Ball> chart_;
  validated::SectionReturn<Ball> return_;
};

}  // namespace casimir::horseshoe
