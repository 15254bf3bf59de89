#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/validated/section_return.hpp"
#include "tools/analysis/horseshoe/numeric_return.hpp"

namespace casimir::horseshoe {

/// A parallelogram on the surface and the level, in coordinates of its own: the point of a and b in
/// [-1, 1] is
///   centre + a U + b V + sum_k w_k W_k
/// with the only w in the box `sheet` for which it lies on the surface and the level. U points
/// along the unstable direction, V along the stable one, W_1 along the flow, the other W_k along
/// the gradients.
struct HSet {
  std::string name;
  std::vector<double> centre;
  validated::Matrix<double> frame;               ///< the columns U, V, W_1, ..: exact numbers
  validated::Matrix<validated::MidRad> inverse;  ///< of the frame
  std::vector<double> sheet;                     ///< half widths of the box of w
  std::vector<validated::MidRad> within;         ///< contains the w of all points

  std::size_t states() const { return centre.size(); }
};

/// An interval of each coordinate.
struct Patch {
  double a = 0, half_a = 1, b = 0, half_b = 1;
};

/// Puts h-sets onto the surface and the level.
///
/// Theorem (Krawczyk, with a and b as parameters). Let G(a, b, w) be the values of the surface's
/// and the level's functions there less those wanted. If on the box [-1,1]^2 x W
///   K = -Y G(0,0,0) - (Y G_{a,b}) [-1,1]^2 + (I - Y G_w) W
/// lies in the inside of W, then for each a and b there is exactly one w in W with G = 0; it lies
/// in K, and depends continuously on a and b (implicit function theorem: G_w is regular on the
/// box). Checked in `embed`, with enclosures of the derivatives over the box; that the functions
/// are differentiable there is asked of the arithmetic, which refuses all else.
/// In balls of doubles, or of Arb's at the precision of the thread.
template <class Ball>
class SurfaceChart {
 public:
  /// The system must outlive this.
  explicit SurfaceChart(const SectionSystem& system);

  /// Makes an h-set with this frame; nothing where it cannot be shown to lie on the surface.
  /// \param along, across  U and V; their lengths are the half sizes.
  std::optional<HSet> embed(std::string name, const Eigen::VectorXd& centre,
                            const Eigen::VectorXd& along, const Eigen::VectorXd& across,
                            const NumericReturn& map);

  /// An h-set of which somebody says that it is one: nothing where the frame has no certain inverse
  /// or the set cannot be shown to lie on the surface, with one point for each a and b.
  /// \param sheet  half widths of the box of w.
  std::optional<HSet> proved(std::string name, const std::vector<double>& centre,
                             const validated::Matrix<double>& frame,
                             const std::vector<double>& sheet);

  /// The points of a part of an h-set, and others beside them.
  validated::AffineSet part(const HSet& set, const Patch& patch);

  /// Whether two h-sets have no point in common, certainly.
  bool disjoint(const HSet& one, const HSet& other) const;

 private:
  using Balls = std::vector<Ball>;
  struct Region;
  Region region(const HSet& set, const Patch& patch, const Balls& sheet,
                const std::vector<double>& at);
  std::optional<Balls> values(const Balls& box);
  validated::Matrix<Ball> gradients(const Balls& box);
  bool find_sheet(HSet& set, double size);
  bool has_sheet(HSet& set, const std::vector<double>& half);

  const SectionSystem& system_;
  validated::BallFunction<Ball> constraints_, gradients_;
  Balls levels_;
};

}  // namespace casimir::horseshoe
