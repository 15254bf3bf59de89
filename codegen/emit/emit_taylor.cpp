// Taylor coefficients of solutions: the recurrences of a straight-line program, as C++ text.
#include <algorithm>
#include <map>
#include <set>

#include "codegen/emit/header_context.hpp"
#include "codegen/emit/identifiers.hpp"
#include "codegen/optimise/lower.hpp"
#include "runtime/program/function_table.hpp"

namespace casimir::codegen {

namespace {

/// A function of the header: coefficient k >= 1 (products: k >= 0) of a series, from those of its
/// arguments and the earlier ones of its own.
struct Helper {
  const char* name;
  const char* text;
};

constexpr Helper kHelpers[] = {{"taylor_product", R"(template <class Real>
inline Real taylor_product(const Real* a, const Real* b, int k) {
  Real sum = a[0] * b[k];
  for (int j = 1; j <= k; ++j) sum += a[j] * b[k - j];
  return sum;
}
)"},
                               {"taylor_quotient", R"(// q = a / b, from coefficient k of a.
template <class Real>
inline Real taylor_quotient(Real a, const Real* b, const Real* q, int k) {
  for (int j = 0; j < k; ++j) a -= q[j] * b[k - j];
  return a / b[0];
}
)"},
                               {"taylor_sqrt", R"(template <class Real>
inline Real taylor_sqrt(const Real* a, const Real* s, int k) {
  Real sum = a[k];
  for (int j = 1; j < k; ++j) sum -= s[j] * s[k - j];
  return sum / (2 * s[0]);
}
)"},
                               {"taylor_integral", R"(// The series whose derivative is a' * f.
template <class Real>
inline Real taylor_integral(const Real* a, const Real* f, int k) {
  Real sum = 0;
  for (int j = 1; j <= k; ++j) sum += static_cast<Real>(j) * a[j] * f[k - j];
  return sum / static_cast<Real>(k);
}
)"},
                               {"taylor_ratio", R"(// The series y whose derivative is a' / f.
template <class Real>
inline Real taylor_ratio(const Real* a, const Real* f, const Real* y, int k) {
  Real sum = 0;
  for (int j = 1; j < k; ++j) sum += static_cast<Real>(j) * y[j] * f[k - j];
  return (a[k] - sum / static_cast<Real>(k)) / f[0];
}
)"},
                               {"taylor_pow", R"(template <class Real>
inline Real taylor_pow(const Real* a, Real exponent, const Real* y, int k) {
  Real sum = 0;
  for (int j = 1; j <= k; ++j) {
    sum += (exponent * static_cast<Real>(j) - static_cast<Real>(k - j)) * a[j] * y[k - j];
  }
  return sum / (static_cast<Real>(k) * a[0]);
}
)"},
                               {"taylor_atan2", R"(// The angle of (b, a), where d = a*a + b*b.
template <class Real>
inline Real taylor_atan2(const Real* a, const Real* b, const Real* d, const Real* y, int k) {
  Real sum = 0;
  for (int j = 1; j <= k; ++j) sum += static_cast<Real>(j) * (a[j] * b[k - j] - b[j] * a[k - j]);
  for (int j = 1; j < k; ++j) sum -= static_cast<Real>(j) * y[j] * d[k - j];
  return sum / (static_cast<Real>(k) * d[0]);
}
)"}};

class TaylorWriter {
 public:
  explicit TaylorWriter(const HeaderContext& context)
      : context_(context),
        program_(without_dead_code(context.spec.rhs)),
        unique_(context.names),
        varies_(program_.code.size(), false),
        series_(program_.code.size()),
        fixed_(program_.code.size()),
        inlined_(program_.code.size()) {
    const std::size_t n = context.spec.states.size();
    for (std::size_t i = 0; i < program_.code.size(); ++i) {
      const Instruction& c = code(i);
      if (c.op == Op::input) {
        const auto input = static_cast<std::size_t>(c.a);
        varies_[i] = input < n || input + 1 == context.names.size();
        if (varies_[i]) series_[i] = input < n ? state(input) : "time_series";
      } else if (c.op != Op::constant && c.op != Op::pi) {
        varies_[i] = varies_[index(c.a)] || (c.b >= 0 && varies_[index(c.b)]);
      }
    }
  }

  std::string run() {
    const std::vector<bool> kept = kept_values();
    for (std::size_t i = 0; i < program_.code.size(); ++i) {
      if (!varies_[i] || code(i).op == Op::input) continue;
      kept[i] ? write(i) : static_cast<void>(inlined_[i] = sum_or_product(code(i)));
    }
    const std::string steps = state_steps();
    const std::string text = signature() + start() + fixed_values() + arrays_ +
                             "\n  for (int degree = 0; degree < Order; ++degree) {\n" + loop_ +
                             steps + "  }\n}\n\n";
    std::string helpers;
    for (const Helper& helper : kHelpers) {
      if (used_.contains(helper.name)) helpers += std::string(helper.text) + "\n";
    }
    return helpers + text;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  const Instruction& code(std::size_t i) const { return program_.code[i]; }
  const std::string& real() const { return context_.style.real; }
  std::string state(std::size_t i) const { return context_.names[i]; }

  std::string call(const char* helper, const std::string& arguments) {
    used_.insert(helper);
    return std::string(helper) + "(" + arguments + ", degree)";
  }

  std::string new_array(const std::string& wanted) {
    const std::string name = unique_.unique(wanted);
    arrays_ += "  " + real() + " " + name + "[Order + 1] = {};\n";
    return name;
  }

  void assign(const std::string& array, const std::string& value) {
    loop_ += wrapped("    " + array + "[degree] = " + value + ";") + "\n";
  }

  void assign_from(const std::string& array, const std::string& first, const std::string& value) {
    assign(array, "degree == 0 ? " + first + " : " + value);
  }

  /// A value that does not vary, as the name of a local.
  std::string fixed(int i) {
    std::string& name = fixed_[index(i)];
    if (name.empty()) {
      const Instruction& c = code(index(i));
      if (c.op == Op::constant) {
        const NumberText number =
            number_text(program_.constants[index(c.a)], context_.style.scalar);
        if (number.is_plain && number.text[0] != '-') return name = number.text;
      }
      name = unique_.unique("fixed_" + std::to_string(fixed_order_.size() + 1));
      fixed_order_.push_back(i);
    }
    return name;
  }

  /// Whether a value must be kept for later powers of the time: as an operand of anything but a
  /// sum, or because it is used more than once.
  std::vector<bool> kept_values() const {
    std::vector<int> uses(program_.code.size(), 0);
    std::vector<bool> kept(program_.code.size(), false);
    for (const int output : program_.outputs) ++uses[index(output)];
    for (std::size_t i = 0; i < program_.code.size(); ++i) {
      const Instruction& c = code(i);
      if (c.op == Op::input || c.op == Op::constant || c.op == Op::pi) continue;
      const bool linear = c.op == Op::add || c.op == Op::sub || c.op == Op::neg ||
                          (c.op == Op::mul && !(varies_[index(c.a)] && varies_[index(c.b)]));
      const bool itself = c.op != Op::mul && !linear;  // recurrences in their own coefficients
      kept[i] = kept[i] || itself;
      for (const int operand : {c.a, c.b}) {
        if (operand < 0) continue;
        ++uses[index(operand)];
        if (!linear) kept[index(operand)] = true;
      }
    }
    for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = kept[i] || uses[i] > 1;
    return kept;
  }

  /// The current coefficient of an operand; in parentheses if it is a sum and they are needed.
  std::string term(int i, bool needs_parentheses = false) {
    const std::string& text = inlined_[index(i)];
    if (!text.empty()) {
      const Op op = code(index(i)).op;
      const bool is_sum = op == Op::add || op == Op::sub || op == Op::neg;
      return is_sum && needs_parentheses ? "(" + text + ")" : text;
    }
    return varies_[index(i)] ? series_[index(i)] + "[degree]"
                             : "(degree == 0 ? " + fixed(i) + " : 0)";
  }

  /// All coefficients of an operand.
  std::string series(int i) {
    if (series_[index(i)].empty()) {  // a fixed argument of atan2
      series_[index(i)] = new_array("series_" + std::to_string(++count_));
      arrays_ += "  " + series_[index(i)] + "[0] = " + fixed(i) + ";\n";
    }
    return series_[index(i)];
  }

  std::string first_value(std::string_view function, const std::string& arguments) const {
    return context_.style.call_prefix + std::string(function) + context_.style.call_suffix + "(" +
           arguments + ")";
  }

  void write(std::size_t i) {
    const Instruction& c = code(i);
    if (is_function(c.op) && function_row(c.op).partner != c.op) return write_pair(i);
    const std::string y = new_array("series_" + std::to_string(++count_));
    series_[i] = y;
    switch (c.op) {
      case Op::add:
      case Op::sub:
      case Op::neg:
      case Op::mul:
        return assign(y, sum_or_product(c));
      case Op::div:
        if (!varies_[index(c.b)]) return assign(y, term(c.a) + " / " + fixed(c.b));
        return assign(
            y, call("taylor_quotient", real() + "(" + term(c.a) + "), " + series(c.b) + ", " + y));
      default:
        return write_function(c, y);
    }
  }

  std::string sum_or_product(const Instruction& c) {
    if (c.op == Op::add) return term(c.a) + " + " + term(c.b, true);
    if (c.op == Op::sub) return term(c.a) + " - " + term(c.b, true);
    if (c.op == Op::neg) return "-" + term(c.a, true);
    if (!varies_[index(c.a)]) return fixed(c.a) + " * " + term(c.b, true);
    if (!varies_[index(c.b)]) return term(c.a, true) + " * " + fixed(c.b);
    return call("taylor_product", series(c.a) + ", " + series(c.b));
  }

  void write_function(const Instruction& c, const std::string& y) {
    const std::string a = series(c.a);
    switch (function_row(c.op).step[0].rule) {
      case SeriesRule::power: {
        const std::string exponent = fixed(c.b);
        return assign_from(y, first_value("pow", a + "[0], " + exponent),
                           call("taylor_pow", a + ", " + exponent + ", " + y));
      }
      case SeriesRule::side: {  // where it begins at zero, the first term that is not says where
        const std::string side = unique_.unique(y + "_side");
        arrays_ += "  " + real() + " " + side + " = 0;\n";
        loop_ += "    if (" + side + " == 0) " + side + " = " + a + "[degree] > 0 ? 1 : " + a +
                 "[degree] < 0 ? -1 : 0;\n";
        return assign(y, side + " * " + a + "[degree]");
      }
      case SeriesRule::constant: {
        jumps_ = true;
        // What has no value has no sign either, and where it begins at zero the terms that say on
        // which side it goes on may depend on the sign.
        const auto number = [&](const std::string& text) {
          return "static_cast<" + real() + ">(" + text + ")";
        };
        return assign(y, "degree > 0 ? " + number("0") + " : " + a + "[0] > 0 ? " + number("1") +
                             " : " + a + "[0] < 0 ? " + number("-1") + " : " + "(" + a + "[0] - " +
                             a + "[0]) / (" + a + "[0] - " + a + "[0])");
      }
      case SeriesRule::angle: {
        const std::string b = series(c.b);
        const std::string squares = new_array(y + "_squares");
        assign(squares,
               call("taylor_product", a + ", " + a) + " + " + call("taylor_product", b + ", " + b));
        return assign_from(y, first_value("atan2", a + "[0], " + b + "[0]"),
                           call("taylor_atan2", a + ", " + b + ", " + squares + ", " + y));
      }
      default:
        return write_steps(c.op, a, y);
    }
  }

  /// The recurrence of a function of one argument.
  void write_steps(Op op, const std::string& a, const std::string& y) {
    std::map<Slot, std::string> array{{Slot::argument, a}, {Slot::value, y}};
    for (const SeriesStep& step : series_steps(op)) {
      std::string& name = array[step.target];
      if (!name.empty()) continue;
      const std::string_view wanted = step.target == Slot::inner ? "rest" : function_row(op).helper;
      name = new_array(y + "_" + std::string(wanted));
    }
    for (const SeriesStep& step : series_steps(op)) write_step(op, step, array);
  }

  void write_step(Op op, const SeriesStep& step, const std::map<Slot, std::string>& array) {
    const std::string &y = array.at(step.target), &a = array.at(step.of);
    const bool negative = step.sign < 0;
    if (step.rule == SeriesRule::squares) {
      const std::string one = "static_cast<" + real() + ">(degree == 0 ? 1 : 0)";
      const std::string square = call("taylor_product", a + ", " + a);
      return assign(y, negative ? one + " - " + square : square + " + " + one);
    }
    if (step.rule == SeriesRule::root)
      return assign_from(y, first_value("sqrt", a + "[0]"), call("taylor_sqrt", a + ", " + y));
    const Op own = step.target == Slot::value ? op : function_row(op).partner;
    const std::string start =
        first_value(function_row(own).c_name, array.at(Slot::argument) + "[0]");
    const std::string& f = array.at(step.by);
    if (step.rule == SeriesRule::integral)
      return assign_from(y, start, (negative ? "-" : "") + call("taylor_integral", a + ", " + f));
    std::string numerator = a;
    if (negative) {
      numerator = new_array(y + "_minus");
      assign(numerator, "-" + a + "[degree]");
    }
    assign_from(y, start, call("taylor_ratio", numerator + ", " + f + ", " + y));
  }

  /// Each of the two needs the other.
  void write_pair(std::size_t i) {
    const Instruction& c = code(i);
    const FunctionRow& row = function_row(c.op);
    auto& [first, second] = pairs_[{row.first, c.a}];
    if (first.empty()) {
      const std::string a = series(c.a);
      const FunctionRow& other = function_row(function_row(row.first).partner);
      const std::string number = "_" + std::to_string(++count_);
      first = new_array(std::string(function_row(row.first).name) + number);
      second = new_array(std::string(other.name) + number);
      const std::map<Slot, std::string> array{
          {Slot::argument, a}, {Slot::value, first}, {Slot::helper, second}};
      for (const SeriesStep& step : series_steps(c.op)) write_step(row.first, step, array);
    }
    series_[i] = row.first == c.op ? first : second;
  }

  std::string signature() const {
    const std::string unused = "[[maybe_unused]] ";
    std::string text =
        "// Taylor coefficients of the solution through x: coefficients[i + dimension*k] belongs "
        "to\n"
        "// the power k of the time from there, k = 0 .. Order.\n";
    if (jumps_)
      text +=
          "// They are no numbers where the argument of a sign is 0 at x: on which side the "
          "motion\n"
          "// goes on may depend on them.\n";
    text += context_.is_template ? "template <int Order, class Real>\n" : "template <int Order>\n";
    return text +
           wrapped(
               "inline void taylor(" + (context_.spec.uses_time ? unused + real() + " t, " : "") +
               "const " + real() + "* x, " +
               (context_.has_parameters() ? unused + "const " + context_.parameter_type() + "& p, "
                                          : "") +
               real() + "* coefficients) {") +
           "\n" + (context_.is_template ? using_declarations(program_) + extra_using() : "");
  }

  /// Sines need cosines and the other way round; asin and acos need sqrt.
  std::string extra_using() const {
    const std::string present = using_declarations(program_);
    std::string text;
    const auto add = [&](std::string_view name) {
      const std::string line = "  using std::" + std::string(name) + ";\n";
      if (present.find(line) == std::string::npos && text.find(line) == std::string::npos)
        text += line;
    };
    for (const Instruction& c : program_.code) {
      if (!is_function(c.op)) continue;
      if (function_row(c.op).partner != c.op) add(function_row(function_row(c.op).partner).c_name);
      for (const SeriesStep& step : series_steps(c.op))
        if (step.rule == SeriesRule::root) add("sqrt");
    }
    return text;
  }

  std::string start() const {
    std::string text;
    for (std::size_t i = 0; i < context_.spec.states.size(); ++i) {
      text += "  " + real() + " " + state(i) + "[Order + 1] = {" + context_.sources[i] + "};\n";
    }
    if (context_.spec.uses_time) {
      text += "  " + real() +
              " time_series[Order + 1] = {t};\n"
              "  if constexpr (Order > 0) time_series[1] = 1;\n";
    }
    return text + "  for (int i = 0; i < dimension; ++i) coefficients[i] = x[i];\n";
  }

  /// The values that do not vary, by the statements of a program of their own.
  std::string fixed_values() const {
    if (fixed_order_.empty()) return "";
    Program constants = program_;
    constants.outputs = fixed_order_;
    constants.output_names.assign(fixed_order_.size(), "");
    std::vector<std::string> targets;
    for (const int i : fixed_order_) targets.push_back("const " + real() + " " + fixed_[index(i)]);
    return statements(without_dead_code(constants), context_.sources, context_.names, targets,
                      context_.style);
  }

  std::string state_steps() {
    const std::string divisor = unique_.unique("next");
    std::string text = loop_.empty() ? "" : "\n";
    text += "    const " + real() + " " + divisor + " = static_cast<" + real() + ">(degree + 1);\n";
    for (std::size_t i = 0; i < program_.outputs.size(); ++i) {
      const std::string rate = term(program_.outputs[i], true);
      text += wrapped("    " + state(i) + "[degree + 1] = " + rate + " / " + divisor + ";") + "\n";
    }
    for (std::size_t i = 0; i < program_.outputs.size(); ++i) {
      text += "    coefficients[dimension * (degree + 1) + " + std::to_string(i) +
              "] = " + state(i) + "[degree + 1];\n";
    }
    return text;
  }

  const HeaderContext& context_;
  const Program program_;
  Names unique_;
  std::vector<bool> varies_;
  std::vector<std::string> series_;
  std::vector<std::string> fixed_;
  std::vector<int> fixed_order_;
  std::vector<std::string> inlined_;
  std::map<std::pair<Op, int>, std::pair<std::string, std::string>> pairs_;
  std::set<std::string> used_;
  std::string arrays_;
  std::string loop_;
  bool jumps_ = false;  ///< it has a sign
  int count_ = 0;
};

}  // namespace

std::string taylor(const HeaderContext& context) { return TaylorWriter(context).run(); }

}  // namespace casimir::codegen
