#pragma once

#include <optional>
#include <vector>

#include "runtime/certificate/ball_set.hpp"
#include "runtime/certificate/level_bound.hpp"
#include "runtime/trace_check.hpp"
#include "runtime/validated/flow_piece.hpp"

namespace casimir::certificate {

/// A step to be verified.
struct StepClaim {
  const BallSet& before;
  const BallSet& after;
  ArbBall elapsed;  ///< since the start of the run
  ArbBall length;
  int room;
  const std::vector<int>& columns;
};

/// Verifies steps of one run: see `check_trace`.
class StepCheck {
 public:
  /// \param bounds            of the integrals; they and the flow must outlive this.
  /// \param with_derivatives  whether `derivatives` is wanted.
  StepCheck(const validated::FlowProgram& flow, std::vector<LevelBound>& bounds, int order,
            slong bits, bool forwards, bool with_derivatives);

  TraceFault operator()(const StepClaim& claim);

  /// Whether a function of one output is certain to be analytic on all solutions during the last
  /// step, which is proved: on a box around all of them, or on one for each part of the step.
  bool is_analytic(validated::BallFunction<ArbBall>& function, const StepClaim& claim) const;

  /// The derivatives of the state after the last step by that before it.
  const BallMatrix& derivatives() const { return whole_derivatives_; }

 private:
  template <class OnBox>
  bool holds_all_along(const OnBox& on_box, const StepClaim& claim) const;
  ArbBall time_of(const ArbBall& elapsed) const { return forwards_ ? elapsed : -elapsed; }
  ArbBall times_of(const StepClaim& claim) const;
  Vector states_at(const ArbBall& elapsed) const;
  bool stays_in_tube(const StepClaim& claim, const Vector& hull);
  int order_of_derivatives(const StepClaim& claim) const;
  void find_derivatives(const ArbBall& length);
  void find_whole_derivatives(const StepClaim& claim);
  TraceFault leads_inside(const StepClaim& claim, const ArbBall& time, int order);

  const validated::FlowProgram& flow_;
  std::vector<LevelBound>& bounds_;
  int order_, derivative_order_ = 0;
  slong bits_;
  bool forwards_;
  ArbSeries point_, box_, tube_;
  std::optional<ArbSeries> tube_jacobian_;  ///< where derivatives are wanted
  BallMatrix derivatives_;                  ///< of the Taylor polynomial
  BallMatrix whole_derivatives_;            ///< with the remainder
  Vector tube_box_, remainder_;
};

}  // namespace casimir::certificate
