// The header for users.
#include <algorithm>
#include <utility>
#include <vector>

#include "codegen/emit_cpp.hpp"
#include "codegen/names.hpp"
#include "codegen/statements.hpp"

namespace casimir {

using codegen::Names;
using codegen::StatementStyle;

namespace {

/// One generated function: name, what it writes, and the program.
struct Function {
  std::string name;
  std::string target;
  std::string comment;
  const Program& program;
};

class HeaderWriter {
 public:
  HeaderWriter(const Specialisation& spec, Scalar scalar)
      : spec_(spec), is_template_(scalar == Scalar::templated) {
    style_.scalar = scalar;
    style_.real = scalar == Scalar::real64 ? "double" : is_template_ ? "Real" : "real";
    if (is_template_) style_.call_prefix.clear();
    if (scalar == Scalar::float128) {
      style_.call_prefix.clear();
      style_.call_suffix = "q";
    }
    name_inputs();
  }

  std::string run() {
    Names namespaces({"state_names", "invariant_names", "initial_state"});
    const std::string scope = namespaces.unique(spec_.case_name);
    const std::string guard = guard_of(scope);
    std::string text = codegen::head_comment(spec_) + "#ifndef " + guard + "\n#define " + guard +
                       "\n\n" + includes();
    text += "namespace " + scope + " {\n\n" + constants();
    text += function({"rhs", "dx", "The time derivatives of the state.", spec_.rhs});
    if (!spec_.invariant_names.empty()) {
      text += function({"invariants", "values",
                        "Conserved along solutions: " + invariant_list() + ".", spec_.invariants});
    }
    if (spec_.has_jacobian) {
      text += function({"jacobian", "J", "J[i + dimension*j] = d(dx[i])/d(x[j]), all entries.",
                        spec_.jacobian.program});
    }
    return text + adapters() + "}  // namespace " + scope + "\n\n#endif  // " + guard + "\n";
  }

 private:
  /// `#pragma once` would be a warning where the header is compiled alone.
  static std::string guard_of(const std::string& scope) {
    std::string result = "CASIMIR_GENERATED_";
    for (const char c : scope)
      result += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return result + (result.ends_with('_') ? "HPP" : "_HPP");
  }

  bool has_parameters() const { return !spec_.parameters.empty(); }

  void name_inputs() {
    Names names({"state_names", "invariant_names", "initial_state"});
    for (std::size_t i = 0; i < spec_.states.size(); ++i) {
      sources_.push_back("x[" + std::to_string(i) + "]");
      names_.push_back(names.unique(spec_.states[i]));
    }
    for (const std::string& parameter : spec_.parameters) {
      names_.push_back(names.unique(parameter));
      sources_.push_back("p." + names_.back());
    }
    sources_.push_back("t");
    names_.push_back("t");
  }

  std::string includes() const {
    std::string text;
    if (style_.scalar == Scalar::float128) return "#include <quadmath.h>\n\n";
    return needs_math_library(spec_) || has_irrational_constants() ? "#include <cmath>\n\n" : text;
  }

  /// In a template these are computed where they are used.
  bool has_irrational_constants() const {
    if (!is_template_) return false;
    const auto is_function = [](const Instruction& c) { return c.op >= Op::pow || c.op == Op::pi; };
    return std::ranges::any_of(spec_.rhs.code, is_function) ||
           std::ranges::any_of(spec_.invariants.code, is_function) ||
           std::ranges::any_of(spec_.jacobian.program.code, is_function) ||
           std::ranges::any_of(spec_.start.code, is_function);
  }

  std::string invariant_list() const {
    std::string result;
    for (const std::string& name : spec_.invariant_names)
      result += (result.empty() ? "" : ", ") + name;
    return result;
  }

  static std::string names_array(const std::string& name, const std::vector<std::string>& values) {
    if (values.empty()) return "";
    std::string list;
    for (const std::string& value : values) {
      list += (list.empty() ? "" : ", ") + codegen::string_literal(value);
    }
    return codegen::wrapped("inline constexpr const char* " + name + "[] = {" + list + "};") + "\n";
  }

  /// The number that output k of Specialisation::start is.
  std::string start_value(std::size_t k) const {
    const int i = spec_.start.outputs[k];
    const bool rational = codegen::is_rational(spec_.start, i);
    // Start values of a template are doubles.
    const Scalar scalar = is_template_ ? Scalar::real64 : style_.scalar;
    return codegen::number_text(codegen::constant_value(spec_.start, i), scalar,
                                rational ? "" : codegen::constant_text(spec_.start, i))
        .text;
  }

  std::string constants() const {
    const std::string real = is_template_ ? "double" : style_.real;
    std::string text;
    if (style_.scalar == Scalar::float128) text += "__extension__ typedef __float128 real;\n";
    if (style_.scalar == Scalar::long_double) text += "using real = long double;\n";
    if (style_.scalar == Scalar::real32) text += "using real = float;\n";
    text += "inline constexpr int dimension = " + std::to_string(spec_.states.size()) + ";\n";
    text += names_array("state_names", spec_.states);
    text += names_array("invariant_names", spec_.invariant_names);
    std::string initial;
    for (std::size_t i = 0; i < spec_.states.size(); ++i) {
      initial += (i == 0 ? "" : ", ") + start_value(i);
    }
    text += codegen::wrapped("inline constexpr " + real + " initial_state[] = {" + initial + "};") +
            "\n";
    text += "inline constexpr " + real +
            " duration = " + start_value(spec_.start.outputs.size() - 1) + ";\n\n";
    return text + parameter_struct();
  }

  std::string parameter_struct() const {
    if (!has_parameters()) return "";
    std::string text = "// What may be chosen at run time; the defaults are those of the scene.\n";
    if (is_template_) text += "template <class Real>\n";
    text += "struct parameters {\n";
    for (std::size_t i = 0; i < spec_.parameters.size(); ++i) {
      const std::string value = start_value(spec_.states.size() + i);
      text += "  " + style_.real + " " + names_[spec_.states.size() + i] + " = " +
              (is_template_ ? "Real(" + value + ")" : value) + ";\n";
    }
    return text + "};\n\n";
  }

  std::string parameter_type() const { return is_template_ ? "parameters<Real>" : "parameters"; }

  /// "t, x, p, " as far as the functions take them.
  std::string arguments(const std::string& state) const {
    return (spec_.uses_time ? "t, " : "") + state + ", " + (has_parameters() ? "p, " : "");
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
    if (has_parameters())
      text += named(reads_parameters, "const " + parameter_type() + "&", "p") + ", ";
    return text + named(writes(f), style_.real + "*", f.target) + ") {\n";
  }

  bool writes(const Function& f) const { return !f.program.outputs.empty() || f.target == "J"; }

  std::string function(const Function& f) const {
    std::vector<std::string> targets;
    for (std::size_t k = 0; k < f.program.outputs.size(); ++k) {
      std::size_t place = k;
      if (f.target == "J") {
        const auto& [row, column] = spec_.jacobian.entries[k];
        place =
            static_cast<std::size_t>(row) + spec_.states.size() * static_cast<std::size_t>(column);
      }
      targets.push_back(f.target + "[" + std::to_string(place) + "]");
    }
    std::string text =
        codegen::comment_lines(f.comment) + (is_template_ ? "template <class Real>\n" : "");
    text += signature(f) + using_declarations(f.program);
    const std::size_t n = spec_.states.size();
    if (f.target == "J" && spec_.jacobian.entries.size() < n * n) {
      text += "  for (int i = 0; i < dimension * dimension; ++i) J[i] = 0;\n";
    }
    return text + codegen::statements(f.program, sources_, names_, targets, style_) + "}\n\n";
  }

  /// Functions of the number type of a template are found beside it, those of double in std.
  std::string using_declarations(const Program& program) const {
    if (!is_template_) return "";
    static constexpr std::pair<Op, const char*> kFunctions[] = {
        {Op::pow, "pow"},   {Op::sqrt, "sqrt"}, {Op::sin, "sin"},    {Op::cos, "cos"},
        {Op::tan, "tan"},   {Op::exp, "exp"},   {Op::log, "log"},    {Op::asin, "asin"},
        {Op::acos, "acos"}, {Op::pi, "acos"},   {Op::atan2, "atan2"}};
    std::string text;
    for (const auto& [op, name] : kFunctions) {
      const bool called =
          std::ranges::any_of(program.code, [op = op](const Instruction& c) { return c.op == op; });
      const std::string line = std::string("  using std::") + name + ";\n";
      if (called && text.find(line) == std::string::npos) text += line;
    }
    return text;
  }

  // --- adapters

  std::string adapters() const {
    std::string text = odeint_system();
    if (spec_.has_jacobian && !spec_.uses_time && !is_template_) text += stiff_system();
    if (style_.scalar == Scalar::real64) text += sundials();
    return text;
  }

  /// How an adapter that holds p hands it on: a template deduces it from the state.
  std::string member() const {
    if (!has_parameters()) return "";
    return is_template_ ? "  parameters<Real> p{};\n\n" : "  parameters p{};\n\n";
  }

  std::string odeint_system() const {
    std::string text =
        "// For Boost.Odeint: integrate_adaptive(stepper, system{}, x, t0, t1, dt).\n";
    if (is_template_ && has_parameters()) text += "template <class Real>\n";
    const std::string time = spec_.uses_time ? " t" : " /*t*/";
    text += "struct system {\n" + member() +
            "  template <class State, class Derivative, class Time>\n"
            "  void operator()(const State& x, Derivative& dxdt, Time" +
            time +
            ") const {\n"
            "    rhs(" +
            arguments("&x[0]") + "&dxdt[0]);\n  }\n};\n\n";
    return text;
  }

  std::string stiff_system() const {
    return "// For the implicit steppers of Boost.Odeint: std::pair(system{}, stiff_system{}).\n"
           "struct stiff_system {\n" +
           member() +
           "  template <class State, class Matrix, class Time, class Derivative>\n"
           "  void operator()(const State& x, Matrix& J, const Time& /*t*/, Derivative& dfdt) "
           "const {\n"
           "    " +
           style_.real +
           " columns[dimension * dimension];\n"
           "    jacobian(" +
           arguments("&x[0]") +
           "columns);\n"
           "    for (unsigned j = 0; j < dimension; ++j) {\n"
           "      for (unsigned i = 0; i < dimension; ++i) J(i, j) = columns[i + dimension * j];\n"
           "      dfdt[j] = 0;\n"
           "    }\n"
           "  }\n};\n\n";
  }

  std::string sundials() const {
    const std::string user = has_parameters() ? "void* user" : "void* /*user*/";
    const std::string time = spec_.uses_time ? "double t" : "double /*t*/";
    const std::string parameters = has_parameters()
                                       ? "  const parameters p = user ? *static_cast<const "
                                         "parameters*>(user) : parameters{};\n"
                                       : "";
    std::string text = "// For CVODE: CVodeInit(memory, sundials_rhs<N_Vector>, t0, y).";
    text += has_parameters() ? " User data: parameters, or null.\n" : "\n";
    text += "template <class Vector>\nint sundials_rhs(" + time + ", Vector y, Vector ydot, " +
            user + ") {\n" + parameters + "  rhs(" + arguments("N_VGetArrayPointer(y)") +
            "N_VGetArrayPointer(ydot));\n  return 0;\n}\n\n";
    if (!spec_.has_jacobian) return text;
    text +=
        "// For CVODE: CVodeSetJacFn(memory, sundials_jacobian<N_Vector, SUNMatrix>), dense "
        "matrices.\n"
        "template <class Vector, class Matrix>\nint sundials_jacobian(" +
        time + ", Vector y, Vector /*fy*/, Matrix J, " + user +
        ",\n"
        "                      Vector /*tmp1*/, Vector /*tmp2*/, Vector /*tmp3*/) {\n" +
        parameters + "  jacobian(" + arguments("N_VGetArrayPointer(y)") +
        "SUNDenseMatrix_Data(J));\n  return 0;\n}\n\n";
    return text;
  }

  const Specialisation& spec_;
  bool is_template_;
  StatementStyle style_;
  std::vector<std::string> sources_;
  std::vector<std::string> names_;
};

}  // namespace

std::string emit_header(const Specialisation& spec, const HeaderOptions& options) {
  return HeaderWriter(spec, options.scalar).run();
}

}  // namespace casimir
