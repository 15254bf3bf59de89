// The header for users who write C.
#include <algorithm>
#include <vector>

#include "codegen/emit/header_context.hpp"
#include "codegen/emit/identifiers.hpp"
#include "codegen/emit/statements.hpp"
#include "codegen/emit_cpp.hpp"
#include "symbolic/error.hpp"

namespace casimir::codegen {

namespace {

/// C has no namespaces: every name at file scope begins with that of the case.
class CWriter {
 public:
  CWriter(const Specialisation& spec, const HeaderOptions& options)
      : context_(spec, options),
        prefix_(options.name ? *options.name + "_" : prefix_of(spec.case_name)),
        guard_(guard_of(prefix_.substr(0, prefix_.size() - 1), options.name.has_value(), "H")),
        sparse_jacobian_(options.sparse_jacobian) {}

  std::string run() const {
    std::string text = head_comment(spec_, true) + ownership_comment() + "#ifndef " + guard_ +
                       "\n#define " + guard_ + "\n\n" + includes() + constants();
    text += function(words_.rhs, words_.comment, spec_.rhs, {words_.target},
                     context_.entries(words_.target, spec_.rhs, nullptr));
    if (spec_.has_inverse) {
      text += function("inverse", words_.inverse, spec_.inverse, {"previous"},
                       context_.entries("previous", spec_.inverse, nullptr));
    }
    if (!spec_.invariant_names.empty()) {
      text += function("invariants", words_.conserved + listed(spec_.invariant_names) + ".",
                       spec_.invariants, {"values"},
                       context_.entries("values", spec_.invariants, nullptr));
      if (spec_.has_gradients) text += gradients();
    }
    if (spec_.has_jacobian) text += jacobian();
    if (spec_.has_variational) {
      text += function(words_.variational, words_.deviation, spec_.variational,
                       {words_.target, words_.deviation_target}, context_.variational());
    }
    return text + "#endif  // " + guard_ + "\n";
  }

 private:
  static std::string prefix_of(const std::string& case_name) {
    const std::string name = Names().unique(case_name);
    return name.ends_with('_') ? name : name + "_";
  }

  std::string includes() const {
    const bool calls = needs_math_library(spec_) || calls_functions(spec_.gradients.program) ||
                       calls_functions(spec_.variational) || calls_functions(spec_.inverse);
    return calls ? "#include <math.h>\n\n" : "";
  }

  std::string table(const std::string& type, const std::string& name,
                    const std::string& list) const {
    if (list.empty()) return "";
    return wrapped("static const " + type + " " + prefix_ + name + "[] = {" + list + "};") + "\n";
  }

  std::string constants() const {
    const std::size_t last = spec_.start.outputs.size() - 1;
    std::string text =
        "enum { " + prefix_ + "dimension = " + std::to_string(spec_.states.size()) + " };\n";
    text += "enum { " + prefix_ +
            "invariant_count = " + std::to_string(spec_.invariant_names.size()) + " };\n";
    text += table("char* const", "state_names", quoted_list(spec_.states));
    text += table("char* const", "invariant_names", quoted_list(spec_.invariant_names));
    text += table(style_.real, "initial_state", context_.initial_values(style_.scalar));
    if (spec_.has_duration) {
      text += "static const " + style_.real + " " + prefix_ +
              "duration = " + context_.start_value(last, style_.scalar) + ";\n";
    }
    return text + "\n" + parameter_struct();
  }

  std::string parameter_struct() const {
    if (!context_.has_parameters()) return "";
    const std::size_t first = spec_.states.size();
    std::string fields, values;
    for (std::size_t i = first; i < first + spec_.parameters.size(); ++i) {
      fields += "  " + style_.real + " " + context_.names[i] + ";\n";
      values += (i == first ? "" : ", ") + context_.start_value(i, style_.scalar);
    }
    return "// What may be chosen at run time, and the values of the scene.\ntypedef struct {\n" +
           fields + "} " + prefix_ + "parameters;\n" +
           wrapped("static const " + prefix_ + "parameters " + prefix_ + "default_parameters = {" +
                   values + "};") +
           "\n\n";
  }

  std::string gradients() const {
    const SparseProgram& matrix = spec_.gradients;
    return function("gradients",
                    "dvalues[i + dimension*k] = d(values[k])/d(x[i]): the gradient of each "
                    "invariant.",
                    matrix.program, {"dvalues"},
                    context_.entries("dvalues", matrix.program, &matrix),
                    zeros("dvalues", matrix, spec_.invariant_names.size()));
  }

  std::string jacobian() const {
    const SparseProgram& matrix = spec_.jacobian;
    std::string text;
    if (!matrix.entries.empty()) {
      const Pattern pattern = pattern_of(matrix, spec_.states.size());
      text +=
          "// Where the Jacobian may differ from zero: column j in the rows jacobian_rows[k],\n"
          "// jacobian_columns[j] <= k < jacobian_columns[j + 1].\nenum { " +
          prefix_ + "jacobian_nonzeros = " + std::to_string(matrix.entries.size()) + " };\n" +
          table("int", "jacobian_columns", pattern.columns) +
          table("int", "jacobian_rows", pattern.rows) + "\n";
    }
    text += function("jacobian", words_.jacobian, matrix.program, {"J"},
                     context_.entries("J", matrix.program, &matrix),
                     zeros("J", matrix, spec_.states.size()));
    if (!sparse_jacobian_) return text;
    return text + function("jacobian_entries",
                           "The entries of the Jacobian that are not always zero, as in "
                           "jacobian_rows.",
                           matrix.program, {"entries"},
                           context_.entries("entries", matrix.program, nullptr));
  }

  std::string zeros(const std::string& target, const SparseProgram& matrix,
                    std::size_t columns) const {
    const std::size_t all = spec_.states.size() * columns;
    if (matrix.entries.size() == all) return "";
    return "  for (int i = 0; i < " + std::to_string(all) + "; ++i) " + target + "[i] = 0;\n";
  }

  /// \param written  the parameters that are written to.
  /// \param before   statements in front of those of the program.
  std::string function(const std::string& name, const std::string& comment, const Program& program,
                       const std::vector<std::string>& written, const Slots& slots,
                       const std::string& before = "") const {
    const std::size_t n = spec_.states.size();
    const std::vector<bool> used = used_inputs(program);
    const auto any_of = [&](std::size_t from, std::size_t count) {
      return std::find(used.begin() + static_cast<long>(from),
                       used.begin() + static_cast<long>(from + count),
                       true) != used.begin() + static_cast<long>(from + count);
    };
    std::string parameters, unused;
    const auto parameter = [&](const std::string& type, const std::string& local, bool is_used) {
      parameters += (parameters.empty() ? "" : ", ") + type + " " + local;
      if (!is_used) unused += "  (void)" + local + ";\n";
    };
    const bool with_deviation = written.size() > 1;
    if (spec_.uses_time) parameter(style_.real, "t", used.back());
    parameter("const " + style_.real + "*", "x", any_of(0, n));
    if (with_deviation) parameter("const " + style_.real + "*", "delta_x", any_of(n, n));
    if (context_.has_parameters()) {
      parameter("const " + prefix_ + "parameters*", "p",
                any_of(with_deviation ? 2 * n : n, spec_.parameters.size()));
    }
    const bool writes = !program.outputs.empty() || !before.empty();
    for (const std::string& target : written) parameter(style_.real + "*", target, writes);
    return comment_lines(comment) +
           wrapped("static inline void " + prefix_ + name + "(" + parameters + ") {") + "\n" +
           unused + before +
           statements(program, slots.sources, slots.names, slots.targets, style_) + "}\n\n";
  }

  const HeaderContext context_;
  const Specialisation& spec_ = context_.spec;
  const MotionWords words_ = context_.words();
  const StatementStyle& style_ = context_.style;
  const std::string prefix_, guard_;
  const bool sparse_jacobian_;
};

}  // namespace

std::string emit_c_header(const Specialisation& spec, const HeaderOptions& options) {
  if (options.scalar == Scalar::templated || options.scalar == Scalar::float128)
    throw ModelError("C99 has the number types double, float and long double");
  if (spec.taylor) {
    throw ModelError(
        "Taylor coefficients are a template of C++: there is no form of them for the language C");
  }
  return CWriter(spec, options).run();
}

}  // namespace casimir::codegen
