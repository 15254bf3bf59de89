#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/certificate/ball_set.hpp"
#include "runtime/validated/contraction.hpp"
#include "runtime/validated_run.hpp"

namespace casimir::certificate {

/// What one integral says of a set: with its value c at the start and its gradient g over a convex
/// box with the set in it, g (x - m) = c - I(m) for each state x of the set (mean value theorem).
/// For x = m + C s + B r and the start m_0 + s with c = I(m_0) + g_0 s that is
///   (g B) r = I(m_0) - I(m) + (g_0 - g C) s,
/// which bounds each r_w whose factor is certain not to vanish. It holds as long as all solutions
/// have been certain to stay where the integral is analytic.
class LevelBound {
 public:
  /// \param bits  of the values, more than those of the sets.
  LevelBound(const KnownIntegral& integral, slong bits);

  const std::string& name() const { return integral_.name; }
  bool has_bounded() const { return bounded_; }

  /// Where the run begins: at the exact point, or in the set.
  void begin(const Vector& point, const BallSet& first, bool wide);
  bool usable() const { return usable_; }
  /// Whether it is certain to be analytic on a box that solutions go through, during these times.
  bool is_analytic_on(const Vector& box, const ArbBall& time);
  /// It was not analytic all along.
  void give_up() { usable_ = false; }
  /// Bounds a coordinate of a set. \return false where no state of the set is on the level.
  bool bound(BallSet& set, std::size_t which, const Vector& hull, const ArbBall& time);

 private:
  Vector gradient_over(const Vector& box, const ArbBall& time);

  const KnownIntegral& integral_;
  slong bits_;
  bool polynomial_, usable_ = true, bounded_ = false;
  validated::BallFunction<ArbBall> value_, gradient_;
  std::optional<validated::BallFunction<ArbBall>> exact_value_;
  ArbBall level_;
  Vector first_gradient_;
};

}  // namespace casimir::certificate
