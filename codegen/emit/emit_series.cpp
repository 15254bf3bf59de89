// The recurrences of a straight-line program's Taylor coefficients, for the compiled kernel.
#include "codegen/emit/emit_series.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "codegen/emit/identifiers.hpp"
#include "codegen/emit/number_literal.hpp"
#include "codegen/emit/statements.hpp"
#include "codegen/optimise/lower.hpp"

namespace casimir::codegen {

namespace {

/// One series l times another r, as the kernel sums it. A weighted operand has j times its
/// coefficient j.
struct Sum {
  std::string left, right;
  bool weighted;
  friend auto operator<=>(const Sum&, const Sum&) = default;
};

/// Writes two passes over the program: the values at a state, which stay as members (`v3`), and
/// coefficient k of the same quantities (`v3_k`).
class SeriesWriter {
 public:
  SeriesWriter(const Program& rhs, const std::vector<std::string>& names, bool lanes)
      : lanes_(lanes),
        program_(without_dead_code(rhs)),
        constant_(constant_instructions(program_)),
        unique_({"V",      "c",      "rate",   "order",     "p",    "most", "states", "blocks",
                 "groups", "smooth", "width",  "k",         "by_k", "step", "unit",   "state",
                 "at",     "begin",  "expand", "form_sums", "lane", "pack", "row",    "enter",
                 "inner",  "room",   "begun_", "series_",   "sum_", "each"}),
        value_(program_.code.size()),
        varies_(program_.code.size(), false),
        states_(program_.outputs.size()) {
    for (const std::string& name : names) inputs_.push_back(fresh(name));
  }

  std::string run() {
    for (std::size_t i = 0; i < program_.code.size(); ++i) write(i);
    return lanes_ ? assembled_lanes() : assembled();
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  const Instruction& code(std::size_t i) const { return program_.code[i]; }

  std::string literal(std::size_t i) {
    const int line = static_cast<int>(i);
    const bool rational = is_rational(program_, line);
    const NumberText number = number_text(constant_value(program_, line), Scalar::real64,
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
    Sum wanted{left, right, weighted};
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
      value_[i] = member("v" + std::to_string(++count_));
      write_operation(i);
    }
  }

  void write_input(std::size_t i) {
    const std::size_t input = index(code(i).a);
    varies_[i] = input < states_ || input + 1 == inputs_.size();
    value_[i] = inputs_[input];
    if (input >= states_ && input + 1 < inputs_.size()) used_parameters_.insert(input);
    uses_time_ = uses_time_ || input + 1 == inputs_.size();
  }

  bool varies(int i) const { return i >= 0 && varies_[index(i)]; }
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
    assign_next(value_[i], sum(a, b) + " + " + a + " * " + b + "_k + " + a + "_k * " + b);
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
    assign_next(y,
                "(" + next(c.a) + " - " + y + " * " + b + "_k - " + sum(y, b) + ") * " + inverse);
  }

  std::string called(const char* function, const std::string& arguments) const {
    const std::string builtin = "__builtin_" + std::string(function);
    if (!lanes_) return builtin + "(" + arguments + ")";
    return "casimir_kernel::lanes::each<V>([](auto... x) { return " + builtin + "(x...); }, " +
           arguments + ")";
  }

  void write_function(std::size_t i) {
    const Instruction& c = code(i);
    const std::string &a = at(c.a), &y = value_[i];
    static constexpr const char* kNames[] = {"pow", "sqrt", "sin",  "cos",   "tan", "exp",
                                             "log", "asin", "acos", "atan2", "fabs"};
    if (c.op == Op::sign) return write_sign(i);
    const char* const name = kNames[static_cast<int>(c.op) - static_cast<int>(Op::pow)];
    assign_value(y, called(name, c.b < 0 ? a : a + ", " + at(c.b)));
    if (!varies_[i]) return;
    switch (c.op) {
      case Op::pow:
        return write_power(y, a, at(c.b));
      case Op::sqrt:
        return write_root(y, a + "_k");
      case Op::sin:
      case Op::cos:
        return write_sine_or_cosine(i);
      case Op::tan:
        return write_tangent(y, a);
      case Op::exp:  // y' = a' y
        return assign_next(y, a + "_k * " + y + " + " + slope(a, y));
      case Op::log:  // a y' = a'
        return write_ratio(y, a + "_k", a);
      case Op::asin:
      case Op::acos:
        return write_arc(c.op, y, a);
      case Op::abs:
        return write_modulus(y, a);
      default:
        return write_angle(y, c);
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
    assign_value(value_[i], side(a, lanes_ ? "V{}" : "0."));
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
    assign_next(y, "(" + numerator + " - " + slope(y, f) + ") * " + inverse);
  }

  /// y y = a.
  void write_root(const std::string& y, const std::string& next_of_square) {
    const std::string half = member(y + "_half");
    assign_value(half, "0.5 / " + y);
    assign_next(y, "(" + next_of_square + " - " + sum(y, y) + ") * " + half);
  }

  /// a y' = e y a'.
  void write_power(const std::string& y, const std::string& a, const std::string& e) {
    const std::string inverse = member(y + "_inverse");
    assign_value(inverse, "1 / " + a);
    assign_next(y, "(" + e + " * (" + a + "_k * " + y + " + " + slope(a, y) + ") - " + slope(y, a) +
                       ") * " + inverse);
  }

  /// Each of the two needs the other.
  void write_sine_or_cosine(std::size_t i) {
    const Instruction& c = code(i);
    const std::string& a = at(c.a);
    const auto [place, is_new] = turns_.try_emplace(c.a);
    auto& [sine, cosine] = place->second;
    if (!is_new) {  // the other came before and wrote both
      const std::string& known = c.op == Op::sin ? sine : cosine;
      next_ += "        const " + real() + " " + value_[i] + "_k = " + known + "_k;\n";
      return;
    }
    const std::string partner = member(value_[i] + (c.op == Op::sin ? "_cos" : "_sin"));
    sine = c.op == Op::sin ? value_[i] : partner;
    cosine = c.op == Op::sin ? partner : value_[i];
    assign_value(partner, called(c.op == Op::sin ? "cos" : "sin", a));
    assign_next(sine, a + "_k * " + cosine + " + " + slope(a, cosine));
    assign_next(cosine, "-(" + a + "_k * " + sine + " + " + slope(a, sine) + ")");
  }

  /// y' = a' u with u = 1 + y y.
  void write_tangent(const std::string& y, const std::string& a) {
    const std::string u = member(y + "_slope");
    assign_value(u, "1 + " + y + " * " + y);
    assign_next(y, a + "_k * " + u + " + " + slope(a, u));
    assign_next(u, "2 * " + y + " * " + y + "_k + " + sum(y, y));
  }

  /// u y' = a' or -a' with u u = 1 - a a.
  void write_arc(Op op, const std::string& y, const std::string& a) {
    const std::string u = member(y + "_root");
    assign_value(u, called("sqrt", "(1 - " + a + ") * (1 + " + a + ")"));
    write_root(u, "-(2 * " + a + " * " + a + "_k + " + sum(a, a) + ")");
    write_ratio(y, (op == Op::asin ? "" : "-") + a + "_k", u);
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

  static std::string packed(const std::string& target, const std::vector<std::string>& entries,
                            const std::string& indent) {
    if (entries.empty()) return "";
    std::string text = indent + "pack(" + target;
    for (const std::string& entry : entries) text += ", " + entry;
    return wrapped(text + ");") + "\n";
  }

  std::string begin_function() const {
    std::string text = "    void begin([[maybe_unused]] double at, const V* state) {\n";
    for (std::size_t i = 0; i < states_; ++i) {
      text += "      " + inputs_[i] + " = lane(state, " + std::to_string(i) + ");\n";
    }
    for (const std::size_t i : used_parameters_)
      text += "      " + inputs_[i] + " = p[" + std::to_string(i - states_) + "];\n";
    if (uses_time_) text += "      " + inputs_.back() + " = at;\n";
    std::vector<std::string> rates;
    for (const int output : program_.outputs) rates.push_back(at(output));
    return text + begin_ + packed("rate", rates, "      ") + "    }\n";
  }

  std::string expand_function() const {
    std::vector<std::string> first, rates, next_states, left, right;
    for (std::size_t i = 0; i < states_; ++i) {
      first.push_back(inputs_[i] + "_1");
      rates.push_back(next(program_.outputs[i]));
    }
    for (const Sum& s : order_) {
      left.push_back(s.weighted ? "k * " + s.left + "_k" : s.left + "_k");
      right.push_back(s.right + "_k");
    }
    std::string text = "    void expand(double unit) {\n";
    text += "      for (int b = 0; b < blocks; ++b) c[1][b] = rate[b] * unit;\n";
    for (std::size_t i = 0; i < states_; ++i) {
      text += "      double " + inputs_[i] + "_k = lane(c[1], " + std::to_string(i) + ");\n";
      next_states.push_back(inputs_[i] + "_k");
    }
    text +=
        "      for (int k = 1; k < order; ++k) {\n"
        "        [[maybe_unused]] const double by_k = casimir_kernel::taylor::reciprocal.of[k];\n";
    if (uses_time_) text += "        const double " + inputs_.back() + "_k = k == 1 ? unit : 0;\n";
    if (!order_.empty()) text += "        form_sums(k);\n";
    text += next_ + packed("left_[k]", left, "        ") + packed("right_[k]", right, "        ") +
            "        const casimir_kernel::taylor::Part<double> step(unit, k + 1);\n";
    // A rate may be another state as it is: all are formed before any is replaced.
    for (std::size_t i = 0; i < states_; ++i)
      text += "        const double " + inputs_[i] + "_next = step * (" + rates[i] + ");\n";
    for (std::size_t i = 0; i < states_; ++i)
      text += "        " + inputs_[i] + "_k = " + inputs_[i] + "_next;\n";
    return text + packed("c[k + 1]", next_states, "        ") + "      }\n    }\n";
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

  std::string assembled() {
    std::string all = "    double ";
    for (std::size_t i = 0; i < states_; ++i) all += (i == 0 ? "" : ", ") + inputs_[i];
    for (const std::size_t i : used_parameters_) all += ", " + inputs_[i];
    if (uses_time_) all += ", " + inputs_.back();
    if (!members_.empty()) all += ", " + members_;
    const std::string base = "casimir_kernel::taylor::Convolved<" + std::to_string(states_) + ", " +
                             std::to_string(order_.size()) + ">";
    return "  // Taylor coefficients of solutions: values at the state, and coefficient k of "
           "each.\n"
           "  struct Series : " +
           base + " {\n    static constexpr bool smooth = " + (is_smooth() ? "true" : "false") +
           ";\n" + wrapped(all + ";") + "\n\n" + begin_function() + "\n" + expand_function() +
           "  };\n";
  }

  // One trajectory in each lane.

  std::string begin_in_lanes() const {
    std::string text = "    void begin([[maybe_unused]] V at, const V* state, V* rate) {\n";
    for (std::size_t i = 0; i < states_; ++i)
      text += "      " + inputs_[i] + " = state[" + std::to_string(i) + "];\n";
    for (const std::size_t i : used_parameters_)
      text += "      " + inputs_[i] + " = p[" + std::to_string(i - states_) + "];\n";
    if (uses_time_) text += "      " + inputs_.back() + " = at;\n";
    text += begin_;
    for (std::size_t i = 0; i < states_; ++i) {
      const std::string place = std::to_string(i);
      text += wrapped("      rate[" + place + "] = begun_[" + place + "] = V{} + " +
                      at(program_.outputs[i]) + ";") +
              "\n";
    }
    return text + "    }\n";
  }

  /// The series that sums are formed of, each with its row: weighted ones are others.
  std::map<std::pair<std::string, bool>, std::size_t> rows_of_sums() const {
    std::map<std::pair<std::string, bool>, std::size_t> rows;
    for (const Sum& s : order_) {
      rows.try_emplace({s.left, s.weighted}, rows.size());
      rows.try_emplace({s.right, false}, rows.size());
    }
    return rows;
  }

  std::string expand_in_lanes() const {
    const auto rows = rows_of_sums();
    const auto row = [&](const std::string& name, bool weighted) {
      return "series_[" + std::to_string(rows.at({name, weighted})) + "]";
    };
    std::string text = "    void expand(V unit) {\n";
    for (std::size_t i = 0; i < states_; ++i) {
      const std::string place = std::to_string(i);
      text +=
          "      V " + inputs_[i] + "_k = c[" + place + "][1] = begun_[" + place + "] * unit;\n";
    }
    text +=
        "      for (int k = 1; k < order; ++k) {\n"
        "        [[maybe_unused]] const double by_k = casimir_kernel::taylor::reciprocal.of[k];\n";
    if (uses_time_) text += "        const V " + inputs_.back() + "_k = k == 1 ? unit : V{};\n";
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const Sum& s = order_[i];
      text += "        sum_[" + std::to_string(i) + "] = inner(" + row(s.left, s.weighted) + ", " +
              row(s.right, false) + ", k);\n";
    }
    text += next_;
    for (const auto& [series, place] : rows)
      text += "        series_[" + std::to_string(place) +
              "][k] = " + (series.second ? "static_cast<double>(k) * " : "") + series.first +
              "_k;\n";
    text += "        const casimir_kernel::taylor::Part<V> step(unit, k + 1);\n";
    for (std::size_t i = 0; i < states_; ++i)
      text +=
          "        const V " + inputs_[i] + "_next = step * (" + next(program_.outputs[i]) + ");\n";
    for (std::size_t i = 0; i < states_; ++i)
      text += "        c[" + std::to_string(i) + "][k + 1] = " + inputs_[i] + "_k = " + inputs_[i] +
              "_next;\n";
    return text + "      }\n    }\n";
  }

  std::string assembled_lanes() {
    std::string all = "    V ";
    for (std::size_t i = 0; i < states_; ++i) all += (i == 0 ? "" : ", ") + inputs_[i];
    for (const std::size_t i : used_parameters_) all += ", " + inputs_[i];
    if (uses_time_) all += ", " + inputs_.back();
    if (!members_.empty()) all += ", " + members_;
    const std::size_t parameters = program_.inputs.size() - states_ - 1;
    std::string base = "casimir_kernel::lanes::Convolved<";
    for (const std::size_t count : {states_, parameters, rows_of_sums().size()})
      base += std::to_string(count) + ", ";
    return "// Taylor coefficients of solutions: values at the state, and coefficient k of each.\n"
           "  struct Series : " +
           base + std::to_string(order_.size()) + "> {\n" + wrapped(all + ";") + "\n\n" +
           begin_in_lanes() + "\n" + expand_in_lanes() + "  };\n";
  }

  const bool lanes_;
  const Program program_;
  const std::vector<bool> constant_;
  Names unique_;
  std::vector<std::string> value_;
  std::vector<bool> varies_;
  std::vector<std::string> inputs_;
  const std::size_t states_;
  std::set<std::size_t> used_parameters_;
  bool uses_time_ = false;
  std::map<int, std::pair<std::string, std::string>> turns_;
  std::map<Sum, int> sums_;
  std::vector<Sum> order_;
  std::string members_, begin_, next_;
  int count_ = 0;
};

}  // namespace

std::string series_struct(const Program& rhs, const std::vector<std::string>& names) {
  return SeriesWriter(rhs, names, false).run();
}

std::string lane_series_struct(const Program& rhs, const std::vector<std::string>& names) {
  return SeriesWriter(rhs, names, true).run();
}

}  // namespace casimir::codegen
