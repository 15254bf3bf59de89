#include "tools/analysis/estimate/near_singular.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "codegen/optimise/lower.hpp"

namespace casimir {
namespace {

constexpr double kNearZero = 1e-3;

/// Lines that something is divided by: the factors of denominators, and bases of negative powers.
std::set<int> divisors_of(const Program& program) {
  const std::vector<bool> constant = codegen::constant_instructions(program);
  std::set<int> lines;
  const std::function<void(int)> add = [&](int line) {
    const Instruction& code = program.code[static_cast<std::size_t>(line)];
    if (code.op == Op::mul) {
      add(code.a);
      add(code.b);
    } else if (!constant[static_cast<std::size_t>(line)]) {
      lines.insert(line);
    }
  };
  for (const Instruction& code : program.code) {
    if (code.op == Op::div) add(code.b);
    if (code.op != Op::pow) continue;
    const Instruction& exponent = program.code[static_cast<std::size_t>(code.b)];
    if (exponent.op == Op::constant &&
        cln::minusp(program.constants[static_cast<std::size_t>(exponent.a)]))
      add(code.a);
  }
  return lines;
}

/// Adds a quotient by cos(u) for each tan(u): its poles, too, are zeros of a divisor.
void divide_tangents(Program& program) {
  const std::size_t lines = program.code.size();
  for (std::size_t i = 0; i < lines; ++i) {
    if (program.code[i].op != Op::tan) continue;
    const int angle = program.code[i].a, cosine = static_cast<int>(program.code.size());
    program.code.push_back({Op::cos, angle});
    program.code.push_back({Op::div, angle, cosine});
  }
}

/// The states that a line depends on.
std::vector<std::size_t> states_in(const Program& program, int line, std::size_t states) {
  std::set<int> open{line};
  std::vector<std::size_t> found;
  while (!open.empty()) {
    const int last = *open.rbegin();
    open.erase(last);
    const Instruction& code = program.code[static_cast<std::size_t>(last)];
    if (code.op == Op::input) {
      if (static_cast<std::size_t>(code.a) < states)
        found.push_back(static_cast<std::size_t>(code.a));
    } else if (code.op != Op::constant && code.op != Op::pi) {
      open.insert(code.a);
      if (code.b >= 0) open.insert(code.b);
    }
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace

NearSingular::NearSingular(const PreparedScene& run) : run_(run) {
  Program divisors = run.specialisation.rhs;
  divisors.outputs.clear();
  divisors.output_names.clear();
  divide_tangents(divisors);
  for (const int line : divisors_of(divisors)) {
    divisors.outputs.push_back(line);
    divisors.output_names.push_back("divisor");
    states_.push_back(states_in(divisors, line, run.initial.size()));
  }
  divisors_.emplace(codegen::without_dead_code(divisors));
  values_.resize(divisors.outputs.size());
  ranges_.resize(divisors.outputs.size());
  inputs_ = run.initial;
  inputs_.insert(inputs_.end(), run.parameters.begin(), run.parameters.end());
  inputs_.push_back(0);
  see(0, run.initial.data());
}

void NearSingular::see(double t, const double* x) {
  if (!divides()) return;
  std::copy_n(x, run_.initial.size(), inputs_.begin());
  inputs_.back() = t;
  (*divisors_)(inputs_.data(), values_.data());
  std::optional<double> crosses;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    Range& range = ranges_[i];
    const double size = std::abs(values_[i]);
    range.largest = std::max(range.largest, size);
    const bool other_sign = values_[i] * range.last < 0;
    if (other_sign) crosses = std::max(crosses.value_or(0), size / range.largest);
    if (other_sign && !range.crossed) range.crossed = t;
    range.last = values_[i];
    if (!range.state.empty() && !(size < range.least)) continue;
    range.least = size;
    range.time = t;
    range.state.assign(x, x + run_.initial.size());
  }
  count(t, crosses);
}

void NearSingular::count(double t, std::optional<double> crosses) {
  constexpr unsigned long long kWindow = 4096, kOften = kWindow / 4;
  constexpr double kTiny = 1e-3, kNear = 1e-2;
  ++steps_;
  if (crosses && changes_ == 0) {
    step_before_ = std::abs(t) / static_cast<double>(steps_);
    window_begins_ = steps_;
    window_time_ = t;
  }
  if (crosses) {
    ++changes_;
    farthest_ = std::max(farthest_, *crosses);
  }
  if (changes_ == 0 || steps_ < window_begins_ + kWindow) return;
  const double step = std::abs(t - window_time_) / static_cast<double>(kWindow);
  to_and_fro_ =
      to_and_fro_ || (changes_ > kOften && step < kTiny * step_before_ && farthest_ < kNear);
  window_begins_ = steps_;
  window_time_ = t;
  changes_ = 1;
  farthest_ = 0;
}

bool NearSingular::crossed() const {
  return std::ranges::any_of(ranges_, [](const Range& range) { return range.crossed.has_value(); });
}

std::optional<std::string> NearSingular::finding() const {
  for (const Range& range : ranges_) {
    if (range.crossed)
      return fmt::format(
          "the equations divide by a quantity that changes its sign before t = {:.6g}: a step went "
          "over a pole of theirs, and what comes after it may mean nothing",
          *range.crossed);
  }
  const Range* worst = nullptr;
  for (const Range& range : ranges_) {
    if (range.least < kNearZero * range.largest &&
        (!worst || range.least / range.largest < worst->least / worst->largest))
      worst = &range;
  }
  if (!worst) return std::nullopt;
  const std::size_t which = static_cast<std::size_t>(worst - ranges_.data());
  std::string where;
  for (const std::size_t i : states_[which])
    where += fmt::format("{}{} = {:.6g}", where.empty() ? "" : ", ", run_.specialisation.states[i],
                         worst->state[i]);
  if (where.empty())  // a quantity of the time alone, which no other variables mend
    return fmt::format(
        "the equations divide by a quantity that comes down to {:.0e} of its largest value at "
        "t = {:.6g}, which costs digits",
        worst->least / worst->largest, worst->time);
  return fmt::format(
      "the coordinates are nearly singular at t = {:.6g}, where {}: the equations divide by a "
      "quantity that comes down to {:.0e} of its largest value there, which costs digits; "
      "variables without this singularity do better",
      worst->time, where, worst->least / worst->largest);
}

}  // namespace casimir
