// The header for users.
#include <algorithm>
#include <utility>
#include <vector>

#include "codegen/emit/header_context.hpp"
#include "codegen/emit/identifiers.hpp"
#include "codegen/emit/statements.hpp"
#include "codegen/emit_cpp.hpp"
#include "codegen/prepare.hpp"
#include "runtime/program/function_table.hpp"

namespace casimir {

using codegen::HeaderContext;
using codegen::Names;
using codegen::StatementStyle;

namespace {

/// One generated function: name, what it writes, and the program.
struct Function {
  std::string name;
  std::string target;
  std::string comment;
  const Program& program;
  /// Where the outputs go in a matrix by columns with `dimension` rows; null: one after the other.
  const SparseProgram* matrix = nullptr;
  std::size_t columns = 0;
  std::string size = {};  ///< the number of its entries, as C++ has it
  bool prepared = false;  ///< takes `prepared` in place of `parameters`
};

class HeaderWriter {
 public:
  HeaderWriter(const Specialisation& spec, const HeaderOptions& options)
      : context_(spec, options), sparse_jacobian_(options.sparse_jacobian), name_(options.name) {}

  std::string run() {
    std::vector<std::string> taken = codegen::global_functions();
    for (const char* name : {"state_names", "invariant_names", "initial_state"})
      taken.emplace_back(name);
    Names namespaces(std::move(taken));
    const std::string scope = name_ ? *name_ : namespaces.unique(spec_.case_name);
    const std::string guard = codegen::guard_of(scope, name_.has_value(), "HPP");
    std::string text = codegen::head_comment(spec_, true) + codegen::ownership_comment() +
                       "#ifndef " + guard + "\n#define " + guard + "\n\n" + includes();
    text += "namespace " + scope + " {\n\n" + constants();
    text += function({words_.rhs, words_.target, words_.comment, spec_.rhs});
    if (spec_.has_inverse) text += function({"inverse", "previous", words_.inverse, spec_.inverse});
    if (!spec_.invariant_names.empty()) {
      text += function({"invariants", "values",
                        words_.conserved + codegen::listed(spec_.invariant_names) + ".",
                        spec_.invariants});
    }
    if (spec_.has_gradients && !spec_.invariant_names.empty()) text += gradients();
    if (spec_.has_jacobian) text += jacobian();
    if (context_.has_parameters()) text += preparation();
    if (is_template_) text += start_function();
    if (spec_.has_variational) text += variational();
    if (spec_.taylor) text += codegen::taylor(context_);
    if (!spec_.of_map) text += codegen::adapters(context_);
    return text + "}  // namespace " + scope + "\n\n#endif  // " + guard + "\n";
  }

 private:
  std::string gradients() const {
    return function({"gradients", "dvalues",
                     "dvalues[i + dimension*k] = d(values[k])/d(x[i]): the gradient of each "
                     "invariant.",
                     spec_.gradients.program, &spec_.gradients, spec_.invariant_names.size(),
                     "dimension * " + std::to_string(spec_.invariant_names.size())});
  }

  std::string prepared_type() const { return is_template_ ? "prepared<Real>" : "prepared"; }

  /// The parameters with what depends on nothing else, and the functions that take it. They have
  /// the names of those that take `parameters`; its constructor is explicit, so that {} still means
  /// these.
  std::string preparation() {
    std::vector<Program> programs{spec_.rhs};
    if (spec_.has_jacobian) programs.push_back(spec_.jacobian.program);
    prepared_ = codegen::prepared(programs, spec_.states.size(), spec_.parameters.size());
    Names names(names_);
    for (const std::string& name : prepared_.prepare.output_names)
      prepared_names_.push_back(names.unique(name));
    const std::string head = is_template_ ? "template <class Real>\n" : "";
    std::string text =
        codegen::comment_lines("The parameters, with what depends on nothing else computed once.") +
        head + prepared_struct() + head + "inline " + prepared_type() + " prepare(const " +
        context_.parameter_type() + "& p) { return " + prepared_type() + "(p); }\n\n";
    if (prepared_names_.empty())
      return text + forwarded(words_.rhs, words_.target) +
             (spec_.has_jacobian ? forwarded("jacobian", "J") : "");
    text += function({.name = words_.rhs,
                      .target = words_.target,
                      .comment = words_.comment,
                      .program = prepared_.rest[0],
                      .prepared = true});
    if (!spec_.has_jacobian) return text;
    const SparseProgram matrix{spec_.jacobian.entries, prepared_.rest[1]};
    return text + function({.name = "jacobian",
                            .target = "J",
                            .comment = words_.jacobian,
                            .program = matrix.program,
                            .matrix = &matrix,
                            .columns = spec_.states.size(),
                            .size = "dimension * dimension",
                            .prepared = true});
  }

  /// A function that gains nothing from what is prepared.
  std::string forwarded(const std::string& name, const std::string& target) const {
    const std::string real = style_.real;
    return (is_template_ ? "template <class Real>\n" : "") +
           codegen::wrapped("inline void " + name + "(" + (spec_.uses_time ? real + " t, " : "") +
                            "const " + real + "* x, const " + prepared_type() + "& p, " + real +
                            "* " + target + ") {") +
           "\n  " + name + "(" + (spec_.uses_time ? "t, " : "") + "x, p.p, " + target + ");\n}\n\n";
  }

  std::string prepared_struct() const {
    const Program& program = prepared_.prepare;
    const auto of_parameters = [&](const std::vector<std::string>& all) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(spec_.states.size());
      return std::vector<std::string>(begin,
                                      begin + static_cast<std::ptrdiff_t>(spec_.parameters.size()));
    };
    std::string fields;
    std::vector<std::string> targets;
    for (const std::string& name : prepared_names_) {
      fields += "  " + style_.real + " " + name + " = 0;\n";
      targets.push_back("this->" + name);
    }
    StatementStyle inner = style_;
    inner.indent = "    ";
    const std::string statements = codegen::statements(program, of_parameters(context_.sources),
                                                       of_parameters(names_), targets, inner);
    return "struct prepared {\n  " + context_.parameter_type() + " p;\n" + fields +
           "  explicit prepared(const " + context_.parameter_type() + "& values) : p(values) {" +
           (targets.empty() ? "}\n" : "\n" + using_declarations(program) + statements + "  }\n") +
           "};\n\n";
  }

  /// Parameters are members of the parameters in `prepared`.
  void read_prepared(codegen::Slots& slots) const {
    const std::size_t first = spec_.states.size(), count = spec_.parameters.size();
    for (std::size_t i = first; i < first + count; ++i) slots.sources[i] = "p." + slots.sources[i];
    std::vector<std::string> members;
    for (const std::string& name : prepared_names_) members.push_back("p." + name);
    slots.sources.insert(slots.sources.end() - 1, members.begin(), members.end());
    slots.names.insert(slots.names.end() - 1, prepared_names_.begin(), prepared_names_.end());
  }

  std::string jacobian() const {
    const SparseProgram& matrix = spec_.jacobian;
    std::string text =
        pattern() + function({"jacobian", "J", words_.jacobian, matrix.program, &matrix,
                              spec_.states.size(), "dimension * dimension"});
    if (sparse_jacobian_) {
      text +=
          function({"jacobian_entries", "entries",
                    "The entries of the Jacobian that are not always zero, as in jacobian_rows.",
                    matrix.program});
    }
    return text;
  }

  /// The places of the entries, as sparse matrices by columns have them.
  std::string pattern() const {
    const auto& entries = spec_.jacobian.entries;
    if (entries.empty()) return "";
    const codegen::Pattern pattern = codegen::pattern_of(spec_.jacobian, spec_.states.size());
    const auto array = [](const std::string& name, const std::string& list) {
      return codegen::wrapped("inline constexpr int " + name + "[] = {" + list + "};") + "\n";
    };
    return "// Where the Jacobian may differ from zero: column j in the rows jacobian_rows[k],\n"
           "// jacobian_columns[j] <= k < jacobian_columns[j + 1].\n"
           "inline constexpr int jacobian_nonzeros = " +
           std::to_string(entries.size()) + ";\n" + array("jacobian_columns", pattern.columns) +
           array("jacobian_rows", pattern.rows) + "\n";
  }

  std::string includes() const {
    std::string text;
    if (style_.scalar == Scalar::float128) return "#include <quadmath.h>\n\n";
    return needs_math_library(spec_) || has_irrational_constants() ? "#include <cmath>\n\n" : text;
  }

  /// In a template these are computed where they are used.
  bool has_irrational_constants() const {
    if (!is_template_) return false;
    const auto is_function = [](const Instruction& c) {
      return casimir::is_function(c.op) || c.op == Op::pi;
    };
    return std::ranges::any_of(spec_.rhs.code, is_function) ||
           std::ranges::any_of(spec_.invariants.code, is_function) ||
           std::ranges::any_of(spec_.gradients.program.code, is_function) ||
           std::ranges::any_of(spec_.jacobian.program.code, is_function) ||
           std::ranges::any_of(spec_.variational.code, is_function) ||
           std::ranges::any_of(spec_.inverse.code, is_function);
  }

  static std::string names_array(const std::string& name, const std::vector<std::string>& values) {
    if (values.empty()) return "";
    return codegen::wrapped("inline constexpr const char* " + name + "[] = {" +
                            codegen::quoted_list(values) + "};") +
           "\n";
  }

  std::string constants() const {
    // Those of a template are doubles; `start` has them in its number type.
    const std::string real = is_template_ ? "double" : style_.real;
    const Scalar scalar = is_template_ ? Scalar::real64 : style_.scalar;
    std::string text;
    if (style_.scalar == Scalar::float128) text += "__extension__ typedef __float128 real;\n";
    if (style_.scalar == Scalar::long_double) text += "using real = long double;\n";
    if (style_.scalar == Scalar::real32) text += "using real = float;\n";
    text += "inline constexpr int dimension = " + std::to_string(spec_.states.size()) + ";\n";
    text += names_array("state_names", spec_.states);
    text += names_array("invariant_names", spec_.invariant_names);
    text += codegen::wrapped("inline constexpr " + real + " initial_state[] = {" +
                             context_.initial_values(scalar) + "};") +
            "\n";
    if (spec_.has_duration) {
      text += "inline constexpr " + real +
              " duration = " + context_.start_value(spec_.start.outputs.size() - 1, scalar) + ";\n";
    }
    return text + "\n" + parameter_struct();
  }

  std::string parameter_struct() const {
    if (!context_.has_parameters()) return "";
    std::string text = "// What may be chosen at run time; the defaults are those of the scene.\n";
    if (is_template_) text += "template <class Real>\n";
    text += "struct parameters {\n";
    for (std::size_t i = 0; i < spec_.parameters.size(); ++i) {
      const std::string value = context_.start_value(spec_.states.size() + i, style_.scalar);
      text += "  " + style_.real + " " + names_[spec_.states.size() + i] + " = " + value + ";\n";
    }
    return text + "};\n\n";
  }

  std::string signature(const Function& f) const {
    const std::vector<bool> used = codegen::used_inputs(f.program);
    const bool reads_state =
        std::any_of(used.begin(), used.begin() + static_cast<long>(spec_.states.size()),
                    [](bool one) { return one; });
    const bool reads_parameters = std::any_of(used.begin() + static_cast<long>(spec_.states.size()),
                                              used.end() - 1, [](bool one) { return one; });
    const auto named = [](bool is_used, const std::string& type, const std::string& name) {
      return type + (is_used ? " " + name : " /*" + name + "*/");
    };
    std::string text = "inline void " + f.name + "(";
    if (spec_.uses_time) text += named(used.back(), style_.real, "t") + ", ";
    text += named(reads_state, "const " + style_.real + "*", "x") + ", ";
    if (context_.has_parameters())
      text +=
          named(reads_parameters,
                "const " + (f.prepared ? prepared_type() : context_.parameter_type()) + "&", "p") +
          ", ";
    return text + named(writes(f), style_.real + "*", f.target) + ") {\n";
  }

  /// The exact initial state in the number type of a template.
  std::string start_function() const {
    std::string text =
        "// The initial state in that number type.\ntemplate <class Real>\n"
        "inline void start(Real* x) {\n";
    for (std::size_t i = 0; i < spec_.states.size(); ++i) {
      text += "  x[" + std::to_string(i) + "] = " + context_.start_value(i, style_.scalar) + ";\n";
    }
    return text + "}\n\n";
  }

  std::string variational() const {
    const codegen::Slots slots = context_.variational();
    const std::string real = style_.real;
    const std::string unused = "[[maybe_unused]] ";
    std::string text = codegen::comment_lines(words_.deviation);
    if (is_template_) text += "template <class Real>\n";
    text += codegen::wrapped(
        "inline void " + words_.variational + "(" +
        (spec_.uses_time ? unused + real + " t, " : "") + unused + "const " + real + "* x, " +
        unused + "const " + real + "* delta_x, " +
        (context_.has_parameters() ? unused + "const " + context_.parameter_type() + "& p, " : "") +
        real + "* " + words_.target + ", " + real + "* " + words_.deviation_target + ") {");
    return text + "\n" + using_declarations(spec_.variational) +
           codegen::statements(spec_.variational, slots.sources, slots.names, slots.targets,
                               style_) +
           "}\n\n";
  }

  static bool writes(const Function& f) { return !f.program.outputs.empty() || f.matrix; }

  std::string function(const Function& f) const {
    codegen::Slots slots = context_.entries(f.target, f.program, f.matrix);
    if (f.prepared) read_prepared(slots);
    std::string text =
        codegen::comment_lines(f.comment) + (is_template_ ? "template <class Real>\n" : "");
    text += signature(f) + using_declarations(f.program);
    if (f.matrix && f.matrix->entries.size() < spec_.states.size() * f.columns) {
      text += "  for (int i = 0; i < " + f.size + "; ++i) " + f.target + "[i] = 0;\n";
    }
    return text +
           codegen::statements(f.program, slots.sources, slots.names, slots.targets, style_) +
           "}\n\n";
  }

  std::string using_declarations(const Program& program) const {
    return is_template_ ? codegen::using_declarations(program) : "";
  }

  const HeaderContext context_;
  codegen::Prepared prepared_;
  std::vector<std::string> prepared_names_;
  const bool sparse_jacobian_;
  const std::optional<std::string> name_;
  const Specialisation& spec_ = context_.spec;
  const codegen::MotionWords words_ = context_.words();
  const StatementStyle& style_ = context_.style;
  const std::vector<std::string>& names_ = context_.names;
  const bool is_template_ = context_.is_template;
};

}  // namespace

std::string emit_header(const Specialisation& spec, const HeaderOptions& options) {
  if (options.name) codegen::check_header_name(*options.name, options.language != Language::c);
  if (options.language == Language::c) return codegen::emit_c_header(spec, options);
  return HeaderWriter(spec, options).run();
}

}  // namespace casimir
