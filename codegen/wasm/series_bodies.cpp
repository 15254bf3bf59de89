#include "codegen/wasm/series_bodies.hpp"

#include "codegen/emit/number_literal.hpp"
#include "codegen/optimise/lower.hpp"
#include "runtime/program/function_table.hpp"

namespace casimir::codegen::wasm {
namespace {

constexpr int kEightK = 0;  ///< the local that holds 8 k

int index(std::size_t i) { return static_cast<int>(i); }

}  // namespace

SeriesSums add_sums(ModuleWriter& module) {
  enum { kU, kV, kK, kFrom, kTo, kSum, kWeight };
  const Signature signature{std::vector<Type>(5, Type::i32), {Type::f64}};
  const auto sum = [&](bool weighted) {
    Body body;
    if (weighted) {
      body.get(kFrom).add(Code::f64_from_i32).number(1. / kDouble).add(Code::f64_mul).set(kWeight);
    }
    body.get(kFrom).get(kTo).add(Code::i32_at_most).open(Code::if_);
    body.get(kV).get(kK).add(Code::i32_add).set(kV);  // v_k
    body.open(Code::loop);
    body.get(kSum).get(kU).get(kFrom).add(Code::i32_add).load(0);
    if (weighted) body.get(kWeight).add(Code::f64_mul);
    body.get(kV).get(kFrom).add(Code::i32_sub).load(0);
    body.add(Code::f64_mul).add(Code::f64_add).set(kSum);
    if (weighted) body.get(kWeight).number(1).add(Code::f64_add).set(kWeight);
    body.get(kFrom).integer(kDouble).add(Code::i32_add).tee(kFrom);
    body.get(kTo).add(Code::i32_at_most).again();
    body.add(Code::end).add(Code::end).get(kSum);
    return module.function(signature, {{weighted ? 2 : 1, Type::f64}}, body);
  };
  const int plain = sum(false);
  return {plain, sum(true)};
}

SeriesBodies::SeriesBodies(const Program& flow, std::size_t states, const SeriesPlaces& places,
                           const Imports& imports, const SeriesSums& sums, const Limits& limits)
    : flow_(flow), states_(states), at_(places), imports_(imports), sums_(sums) {
  const std::vector<bool> constant = constant_instructions(flow);
  const int time = index(flow.inputs.size()) - 1;
  int next_place = state(states + 1);
  for (std::size_t i = 0; i < flow.code.size(); ++i) {
    const Instruction& line = flow.code[i];
    const bool is_input = line.op == Op::input;
    // What stands in a constant is its place in the table of constants.
    const bool is_moving = is_input      ? line.a < index(states) || line.a == time
                           : constant[i] ? false
                                         : varies(line.a) || varies(line.b);
    kinds_.push_back(constant[i] ? kConstant : is_moving ? kVaries : kPrepared);
    constants_.push_back(constant[i] ? nearest<double>(constant_value(flow, index(i), limits)) : 0);
    const bool has_series = is_input && is_moving;
    places_.push_back(has_series ? state(line.a == time ? states : static_cast<std::size_t>(line.a))
                                 : next_place);
    if (!has_series) next_place += at_.stride;
    const bool helped = is_moving && is_function(line.op) && has_helpers(line.op);
    helpers_.push_back(helped ? next_place : -1);
    if (helped) next_place += 2 * at_.stride;
  }
  end_ = next_place;
}

/// Coefficient 0.
void SeriesBodies::value(Body& body, int line) const {
  const auto i = static_cast<std::size_t>(line);
  if (kinds_[i] == kConstant)
    body.number(constants_[i]);
  else
    body.load_at(places_[i]);
}

/// Coefficient k.
void SeriesBodies::next(Body& body, int line) const { body.get(kEightK).load(place(line)); }

Body SeriesBodies::prepare() const {
  Body body;
  for (std::size_t i = 0; i < flow_.code.size(); ++i) {
    const Instruction& line = flow_.code[i];
    if (kinds_[i] == kVaries) continue;
    body.integer(0);
    if (kinds_[i] == kConstant)
      body.number(constants_[i]);
    else if (line.op == Op::input)
      body.load_at(at_.inputs + kDouble * line.a);
    else
      add_operation(
          body, line.op, imports_, [&] { value(body, line.a); }, [&] { value(body, line.b); });
    body.store(places_[i]);
  }
  return body;
}

Body SeriesBodies::begin() const {
  Body body;
  for (std::size_t i = 0; i < states_; ++i)
    body.integer(0).load_at(at_.inputs + kDouble * index(i)).store(state(i));
  const int time = at_.inputs + kDouble * (index(flow_.inputs.size()) - 1);
  body.integer(0).load_at(time).store(state(states_));
  body.integer(0).load_at(at_.unit).store(state(states_) + kDouble);
  for (std::size_t i = 0; i < flow_.code.size(); ++i) {
    const Instruction& line = flow_.code[i];
    if (kinds_[i] != kVaries || line.op == Op::input) continue;
    body.integer(0);
    add_operation(
        body, line.op, imports_, [&] { value(body, line.a); }, [&] { value(body, line.b); });
    body.store(places_[i]);
    if (helpers_[i] >= 0) begin_helpers(body, i);
  }
  return body;
}

/// Where a slot of the recurrence of a line stands.
struct SeriesBodies::Recurrence {
  const SeriesBodies& bodies;
  std::size_t i;

  int at(Slot slot) const {
    const Instruction& line = bodies.flow_.code[i];
    switch (own_slot(line.op, slot)) {
      case Slot::argument:
        return bodies.place(line.a);
      case Slot::second:
        return bodies.place(line.b);
      case Slot::value:
        return bodies.places_[i];
      case Slot::helper:
        return bodies.helpers_[i];
      default:
        return bodies.helpers_[i] + bodies.at_.stride;
    }
  }

  void sum(Body& body, int function, int u, int v, int from, bool to_k) const {
    body.integer(u).integer(v).get(kEightK).integer(kDouble * from).get(kEightK);
    if (!to_k) body.integer(kDouble).add(Code::i32_sub);
    body.call(function);
  }
  void plain(Body& body, int u, int v, int from, bool to_k) const {
    sum(body, bodies.sums_.plain, u, v, from, to_k);
  }
  void weighted(Body& body, int u, int v, bool to_k) const {
    sum(body, bodies.sums_.weighted, u, v, 1, to_k);
  }
  /// k as a double.
  static void order(Body& body) {
    body.get(kEightK).add(Code::f64_from_i32).number(1. / kDouble).add(Code::f64_mul);
  }
  static void coefficient(Body& body, int series) { body.get(kEightK).load(series); }

  void begin(Body& body, const SeriesStep& step) const;
  void extend(Body& body, const SeriesStep& step) const;
  void side(Body& body, int a) const;
  void power(Body& body) const;
  void angle(Body& body) const;
};

void SeriesBodies::begin_helpers(Body& body, std::size_t i) const {
  for (const SeriesStep& step : series_steps(flow_.code[i].op))
    Recurrence{*this, i}.begin(body, step);
}

/// Coefficient 0 of the helper that a step is about.
void SeriesBodies::Recurrence::begin(Body& body, const SeriesStep& step) const {
  const Instruction& line = bodies.flow_.code[i];
  const int helper = bodies.helpers_[i];
  const auto square = [&](int series) { body.load_at(series).load_at(series).add(Code::f64_mul); };
  if (step.rule == SeriesRule::angle) {
    body.integer(0);
    square(bodies.place(line.b));
    square(bodies.place(line.a));
    body.add(Code::f64_add).store(helper);
    return;
  }
  if (step.rule == SeriesRule::side) {
    body.integer(0);
    add_operation(
        body, Op::sign, bodies.imports_, [&] { bodies.value(body, line.a); }, [] {});
    body.store(helper);
    return;
  }
  const int target = at(step.target), of = at(step.of);
  if (target == bodies.places_[i]) return;
  body.integer(0);
  if (step.rule == SeriesRule::squares) {
    body.number(1);
    square(of);
    body.add(step.sign < 0 ? Code::f64_sub : Code::f64_add);
  } else if (step.rule == SeriesRule::root) {
    body.load_at(of).add(Code::f64_sqrt);
  } else {
    bodies.value(body, line.a);
    body.call(bodies.imports_.at(function_row(line.op).partner));
  }
  body.store(target);
}

/// Coefficient k > 0 of the series that a step is about.
void SeriesBodies::Recurrence::extend(Body& body, const SeriesStep& step) const {
  const int y = at(step.target), a = at(step.of), f = at(step.by);
  if (step.rule == SeriesRule::side) return side(body, bodies.place(bodies.flow_.code[i].a));
  if (step.rule == SeriesRule::power) return power(body);
  if (step.rule == SeriesRule::angle) return angle(body);
  if (step.rule == SeriesRule::constant) return;  // its coefficients stay zero
  body.get(kEightK);
  switch (step.rule) {
    case SeriesRule::integral:  // k y_k = s sum of j a_j f_{k-j}
      weighted(body, a, f, true);
      order(body);
      body.add(Code::f64_div);
      if (step.sign < 0) body.add(Code::f64_neg);
      break;
    case SeriesRule::quotient:  // k f_0 y_k = s k a_k - sum of j y_j f_{k-j}, j < k
      order(body);
      coefficient(body, a);
      body.add(Code::f64_mul);
      if (step.sign < 0) body.add(Code::f64_neg);
      weighted(body, y, f, false);
      body.add(Code::f64_sub);
      order(body);
      body.load_at(f).add(Code::f64_mul).add(Code::f64_div);
      break;
    case SeriesRule::root:  // 2 y_0 y_k = a_k - sum of y_j y_{k-j}, 0 < j < k
      coefficient(body, a);
      plain(body, y, y, 1, false);
      body.add(Code::f64_sub).number(2).load_at(y).add(Code::f64_mul).add(Code::f64_div);
      break;
    default:  // squares: y_k = s sum of a_j a_{k-j}
      plain(body, a, a, 0, true);
      if (step.sign < 0) body.add(Code::f64_neg);
  }
  body.store(y);
}

/// y = u a; where u begins at zero, the first term of a that is not says on which side it is.
void SeriesBodies::Recurrence::side(Body& body, int a) const {
  const int u = bodies.helpers_[i];
  body.load_at(u).number(0).add(Code::f64_equal).open(Code::if_).integer(0);
  add_operation(
      body, Op::sign, bodies.imports_, [&] { coefficient(body, a); }, [] {});
  body.store(u).add(Code::end);
  body.get(kEightK).load_at(u);
  coefficient(body, a);
  body.add(Code::f64_mul).store(bodies.places_[i]);
}

/// k a_0 y_k = e sum of j a_j y_{k-j} - sum of j y_j a_{k-j}, j < k
void SeriesBodies::Recurrence::power(Body& body) const {
  const Instruction& line = bodies.flow_.code[i];
  const int a = bodies.place(line.a), y = bodies.places_[i];
  body.get(kEightK);
  bodies.value(body, line.b);
  weighted(body, a, y, true);
  body.add(Code::f64_mul);
  weighted(body, y, a, false);
  body.add(Code::f64_sub);
  order(body);
  body.load_at(a).add(Code::f64_mul).add(Code::f64_div).store(y);
}

/// With r = b b + a a: k r_0 y_k = sum of j (a_j b_{k-j} - b_j a_{k-j}) - sum of j y_j r_{k-j}, j <
/// k
void SeriesBodies::Recurrence::angle(Body& body) const {
  const Instruction& line = bodies.flow_.code[i];
  const int a = bodies.place(line.a), b = bodies.place(line.b);
  const int y = bodies.places_[i], r = bodies.helpers_[i];
  body.get(kEightK);
  plain(body, b, b, 0, true);
  plain(body, a, a, 0, true);
  body.add(Code::f64_add).store(r);
  body.get(kEightK);
  weighted(body, a, b, true);
  weighted(body, b, a, true);
  body.add(Code::f64_sub);
  weighted(body, y, r, false);
  body.add(Code::f64_sub);
  order(body);
  body.load_at(r).add(Code::f64_mul).add(Code::f64_div).store(y);
}

void SeriesBodies::extend_product(Body& body, const Instruction& line) const {
  if (!varies(line.a) || !varies(line.b)) {
    const bool first = varies(line.a);
    next(body, first ? line.a : line.b);
    value(body, first ? line.b : line.a);
    body.add(Code::f64_mul);
  } else {
    Recurrence{*this, 0}.plain(body, place(line.a), place(line.b), 0, true);
  }
}

/// y b = a
void SeriesBodies::extend_quotient(Body& body, const Instruction& line, int y) const {
  if (varies(line.a))
    next(body, line.a);
  else
    body.number(0);
  if (varies(line.b)) {
    Recurrence{*this, 0}.plain(body, place(line.b), y, 1, true);
    body.add(Code::f64_sub);
  }
  value(body, line.b);
  body.add(Code::f64_div);
}

/// Coefficient k > 0 of a line that varies.
void SeriesBodies::extend_line(Body& body, std::size_t i) const {
  const Instruction& line = flow_.code[i];
  if (is_function(line.op)) {
    for (const SeriesStep& step : series_steps(line.op)) Recurrence{*this, i}.extend(body, step);
    return;
  }
  body.get(kEightK);
  switch (line.op) {
    case Op::mul:
      extend_product(body, line);
      break;
    case Op::div:
      extend_quotient(body, line, places_[i]);
      break;
    case Op::neg:
      next(body, line.a);
      body.add(Code::f64_neg);
      break;
    default:  // a sum or a difference, of which one part may be constant
      if (varies(line.a)) next(body, line.a);
      if (varies(line.b)) next(body, line.b);
      if (varies(line.a) && varies(line.b))
        body.add(line.op == Op::add ? Code::f64_add : Code::f64_sub);
      else if (varies(line.b) && line.op == Op::sub)
        body.add(Code::f64_neg);
  }
  body.store(places_[i]);
}

Body SeriesBodies::extend() const {
  Body body;
  for (std::size_t i = 0; i < flow_.code.size(); ++i)
    if (kinds_[i] == kVaries && flow_.code[i].op != Op::input) extend_line(body, i);
  return body;
}

Body SeriesBodies::advance() const {
  constexpr int kShare = 1;
  Body body;  // unit/(k + 1)
  body.load_at(at_.unit).get(kEightK).integer(kDouble).add(Code::i32_add).add(Code::f64_from_i32);
  body.number(1. / kDouble).add(Code::f64_mul).set(kShare);
  body.set(kShare + 1);
  for (std::size_t i = 0; i < states_; ++i) {
    body.get(kEightK);
    next(body, flow_.outputs[i]);
    body.get(kShare).add(Code::f64_div).get(kShare + 1).add(Code::f64_mul);
    body.store(state(i) + kDouble);
  }
  return body;
}

std::vector<int> SeriesBodies::singular() const {
  std::vector<int> result;
  for (std::size_t i = 0; i < flow_.code.size(); ++i) {
    const Instruction& line = flow_.code[i];
    const bool can = line.op == Op::div ? varies(line.b)
                                        : is_function(line.op) && function_row(line.op).singular;
    if (kinds_[i] == kVaries && can) result.push_back(places_[i]);
  }
  return result;
}

std::vector<int> SeriesBodies::kinks() const {
  std::vector<int> result;
  for (std::size_t i = 0; i < flow_.code.size(); ++i) {
    const Instruction& line = flow_.code[i];
    if (kinds_[i] == kVaries && (line.op == Op::abs || line.op == Op::sign || line.op == Op::sqrt))
      result.push_back(place(line.a));
  }
  return result;
}

bool SeriesBodies::needs_comparison() const {
  for (std::size_t i = 0; i < flow_.code.size(); ++i) {
    const Instruction& line = flow_.code[i];
    if (kinds_[i] != kVaries) continue;
    if (line.op == Op::div || (is_function(line.op) && line.op != Op::exp && line.op != Op::sin &&
                               line.op != Op::cos && line.op != Op::sinh && line.op != Op::cosh))
      return true;
  }
  return false;
}

}  // namespace casimir::codegen::wasm
