// The struct of Taylor coefficients for a compiled kernel, of one trajectory.
#include "codegen/emit/emit_series.hpp"
#include "codegen/emit/series_recurrences.hpp"
#include "codegen/emit/statements.hpp"

namespace casimir::codegen {
namespace {

std::string packed(const std::string& target, const std::vector<std::string>& entries,
                   const std::string& indent) {
  if (entries.empty()) return "";
  std::string text = indent + "pack(" + target;
  for (const std::string& entry : entries) text += ", " + entry;
  return wrapped(text + ");") + "\n";
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

std::string expand_function(const SeriesRecurrences& r) {
  std::vector<std::string> next_states, left, right;
  for (const SeriesSum& s : r.sums) {
    left.push_back(s.weighted ? "k * " + s.left + "_k" : s.left + "_k");
    right.push_back(s.right + "_k");
  }
  std::string text = "    void expand(double unit) {\n";
  text += "      for (int b = 0; b < blocks; ++b) c[1][b] = rate[b] * unit;\n";
  for (std::size_t i = 0; i < r.states; ++i) {
    text += "      double " + r.inputs[i] + "_k = lane(c[1], " + std::to_string(i) + ");\n";
    next_states.push_back(r.inputs[i] + "_k");
  }
  text +=
      "      for (int k = 1; k < order; ++k) {\n"
      "        [[maybe_unused]] const double by_k = casimir_kernel::taylor::reciprocal.of[k];\n";
  if (r.uses_time) text += "        const double " + r.inputs.back() + "_k = k == 1 ? unit : 0;\n";
  if (!r.sums.empty()) text += "        form_sums(k);\n";
  text += r.next + packed("left_[k]", left, "        ") + packed("right_[k]", right, "        ") +
          "        const casimir_kernel::taylor::Part<double> step(unit, k + 1);\n";
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
                           std::to_string(r.sums.size()) + ">";
  return "  // Taylor coefficients of solutions: values at the state, and coefficient k of "
         "each.\n"
         "  struct Series : " +
         base + " {\n    static constexpr bool smooth = " + (r.smooth ? "true" : "false") + ";\n" +
         wrapped("    double " + r.declared() + ";") + "\n\n" + begin_function(r) + "\n" +
         expand_function(r) + "  };\n";
}

}  // namespace casimir::codegen
