#include "runtime/program/angle_branches.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/program/function_table.hpp"

namespace casimir {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A number and its derivative by the time.
struct Moving {
  double value, rate;
  friend Moving operator+(Moving a, Moving b) { return {a.value + b.value, a.rate + b.rate}; }
  friend Moving operator-(Moving a, Moving b) { return {a.value - b.value, a.rate - b.rate}; }
  friend Moving operator*(Moving a, Moving b) {
    return {a.value * b.value, a.rate * b.value + a.value * b.rate};
  }
  Moving operator-() const { return {-value, -rate}; }
};

}  // namespace

template <>
struct Arithmetic<Moving> {
  using N = Moving;
  using Real = Arithmetic<double>;
  static N from(const cln::cl_RA& value) { return {Real::from(value), 0}; }
  static N pi() { return {Real::pi(), 0}; }
  static N divide(N a, N b) {
    const double quotient = a.value / b.value;
    return {quotient, (a.rate - quotient * b.rate) / b.value};
  }
  static N sqrt(N a) {
    const double root = std::sqrt(a.value);
    return {root, a.rate / (2 * root)};
  }
  static N power(N a, N e) {  // of a constant exponent, see Op::pow
    return {std::pow(a.value, e.value), e.value * std::pow(a.value, e.value - 1) * a.rate};
  }
  static N function(Op op, N a) {
    const double value = Real::function(op, a.value);
    return {value, slope(op, a.value, value) * a.rate};
  }
  static N log(N a) { return {std::log(a.value), a.rate / a.value}; }
  static N asin(N a) { return {std::asin(a.value), a.rate / std::sqrt(1 - a.value * a.value)}; }
  static N acos(N a) { return {std::acos(a.value), -a.rate / std::sqrt(1 - a.value * a.value)}; }
  /// Both divided by the length of the point, whose square may overflow.
  static N atan2(N y, N x) {
    const double length = std::hypot(x.value, y.value), s = y.value / length, c = x.value / length;
    return {std::atan2(y.value, x.value), (c * y.rate - s * x.rate) / length};
  }
  static int sign(N a) { return Real::sign(a.value); }

 private:
  /// The derivative of a function that is an integral by its recurrence, at a place with its value.
  static double slope(Op op, double a, double value) {
    for (const SeriesStep& step : series_steps(op)) {
      if (own_slot(op, step.target) != Slot::value) continue;
      if (own_slot(op, step.by) == Slot::value) return step.sign * value;
      if (function_row(op).partner != op)
        return step.sign * Real::function(function_row(op).partner, a);
      return 1 + series_steps(op)[1].sign * (value * value);  // of tan and tanh
    }
    return 0;
  }
};

namespace {

/// For each line whether one of `sources` goes into it; they are lines themselves.
std::vector<bool> reached(const Program& program, std::vector<bool> sources) {
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    const Instruction& line = program.code[i];
    if (line.op == Op::input || is_literal(line)) continue;
    for (const int operand : {line.a, line.b})
      if (operand >= 0 && sources[static_cast<std::size_t>(operand)]) sources[i] = true;
  }
  return sources;
}

double period_of(const Angle& angle) { return angle.half_turns * kPi; }

}  // namespace

std::vector<Angle> moving_angles(const Program& program, std::size_t moving) {
  std::vector<bool> sources(program.code.size(), false);
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    const auto input = static_cast<std::size_t>(program.code[i].a);
    sources[i] =
        program.code[i].op == Op::input && (input < moving || input + 1 == program.inputs.size());
  }
  const std::vector<bool> moves = reached(program, sources);
  std::vector<Angle> angles;
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    const Instruction& line = program.code[i];
    if (line.op != Op::atan2 || !moves[i]) continue;
    const bool both =
        moves[static_cast<std::size_t>(line.a)] && moves[static_cast<std::size_t>(line.b)];
    angles.push_back({i, both ? 2 : 1});
  }
  return angles;
}

std::vector<bool> with_angles(const Program& program, const std::vector<Angle>& angles) {
  std::vector<bool> sources(program.code.size(), false);
  for (const Angle& angle : angles) sources[angle.line] = true;
  const std::vector<bool> lines = reached(program, sources);
  std::vector<bool> outputs;
  for (const int i : program.outputs) outputs.push_back(lines[static_cast<std::size_t>(i)]);
  return outputs;
}

AngleFollower::AngleFollower(const Program& program, std::vector<double> parameters, Rates rates,
                             double t, const std::vector<double>& x)
    : program_(program),
      parameters_(std::move(parameters)),
      rates_(std::move(rates)),
      states_(x.size()),
      angles_(moving_angles(program, x.size())),
      has_angles_(with_angles(program, angles_)) {
  if (!follows()) return;
  for (const Instruction& line : program.code)
    literals_.push_back(is_literal(line) ? literal_value(program, line, Arithmetic<double>{}) : 0);
  last_ = point_at(t, x.data());
  last_.angles = last_.principal;
}

AngleFollower::Point AngleFollower::point_at(double t, const double* x) const {
  std::vector<double> rates(states_);
  rates_(t, x, rates.data());
  std::vector<Moving> values;
  values.reserve(program_.code.size());
  const auto input = [&](std::size_t i) -> Moving {
    if (i < states_) return {x[i], rates[i]};
    if (i + 1 == program_.inputs.size()) return {t, 1};
    return {parameters_[i - states_], 0};
  };
  for (std::size_t i = 0; i < program_.code.size(); ++i) {
    const Instruction& line = program_.code[i];
    const auto operand = [&](int k) { return values[static_cast<std::size_t>(k)]; };
    if (line.op == Op::input)
      values.push_back(input(static_cast<std::size_t>(line.a)));
    else if (is_literal(line))
      values.push_back({literals_[i], 0});
    else
      values.push_back(applied(line.op, operand(line.a), operand(line.b < 0 ? line.a : line.b),
                               Arithmetic<Moving>{}));
  }
  Point point{t, {}, {}, {}};
  for (const Angle& angle : angles_) {
    point.principal.push_back(values[angle.line].value);
    point.rates.push_back(values[angle.line].rate);
  }
  return point;
}

/// Whether the rates at both ends tell how far the angle goes: it turns by less than a quarter of a
/// period, and to the branch that they lead to.
bool AngleFollower::is_clear(const Point& from, const Point& to, std::size_t k) const {
  const double period = period_of(angles_[k]), time = to.time - from.time;
  const double fastest = std::max(std::abs(from.rates[k]), std::abs(to.rates[k]));
  const double led = time * (from.rates[k] + to.rates[k]) / 2;
  const double gap = std::remainder(to.principal[k] - from.principal[k] - led, period);
  constexpr double kOff = 1. / 16;
  return std::abs(time) * fastest < period / 4 && std::abs(gap) < kOff * period;
}

/// Whether points in between could tell: not where the angle has no rates, as at the origin.
bool AngleFollower::may_become_clear(const Point& from, const Point& to, std::size_t k) const {
  return std::isfinite(from.principal[k]) && std::isfinite(to.principal[k]) &&
         (std::isfinite(from.rates[k]) || std::isfinite(to.rates[k]));
}

/// The angles of `to` on the branches of `from`. What jumps by something else than a period does
/// not go on smoothly: it keeps its jump.
void AngleFollower::join(const Point& from, Point& to) const {
  to.angles = from.angles;
  for (std::size_t k = 0; k < angles_.size(); ++k) {
    const double jump = to.principal[k] - from.principal[k];
    to.angles[k] += is_clear(from, to, k) ? std::remainder(jump, period_of(angles_[k])) : jump;
  }
}

void AngleFollower::follow(const Point& from, Point& to, int halvings, const StateAt& state_at) {
  // A step may be long for an angle although it is short for the states: its middle and quarters
  // are always looked at.
  constexpr int kAlways = 2, kMost = 40;
  bool enough = halvings >= kAlways;
  for (std::size_t k = 0; k < angles_.size() && enough; ++k)
    enough = is_clear(from, to, k) || !may_become_clear(from, to, k);
  const double middle = from.time + (to.time - from.time) / 2;
  if (enough || halvings == kMost || points_left_ == 0 || middle == from.time || middle == to.time)
    return join(from, to);
  --points_left_;
  std::vector<double> x(states_);
  state_at(middle, x.data());
  Point between = point_at(middle, x.data());
  follow(from, between, halvings + 1, state_at);
  follow(between, to, halvings + 1, state_at);
}

void AngleFollower::advance(double t, const double* x, const StateAt& state_at) {
  constexpr int kMostPoints = 4000;  // of a step: an angle that turns faster is not followed
  points_left_ = kMostPoints;
  Point to = point_at(t, x);
  follow(last_, to, 0, state_at);
  last_ = std::move(to);
}

long AngleFollower::half_turns(std::size_t k, double principal) const {
  const double branches = std::round((last_.angles[k] - principal) / period_of(angles_[k]));
  return std::isfinite(branches) ? static_cast<long>(branches) * angles_[k].half_turns : 0;
}

void AngleFollower::put(double t, const double* x, long double* outputs) const {
  std::vector<long double> inputs(x, x + states_);
  inputs.insert(inputs.end(), parameters_.begin(), parameters_.end());
  inputs.push_back(t);
  const std::vector<long double> values =
      evaluate_on_branches(program_, inputs, angles_, [this](std::size_t k, long double principal) {
        return half_turns(k, static_cast<double>(principal));
      });
  for (std::size_t i = 0; i < values.size(); ++i)
    if (has_angles_[i]) outputs[i] = values[i];
}

namespace {

/// The outputs with each angle so many branches on.
std::vector<long double> outputs_at(const Program& program, const std::vector<Angle>& angles,
                                    const std::vector<long double>& inputs,
                                    const std::vector<int>& branches) {
  return evaluate_on_branches(program, inputs, angles, [&](std::size_t k, long double) {
    return static_cast<long>(branches[k]) * angles[k].half_turns;
  });
}

/// The changes of the outputs from branch to branch: of each output by each angle. Empty for an
/// output in which they are not the sum of those of the single angles.
std::vector<std::optional<std::vector<long double>>> periods_at(
    const Program& program, const std::vector<Angle>& angles,
    const std::vector<long double>& inputs) {
  const std::vector<int> none(angles.size(), 0);
  const std::vector<long double> base = outputs_at(program, angles, inputs, none);
  std::vector<std::optional<std::vector<long double>>> result(base.size(),
                                                              std::vector<long double>{});
  std::vector<long double> sum = base, largest(base.size(), 0);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    std::vector<int> branches = none;
    branches[k] = 1;
    const std::vector<long double> moved = outputs_at(program, angles, inputs, branches);
    for (std::size_t i = 0; i < base.size(); ++i) {
      result[i]->push_back(moved[i] - base[i]);
      sum[i] += 3 * (moved[i] - base[i]);
      largest[i] = std::max(largest[i], std::abs(moved[i] - base[i]) + std::abs(base[i]));
    }
  }
  const std::vector<long double> all =
      outputs_at(program, angles, inputs, std::vector<int>(angles.size(), 3));
  constexpr long double kRounding = 1e-14L;
  for (std::size_t i = 0; i < base.size(); ++i)
    if (!(std::abs(all[i] - sum[i]) <= kRounding * largest[i])) result[i].reset();
  return result;
}

/// The largest number of which all are multiples; 0 where there is none but a tiny one.
long double common_measure(const std::vector<long double>& numbers) {
  long double measure = 0, largest = 0;
  for (const long double number : numbers) largest = std::max(largest, std::abs(number));
  constexpr long double kZero = 1e-12L, kTiny = 1e-3L;
  for (long double number : numbers) {
    number = std::abs(number);
    while (number > kZero * largest) {
      measure = std::fmod(measure, number);
      if (number - measure < kZero * largest) measure = 0;
      std::swap(measure, number);
    }
  }
  return measure < kTiny * largest ? 0 : measure;
}

}  // namespace

std::vector<long double> least_differences(const Program& program, const std::vector<Angle>& angles,
                                           const std::vector<long double>& first,
                                           const std::vector<long double>& last) {
  const std::vector<int> principal(angles.size(), 0);
  const std::vector<long double> before = outputs_at(program, angles, first, principal),
                                 after = outputs_at(program, angles, last, principal);
  std::vector<long double> differences;
  for (std::size_t i = 0; i < before.size(); ++i) differences.push_back(after[i] - before[i]);
  if (angles.empty()) return differences;
  const auto first_periods = periods_at(program, angles, first),
             last_periods = periods_at(program, angles, last);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!first_periods[i] || !last_periods[i]) continue;
    // The factor of an angle may be an integral itself, which a run keeps to its tolerance only.
    constexpr long double kSame = 1e-6L;
    bool same = true;
    for (std::size_t k = 0; k < angles.size(); ++k) {
      const long double a = (*first_periods[i])[k], b = (*last_periods[i])[k];
      same = same && std::abs(a - b) <= kSame * std::abs(a);
    }
    const long double period = same ? common_measure(*first_periods[i]) : 0;
    if (period > 0) differences[i] = std::remainder(differences[i], period);
  }
  return differences;
}

}  // namespace casimir
