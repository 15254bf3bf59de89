#include "runtime/undefined_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "runtime/evaluate.hpp"

namespace casimir {
namespace {

constexpr const char* kAllAlong =
    "the equations have no value: the sign of 0 or the angle of the origin is taken all along";

/// The program, its line `k` replaced by a number.
Program with_constant(Program program, std::size_t k, int number) {
  program.code[k] = {Op::constant, static_cast<int>(program.constants.size())};
  program.constants.emplace_back(number);
  return program;
}

/// The values of the inputs after a time in which the rates stay what they are.
std::vector<double> led_by(const std::vector<double>& rates, double time,
                           std::vector<double> inputs) {
  for (std::size_t i = 0; i < rates.size(); ++i) inputs[i] += time * rates[i];
  inputs.back() += time;
  return inputs;
}

}  // namespace

UndefinedMotion::UndefinedMotion(const Program& rhs) : rhs_(rhs), arguments_(rhs) {
  std::vector<int> angles;
  arguments_.outputs.clear();
  for (std::size_t k = 0; k < rhs.code.size(); ++k) {
    const Instruction& line = rhs.code[k];
    if (line.op == Op::sign) {
      signs_.push_back(k);
      arguments_.outputs.push_back(line.a);
    }
    if (line.op == Op::atan2) angles.insert(angles.end(), {line.a, line.b});
  }
  angles_ = angles.size() / 2;
  arguments_.outputs.insert(arguments_.outputs.end(), angles.begin(), angles.end());
  arguments_.output_names.assign(arguments_.outputs.size(), "");
  // They are evaluated at every step; what comes behind the last of them is not needed.
  std::size_t lines = 0;
  for (const int line : arguments_.outputs) lines = std::max(lines, std::size_t(line) + 1);
  arguments_.code.resize(lines);
}

std::string UndefinedMotion::why(Status status, const std::vector<double>& start,
                                 const std::vector<double>& end) const {
  if (arguments_.outputs.empty()) return {};
  try {
    switch (status) {
      case Status::ok:
        if (is_undefined_along(start, end)) return kAllAlong;
        break;
      case Status::singularity:
      case Status::step_underflow:
      case Status::no_convergence:
        for (const std::size_t k : signs_)
          if (leads_back_to_jump(k, end, end.back() - start.back()))
            return reason_of(Status::at_jump);
        break;
      default:
        break;
    }
  } catch (const std::domain_error&) {
    // There is no value for another reason, for which the run ended or which it passed.
  }
  return {};
}

bool UndefinedMotion::turns_back(const std::vector<double>& before,
                                 const std::vector<double>& behind, const std::vector<double>& end,
                                 double way) const {
  for (std::size_t k = 0; k < signs_.size(); ++k)
    if (before[k] * behind[k] <= 0 && leads_back_to_jump(signs_[k], end, way)) return true;
  return false;
}

bool UndefinedMotion::is_undefined_along(const std::vector<double>& start,
                                         const std::vector<double>& end) const {
  std::vector<bool> zero(signs_.size() + angles_, true);
  const auto none_after = [&](const std::vector<double>& place) {
    const std::vector<double> values = evaluate(arguments_, place);
    for (std::size_t k = 0; k < zero.size(); ++k) {
      const std::size_t pair = 2 * k - signs_.size();
      zero[k] = zero[k] &&
                (k < signs_.size() ? values[k] == 0 : values[pair] == 0 && values[pair + 1] == 0);
    }
    return std::ranges::find(zero, true) == zero.end();
  };
  if (none_after(start) || none_after(end)) return false;
  // Where the rates lead from there: what leaves comes back to 0 perhaps.
  const double way = (end.back() - start.back()) / 1024;
  for (const std::vector<double>& at : {start, end}) {
    const std::vector<double> rates = evaluate(rhs_, at);
    if (none_after(led_by(rates, way, at)) || none_after(led_by(rates, -way, at))) return false;
  }
  return true;
}

/// By the rates of change of the argument along both fields, on a way that is so short that these
/// do not change, and so long that rounding does not tell.
bool UndefinedMotion::leads_back_to_jump(std::size_t k, const std::vector<double>& end,
                                         double way) const {
  Program argument = rhs_;
  argument.outputs = {rhs_.code[k].a};
  argument.output_names = {""};
  const double here = evaluate(argument, end)[0];
  const std::vector<double> above = evaluate(with_constant(rhs_, k, 1), end),
                            below = evaluate(with_constant(rhs_, k, -1), end);
  const auto change = [&](const std::vector<double>& rates, double time) {
    return evaluate(argument, led_by(rates, time, end))[0] - here;
  };
  constexpr double kLonger = 16;
  const auto as_longer = [&](double one, double on_longer) {
    return on_longer / one > kLonger / 2 && on_longer / one < kLonger * 2;
  };
  for (double part = 0x1p-52; part < 0x1p-4; part *= kLonger) {
    const double from_above = change(above, part * way), from_below = change(below, part * way);
    if (!(std::min(std::abs(from_above), std::abs(from_below)) > 2 * std::abs(here)) ||
        !as_longer(from_above, change(above, kLonger * part * way)) ||
        !as_longer(from_below, change(below, kLonger * part * way)))
      continue;
    return from_above < 0 && from_below > 0;
  }
  return false;
}

void UndefinedSteps::see(double t, const double* x, std::size_t states) {
  if (!looks() || !why_.empty()) return;
  std::vector<double> now(x, x + states);
  now.insert(now.end(), parameters_.begin(), parameters_.end());
  now.push_back(t);
  try {
    std::vector<double> values = evaluate(motion_.arguments(), now);
    if (stays_undefined(now, values))
      why_ = kAllAlong;
    else if (!last_.empty() && motion_.turns_back(last_, values, now, t - *begin_))
      why_ = reason_of(Status::at_jump);
    last_ = std::move(values);
  } catch (const std::domain_error&) {
    last_.clear();  // no value for another reason, for which the run ends or which it passes
  }
  if (!begin_) begin_ = t;
}

/// A motion that begins at a zero of order 2 may be rounded to it for a step or two.
bool UndefinedSteps::stays_undefined(const std::vector<double>& now,
                                     const std::vector<double>& values) {
  constexpr double kPartOfRun = 0x1p-12;
  since_.resize(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k] != 0)
      since_[k].clear();
    else if (since_[k].empty())
      since_[k] = now;
    else if (std::abs(now.back() - since_[k].back()) > kPartOfRun * std::abs(duration_) &&
             motion_.is_undefined_along(since_[k], now))
      return true;
  }
  return false;
}

}  // namespace casimir
