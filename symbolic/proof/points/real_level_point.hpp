#pragma once

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

  bool exists(const Level& level, const std::vector<GiNaC::ex>& expressions);

 private:
  bool at_simple_point(const Level& level, const std::vector<GiNaC::ex>& expressions);
  bool is_on(std::vector<GiNaC::ex> coordinates, const Level& level,
             const std::vector<GiNaC::ex>& expressions);
  bool at_rational_point(const Level& level, const std::vector<GiNaC::ex>& expressions);
  GiNaC::exmap values_of(const RealPoint& point) const;
  bool near(const Level& level, const std::vector<GiNaC::ex>& start,
            const std::vector<GiNaC::ex>& expressions);

  const FunctionRing& ring_;
  RealPoints& real_;
  PointSearch& exact_;
};

}  // namespace casimir
