// The struct of Taylor coefficients for a compiled kernel, one trajectory in each lane.
#include <map>
#include <utility>

#include "codegen/emit/emit_series.hpp"
#include "codegen/emit/series_recurrences.hpp"
#include "codegen/emit/statements.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir::codegen {
namespace {

std::string begin_in_lanes(const SeriesRecurrences& r) {
  std::string text = "    void begin([[maybe_unused]] V at, const V* state, V* rate) {\n";
  for (std::size_t i = 0; i < r.states; ++i)
    text += "      " + r.inputs[i] + " = state[" + std::to_string(i) + "];\n";
  for (const std::size_t i : r.used_parameters)
    text += "      " + r.inputs[i] + " = p[" + std::to_string(i - r.states) + "];\n";
  if (r.uses_time) text += "      " + r.inputs.back() + " = at;\n";
  text += r.begin;
  for (std::size_t i = 0; i < r.states; ++i) {
    const std::string place = std::to_string(i);
    text +=
        wrapped("      rate[" + place + "] = begun_[" + place + "] = V{} + " + r.rates[i] + ";") +
        "\n";
  }
  return text + "    }\n";
}

/// The series that sums are formed of, each with its row: weighted ones are others.
std::map<std::pair<std::string, bool>, std::size_t> rows_of_sums(const SeriesRecurrences& r) {
  std::map<std::pair<std::string, bool>, std::size_t> rows;
  for (const SeriesSum& s : r.sums) {
    rows.try_emplace({s.left, s.weighted}, rows.size());
    rows.try_emplace({s.right, false}, rows.size());
  }
  return rows;
}

std::string expand_in_lanes(const SeriesRecurrences& r) {
  const auto rows = rows_of_sums(r);
  const auto row = [&](const std::string& name, bool weighted) {
    return "series_[" + std::to_string(rows.at({name, weighted})) + "]";
  };
  std::string text = "    void expand(V unit) {\n";
  for (std::size_t i = 0; i < r.states; ++i) {
    const std::string place = std::to_string(i);
    text += "      V " + r.inputs[i] + "_k = c[" + place + "][1] = begun_[" + place + "] * unit;\n";
  }
  text +=
      "      for (int k = 1; k < order; ++k) {\n"
      "        [[maybe_unused]] const double by_k = casimir_kernel::taylor::reciprocal.of[k];\n";
  if (r.uses_time) text += "        const V " + r.inputs.back() + "_k = k == 1 ? unit : V{};\n";
  for (std::size_t i = 0; i < r.sums.size(); ++i) {
    const SeriesSum& s = r.sums[i];
    text += "        sum_[" + std::to_string(i) + "] = inner(" + row(s.left, s.weighted) + ", " +
            row(s.right, false) + ", k);\n";
  }
  text += r.next;
  for (const auto& [series, place] : rows)
    text += "        series_[" + std::to_string(place) +
            "][k] = " + (series.second ? "static_cast<double>(k) * " : "") + series.first + "_k;\n";
  text += "        const casimir_kernel::taylor::Part<V> step(unit, k + 1);\n";
  for (std::size_t i = 0; i < r.states; ++i)
    text += "        const V " + r.inputs[i] + "_next = step * (" + r.next_rates[i] + ");\n";
  for (std::size_t i = 0; i < r.states; ++i)
    text += "        c[" + std::to_string(i) + "][k + 1] = " + r.inputs[i] + "_k = " + r.inputs[i] +
            "_next;\n";
  return text + "      }\n    }\n";
}

}  // namespace

std::string lane_series_struct(const Program& rhs, const std::vector<std::string>& names,
                               const Limits& limits) {
  const SeriesRecurrences r = series_recurrences(rhs, names, SeriesValue::lanes, limits);
  const std::size_t parameters = r.inputs.size() - r.states - 1;
  std::string base = "casimir_kernel::lanes::Convolved<";
  for (const std::size_t count : {r.states, parameters, rows_of_sums(r).size()})
    base += std::to_string(count) + ", ";
  return "// Taylor coefficients of solutions: values at the state, and coefficient k of each.\n"
         "  struct Series : " +
         base + std::to_string(r.sums.size()) + "> {\n" + wrapped("    V " + r.declared() + ";") +
         "\n\n" + begin_in_lanes(r) + "\n" + expand_in_lanes(r) + "  };\n";
}

}  // namespace casimir::codegen
