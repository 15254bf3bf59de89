#include "codegen/emit/header_context.hpp"

#include <algorithm>

#include "codegen/emit/identifiers.hpp"
#include "runtime/program/function_table.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir::codegen {

namespace {

/// What locals of a header must not be called, beside what Names knows of.
std::vector<std::string> taken_names(Language language, bool of_map) {
  std::vector<std::string> names{"state_names", "invariant_names", "initial_state"};
  if (of_map) {
    for (const char* name : {"step", "inverse", "next", "previous", "tangent", "delta_next"})
      names.emplace_back(name);
  }
  if (language == Language::cpp) return names;
  for (const FunctionRow& function : function_table()) {
    for (const char* suffix : {"f", "l"}) names.push_back(std::string(function.c_name) + suffix);
  }
  return names;
}

StatementStyle style_for(const HeaderOptions& options, const Limits& limits) {
  StatementStyle style;
  style.limits = limits;
  style.scalar = options.scalar;
  if (options.language == Language::c) {
    const bool is_float = options.scalar == Scalar::real32;
    const bool is_long = options.scalar == Scalar::long_double;
    style.real = is_float ? "float" : is_long ? "long double" : "double";
    style.call_prefix.clear();
    style.call_suffix = is_float ? "f" : is_long ? "l" : "";
    style.c_casts = true;
    return style;
  }
  const bool is_template = options.scalar == Scalar::templated;
  style.real = options.scalar == Scalar::real64 ? "double" : is_template ? "Real" : "real";
  if (is_template) style.call_prefix.clear();
  if (options.scalar == Scalar::float128) {
    style.call_prefix.clear();
    style.call_suffix = "q";
  }
  return style;
}

}  // namespace

HeaderContext::HeaderContext(const Specialisation& specialisation, const HeaderOptions& options)
    : spec(specialisation),
      is_template(options.scalar == Scalar::templated),
      style(style_for(options, spec.limits)) {
  Names unique(taken_names(options.language, specialisation.of_map));
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    sources.push_back("x[" + std::to_string(i) + "]");
    names.push_back(unique.unique(spec.states[i]));
  }
  for (const std::string& parameter : spec.parameters) {
    names.push_back(unique.unique(parameter));
    sources.push_back((options.language == Language::c ? "p->" : "p.") + names.back());
  }
  sources.push_back("t");
  names.push_back("t");
}

MotionWords HeaderContext::words() const {
  if (!spec.of_map)
    return {.rhs = "rhs",
            .target = "dx",
            .comment = "The time derivatives of the state.",
            .variational = "variational",
            .deviation_target = "ddelta_x",
            .deviation = "The rhs, and the derivative of a small deviation delta_x carried along.",
            .jacobian = "J[i + dimension*j] = d(dx[i])/d(x[j]), all entries.",
            .conserved = "Conserved along solutions: ",
            .inverse = ""};
  return {.rhs = "step",
          .target = "next",
          .comment = "The next state. `next` is not `x`.",
          .variational = "tangent",
          .deviation_target = "delta_next",
          .deviation = "The next state, and the image of a small deviation delta_x.",
          .jacobian = "J[i + dimension*j] = d(next[i])/d(x[j]), all entries.",
          .conserved = "What the case says that the map keeps: ",
          .inverse =
              "The state before x: inverse(step(x)) = x is proved, wherever both have "
              "values. `previous` is not `x`."};
}

std::string HeaderContext::parameter_type() const {
  return is_template ? "parameters<Real>" : "parameters";
}

std::string HeaderContext::arguments(const std::string& state) const {
  return (spec.uses_time ? "t, " : "") + state + ", " + (has_parameters() ? "p, " : "");
}

std::string HeaderContext::start_value(std::size_t k, Scalar scalar) const {
  const int i = spec.start.outputs[k];
  const bool rational = is_rational(spec.start, i);
  return number_text(constant_value(spec.start, i, spec.limits), scalar,
                     rational ? "" : constant_text(spec.start, i))
      .text;
}

std::string HeaderContext::initial_values(Scalar scalar) const {
  std::string list;
  for (std::size_t i = 0; i < spec.states.size(); ++i)
    list += (i == 0 ? "" : ", ") + start_value(i, scalar);
  return list;
}

Slots HeaderContext::entries(const std::string& target, const Program& program,
                             const SparseProgram* matrix) const {
  Slots result{sources, names, {}};
  for (std::size_t k = 0; k < program.outputs.size(); ++k) {
    std::size_t place = k;
    if (matrix) {
      const auto& [row, column] = matrix->entries[k];
      place = static_cast<std::size_t>(row) + spec.states.size() * static_cast<std::size_t>(column);
    }
    result.targets.push_back(target + "[" + std::to_string(place) + "]");
  }
  return result;
}

Slots HeaderContext::variational() const {
  const std::size_t n = spec.states.size();
  const auto middle = static_cast<long>(n);
  Slots result;
  result.sources.assign(sources.begin(), sources.begin() + middle);
  result.names.assign(names.begin(), names.begin() + middle);
  Names more(names);
  const MotionWords of_motion = words();
  for (std::size_t i = 0; i < n; ++i) {
    result.sources.push_back("delta_x[" + std::to_string(i) + "]");
    result.names.push_back(more.unique("delta_" + names[i]));
    result.targets.push_back(of_motion.target + "[" + std::to_string(i) + "]");
  }
  for (std::size_t i = 0; i < n; ++i)
    result.targets.push_back(of_motion.deviation_target + "[" + std::to_string(i) + "]");
  result.sources.insert(result.sources.end(), sources.begin() + middle, sources.end());
  result.names.insert(result.names.end(), names.begin() + middle, names.end());
  return result;
}

Pattern pattern_of(const SparseProgram& matrix, std::size_t columns) {
  Pattern result{"0", ""};
  std::size_t k = 0;
  for (std::size_t column = 0; column < columns; ++column) {
    for (; k < matrix.entries.size() && matrix.entries[k].second == static_cast<int>(column); ++k)
      result.rows += (result.rows.empty() ? "" : ", ") + std::to_string(matrix.entries[k].first);
    result.columns += ", " + std::to_string(k);
  }
  return result;
}

std::string guard_of(const std::string& scope, bool given, const std::string& end) {
  std::string upper = scope;
  for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  const bool has_capitals = std::ranges::any_of(scope, [](char c) { return c >= 'A' && c <= 'Z'; });
  const std::string text = given && has_capitals ? scope + "_as_written" : upper;
  return "CASIMIR_GENERATED_" + text + (text.ends_with('_') ? "" : "_") + end;
}

std::string quoted_list(const std::vector<std::string>& values) {
  std::string list;
  for (const std::string& value : values)
    list += (list.empty() ? "" : ", ") + string_literal(value);
  return list;
}

std::string listed(const std::vector<std::string>& names) {
  std::string result;
  for (const std::string& name : names) result += (result.empty() ? "" : ", ") + name;
  return result;
}

}  // namespace casimir::codegen
