#pragma once

#include <optional>
#include <vector>

#include "symbolic/proof/level.hpp"
#include "symbolic/proof/points/point_search.hpp"
#include "symbolic/proof/points/real_point.hpp"

namespace casimir {

/// Looks for a real point of a level inside every assumption at which the expressions have real
/// values, so that a claim about the level is a claim about something. The point is exact, or one
/// that Newton's method with balls proves to exist.
class RealLevelPoints {
 public:
  /// Borrows all.
  RealLevelPoints(const FunctionRing& ring, RealPoints& real, PointSearch& exact)
      : ring_(ring), real_(real), exact_(exact) {}

  /// \param differentiable  so that the expressions are, too, at the point
  std::optional<BallEvaluator> find(const Level& level, const std::vector<GiNaC::ex>& expressions,
                                    bool differentiable = false);

 private:
  std::optional<BallEvaluator> at_simple_point(const Level& level,
                                               const std::vector<GiNaC::ex>& expressions);
  std::optional<BallEvaluator> on(std::vector<GiNaC::ex> coordinates, const Level& level,
                                  const std::vector<GiNaC::ex>& expressions);
  std::optional<BallEvaluator> at_rational_point(const Level& level,
                                                 const std::vector<GiNaC::ex>& expressions);
  GiNaC::exmap values_of(const RealPoint& point) const;
  std::optional<BallEvaluator> near(const Level& level, const std::vector<GiNaC::ex>& start);

  bool admits(BallEvaluator& at, const std::vector<GiNaC::ex>& expressions) const;

  const FunctionRing& ring_;
  RealPoints& real_;
  PointSearch& exact_;
  bool differentiable_ = false;
};

}  // namespace casimir
