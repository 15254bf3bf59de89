// The struct of Taylor coefficients for a compiled kernel, of one trajectory.
#include "codegen/emit/emit_series.hpp"
#include "codegen/emit/series_recurrences.hpp"
#include "codegen/emit/statements.hpp"

namespace casimir::codegen {
namespace {

/// As arguments behind another.
std::string further(const std::vector<std::string>& arguments) {
  std::string text;
  for (const std::string& argument : arguments) text += ", " + argument;
  return text;
}

std::string packed(const std::string& target, const std::vector<std::string>& numbers,
                   const std::string& indent) {
  if (numbers.empty()) return "";
  return wrapped(indent + "pack(" + target + further(numbers) + ");") + "\n";
}

std::string begin_function(const SeriesRecurrences& r) {
  std::string text = "    void begin([[maybe_unused]] double at, const V* state) {\n";
  for (std::size_t i = 0; i < r.states; ++i) {
    text += "      " + r.inputs[i] + " = lane(state, " + std::to_string(i) + ");\n";
  }
  for (const std::size_t i : r.used_parameters)
    text += "      " + r.inputs[i] + " = p[" + std::to_string(i - r.states) + "];\n";
  if (r.uses_time) text += "      " + r.inputs.back() + " = at;\n";
  return text + r.begin + packed("rate", r.rates, "      ") + "    }\n";
}

/// What stands in the sums of a kernel, coefficients of order k.
struct Operands {
  std::vector<std::string> left, right;
};

Operands operands_of(const SeriesRecurrences& r) {
  Operands result;
  for (const SeriesSum& s : r.sums) {
    result.left.push_back(s.weighted ? "k * " + s.left + "_k" : s.left + "_k");
    result.right.push_back(s.right + "_k");
  }
  return result;
}

/// Of more sums, what the newest coefficients add to each costs more than to wait for all of them.
constexpr std::size_t kFewSums = 8;

bool has_few_sums(const SeriesRecurrences& r) { return r.sums.size() <= kFewSums; }

/// What sums are formed of, for the orders that follow.
std::string packed_operands(const SeriesRecurrences& r) {
  const Operands operands = operands_of(r);
  return packed("left_[k]", operands.left, "        ") +
         packed("right_of(k)", operands.right, "        ");
}

/// The sums of order k + 1, of which `form_inner` has all but what the coefficients of order k add:
/// l[1] r[k] + l[k] r[1], of order 2 the first alone.
std::string sums_of_next_order(const SeriesRecurrences& r) {
  const Operands operands = operands_of(r);
  const std::string indent = "        ";
  std::string text =
      wrapped(indent + "if (k == 1) store(first_left_" + further(operands.left) + ");") + "\n";
  for (std::size_t i = 0; i < r.sums.size(); ++i) {
    const std::string place = "[" + std::to_string(i) + "]";
    text +=
        wrapped(indent + "sum_" + place + " = formed_" + place + " + first_left_" + place + " * " +
                operands.right[i] + " + " + operands.left[i] + " * first_right_" + place + ";") +
        "\n";
  }
  return text +
         wrapped(indent + "if (k == 1) store(first_right_" + further(operands.right) + ");") + "\n";
}

std::string expand_function(const SeriesRecurrences& r) {
  std::vector<std::string> next_states;
  std::string text = "    void expand(double unit) {\n";
  text += "      for (int b = 0; b < blocks; ++b) c[1][b] = rate[b] * unit;\n";
  for (std::size_t i = 0; i < r.states; ++i) {
    text += "      double " + r.inputs[i] + "_k = lane(c[1], " + std::to_string(i) + ");\n";
    next_states.push_back(r.inputs[i] + "_k");
  }
  const bool few = has_few_sums(r);
  if (!few) {
    text += "      const double* const sum_ = formed_;\n";
  } else if (!r.sums.empty()) {
    text += "      double sum_[" + std::to_string(r.sums.size()) + "] = {};\n" +
            "      for (double& first : first_right_) first = 0;\n      clear_operands();\n";
  }
  text +=
      "      for (int k = 1; k < order; ++k) {\n"
      "        [[maybe_unused]] const double by_k = casimir_kernel::taylor::reciprocal.of[k];\n";
  if (r.uses_time) text += "        const double " + r.inputs.back() + "_k = k == 1 ? unit : 0;\n";
  if (!r.sums.empty()) text += few ? "        form_inner(k + 1);\n" : "        form_sums(k);\n";
  text += r.next + packed_operands(r);
  if (few && !r.sums.empty()) text += sums_of_next_order(r);
  text += "        const casimir_kernel::taylor::Part<double> step(unit, k + 1);\n";
  // A rate may be another state as it is: all are formed before any is replaced.
  for (std::size_t i = 0; i < r.states; ++i)
    text += "        const double " + r.inputs[i] + "_next = step * (" + r.next_rates[i] + ");\n";
  for (std::size_t i = 0; i < r.states; ++i)
    text += "        " + r.inputs[i] + "_k = " + r.inputs[i] + "_next;\n";
  return text + packed("c[k + 1]", next_states, "        ") + "      }\n    }\n";
}

}  // namespace

std::string series_struct(const Program& rhs, const std::vector<std::string>& names,
                          const Limits& limits) {
  const SeriesRecurrences r = series_recurrences(rhs, names, SeriesValue::number, limits);
  const std::string base = "casimir_kernel::taylor::Convolved<" + std::to_string(r.states) + ", " +
                           std::to_string(r.sums.size()) +
                           (has_few_sums(r) ? ", true>" : ", false>");
  return "  // Taylor coefficients of solutions: values at the state, and coefficient k of "
         "each.\n"
         "  struct Series : " +
         base + " {\n    static constexpr bool smooth = " + (r.smooth ? "true" : "false") + ";\n" +
         wrapped("    double " + r.declared() + ";") + "\n\n" + begin_function(r) + "\n" +
         expand_function(r) + "  };\n";
}

}  // namespace casimir::codegen
