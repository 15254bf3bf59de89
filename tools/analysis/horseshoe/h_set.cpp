#include "tools/analysis/horseshoe/h_set.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/step/dense.hpp"
#include "tools/analysis/proof/ball_matrix.hpp"

namespace casimir::horseshoe {
namespace {

using validated::approximate;
using validated::ArbBall;
using validated::contains;
using validated::MidRad;
using validated::outwards;
using validated::symmetric;
using validated::widened;

/// All numbers within `half` of a double.
template <class Ball>
Ball interval(double middle, double half) {
  return Ball(MidRad(middle, half));
}

/// The inverse of the doubles, in balls; nothing where it is not certain to exist.
std::optional<validated::Matrix<MidRad>> inverse_of(const validated::Matrix<double>& matrix) {
  BallMatrix exact(matrix.rows, matrix.columns), inverse(matrix.rows, matrix.columns);
  for (std::size_t i = 0; i < matrix.rows; ++i)
    for (std::size_t j = 0; j < matrix.columns; ++j) arb_set_d(exact.at(i, j), matrix(i, j));
  if (arb_mat_inv(inverse.raw(), exact.raw(), kBallBits) == 0) return std::nullopt;
  validated::Matrix<MidRad> result(matrix.rows, matrix.columns);
  for (std::size_t i = 0; i < matrix.rows; ++i)
    for (std::size_t j = 0; j < matrix.columns; ++j) {
      validated::ArbBall entry;
      arb_set(entry.raw(), inverse.at(i, j));
      result(i, j) = validated::outwards(entry);
    }
  return result;
}

template <class Ball>
Eigen::MatrixXd middles(const validated::Matrix<Ball>& matrix) {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(matrix.rows),
                         static_cast<Eigen::Index>(matrix.columns));
  for (std::size_t i = 0; i < matrix.rows; ++i)
    for (std::size_t j = 0; j < matrix.columns; ++j)
      result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          approximate(matrix(i, j));
  return result;
}

}  // namespace

/// The linear algebra of Krawczyk's operator over a part of an h-set.
template <class Ball>
struct SurfaceChart<Ball>::Region {
  Balls offset;                      ///< -Y G at the point (a, b, w) of the region
  validated::Matrix<Ball> by_patch;  ///< -Y G_{a,b}
  validated::Matrix<Ball> defect;    ///< I - Y G_w
  std::size_t count() const { return offset.size(); }
};

template <class Ball>
SurfaceChart<Ball>::SurfaceChart(const SectionSystem& system)
    : system_(system), constraints_(system.constraints), gradients_(system.gradients.program) {
  for (const RationalInterval& level : system.levels) {
    const Ball low = Arithmetic<Ball>::from(level.low), high = Arithmetic<Ball>::from(level.high);
    const Ball half = (high - low) * Ball(0.5);
    levels_.push_back(widened(low + half, symmetric(half)));
  }
}

template <class Ball>
std::optional<std::vector<Ball>> SurfaceChart<Ball>::values(const Balls& box) {
  Balls result = constraints_(box, Ball());
  for (std::size_t a = 0; a < levels_.size(); ++a) result[a + 1] = result[a + 1] - levels_[a];
  for (const Ball& value : result)
    if (!validated::is_usable(value)) return std::nullopt;
  return result;
}

template <class Ball>
validated::Matrix<Ball> SurfaceChart<Ball>::gradients(const Balls& box) {
  const Balls& entries = gradients_(box, Ball());
  validated::Matrix<Ball> result(levels_.size() + 1, box.size());
  for (std::size_t k = 0; k < entries.size(); ++k)
    result(static_cast<std::size_t>(system_.gradients.entries[k].second),
           static_cast<std::size_t>(system_.gradients.entries[k].first)) = entries[k];
  return result;
}

/// \param sheet  contains the w of all points.
/// \throws std::domain_error
template <class Ball>
typename SurfaceChart<Ball>::Region SurfaceChart<Ball>::region(const HSet& set, const Patch& patch,
                                                               const Balls& sheet,
                                                               const std::vector<double>& at) {
  const std::size_t n = set.states(), m = n - 2;
  Balls box(n), point(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Ball u(set.frame(i, 0)), v(set.frame(i, 1));
    box[i] = Ball(set.centre[i]) + u * interval<Ball>(patch.a, patch.half_a) +
             v * interval<Ball>(patch.b, patch.half_b);
    point[i] = Ball(set.centre[i]) + u * Ball(patch.a) + v * Ball(patch.b);
    for (std::size_t k = 0; k < m; ++k) {
      // The hull with `at`: derivatives are asked between the two.
      const Ball hull = contains(sheet[k], Ball(at[k]))
                            ? sheet[k]
                            : widened(sheet[k], Ball(at[k]) - middle_of(sheet[k]));
      box[i] = box[i] + Ball(set.frame(i, k + 2)) * hull;
      point[i] = point[i] + Ball(set.frame(i, k + 2)) * Ball(at[k]);
    }
  }
  // The functions have to be differentiable all over the box.
  if (!values(box)) throw std::domain_error("no value");
  const auto value = values(point);
  if (!value) throw std::domain_error("no value");
  const validated::Matrix<Ball> by_frame = product(gradients(box), set.frame);
  validated::Matrix<Ball> by_sheet(m, m), by_patch(m, 2);
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t k = 0; k < m; ++k) by_sheet(i, k) = by_frame(i, k + 2);
    for (std::size_t k = 0; k < 2; ++k) by_patch(i, k) = by_frame(i, k);
  }
  const Eigen::MatrixXd inverse = inverted(middles(by_sheet));
  if (!inverse.allFinite()) throw std::domain_error("the surface has no certain direction");
  validated::Matrix<double> y(m, m);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < m; ++k)
      y(i, k) = inverse(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
  Region result{product(y, *value), validated::Matrix<Ball>(m, 2), validated::Matrix<Ball>(m, m)};
  for (Ball& one : result.offset) one = -one;
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t k = 0; k < m; ++k)
        result.by_patch(i, j) = result.by_patch(i, j) - Ball(y(i, k)) * by_patch(k, j);
    for (std::size_t j = 0; j < m; ++j) {
      result.defect(i, j) = Ball(i == j ? 1. : 0.);
      for (std::size_t k = 0; k < m; ++k)
        result.defect(i, j) = result.defect(i, j) - Ball(y(i, k)) * by_sheet(k, j);
    }
  }
  return result;
}

template <class Ball>
bool SurfaceChart<Ball>::has_sheet(HSet& set, const std::vector<double>& half) {
  const std::size_t m = set.states() - 2;
  Balls sheet;
  for (const double one : half) sheet.push_back(interval<Ball>(0, one));
  try {
    const Region r = region(set, {}, sheet, std::vector<double>(m));
    Balls image = r.offset;
    for (std::size_t i = 0; i < m; ++i) {
      for (std::size_t j = 0; j < 2; ++j)
        image[i] = image[i] + r.by_patch(i, j) * interval<Ball>(0, 1);
      for (std::size_t k = 0; k < m; ++k) image[i] = image[i] + r.defect(i, k) * sheet[k];
    }
    set.within.clear();
    for (std::size_t i = 0; i < m; ++i) {
      // In the inside: in a box that is smaller.
      if (!contains(interval<Ball>(0, half[i] * 0.999), image[i])) return false;
      set.within.push_back(outwards(image[i]));
    }
    set.sheet = half;
    return true;
  } catch (const std::domain_error&) {
    return false;
  }
}

template <class Ball>
bool SurfaceChart<Ball>::find_sheet(HSet& set, double size) {
  // As wide as the test allows: images are looked for in it.
  for (double half = 0.25 * size; half > 1e-13 * size; half /= 2)
    if (has_sheet(set, std::vector<double>(set.states() - 2, half))) return true;
  return false;
}

template <class Ball>
std::optional<HSet> SurfaceChart<Ball>::proved(std::string name, const std::vector<double>& centre,
                                               const validated::Matrix<double>& frame,
                                               const std::vector<double>& sheet) {
  HSet set;
  set.name = std::move(name);
  set.centre = centre;
  set.frame = frame;
  const auto inverse = inverse_of(set.frame);
  if (!inverse) return std::nullopt;
  set.inverse = *inverse;
  if (!has_sheet(set, sheet)) return std::nullopt;
  return set;
}

template <class Ball>
std::optional<HSet> SurfaceChart<Ball>::embed(std::string name, const Eigen::VectorXd& centre,
                                              const Eigen::VectorXd& along,
                                              const Eigen::VectorXd& across,
                                              const NumericReturn& map) {
  const auto n = static_cast<std::size_t>(centre.size());
  HSet set;
  set.name = std::move(name);
  set.centre.assign(centre.data(), centre.data() + centre.size());
  set.frame = validated::Matrix<double>(n, n);
  const Eigen::MatrixXd gradients = map.gradients(centre);
  Eigen::MatrixXd columns(centre.size(), centre.size());
  columns.col(0) = along;
  columns.col(1) = across;
  columns.col(2) = map.rates(centre).normalized();
  for (Eigen::Index k = 1; k < gradients.cols(); ++k) columns.col(k + 2) = gradients.col(k);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const double length = k < 3 ? 1 : columns.col(column).norm();
      set.frame(i, k) = columns(static_cast<Eigen::Index>(i), column) / length;
    }
  if (!columns.allFinite()) return std::nullopt;
  const auto inverse = inverse_of(set.frame);
  if (!inverse) return std::nullopt;
  set.inverse = *inverse;
  if (!find_sheet(set, centre.norm())) return std::nullopt;
  return set;
}

/// On the patch, w - at = -Y G(point) - (Y G_{a,b}) d + (I - Y G_w) (w - at) with derivatives in
/// the enclosures (mean value theorem for each component), where d is the distance from the middle
/// of the patch: the middle of the second term is carried along, the rest is a box.
template <class Ball>
validated::AffineSet SurfaceChart<Ball>::part(const HSet& set, const Patch& patch) {
  const std::size_t n = set.states(), m = n - 2;
  Balls sheet;
  for (const MidRad& w : set.within) sheet.push_back(Ball(w));
  std::vector<double> at(m);
  Balls rest(m);
  validated::Matrix<double> slope(m, 2);
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    Region r = region(set, patch, sheet, at);
    const double half[] = {patch.half_a, patch.half_b};
    for (std::size_t i = 0; i < m; ++i) {
      rest[i] = r.offset[i];
      for (std::size_t k = 0; k < m; ++k)
        rest[i] = rest[i] + r.defect(i, k) * (sheet[k] - Ball(at[k]));
      Ball whole = Ball(at[i]) + rest[i];
      for (std::size_t j = 0; j < 2; ++j) {
        slope(i, j) = approximate(r.by_patch(i, j));
        const Ball by = interval<Ball>(0, half[j]);
        rest[i] = rest[i] + (r.by_patch(i, j) - Ball(slope(i, j))) * by;
        whole = whole + r.by_patch(i, j) * by;
      }
      rest[i] = rest[i] + Ball(at[i]);  // w less its slopes
      if (!validated::intersect(sheet[i], whole))
        throw std::domain_error("no point of the surface is in the set");
    }
    if (round + 2 < kRounds)
      for (std::size_t i = 0; i < m; ++i) at[i] = approximate(rest[i]);
  }
  validated::AffineSet result{std::vector<double>(n),
                              validated::Matrix<double>(n, 2),
                              {MidRad(0, patch.half_a), MidRad(0, patch.half_b)},
                              std::vector<MidRad>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    Ball middle = Ball(set.centre[i]) + Ball(set.frame(i, 0)) * Ball(patch.a) +
                  Ball(set.frame(i, 1)) * Ball(patch.b);
    Ball along[] = {Ball(set.frame(i, 0)), Ball(set.frame(i, 1))};
    for (std::size_t k = 0; k < m; ++k) {
      const Ball w(set.frame(i, k + 2));
      middle = middle + w * rest[k];
      for (std::size_t j = 0; j < 2; ++j) along[j] = along[j] + w * Ball(slope(k, j));
    }
    result.middle[i] = approximate(middle);
    Ball off = middle - Ball(result.middle[i]);
    for (std::size_t j = 0; j < 2; ++j) {
      result.directions(i, j) = approximate(along[j]);
      off = off + (along[j] - Ball(result.directions(i, j))) * Ball(result.along[j]);
    }
    result.rest[i] = symmetric(outwards(off));
  }
  return result;
}

template <class Ball>
bool SurfaceChart<Ball>::disjoint(const HSet& one, const HSet& other) const {
  // The box of `one` in the coordinates of `other`.
  const std::size_t n = one.states();
  for (std::size_t k = 0; k < n; ++k) {
    Ball place;
    for (std::size_t i = 0; i < n; ++i)
      place = place + Ball(other.inverse(k, i)) * (Ball(one.centre[i]) - Ball(other.centre[i]));
    for (std::size_t j = 0; j < n; ++j) {
      Ball factor;
      for (std::size_t i = 0; i < n; ++i)
        factor = factor + Ball(other.inverse(k, i)) * Ball(one.frame(i, j));
      place = place + factor * Ball(j < 2 ? MidRad(0, 1) : one.within[j - 2]);
    }
    if (!validated::is_usable(place)) continue;
    const Ball own(k < 2 ? MidRad(0, 1) : other.within[k - 2]);
    if (!validated::contains_zero(place - own)) return true;
  }
  return false;
}

template class SurfaceChart<MidRad>;
template class SurfaceChart<ArbBall>;

}  // namespace casimir::horseshoe
