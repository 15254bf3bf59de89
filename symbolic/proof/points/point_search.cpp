#include "symbolic/proof/points/point_search.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "symbolic/algebra/rational_matrix.hpp"

namespace casimir {
namespace {

constexpr int kFreeTrials = 400;
constexpr int kLevelTrials = 4000;

/// A rational root of c0 + c1 x + c2 x^2 (higher coefficients: none is looked for).
bool rational_root(const std::vector<cln::cl_RA>& c, cln::cl_RA* root) {
  std::size_t degree = c.size();
  while (degree > 0 && cln::zerop(c[degree - 1])) --degree;
  if (degree == 2) {
    *root = -c[0] / c[1];
    return true;
  }
  if (degree != 3) return false;
  const cln::cl_RA discriminant = c[1] * c[1] - 4 * c[2] * c[0];
  cln::cl_RA square_root;
  if (cln::minusp(discriminant) || !cln::sqrtp(discriminant, &square_root)) return false;
  *root = (square_root - c[1]) / (2 * c[2]);
  return true;
}

/// (E - S)^-1 (E + S) of a skew S: orthogonal with determinant 1 (Cayley). Empty never happens.
std::optional<RationalMatrix> cayley(const RationalMatrix& skew) {
  const std::size_t n = skew.size();
  RationalMatrix result(n, std::vector<cln::cl_RA>(n, 0));
  for (std::size_t column = 0; column < n; ++column) {
    RationalMatrix equations;
    for (std::size_t i = 0; i < n; ++i) {
      equations.emplace_back();
      for (std::size_t j = 0; j < n; ++j) equations[i].push_back((i == j ? 1 : 0) - skew[i][j]);
      equations[i].push_back((i == column ? 1 : 0) + skew[i][column]);
    }
    const auto solution = solve_unique(std::move(equations));
    if (!solution) return std::nullopt;
    for (std::size_t i = 0; i < n; ++i) result[i][column] = (*solution)[i];
  }
  return result;
}

}  // namespace

cln::cl_RA PointSearch::draw() {
  std::uniform_int_distribution<int> numerators(-9, 9);
  std::uniform_int_distribution<int> denominators(1, 4);
  const int numerator = numerators(random_);
  return cln::cl_RA(numerator) / denominators(random_);
}

bool PointSearch::inside_assumptions(const Point& point) const {
  if (model_.assumptions.empty()) return true;
  GiNaC::exmap values;
  for (std::size_t i = 0; i < ring_.symbols().size(); ++i)
    values[ring_.symbols()[i]] = GiNaC::numeric(point[i]);
  return std::all_of(model_.assumptions.begin(), model_.assumptions.end(),
                     [&](const Assumption& a) { return a.holds_at(values, model_.limits); });
}

/// Rows of a random rotation, or reflection, scaled to the lengths.
bool PointSearch::draw_orthogonal(Point& point, const OrthogonalVectors& group,
                                  std::vector<bool>& fixed) {
  const std::size_t n = group.vectors[0].size();
  std::uniform_int_distribution<int> small(-3, 3);
  RationalMatrix skew(n, std::vector<cln::cl_RA>(n, 0));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      skew[i][j] = small(random_);
      skew[j][i] = -skew[i][j];
    }
  }
  const auto rotation = cayley(skew);
  if (!rotation) return false;
  const bool reflect = random_() % 2 == 0;
  for (std::size_t v = 0; v < group.vectors.size(); ++v) {
    cln::cl_RA length;
    const cln::cl_RA squared = group.squared_lengths[v].evaluate(point);
    if (cln::minusp(squared) || !cln::sqrtp(squared, &length)) return false;
    if (v == 0 && reflect) length = -length;
    for (std::size_t k = 0; k < n; ++k) {
      point[group.vectors[v][k]] = length * (*rotation)[v][k];
      fixed[group.vectors[v][k]] = true;
    }
  }
  return true;
}

/// Moves one coordinate so that the relation holds.
bool PointSearch::solve(Point& point, const Polynomial& relation, std::size_t variable) const {
  if (!relation.uses(variable) || relation.degree(variable) > 2) return false;
  std::vector<cln::cl_RA> values;
  for (const Polynomial& c : relation.coefficients(variable)) values.push_back(c.evaluate(point));
  return rational_root(values, &point[variable]);
}

/// Moves some coordinates so that the level's functions vanish: spheres and frames by a rotation,
/// the rest of a triangular set backwards, or each relation for a coordinate not yet moved.
bool PointSearch::solve_level(Point& point, const Level& level) {
  std::vector<bool> fixed(ring_.symbols().size());
  for (const OrthogonalVectors& group : level.orthogonal) {
    if (!draw_orthogonal(point, group, fixed)) return false;
  }
  const auto vanishes = [&](const Polynomial& f) { return cln::zerop(f.evaluate(point)); };
  const bool triangular =
      !level.solved.empty() && std::none_of(level.solved.begin(), level.solved.end(),
                                            [&](const auto& s) { return fixed[s.variable]; });
  if (triangular && random_() % 2 == 0) {
    for (auto it = level.solved.rbegin(); it != level.solved.rend(); ++it) {
      if (!solve(point, it->relation, it->variable)) return false;
    }
  } else {
    for (const Polynomial& f : level.numerators) {
      if (vanishes(f)) continue;
      std::vector<std::size_t> order(ring_.symbols().size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::shuffle(order.begin(), order.end(), random_);
      // Parameters are moved only where no coordinate will do; those of degree 1 always have a
      // root.
      std::stable_partition(order.begin(), order.end(),
                            [&](std::size_t i) { return f.degree(i) == 1; });
      std::stable_partition(order.begin(), order.end(),
                            [&](std::size_t i) { return i < dimension(); });
      const auto moved = std::find_if(order.begin(), order.end(), [&](std::size_t i) {
        return !fixed[i] && solve(point, f, i);
      });
      if (moved == order.end()) return false;
      fixed[*moved] = true;
    }
  }
  return std::all_of(level.numerators.begin(), level.numerators.end(), vanishes);
}

/// Sine and cosine of that angle for which the relation holds.
std::optional<std::pair<cln::cl_RA, cln::cl_RA>> PointSearch::solved_angle(
    Point point, const Polynomial& relation, std::size_t sine) {
  const long degree = relation.degree(sine) + relation.degree(sine + 1);
  constexpr long kMaxDegree = 12;
  if (degree <= 0 || degree > kMaxDegree) return std::nullopt;
  // (1 + t^2)^degree * relation is a polynomial in t, known by its values at enough points.
  RationalMatrix equations;
  for (long k = -degree; k <= degree; ++k) {
    const cln::cl_RA t = k;
    const cln::cl_RA length = 1 + t * t;
    point[sine] = 2 * t / length;
    point[sine + 1] = (1 - t * t) / length;
    equations.emplace_back();
    for (long power = 0; power <= 2 * degree; ++power)
      equations.back().push_back(cln::expt(t, cln::cl_I(power)));
    equations.back().push_back(relation.evaluate(point) * cln::expt(length, cln::cl_I(degree)));
  }
  const auto coefficients = solve_unique(std::move(equations));
  if (!coefficients) return std::nullopt;
  Polynomial in_t(ring_.ring());
  for (std::size_t k = 0; k < coefficients->size(); ++k)
    in_t += ring_.ring().variable(0).pow(k).scaled((*coefficients)[k]);
  // With t = tan(angle/2); a missing highest power is a root at infinity, the angle Pi.
  std::vector<std::pair<cln::cl_RA, cln::cl_RA>> roots;
  if (cln::zerop(coefficients->back())) roots.emplace_back(0, -1);
  if (in_t.is_zero()) return std::nullopt;
  for (const auto& [factor, times] : in_t.factors()) {
    if (factor.degree(0) != 1) continue;
    const auto parts = factor.coefficients(0);
    const cln::cl_RA t = -parts[0].evaluate(point) / parts[1].evaluate(point);
    roots.emplace_back(2 * t / (1 + t * t), (1 - t * t) / (1 + t * t));
  }
  if (roots.empty()) return std::nullopt;
  return roots[random_() % roots.size()];
}

/// Moves a random coordinate so that the relation holds.
bool PointSearch::solve_coordinate(Point& point, const Polynomial& relation) {
  std::vector<std::size_t> order(dimension());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), random_);
  return std::any_of(order.begin(), order.end(),
                     [&](std::size_t i) { return solve(point, relation, i); });
}

/// For relations that contain sines of plain angles: each is solved for one of them, or for a
/// coordinate. The caller checks the point: what is solved later may spoil what was solved before.
bool PointSearch::solve_angles(Point& point, const Level& level,
                               functions::PointCompleter::Freedom freedom) {
  std::vector<std::size_t> sines = functions::PointCompleter(ring_.table()).free_sines(freedom);
  std::shuffle(sines.begin(), sines.end(), random_);
  const auto draw_one = [this] { return draw(); };
  std::map<std::size_t, std::pair<cln::cl_RA, cln::cl_RA>> moved;
  for (const Polynomial& f : level.numerators) {
    if (cln::zerop(f.evaluate(point))) continue;
    const auto solved = std::find_if(sines.begin(), sines.end(), [&](std::size_t sine) {
      if (moved.contains(sine)) return false;
      const auto angle = solved_angle(point, f, sine);
      if (angle) moved[sine] = *angle;
      return angle.has_value();
    });
    if (solved == sines.end() && !solve_coordinate(point, f)) return false;
    // What does not depend on that angle keeps its value.
    freedom.angles = moved;
    for (const std::size_t sine : sines) {
      freedom.angles.try_emplace(sine, point[sine], point[sine + 1]);
    }
    if (!functions::PointCompleter(ring_.table()).complete(point, draw_one, freedom)) return false;
  }
  return true;
}

std::optional<Point> PointSearch::completed(const Level& level,
                                            const functions::PointCompleter::Freedom& freedom) {
  const int trials = level.empty() ? kFreeTrials : kLevelTrials;
  const bool functions_in_level =
      std::any_of(level.numerators.begin(), level.numerators.end(), [&](const Polynomial& f) {
        for (std::size_t g = ring_.symbols().size(); g < ring_.ring().size(); ++g) {
          if (f.uses(g)) return true;
        }
        return false;
      });
  for (int trial = 0; trial < trials; ++trial) {
    Point point(ring_.ring().size(), 0);
    for (std::size_t i = 0; i < ring_.symbols().size(); ++i) {
      // Functions whose arguments are not plain symbols have rational values at zero at best.
      const bool at_zero = !freedom.formal && !ring_.is_polynomial() && trial % 4 == 3;
      point[i] = at_zero && i < dimension() && freedom.bare[i] ? 0 : draw();
    }
    if (!level.empty() && !functions_in_level && !solve_level(point, level)) continue;
    if (!inside_assumptions(point)) continue;
    if (!functions::PointCompleter(ring_.table())
             .complete(
                 point, [this] { return draw(); }, freedom))
      continue;
    if (functions_in_level && !solve_angles(point, level, freedom)) continue;
    if (std::all_of(level.numerators.begin(), level.numerators.end(),
                    [&](const Polynomial& f) { return cln::zerop(f.evaluate(point)); }))
      return point;
  }
  return std::nullopt;
}

std::optional<Point> PointSearch::rational(const Level& level, int trials) {
  // Relations that contain generators cannot be solved for rational values of the symbols alone.
  for (const Polynomial& f : level.numerators) {
    for (std::size_t g = ring_.symbols().size(); g < ring_.ring().size(); ++g) {
      if (f.uses(g)) return std::nullopt;
    }
  }
  for (int trial = 0; trial < trials; ++trial) {
    Point point(ring_.ring().size(), 0);
    for (std::size_t i = 0; i < ring_.symbols().size(); ++i) point[i] = draw();
    if (!level.empty() && !solve_level(point, level)) continue;
    if (inside_assumptions(point)) return point;
  }
  return std::nullopt;
}

}  // namespace casimir
