#include "runtime/digits/precise_branch.hpp"

#include <cmath>

#include "runtime/evaluate.hpp"

namespace casimir {
namespace {

double double_of(const BigFloat& value) { return arf_get_d(value.mid(), ARF_RND_NEAR); }

BigFloat times(const BigFloat& value, double factor) {
  BigFloat result;
  arf_set_d(result.mid(), factor);
  return value * result;
}

void state_at(const casimir_step* seen, double t, double* x) {
  const PreciseStep& step = *static_cast<const PreciseStep*>(seen->data);
  BigFloat h;
  arf_set_d(h.mid(), t - seen->t0);
  for (const BigFloat& value : step.state(h)) *x++ = double_of(value);
}

}  // namespace

PreciseLook::PreciseLook(const Program& rhs, const std::vector<BigFloat>& state,
                         std::vector<BigFloat> parameters)
    : watch_(rhs), parameters_(std::move(parameters)) {
  std::vector<double> numbers, start;
  for (const BigFloat& value : parameters_) numbers.push_back(double_of(value));
  for (const BigFloat& value : state) start.push_back(double_of(value));
  if (!watch_.looks(numbers.data(), start.data())) return;
  look_ = std::make_unique<StepLook>(watch_, start.size(), numbers.data(), start.data());
  look_->no_largest_number();
}

BigFloat PreciseLook::size(const PreciseStep& step) {
  if (!look_) return step.size;
  jumps_ = landing_ && *landing_ == step.size;
  landing_.reset();
  std::vector<double> x0, x1;
  for (const BigFloat& value : step.state(BigFloat())) x0.push_back(double_of(value));
  for (const BigFloat& value : step.state(step.size)) x1.push_back(double_of(value));
  const double begin = double_of(step.begin), end = double_of(step.begin + step.size);
  const double part =
      (*look_)({begin, end, x0.data(), x1.data(), &state_at, &step, nullptr, nullptr});
  if (part >= 1) return step.size;
  const BigFloat shorter = times(step.size, part);
  const StepWatch::Watched* const met = look_->met();
  jumps_ = false;
  if (!met) return shorter;
  // Just behind a branch the double next to the time may lie before it, and the branch seems to be
  // yet to come: up to a few doubles on there is none where the signs are the same.
  constexpr double kFewDoubles = 0x1p-44;
  const bool is_next = std::abs(end - begin) * part <= kFewDoubles * std::abs(begin);
  if (is_next &&
      argument(step, met->place, BigFloat()).sign() * argument(step, met->place, shorter).sign() >
          0)
    return shorter;
  BigFloat behind = branch(step, met->place, shorter);
  if (met->kind != StepWatch::Kind::side) landing_ = behind;
  return behind;
}

BigFloat PreciseLook::argument(const PreciseStep& step, std::size_t place,
                               const BigFloat& h) const {
  std::vector<BigFloat> inputs = step.state(h);
  inputs.insert(inputs.end(), parameters_.begin(), parameters_.end());
  inputs.push_back(step.begin + h);
  return evaluate(watch_.arguments(), inputs)[place];
}

/// From a place that is on the other side to as many digits as a double has. Regula falsi, which
/// halves the value at an end that stays (the Illinois rule).
BigFloat PreciseLook::branch(const PreciseStep& step, std::size_t place, BigFloat behind) const {
  constexpr slong kBeforeBits = -20;
  constexpr double kBefore = 0x1p-20, kFurther = 0x1p-50;
  BigFloat before = times(behind, 1 - kBefore), first = argument(step, place, before);
  BigFloat last = argument(step, place, behind);
  const auto sides = [&] { return first.sign() * last.sign() < 0; };
  for (double further = kFurther; !sides() && further <= kBefore; further *= 4) {
    behind = times(behind, 1 + further);
    last = argument(step, place, behind);
  }
  if (!sides()) {  // so near to the start of the step that doubles say little of where
    before = BigFloat();
    first = argument(step, place, before);
  }
  if (!sides()) throw UnknownBranch();
  const double enough = behind.log2() - static_cast<double>(BigFloat::precision());
  int side = 0;
  constexpr int kMostHalvings = 500;
  for (int round = 0; round < kMostHalvings && (behind - before).log2() > enough; ++round) {
    const BigFloat middle = (before * last - behind * first) / (last - first);
    const BigFloat u = argument(step, place, middle);
    if (u.is_zero() || middle == before || middle == behind) {
      before = middle;
      break;
    }
    if (u.sign() == last.sign()) {
      behind = middle;
      last = u;
      if (side == 1) first = times(first, 0.5);
      side = 1;
    } else {
      before = middle;
      first = u;
      if (side == -1) last = times(last, 0.5);
      side = -1;
    }
  }
  // The least that is behind. By exponents: of many digits the last is no double.
  for (slong last_bits = 2 - BigFloat::precision();; last_bits += 2) {
    BigFloat further;
    arf_mul_2exp_si(further.mid(), behind.mid(), last_bits);
    const BigFloat next = before + further;
    if (last_bits >= kBeforeBits || argument(step, place, next).sign() == last.sign()) return next;
  }
}

}  // namespace casimir
