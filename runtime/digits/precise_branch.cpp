#include "runtime/digits/precise_branch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

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
  if (chatter_.goes_on(double_of(step.begin))) return {};
  const double begin = double_of(step.begin), end = double_of(step.begin + step.size);
  const double part =
      (*look_)({begin, end, x0.data(), x1.data(), &state_at, &step, nullptr, nullptr});
  if (part >= 1) return up_to_unseen_branch(step);
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
  chatter_.cut();
  BigFloat behind = branch(step, met->place, shorter);
  if (met->kind != StepWatch::Kind::side) landing_ = behind;
  return behind;
}

BigFloat PreciseLook::up_to_unseen_branch(const PreciseStep& step) {
  using Kind = StepWatch::Kind;
  BigFloat size = step.size;
  for (const StepWatch::Watched& watched : watch_.watched()) {
    if (watched.kind != Kind::side && watched.kind != Kind::jump) continue;
    const std::optional<BigFloat> beyond = other_side(step, watched.place);
    if (!beyond) continue;
    const BigFloat behind = branch(step, watched.place, *beyond);
    if (!((behind - size).sign() * step.size.sign() < 0)) continue;
    size = behind;
    chatter_.cut();
    landing_.reset();
    jumps_ = false;
    if (watched.kind == Kind::jump) landing_ = behind;
  }
  return size;
}

std::optional<BigFloat> PreciseLook::other_side(const PreciseStep& step, std::size_t place) const {
  constexpr double kPlaces[] = {0, 0.27, 0.52, 0.78, 1};
  constexpr std::size_t kCount = std::size(kPlaces);
  BigFloat at[kCount], value[kCount];
  int side = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    at[i] = times(step.size, kPlaces[i]);
    value[i] = argument(step, place, at[i]);
    if (side == 0) side = value[i].sign();
    if (side * value[i].sign() < 0) return at[i];
  }
  for (std::size_t i = 0; i + 2 < kCount; ++i)
    if (auto found = beyond_dip(step, place, {at[i], at[i + 1], at[i + 2]},
                                {value[i], value[i + 1], value[i + 2]}))
      return found;
  return std::nullopt;
}

/// By parabolas through three places, each time nearer to where the argument is least.
std::optional<BigFloat> PreciseLook::beyond_dip(const PreciseStep& step, std::size_t place,
                                                std::array<BigFloat, 3> at,
                                                std::array<BigFloat, 3> value) const {
  // What comes down to no thousandth of what is beside it turns elsewhere.
  constexpr double kNearZero = -10;  // of log2
  constexpr int kRounds = 40;
  const int side = value[1].sign();
  const double beside = std::max(value[0].log2(), value[2].log2());
  const BigFloat low = at[0], high = at[2];
  for (int round = 0; round < kRounds; ++round) {
    const BigFloat left = at[1] - at[0], right = at[2] - at[1];
    const BigFloat rise = (value[2] - value[1]) / right, fall = (value[1] - value[0]) / left;
    const BigFloat bend = (rise - fall) / (left + right);
    if (bend.sign() * side <= 0) return std::nullopt;
    // The parabola is least where fall + bend (2 s - at[0] - at[1]) = 0.
    const BigFloat vertex = times(at[0] + at[1] - fall / bend, 0.5);
    if (!((vertex - low).sign() * (high - vertex).sign() > 0)) return std::nullopt;
    const BigFloat u = argument(step, place, vertex);
    if (u.sign() * side < 0) return vertex;
    if (u.is_zero() || vertex == at[1]) return std::nullopt;
    if (round > 1 && u.log2() > beside + kNearZero) return std::nullopt;
    const BigFloat aside = vertex - at[1];
    const BigFloat near = vertex - aside, far = vertex + aside;
    at = {near < far ? near : far, vertex, near < far ? far : near};
    for (std::size_t i = 0; i < at.size(); ++i) value[i] = argument(step, place, at[i]);
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}})
      if (value[i].sign() * side < 0) return at[i];
  }
  return std::nullopt;
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
