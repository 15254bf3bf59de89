#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "runtime/integrate.hpp"
#include "runtime/program.hpp"
#include "runtime/program/interpreter.hpp"

namespace casimir {

/// Carries deviations over places at which a right-hand side f jumps, as those with sign(g) do.
///
/// The variational equations know nothing of a jump. The motion beside comes to the place where g
/// vanishes by dt = -(grad g . delta)/(dg/dt) later, dg/dt by the rates f- before it, and goes by
/// f- instead of the rates f+ behind it until then. So there
///
///   delta+ = delta- + (f+ - f-) (grad g . delta-)/(dg/dt)
///
/// (Mueller: Calculation of Lyapunov exponents for dynamic systems with discontinuities, Chaos,
/// Solitons & Fractals 5 (1995) 1671). It assumes that the motion crosses the place, at a speed
/// that is not zero on either side, and one such place at a time; and that a step ends just behind
/// it. Where one of these does not hold, what becomes of the deviations is not known.
///
/// Jumps are those of sign, which roots of squares in a program are made of, and of the angle of a
/// point at its cut. Others, as of exp(log(u^2)/2)/u, are not seen.
///
/// Holds exact numbers, so it is made where no other thread makes any; one object serves one thread
/// at a time.
class Saltation {
 public:
  /// On which side of each place a motion is: 1 or -1; 0 before it has been on one.
  using Sides = std::vector<int>;

  /// \param rhs  of the states alone, with the inputs of a right-hand side
  explicit Saltation(const Program& rhs);

  /// Whether the rates jump where a sign or an angle in them does, at some of several points that
  /// were looked at: those of sign(x)*sin(x), or of the sine of an angle, do not.
  bool needed() const { return !jumps_.empty(); }

  /// Another motion begins, or one that was on these sides.
  void begin(const Sides& sides = {});
  /// Where the motion is, for `begin`.
  const Sides& sides() const { return sides_; }

  /// A step of the states and the deviations behind them, of the same size each.
  /// \param x  at the end; the deviations are changed where it has passed a jump
  /// \param size  of the states and all deviations
  /// \param parameters  null if there are none
  StepChange operator()(const TakenStep& step, double* x, std::size_t size,
                        const double* parameters);

  /// The same for a run with these parameters; empty where nothing jumps. Borrows both.
  AfterStep hook(const std::vector<double>& parameters, std::size_t size);

 private:
  /// Of sign(u), or of the angle of (v, u), which jumps where v < 0.
  struct Jump {
    std::size_t place;  ///< of u among the outputs of the arguments; v is the next
    bool is_angle;
  };
  /// One that a step has come to.
  struct Passed {
    std::size_t jump;
    int before;   ///< the side
    bool behind;  ///< whether the step ends behind it, or on it
  };

  bool is_real(const Program& rhs, std::size_t line, const Jump& jump);
  double argument(std::size_t place, double t, const double* x);
  double slope(std::size_t place, double t, const double* x, const double* along, double of_time);
  std::vector<double> rates(double t, const double* x);
  std::vector<Passed> passed_in(const TakenStep& step, const double* x);
  bool are_on_side(const std::vector<Passed>& passed, bool before, double t, const double* x);
  std::vector<double> rates_before(const std::vector<Passed>& passed, const TakenStep& step,
                                   const double* x, std::size_t size);
  std::vector<double> rates_behind(const std::vector<Passed>& passed, const TakenStep& step,
                                   const double* x, const std::vector<double>& before);
  StepChange carry(const std::vector<Passed>& passed, const TakenStep& step, double* x,
                   std::size_t size);

  std::size_t states_;
  std::vector<Jump> jumps_;
  Sides sides_;
  std::optional<Interpreter> rates_, arguments_;  ///< none where nothing jumps
  /// The arguments, and their derivatives along a change of state and time.
  std::optional<Interpreter> slopes_;
  std::vector<double> inputs_, slope_inputs_, values_;
};

}  // namespace casimir
