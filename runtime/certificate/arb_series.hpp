#pragma once

#include <vector>

#include "runtime/program.hpp"
#include "runtime/validated/arb_ball.hpp"

namespace casimir::certificate {

using validated::ArbBall;
using Vector = std::vector<ArbBall>;

/// Taylor coefficients of solutions of dx/dt = program(x, t) in Arb's balls, by recurrences written
/// for verification alone: nothing here is shared with the kernels of `runtime/kernels` or with the
/// recurrences of `runtime/program`. All coefficients hold for every state and time of the balls
/// that they are expanded at; where an operation is not certain to be analytic there it is refused.
class ArbSeries {
 public:
  /// \param program  a right-hand side: its inputs are the states and the time; must outlive this.
  /// \param order    of the highest coefficient of the states.
  /// \param bits     of the arithmetic.
  ArbSeries(const Program& program, int order, slong bits);

  /// Coefficients of x(t + h) for a time that runs forwards, of x(t - h) backwards.
  /// \throws std::domain_error
  void expand(const ArbBall& time, const Vector& states, bool forwards) {
    expand(time, states, forwards, order_);
  }
  /// The same up to this order alone: those beyond have no meaning.
  void expand(const ArbBall& time, const Vector& states, bool forwards, int order);

  /// Those of a state: order + 1 of them.
  const Vector& state(std::size_t i) const { return states_[i]; }
  /// Those of a line of the program, all but the last one.
  const Vector& line(int i) const { return lines_[static_cast<std::size_t>(i)]; }
  /// Whether all but the first are zero because the line is free of states and time.
  bool is_constant(int i) const { return constant_[static_cast<std::size_t>(i)]; }

 private:
  void begin(std::size_t i, const ArbBall& time);
  void extend(std::size_t i, int k, bool forwards);
  void extend_input(std::size_t i, int k, bool forwards);
  void extend_function(std::size_t i, int k);
  void extend_arc(std::size_t i, int k);
  void extend_angle(std::size_t i, int k);

  const Program& program_;
  int order_;
  slong bits_;
  std::vector<bool> constant_;
  bool constants_known_ = false;
  std::vector<Vector> states_, lines_;
  std::vector<Vector> helper_;  ///< for each line another series that its recurrence needs
  std::vector<Vector> root_;    ///< .. and of arcs and tangents one more
  ArbBall sum_;
};

}  // namespace casimir::certificate
