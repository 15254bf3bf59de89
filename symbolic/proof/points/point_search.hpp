#pragma once

#include <optional>
#include <random>
#include <vector>

#include "symbolic/functions/function_ring.hpp"
#include "symbolic/functions/point_completer.hpp"
#include "symbolic/model.hpp"
#include "symbolic/proof/level.hpp"

namespace casimir {

/// A point of a ring: the values of its symbols, and of its generators once it is completed.
using Point = std::vector<cln::cl_RA>;

/// Random exact points of a case. Deterministic: the numbers come from a fixed seed.
class PointSearch {
 public:
  /// Borrows both.
  PointSearch(const Model& model, const FunctionRing& ring) : model_(model), ring_(ring) {}

  /// A completed point at which no denominator vanishes, every assumption holds and the level's
  /// functions are zero; empty if none was found.
  std::optional<Point> completed(const Level& level,
                                 const functions::PointCompleter::Freedom& freedom);

  /// The same with rational values of the symbols alone: the functions of the ring may have any
  /// values there.
  std::optional<Point> rational(const Level& level, int trials = 400);

  /// Whether every assumption of the case holds where the symbols have these values.
  bool inside_assumptions(const Point& point) const;

 private:
  std::size_t dimension() const { return model_.variables.size(); }
  cln::cl_RA draw();
  bool draw_orthogonal(Point& point, const OrthogonalVectors& group, std::vector<bool>& fixed);
  bool solve(Point& point, const Polynomial& relation, std::size_t variable) const;
  bool solve_coordinate(Point& point, const Polynomial& relation);
  bool solve_level(Point& point, const Level& level);
  bool solve_angles(Point& point, const Level& level, functions::PointCompleter::Freedom freedom);
  std::optional<std::pair<cln::cl_RA, cln::cl_RA>> solved_angle(Point point,
                                                                const Polynomial& relation,
                                                                std::size_t sine);

  const Model& model_;
  const FunctionRing& ring_;
  std::mt19937 random_{20190101};
};

}  // namespace casimir
