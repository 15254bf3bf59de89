#include "tools/analysis/estimate/saltation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "codegen/optimise/differentiate.hpp"

namespace casimir {
namespace {

/// The arguments of the functions that jump, with the time behind the states, as one more of them.
Program with_time_first(Program arguments, std::size_t states) {
  const std::size_t last = arguments.inputs.size() - 1;
  std::rotate(arguments.inputs.begin() + static_cast<std::ptrdiff_t>(states),
              arguments.inputs.end() - 1, arguments.inputs.end());
  for (Instruction& line : arguments.code) {
    if (line.op != Op::input) continue;
    const auto input = static_cast<std::size_t>(line.a);
    if (input == last)
      line.a = static_cast<int>(states);
    else if (input >= states)
      ++line.a;
  }
  return arguments;
}

/// The rates with the value of a line as one more input, the last.
Program with_value_given(Program rhs, std::size_t line) {
  rhs.code[line] = {Op::input, static_cast<int>(rhs.inputs.size())};
  rhs.inputs.emplace_back("value");
  return rhs;
}

double largest(const double* x, std::size_t n) {
  double result = 0;
  for (std::size_t i = 0; i < n; ++i) result = std::max(result, std::abs(x[i]));
  return result;
}

/// Whether a part of these is more than rounding of them.
bool differ(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kRounding = 1e-8;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(std::abs(a[i] - b[i]) <= kRounding * (std::abs(a[i]) + std::abs(b[i])))) return true;
  return false;
}

/// Of a step: in less rounding does not tell the sides of a place apart.
constexpr double kLeastPart = 1e-9;

/// What is no time beside that of the step.
double resolved_time(const TakenStep& step) {
  constexpr double kRoundings = 64 * std::numeric_limits<double>::epsilon();
  return kRoundings * std::max(std::abs(step.t1), std::abs(step.t1 - step.t0));
}

int side_of(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

}  // namespace

Saltation::Saltation(const Program& rhs) : states_(rhs.outputs.size()) {
  Program arguments = rhs;
  arguments.outputs.clear();
  std::vector<std::size_t> lines;
  for (std::size_t i = 0; i < rhs.code.size(); ++i) {
    const Instruction& line = rhs.code[i];
    const bool is_angle = line.op == Op::atan2;
    if (!is_angle && line.op != Op::sign) continue;
    jumps_.push_back({arguments.outputs.size(), is_angle});
    lines.push_back(i);
    arguments.outputs.push_back(line.a);
    if (is_angle) arguments.outputs.push_back(line.b);
  }
  if (jumps_.empty()) return;
  arguments.output_names.assign(arguments.outputs.size(), "u");
  rates_.emplace(rhs);
  arguments_.emplace(arguments);
  slopes_.emplace(codegen::variational(with_time_first(arguments, states_), states_ + 1));
  inputs_.resize(rhs.inputs.size());
  slope_inputs_.resize(rhs.inputs.size() + states_ + 1);
  values_.resize(2 * arguments.outputs.size());
  std::vector<Jump> real;
  for (std::size_t k = 0; k < jumps_.size(); ++k)
    if (is_real(rhs, lines[k], jumps_[k])) real.push_back(jumps_[k]);
  jumps_ = std::move(real);
  begin();
}

void Saltation::begin(const Sides& sides) {
  sides_ = sides;
  sides_.resize(jumps_.size(), 0);
}

/// Whether the rates differ between both values of the function, at points of the place that are
/// found by Newton's method from random ones. Where there are too few of these, it may be so.
bool Saltation::is_real(const Program& rhs, std::size_t line, const Jump& jump) {
  constexpr int kStarts = 60, kRounds = 40, kPoints = 6;
  const Interpreter given(with_value_given(rhs, line));
  const double value = jump.is_angle ? std::acos(-1.) : 1;
  std::mt19937 random(20261130);
  std::uniform_real_distribution<double> number(-2, 2);
  int points = 0;
  for (int start = 0; start < kStarts && points < kPoints; ++start) {
    for (double& input : inputs_) input = number(random);
    std::vector<double> x(inputs_.begin(), inputs_.begin() + static_cast<std::ptrdiff_t>(states_));
    const double t = inputs_.back();
    const auto argument_there = [&] { return argument(jump.place, t, x.data()); };
    std::vector<double> gradient(states_);
    for (int round = 0; round < kRounds && std::abs(argument_there()) > 1e-14; ++round) {
      double square = 0;
      for (std::size_t i = 0; i < states_; ++i) {
        std::vector<double> unit(states_, 0.);
        unit[i] = 1;
        gradient[i] = slope(jump.place, t, x.data(), unit.data(), 0);
        square += gradient[i] * gradient[i];
      }
      const double u = argument_there();
      for (std::size_t i = 0; i < states_; ++i) x[i] -= u * gradient[i] / square;
    }
    if (!(std::abs(argument_there()) <= 1e-12)) continue;
    if (jump.is_angle && !(argument(jump.place + 1, t, x.data()) < 0)) continue;
    std::vector<double> inputs(x);
    inputs.insert(inputs.end(), inputs_.begin() + static_cast<std::ptrdiff_t>(states_),
                  inputs_.end());
    inputs.push_back(value);
    std::vector<double> above(states_), below(states_);
    given(inputs.data(), above.data());
    inputs.back() = -value;
    given(inputs.data(), below.data());
    const auto is_number = [](double rate) { return std::isfinite(rate); };
    if (!std::ranges::all_of(above, is_number) || !std::ranges::all_of(below, is_number)) continue;
    // Beside the sizes of all rates: of those that are zero there, rounding is left.
    constexpr double kOfAll = 1e-10;
    double most = 0;
    for (std::size_t i = 0; i < states_; ++i) most = std::max(most, std::abs(above[i] - below[i]));
    if (most > kOfAll * (1 + largest(above.data(), states_))) return true;
    ++points;
  }
  return points < kPoints;
}

AfterStep Saltation::hook(const std::vector<double>& parameters, std::size_t size) {
  if (!needed()) return {};
  return [this, &parameters, size](const TakenStep& step, double* x) {
    return (*this)(step, x, size, parameters.data());
  };
}

StepChange Saltation::operator()(const TakenStep& step, double* x, std::size_t size,
                                 const double* parameters) {
  std::copy_n(parameters, inputs_.size() - states_ - 1,
              inputs_.begin() + static_cast<std::ptrdiff_t>(states_));
  const std::vector<Passed> passed = passed_in(step, x);
  return passed.empty() ? StepChange::none : carry(passed, step, x, size);
}

/// Also one that the step ends at, to rounding: the next step begins behind it.
std::vector<Saltation::Passed> Saltation::passed_in(const TakenStep& step, const double* x) {
  const double resolved = resolved_time(step);
  const double direction = step.t1 < step.t0 ? -1 : 1;
  const std::vector<double> own_rates = rates(step.t1, x);
  std::vector<Passed> passed;
  for (std::size_t k = 0; k < jumps_.size(); ++k) {
    const Jump& jump = jumps_[k];
    int& side = sides_[k];
    if (side == 0) side = side_of(argument(jump.place, step.t0, step.x0));
    const double u = argument(jump.place, step.t1, x);
    if (side == 0 || (jump.is_angle && !(argument(jump.place + 1, step.t1, x) < 0))) {
      if (side_of(u) != 0) side = side_of(u);
      continue;
    }
    if (side_of(u) == -side) {
      passed.push_back({k, side, true});
    } else {
      const double speed = direction * slope(jump.place, step.t1, x, own_rates.data(), 1);
      const bool comes = speed * side < 0 && std::abs(u) <= resolved * std::abs(speed);
      if (!comes) continue;
      passed.push_back({k, side, false});
    }
    side = -side;
  }
  return passed;
}

double Saltation::argument(std::size_t place, double t, const double* x) {
  std::copy_n(x, states_, inputs_.begin());
  inputs_.back() = t;
  (*arguments_)(inputs_.data(), values_.data());
  return values_[place];
}

std::vector<double> Saltation::rates(double t, const double* x) {
  std::vector<double> result(states_);
  std::copy_n(x, states_, inputs_.begin());
  inputs_.back() = t;
  (*rates_)(inputs_.data(), result.data());
  return result;
}

/// The derivative of an argument along a change of the states and the time.
double Saltation::slope(std::size_t place, double t, const double* x, const double* along,
                        double of_time) {
  auto next = std::copy_n(x, states_, slope_inputs_.begin());
  *next++ = t;
  next = std::copy_n(along, states_, next);
  *next++ = of_time;
  std::copy(inputs_.begin() + static_cast<std::ptrdiff_t>(states_), inputs_.end() - 1, next);
  (*slopes_)(slope_inputs_.data(), values_.data());
  return values_[values_.size() / 2 + place];
}

bool Saltation::are_on_side(const std::vector<Passed>& passed, bool before, double t,
                            const double* x) {
  return std::ranges::all_of(passed, [&](const Passed& one) {
    return side_of(argument(jumps_[one.jump].place, t, x)) == (before ? one.before : -one.before);
  });
}

/// The rates up to the place, continued from two points before it; empty where there are none.
std::vector<double> Saltation::rates_before(const std::vector<Passed>& passed,
                                            const TakenStep& step, const double* x,
                                            std::size_t size) {
  if (are_on_side(passed, true, step.t1, x)) return rates(step.t1, x);
  std::vector<double> there(size);
  const auto rates_at = [&](double part) -> std::vector<double> {
    const double t = step.t1 - part * (step.t1 - step.t0);
    step.state_at(t, there.data());
    return are_on_side(passed, true, t, there.data()) ? rates(t, there.data())
                                                      : std::vector<double>();
  };
  for (double part = kLeastPart; 2 * part < 1; part *= 2) {
    std::vector<double> near = rates_at(part);
    if (near.empty()) continue;
    const std::vector<double> far = rates_at(2 * part);
    if (far.empty()) continue;
    for (std::size_t i = 0; i < states_; ++i) near[i] = 2 * near[i] - far[i];
    return near;
  }
  // A step that is all rounding, from beside the place to behind it.
  return are_on_side(passed, true, step.t0, step.x0) ? rates(step.t0, step.x0)
                                                     : std::vector<double>();
}

/// The rates behind the place: those at the end of the step, or a little further on.
std::vector<double> Saltation::rates_behind(const std::vector<Passed>& passed,
                                            const TakenStep& step, const double* x,
                                            const std::vector<double>& before) {
  if (are_on_side(passed, false, step.t1, x)) return rates(step.t1, x);
  const double direction = step.t1 < step.t0 ? -1 : 1;
  const double h = direction * std::max(std::abs(step.t1 - step.t0), resolved_time(step));
  std::vector<double> there(states_);
  for (double part = kLeastPart; part < 1; part *= 2) {
    for (std::size_t i = 0; i < states_; ++i) there[i] = x[i] + part * h * before[i];
    if (are_on_side(passed, false, step.t1 + part * h, there.data()))
      return rates(step.t1 + part * h, there.data());
  }
  return {};
}

StepChange Saltation::carry(const std::vector<Passed>& passed, const TakenStep& step, double* x,
                            std::size_t size) {
  const std::vector<double> before = rates_before(passed, step, x, size);
  if (before.empty()) return StepChange::unknown;
  const std::vector<double> behind = rates_behind(passed, step, x, before);
  if (behind.empty()) return StepChange::unknown;
  if (!differ(before, behind)) return StepChange::none;
  const double direction = step.t1 < step.t0 ? -1 : 1;
  // Of the speed on the other side: less is that of a motion that stays, or of rounding.
  constexpr double kLeastOfOtherSpeed = 1e-9;
  // By how much the state may change from the place to where the step ends.
  constexpr double kFurther = 1e-6;
  const double fastest = std::max(largest(before.data(), states_), largest(behind.data(), states_)),
               place = std::max(largest(step.x0, states_), largest(x, states_));
  for (const Passed& one : passed) {
    const std::size_t at = jumps_[one.jump].place;
    const double comes = -one.before * direction * slope(at, step.t1, x, before.data(), 1),
                 goes = -one.before * direction * slope(at, step.t1, x, behind.data(), 1);
    if (!(comes > kLeastOfOtherSpeed * std::abs(goes)) ||
        !(goes > kLeastOfOtherSpeed * std::abs(comes)))
      return StepChange::unknown;
    const double late = std::abs(argument(at, step.t1, x)) / goes;
    if (!(late * fastest <= kFurther * place)) return StepChange::unknown;
  }
  for (std::size_t d = states_; d + states_ <= size; d += states_) {
    double* const deviation = x + d;
    double earlier = 0;
    for (const Passed& one : passed) {
      const std::size_t at = jumps_[one.jump].place;
      const double own =
          slope(at, step.t1, x, deviation, 0) / slope(at, step.t1, x, before.data(), 1);
      // Two places at a time: which of them the motion beside meets first would have to be known.
      constexpr double kSame = 1e-6;
      if (&one == &passed.front())
        earlier = own;
      else if (!(std::abs(own - earlier) <= kSame * std::abs(earlier)))
        return StepChange::unknown;
    }
    for (std::size_t i = 0; i < states_; ++i) {
      deviation[i] += (behind[i] - before[i]) * earlier;
      if (!std::isfinite(deviation[i])) return StepChange::unknown;
    }
  }
  return StepChange::changed;
}

}  // namespace casimir
