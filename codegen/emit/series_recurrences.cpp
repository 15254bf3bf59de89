// The recurrences of a straight-line program's Taylor coefficients, for the compiled kernels.
#include "codegen/emit/series_recurrences.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "codegen/emit/identifiers.hpp"
#include "codegen/emit/number_literal.hpp"
#include "codegen/emit/statements.hpp"
#include "codegen/optimise/lower.hpp"
#include "runtime/program/function_table.hpp"

namespace casimir::codegen {

namespace {

/// What the kernels call their own members and locals.
std::vector<std::string> names_of_kernels() {
  std::istringstream names(
      "V S c rate order p most states blocks groups smooth width sums_width few sums the_states k "
      "by_k step unit state at begin expand form_sums form_inner clear_operands right_of kAtOnce "
      "formed_ lane pack store fill row enter inner "
      "room begun_ series_ sum_ each left_ right_ first_left_ first_right_");
  return {std::istream_iterator<std::string>(names), {}};
}

/// Writes two passes over the program: the values at a state, which stay as members (`v3`), and
/// coefficient k of the same quantities (`v3_k`).
class SeriesWriter {
 public:
  SeriesWriter(const Program& rhs, const std::vector<std::string>& names, SeriesValue value,
               const Limits& limits)
      : limits_(limits),
        lanes_(value == SeriesValue::lanes),
        program_(without_dead_code(rhs)),
        constant_(constant_instructions(program_)),
        unique_(names_of_kernels()),
        value_(program_.code.size()),
        varies_(program_.code.size(), false),
        depth_(program_.code.size(), 0),
        states_(program_.outputs.size()) {
    for (const std::string& name : names) inputs_.push_back(fresh(name));
  }

  SeriesRecurrences run() {
    for (std::size_t i = 0; i < program_.code.size(); ++i) write(i);
    SeriesRecurrences result{.inputs = inputs_,
                             .states = states_,
                             .used_parameters = used_parameters_,
                             .uses_time = uses_time_,
                             .smooth = is_smooth(),
                             .members = members_,
                             .begin = begin_,
                             .next = next_,
                             .sums = order_,
                             .rates = {},
                             .next_rates = {}};
    for (const int output : program_.outputs) {
      result.rates.push_back(at(output));
      result.next_rates.push_back(next(output));
    }
    return result;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  const Instruction& code(std::size_t i) const { return program_.code[i]; }

  std::string literal(std::size_t i) {
    const int line = static_cast<int>(i);
    const bool rational = is_rational(program_, line);
    const NumberText number = number_text(constant_value(program_, line, limits_), Scalar::real64,
                                          rational ? "" : constant_text(program_, line));
    std::string text = number.text;
    if (text.find_first_of(".eExX") == std::string::npos) text += ".";
    return text[0] == '-' ? "(" + text + ")" : text;
  }

  /// What holds a value: a number, or one for each trajectory.
  std::string real() const { return lanes_ ? "V" : "double"; }

  /// A name that is free, also with the _k of a coefficient behind it.
  std::string fresh(const std::string& wanted) {
    for (;;) {
      std::string name = unique_.unique(wanted);
      if (unique_.unique(name + "_k") == name + "_k") return name;
    }
  }

  /// A new member for a value at the state.
  std::string member(const std::string& wanted) {
    const std::string name = fresh(wanted);
    members_ += (members_.empty() ? "" : ", ") + name;
    return name;
  }

  void assign_value(const std::string& name, const std::string& text) {
    begin_ += wrapped("      " + name + " = " + text + ";") + "\n";
  }

  void assign_next(const std::string& name, const std::string& text) {
    next_ += wrapped("        const " + real() + " " + name + "_k = " + text + ";") + "\n";
  }

  /// The inner terms of a sum of two series.
  std::string sum(const std::string& left, const std::string& right, bool weighted = false) {
    SeriesSum wanted{left, right, weighted};
    if (!weighted && right < left) std::swap(wanted.left, wanted.right);
    const auto [place, is_new] = sums_.try_emplace(wanted, static_cast<int>(sums_.size()));
    if (is_new) order_.push_back(wanted);
    return "sum_[" + std::to_string(place->second) + "]";
  }

  /// sum of j l[j] r[k-j] over j = 1 .. k-1, divided by k.
  std::string slope(const std::string& left, const std::string& right) {
    return "by_k * " + sum(left, right, true);
  }

  void write(std::size_t i) {
    const Instruction& c = code(i);
    if (constant_[i]) {
      value_[i] = literal(i);
    } else if (c.op == Op::input) {
      write_input(i);
    } else {
      varies_[i] = varies_[index(c.a)] || (c.b >= 0 && varies_[index(c.b)]);
      depth_[i] = 1 + std::max(depth(c.a), depth(c.b));
      value_[i] = member("v" + std::to_string(++count_));
      write_operation(i);
    }
  }

  void write_input(std::size_t i) {
    const std::size_t input = index(code(i).a);
    varies_[i] = input < states_ ? !stays(input) : input + 1 == inputs_.size();
    value_[i] = inputs_[input];
    if (input >= states_ && input + 1 < inputs_.size()) used_parameters_.insert(input);
    uses_time_ = uses_time_ || input + 1 == inputs_.size();
  }

  /// Whether the rate of a state is the number 0.
  bool stays(std::size_t state) const {
    const int rate = program_.outputs[state];
    if (!constant_[index(rate)] || !is_rational(program_, rate)) return false;
    return zerop(constant_value(program_, rate, limits_));
  }

  bool varies(int i) const { return i >= 0 && varies_[index(i)]; }
  /// How many operations coefficient k waits for that stand one behind the other.
  int depth(int i) const { return varies(i) ? depth_[index(i)] : 0; }
  const std::string& at(int i) const { return value_[index(i)]; }
  std::string next(int i) const { return varies(i) ? value_[index(i)] + "_k" : "0."; }

  void write_operation(std::size_t i) {
    const Instruction& c = code(i);
    const std::string& y = value_[i];
    switch (c.op) {
      case Op::add:
      case Op::sub:
        return write_sum(i);
      case Op::neg:
        assign_value(y, "-" + at(c.a));
        if (varies_[i]) assign_next(y, "-" + next(c.a));
        return;
      case Op::mul:
        return write_product(i);
      case Op::div:
        return write_quotient(i);
      default:
        return write_function(i);
    }
  }

  void write_sum(std::size_t i) {
    const Instruction& c = code(i);
    const std::string sign = c.op == Op::add ? " + " : " - ";
    assign_value(value_[i], at(c.a) + sign + at(c.b));
    if (!varies_[i]) return;
    if (!varies(c.b)) return assign_next(value_[i], next(c.a));
    if (!varies(c.a)) return assign_next(value_[i], (c.op == Op::add ? "" : "-") + next(c.b));
    assign_next(value_[i], next(c.a) + sign + next(c.b));
  }

  void write_product(std::size_t i) {
    const Instruction& c = code(i);
    const std::string &a = at(c.a), &b = at(c.b);
    assign_value(value_[i], a + " * " + b);
    if (!varies_[i]) return;
    if (!varies(c.a)) return assign_next(value_[i], a + " * " + next(c.b));
    if (!varies(c.b)) return assign_next(value_[i], next(c.a) + " * " + b);
    if (c.a == c.b) return assign_next(value_[i], sum(a, a) + " + 2 * " + a + " * " + a + "_k");
    // What is known last is added last.
    const std::string of_a = a + "_k * " + b, of_b = a + " * " + b + "_k";
    const bool a_is_last = depth(c.a) > depth(c.b);
    assign_next(value_[i],
                sum(a, b) + " + " + (a_is_last ? of_b + " + " + of_a : of_a + " + " + of_b));
  }

  /// y b = a.
  void write_quotient(std::size_t i) {
    const Instruction& c = code(i);
    const std::string &a = at(c.a), &b = at(c.b), &y = value_[i];
    assign_value(y, a + " / " + b);
    if (!varies_[i]) return;
    if (!varies(c.b)) return assign_next(y, next(c.a) + " / " + b);
    const std::string inverse = member(y + "_inverse");
    assign_value(inverse, "1 / " + b);
    // y/b, as one factor of b_k, may leave the range of numbers where y and b do not.
    const std::string of_b = y + " * (" + b + "_k * " + inverse + ")",
                      inner = sum(y, b) + " * " + inverse;
    if (!varies(c.a)) return assign_next(y, "-" + inner + " - " + of_b);
    const std::string of_a = next(c.a) + " * " + inverse;
    assign_next(y, depth(c.a) > depth(c.b) ? of_a + " - (" + inner + " + " + of_b + ")"
                                           : of_a + " - " + inner + " - " + of_b);
  }

  std::string called(std::string_view function, const std::string& arguments) const {
    const std::string builtin = "__builtin_" + std::string(function);
    if (!lanes_) return builtin + "(" + arguments + ")";
    return "casimir_kernel::lanes::each<V>([](auto... x) { return " + builtin + "(x...); }, " +
           arguments + ")";
  }

  void write_function(std::size_t i) {
    const Instruction& c = code(i);
    const std::string &a = at(c.a), &y = value_[i];
    if (c.op == Op::sign) return write_sign(i);
    const FunctionRow& row = function_row(c.op);
    const std::string value = called(row.c_name, c.b < 0 ? a : a + ", " + at(c.b));
    if (varies_[i] && row.partner != c.op) return write_pair(i, row, value);
    assign_value(y, value);
    if (!varies_[i]) return;
    switch (row.step[0].rule) {
      case SeriesRule::power:
        return write_power(y, a, at(c.b));
      case SeriesRule::side:
        return write_modulus(y, a);
      case SeriesRule::angle:
        return write_angle(y, c);
      default:
        return write_steps(c.op, y, a);
    }
  }

  /// A series of a recurrence: its value, and its coefficient k.
  struct Series {
    std::string value, next;
  };

  /// The recurrence of a function of one argument.
  void write_steps(Op op, const std::string& y, const std::string& a) {
    std::map<Slot, Series> series{{Slot::argument, {a, a + "_k"}}, {Slot::value, {y, y + "_k"}}};
    for (const SeriesStep& step : series_steps(op)) {
      if (step.target == Slot::value) continue;
      Series& helper = series[step.target];
      const std::string start = first_value(step, series.at(step.of).value);
      if (step.target == Slot::inner) {  // nothing but the argument of the next
        helper.value = start;
        continue;
      }
      const std::string name = member(y + "_" + std::string(function_row(op).helper));
      helper = {name, name + "_k"};
      assign_value(name, start);
    }
    for (const SeriesStep& step : series_steps(op)) write_step(step, series);
  }

  /// The value of a helper that follows from that of another series.
  std::string first_value(const SeriesStep& step, const std::string& of) const {
    if (step.rule == SeriesRule::root) return called("sqrt", of);
    if (step.sign < 0) return "(1 - " + of + ") * (1 + " + of + ")";
    return "1 + " + of + " * " + of;
  }

  void write_step(const SeriesStep& step, std::map<Slot, Series>& series) {
    const std::string minus = step.sign < 0 ? "-" : "";
    const std::string &y = series.at(step.target).value, &a = series.at(step.of).value;
    switch (step.rule) {
      case SeriesRule::integral: {
        const std::string& f = series.at(step.by).value;
        const std::string slopes = a + "_k * " + f + " + " + slope(a, f);
        return assign_next(y, step.sign < 0 ? "-(" + slopes + ")" : slopes);
      }
      case SeriesRule::quotient:
        return write_ratio(y, minus + a + "_k", series.at(step.by).value);
      case SeriesRule::root:
        return write_root(y, series.at(step.of).next);
      default: {
        const std::string squares = "2 * " + a + " * " + a + "_k + " + sum(a, a);
        const std::string next = step.sign < 0 ? "-(" + squares + ")" : squares;
        if (step.target != Slot::inner) return assign_next(y, next);
        series.at(step.target).next = next;
      }
    }
  }

  /// 1, -1 or 0 by the sign of a; where that is zero, what is there already.
  std::string side(const std::string& a, const std::string& otherwise) const {
    if (!lanes_) return a + " > 0 ? 1. : " + a + " < 0 ? -1. : " + otherwise;
    return "casimir_kernel::lanes::each<V>([](double x, double y) { return x > 0 ? 1. : x < 0 ? "
           "-1. : y; }, " +
           a + ", " + otherwise + ")";
  }

  void write_sign(std::size_t i) {
    const std::string& a = at(code(i).a);
    // What has no value has no sign either.
    assign_value(value_[i], side(a, (lanes_ ? "V{} * " : "0. * ") + a));
    if (varies_[i]) assign_next(value_[i], lanes_ ? "V{}" : "0.");
  }

  /// y = side a; where it begins at zero, the first term that is not says on which side.
  void write_modulus(const std::string& y, const std::string& a) {
    const std::string u = member(y + "_side");
    assign_value(u, side(a, lanes_ ? "V{}" : "0."));
    if (lanes_)
      next_ += wrapped("        " + u +
                       " = casimir_kernel::lanes::each<V>([](double s, double x) { return s != 0 ? "
                       "s : x > 0 ? 1. : x < 0 ? -1. : 0.; }, " +
                       u + ", " + a + "_k);") +
               "\n";
    else
      next_ += "        if (" + u + " == 0) " + u + " = " + side(a + "_k", "0.") + ";\n";
    assign_next(y, u + " * " + a + "_k");
  }

  /// y f = integral of the numerator's derivative: f y' = a'.
  void write_ratio(const std::string& y, const std::string& numerator, const std::string& f) {
    const std::string inverse = member(y + "_inverse");
    assign_value(inverse, "1 / " + f);
    assign_next(y, "(" + numerator + ") * " + inverse + " - " + slope(y, f) + " * " + inverse);
  }

  /// y y = a.
  void write_root(const std::string& y, const std::string& next_of_square) {
    const std::string half = member(y + "_half");
    assign_value(half, "0.5 / " + y);
    assign_next(y, "(" + next_of_square + ") * " + half + " - " + sum(y, y) + " * " + half);
  }

  /// a y' = e y a'.
  void write_power(const std::string& y, const std::string& a, const std::string& e) {
    const std::string inverse = member(y + "_inverse"), scaled = member(y + "_scaled");
    assign_value(inverse, "1 / " + a);
    assign_value(scaled, e + " * " + y);
    assign_next(y, scaled + " * (" + a + "_k * " + inverse + ") + (" + e + " * " + slope(a, y) +
                       " - " + slope(y, a) + ") * " + inverse);
  }

  /// Each of the two needs the other.
  void write_pair(std::size_t i, const FunctionRow& row, const std::string& value) {
    const Instruction& c = code(i);
    const std::string& a = at(c.a);
    const bool is_first = row.first == c.op;
    const auto [place, is_new] = pairs_.try_emplace({row.first, c.a});
    auto& [first, second] = place->second;
    if (!is_new) {  // the other came before and wrote both
      const std::string& known = is_first ? first : second;
      assign_value(value_[i], known);
      return assign_next(value_[i], known + "_k");
    }
    assign_value(value_[i], value);
    const std::string name(function_row(row.partner).name);
    const std::string partner = member(value_[i] + "_" + name);
    first = is_first ? value_[i] : partner;
    second = is_first ? partner : value_[i];
    assign_value(partner, called(name, a));
    std::map<Slot, Series> series{{Slot::argument, {a, a + "_k"}},
                                  {Slot::value, {first, first + "_k"}},
                                  {Slot::helper, {second, second + "_k"}}};
    for (const SeriesStep& step : series_steps(c.op)) write_step(step, series);
  }

  /// The angle of (b, a): r y' = b a' - a b' with r = a a + b b.
  void write_angle(const std::string& y, const Instruction& c) {
    const std::string &a = at(c.a), &b = at(c.b);
    const std::string r = member(y + "_square"), inverse = member(y + "_inverse");
    assign_value(r, a + " * " + a + " + " + b + " * " + b);
    assign_value(inverse, "1 / " + r);
    std::string square, turn;
    if (varies(c.a)) {
      square += "2 * " + a + " * " + a + "_k + " + sum(a, a);
      turn += a + "_k * " + b + (varies(c.b) ? " + " + slope(a, b) : "");
    }
    if (varies(c.b)) {
      square += (square.empty() ? "" : " + ") + ("2 * " + b + " * " + b + "_k + " + sum(b, b));
      turn += " - " + b + "_k * " + a + (varies(c.a) ? " - " + slope(b, a) : "");
    }
    assign_next(r, square);
    assign_next(y, "(" + turn + " - " + slope(y, r) + ") * " + inverse);
  }

  /// Whether the rates are polynomials of the states of a degree so low that the series of a
  /// solution shows all of their terms: no other operation, and no time.
  bool is_smooth() const {
    constexpr int kHighest = 3;
    if (uses_time_) return false;
    std::vector<int> degree(program_.code.size(), 0);
    for (std::size_t i = 0; i < program_.code.size(); ++i) {
      const Instruction& c = code(i);
      if (constant_[i] || !varies_[i]) continue;
      const int a = c.op == Op::input ? 1 : degree[index(c.a)];
      const int b = c.b < 0 || c.op == Op::input ? 0 : degree[index(c.b)];
      const bool linear = c.op == Op::input || c.op == Op::add || c.op == Op::sub ||
                          c.op == Op::neg || (c.op == Op::div && !varies(c.b));
      if (!linear && c.op != Op::mul) return false;
      degree[i] = c.op == Op::mul ? a + b : std::max(a, b);
      if (degree[i] > kHighest) return false;
    }
    return true;
  }

  const Limits limits_;
  const bool lanes_;
  const Program program_;
  const std::vector<bool> constant_;
  Names unique_;
  std::vector<std::string> value_;
  std::vector<bool> varies_;
  std::vector<int> depth_;
  std::vector<std::string> inputs_;
  const std::size_t states_;
  std::set<std::size_t> used_parameters_;
  bool uses_time_ = false;
  std::map<std::pair<Op, int>, std::pair<std::string, std::string>> pairs_;
  std::map<SeriesSum, int> sums_;
  std::vector<SeriesSum> order_;
  std::string members_, begin_, next_;
  int count_ = 0;
};

}  // namespace

std::string SeriesRecurrences::declared() const {
  std::string all;
  for (std::size_t i = 0; i < states; ++i) all += (i == 0 ? "" : ", ") + inputs[i];
  for (const std::size_t i : used_parameters) all += ", " + inputs[i];
  if (uses_time) all += ", " + inputs.back();
  if (!members.empty()) all += ", " + members;
  return all;
}

SeriesRecurrences series_recurrences(const Program& rhs, const std::vector<std::string>& names,
                                     SeriesValue value, const Limits& limits) {
  return SeriesWriter(rhs, names, value, limits).run();
}

}  // namespace casimir::codegen
