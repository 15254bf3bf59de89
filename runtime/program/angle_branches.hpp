#pragma once

#include <functional>
#include <vector>

#include "runtime/evaluate.hpp"
#include "runtime/program.hpp"

namespace casimir {

/// An angle that a program computes by atan2, and that jumps where the motion crosses its cut.
struct Angle {
  std::size_t line;  ///< of the program
  /// What one branch differs from the next by, in units of Pi: 2; 1 where one of the arguments
  /// keeps its value, as in atan(u) = atan2(u, 1), whose branches meet where u is infinite.
  int half_turns;
};

/// The angles of a program that depend on its first `moving` inputs or on the last, the time.
std::vector<Angle> moving_angles(const Program& program, std::size_t moving);

/// For each output whether one of the angles goes into it.
std::vector<bool> with_angles(const Program& program, const std::vector<Angle>& angles);

/// As `evaluate`, with angles moved to other branches.
/// \param half_turns  called with the place of an angle and its principal value: what is added to
///                    it, in units of Pi
template <class Number, class HalfTurns>
std::vector<Number> evaluate_on_branches(
    const Program& program, const std::vector<Number>& inputs, const std::vector<Angle>& angles,
    const HalfTurns& half_turns, const Arithmetic<Number>& arithmetic = Arithmetic<Number>{}) {
  std::vector<Number> value;
  value.reserve(program.code.size());
  const auto at = [&](int i) -> const Number& { return value[static_cast<std::size_t>(i)]; };
  std::size_t next = 0;
  for (const Instruction& line : program.code) {
    if (line.op == Op::input)
      value.push_back(inputs[static_cast<std::size_t>(line.a)]);
    else if (is_literal(line))
      value.push_back(literal_value(program, line, arithmetic));
    else
      value.push_back(applied(line.op, at(line.a), at(line.b < 0 ? line.a : line.b), arithmetic));
    if (next == angles.size() || angles[next].line + 1 != value.size()) continue;
    const long turns = half_turns(next++, value.back());
    if (turns != 0)
      value.back() = value.back() + arithmetic.from(cln::cl_RA(turns)) * arithmetic.pi();
  }
  std::vector<Number> outputs;
  for (const int i : program.outputs) outputs.push_back(at(i));
  return outputs;
}

/// Follows the angles of a program along a motion, so that a function with many values, as
/// atan2(y, x) - w t, is compared with itself on one branch. Between two points an angle goes to
/// the branch that its rate of change at both leads to; where that is not clear, a point between
/// them is looked at. Whatever jumps for another reason keeps its jump.
class AngleFollower {
 public:
  using Rates = std::function<void(double t, const double* x, double* rates)>;
  using StateAt = std::function<void(double t, double* x)>;

  /// \param program  with the inputs of a right-hand side; must outlive the follower
  /// \param parameters  its inputs after the states
  AngleFollower(const Program& program, std::vector<double> parameters, Rates rates, double t,
                const std::vector<double>& x);

  /// Whether there is an angle to follow.
  bool follows() const { return !angles_.empty(); }

  /// To the end of a step.
  /// \param state_at  writes the state at a time in the step
  void advance(double t, const double* x, const StateAt& state_at);

  /// Puts those outputs in that have angles, at a state near the last one.
  void put(double t, const double* x, long double* outputs) const;

  const std::vector<Angle>& angles() const { return angles_; }

  /// What has to be added to the principal value of an angle near the last state, in units of Pi.
  long half_turns(std::size_t angle, double principal) const;

 private:
  struct Point {
    double time;
    std::vector<double> principal, rates;
    std::vector<double> angles;  ///< on the branches that are followed
  };
  Point point_at(double t, const double* x) const;
  void follow(const Point& from, Point& to, int halvings, const StateAt& state_at);
  bool is_clear(const Point& from, const Point& to, std::size_t angle) const;
  bool may_become_clear(const Point& from, const Point& to, std::size_t angle) const;
  void join(const Point& from, Point& to) const;

  const Program& program_;
  std::vector<double> parameters_;
  Rates rates_;
  std::size_t states_;
  std::vector<Angle> angles_;
  std::vector<bool> has_angles_;
  std::vector<double> literals_;  ///< of each line
  Point last_;
  int points_left_ = 0;
};

/// How each output differs from one point to another, where nothing is known of the way: for
/// A + c1 angle1 + c2 angle2 + .. with the same factors at both, as little as the branches allow;
/// else as it is. A change by a multiple of what the branches differ by is not seen.
/// \param first, last  inputs of the program
std::vector<long double> least_differences(const Program& program, const std::vector<Angle>& angles,
                                           const std::vector<long double>& first,
                                           const std::vector<long double>& last);

}  // namespace casimir
