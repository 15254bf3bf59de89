// The text of a loadable module.
#include <algorithm>
#include <utility>
#include <vector>

#include "codegen/emit/emit_series.hpp"
#include "codegen/emit/identifiers.hpp"
#include "codegen/emit/statements.hpp"
#include "codegen/emit_cpp.hpp"
#include "codegen/prepare.hpp"
#include "runtime/module_abi.h"

namespace casimir {

using codegen::Names;
using codegen::StatementStyle;

namespace {

std::string counted(int count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string state_list(const Specialisation& spec) {
  std::string result;
  for (const std::string& state : spec.states) result += " " + state;
  return result;
}

/// "scene "default" (r = 1)"; without the values, "any values of r, with a = 1".
std::string origin_text(const Specialisation& spec, bool with_values) {
  const bool scene = with_values || spec.parameters.empty();
  std::string kept, values;
  for (const auto& [name, value] : spec.values) {
    const bool at_run_time = std::ranges::count(spec.parameters, name) != 0;
    if (at_run_time) kept += (kept.empty() ? "" : ", ") + name;
    if (scene || !at_run_time) values += (values.empty() ? "" : ", ") + name + " = " + value;
  }
  if (scene) return "scene \"" + spec.scene + "\"" + (values.empty() ? "" : " (" + values + ")");
  return "any values of " + kept + (values.empty() ? "" : ", with " + values);
}

class ModuleText {
 public:
  explicit ModuleText(const Specialisation& spec) : spec_(spec) {
    for (std::size_t i = 0; i < spec.states.size(); ++i) {
      sources_.push_back("x[" + std::to_string(i) + "]");
    }
    for (std::size_t i = 0; i < spec.parameters.size(); ++i) {
      sources_.push_back("p[" + std::to_string(i) + "]");
    }
    Names names;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      names_.push_back(names.unique(spec.rhs.inputs[i]));
    }
    sources_.push_back("t");
    names_.push_back("t");
    style_.limits = spec_.limits;
    style_.call_prefix = "__builtin_";
    style_.indent = "    ";
  }

  std::string run(const std::string& kernel, const KernelNeeds& needs) {
    // The same text for all values of the parameters at run time: it is compiled once.
    std::string text = codegen::head_comment(spec_, false) + "\n";
    if (!kernel.empty()) text += kernel + (kernel.ends_with('\n') ? "\n" : "\n\n");
    text += "namespace {\n\nstruct System {\n  static constexpr int n = " +
            std::to_string(spec_.states.size()) + ";\n\n";
    // A kernel that is compiled with the system calls it with one set of parameters many times.
    if (!kernel.empty() && !needs.series && !spec_.parameters.empty()) prepare();
    if (prepares()) text += preparation();
    text += function("rhs", "dx", prepares() ? prepared_.rest[0] : spec_.rhs, "");
    if (spec_.has_jacobian) {
      text += "\n  // By columns: J[i + n*j] = d(dx[i]/dt)/dx[j].\n" +
              function("jacobian", "J", prepares() ? prepared_.rest[1] : spec_.jacobian.program,
                       jacobian_zeros());
    }
    text += "\n" + function("invariants", "values", spec_.invariants, "");
    if (needs.splitting) text += flows(*needs.splitting);
    if (needs.moments) text += moments(*needs.moments);
    if (needs.series) text += "\n" + codegen::series_struct(spec_.rhs, names_, spec_.limits);
    text += "};\n\n}  // namespace\n\n";
    text += exports();
    if (needs.series)
      text += series_exports();
    else if (!kernel.empty())
      text += integrate_export();
    return text + "\n}  // extern \"C\"\n";
  }

 private:
  bool prepares() const { return !prepared_.prepare.outputs.empty(); }

  /// Takes what depends on parameters only out of the functions that kernels call.
  void prepare() {
    std::vector<Program> programs{spec_.rhs};
    if (spec_.has_jacobian) programs.push_back(spec_.jacobian.program);
    prepared_ = codegen::prepared(programs, spec_.states.size(), spec_.parameters.size());
    if (!prepares()) return;
    Names names(names_);
    const std::size_t count = spec_.parameters.size();
    for (std::size_t k = 0; k < prepared_.prepare.outputs.size(); ++k) {
      prepared_sources_.push_back("p[" + std::to_string(count + k) + "]");
      prepared_names_.push_back(names.unique(prepared_.prepare.output_names[k]));
    }
  }

  /// The function `prepare`: the parameters, and behind them what is computed from them once.
  std::string preparation() const {
    const auto n = static_cast<std::ptrdiff_t>(spec_.states.size());
    const std::size_t count = spec_.parameters.size();
    std::string copies;
    for (std::size_t i = 0; i < count; ++i)
      copies += "    q[" + std::to_string(i) + "] = p[" + std::to_string(i) + "];\n";
    std::vector<std::string> targets;
    for (std::size_t k = 0; k < prepared_names_.size(); ++k)
      targets.push_back("q[" + std::to_string(count + k) + "]");
    const auto of_parameters = [&](const std::vector<std::string>& all) {
      return std::vector<std::string>(all.begin() + n,
                                      all.begin() + n + static_cast<std::ptrdiff_t>(count));
    };
    return "  // The parameters, and what depends on nothing else. `p` of rhs and jacobian is "
           "this.\n"
           "  static constexpr int prepared = " +
           std::to_string(count + prepared_names_.size()) +
           ";\n  static inline void prepare(const double* p, double* q) {\n" + copies +
           codegen::statements(prepared_.prepare, of_parameters(sources_), of_parameters(names_),
                               targets, style_) +
           "  }\n\n";
  }

  /// What stands for the inputs of a program: those that are prepared are in front of the time.
  static std::vector<std::string> with_prepared(std::vector<std::string> inputs,
                                                const std::vector<std::string>& prepared,
                                                const Program& program) {
    if (program.inputs.size() > inputs.size())
      inputs.insert(inputs.end() - 1, prepared.begin(), prepared.end());
    return inputs;
  }

  std::string jacobian_zeros() const {
    const std::size_t n = spec_.states.size();
    if (spec_.jacobian.entries.size() == n * n) return "";
    return "    for (int i = 0; i < n * n; ++i) J[i] = 0;\n";
  }

  std::string function(const std::string& name, const std::string& target, const Program& program,
                       const std::string& before) const {
    const std::size_t n = spec_.states.size();
    std::vector<std::string> targets;
    for (std::size_t k = 0; k < program.outputs.size(); ++k) {
      std::size_t place = k;
      if (target == "J") {
        const auto& [row, column] = spec_.jacobian.entries[k];
        place = static_cast<std::size_t>(row) + n * static_cast<std::size_t>(column);
      }
      targets.push_back(target + "[" + std::to_string(place) + "]");
    }
    return "  static inline void " + name +
           "([[maybe_unused]] double t, [[maybe_unused]] const double* x,\n" +
           std::string(23 + name.size(), ' ') +
           "[[maybe_unused]] const double* p, [[maybe_unused]] double* " + target + ") {\n" +
           before +
           codegen::statements(program, with_prepared(sources_, prepared_sources_, program),
                               with_prepared(names_, prepared_names_, program), targets, style_) +
           "  }\n";
  }

  /// The flows of the parts, one function each, and what chooses among them.
  std::string flows(const Splitting& splitting) const {
    const std::size_t parts = splitting.parts.size();
    std::string text, choice, moves;
    for (std::size_t k = 0; k < parts; ++k) {
      const Program& flow = splitting.flows[k];
      const std::string name = "flow_" + std::to_string(k);
      text += "\n" + codegen::comment_lines("What the flow of H_" + std::to_string(k) + " = " +
                                                splitting.parts[k] + " adds in the time t.",
                                            "  ");
      text += function(name, "dx", flow, "");
      choice += "    if constexpr (k == " + std::to_string(k) + ") " + name + "(t, x, p, dx);\n";
      std::string row;
      for (const bool moved : codegen::moved_states(flow))
        row += (row.empty() ? "" : ", ") + std::string(moved ? "true" : "false");
      moves += codegen::wrapped("      {" + row + "},") + "\n";
    }
    return "\n  // The Hamiltonian is the sum of these parts, and the flow of each is known.\n"
           "  static constexpr int parts = " +
           std::to_string(parts) + ";\n  static constexpr bool moves[parts][n] = {\n" + moves +
           "  };\n" + text +
           "\n  template <int k>\n  static inline void flow(double t, const double* x, const "
           "double* p, "
           "double* dx) {\n" +
           choice + "  }\n";
  }

  /// The moments of inertia of a free body, which depend on parameters only.
  std::string moments(const Program& program) const {
    std::vector<std::string> targets;
    for (std::size_t k = 0; k < program.outputs.size(); ++k)
      targets.push_back("values[" + std::to_string(k) + "]");
    return "\n  // The principal moments of inertia, and the factor of the time.\n"
           "  static inline void moments([[maybe_unused]] const double* p, double* values) {\n" +
           codegen::statements(program, sources_, names_, targets, style_) + "  }\n";
  }

  std::string exports() const {
    const auto constant = [](const std::string& name, std::size_t value) {
      return "int " + name + "(void) { return " + std::to_string(value) + "; }\n";
    };
    const auto forwarded = [&](const std::string& name, const std::string& target) {
      return "void casimir_" + name + "(double t, const double* x, const double* p, double* " +
             target + ") {\n" +
             (prepares() ? "  double q[System::prepared];\n  System::prepare(p, q);\n" : "") +
             "  System::" + name + "(t, x, " + (prepares() ? "q" : "p") + ", " + target + ");\n}\n";
    };
    std::string text = "extern \"C\" {\n\n";
    text += constant("casimir_abi_version", CASIMIR_ABI_VERSION);
    text += constant("casimir_dimension", spec_.states.size());
    text += constant("casimir_parameter_count", spec_.parameters.size());
    text += constant("casimir_invariant_count", spec_.invariant_names.size());
    text += forwarded("rhs", "dx");
    if (spec_.has_jacobian) text += forwarded("jacobian", "J");
    text += forwarded("invariants", "values");
    return text;
  }

  std::string integrate_export() const {
    const std::string head =
        "void casimir_integrate(const struct casimir_run* run, double* x,\n"
        "                       struct casimir_outcome* outcome) {\n";
    if (!prepares()) return head + "  casimir_kernel::integrate<System>(run, x, outcome);\n}\n";
    return head +
           "  double q[System::prepared];\n"
           "  System::prepare(run->parameters, q);\n"
           "  casimir_run prepared = *run;\n"
           "  prepared.parameters = q;\n"
           "  casimir_kernel::integrate<System>(&prepared, x, outcome);\n}\n";
  }

  /// What the precompiled integrator calls.
  static std::string series_exports() {
    return "\nunsigned long casimir_series_size(void) { return sizeof(System::Series); }\n"
           "int casimir_series_width(void) { return System::Series::width; }\n"
           "int casimir_series_smooth(void) { return System::Series::smooth; }\n"
           "void casimir_series_start(void* series, int order, const double* p) {\n"
           "  static_cast<System::Series*>(series)->order = order;\n"
           "  static_cast<System::Series*>(series)->p = p;\n}\n"
           "void casimir_series_begin(void* series, double t, const double* x) {\n"
           "  static_cast<System::Series*>(series)->begin(\n"
           "      t, reinterpret_cast<const System::Series::V*>(x));\n}\n"
           "void casimir_series_expand(void* series, double unit) {\n"
           "  static_cast<System::Series*>(series)->expand(unit);\n}\n";
  }

  const Specialisation& spec_;
  std::vector<std::string> sources_;
  std::vector<std::string> names_;
  codegen::Prepared prepared_;
  std::vector<std::string> prepared_sources_, prepared_names_;
  StatementStyle style_;
};

}  // namespace

std::string cost_text(const OperationCount& count) {
  return counted(count.mul, "multiplication") + ", " + counted(count.add, "addition") + ", " +
         counted(count.div, "division") + ", " + counted(count.calls, "call");
}

std::string codegen::head_comment(const Specialisation& spec, bool with_values) {
  std::string text =
      comment_lines("Written by casimir from case \"" + spec.case_name + "\", " +
                    origin_text(spec, with_values) + ". Do not edit: edit the case.");
  text += comment_lines(spec.title);
  if (!spec.source.empty()) text += comment_lines("Source: " + spec.source);
  if (!spec.states.empty()) {
    text += comment_lines("State x[0.." + std::to_string(spec.states.size() - 1) +
                          "] =" + state_list(spec) + ".");
  }
  text += comment_lines(std::string("Cost of ") + (spec.of_map ? "step: " : "rhs: ") +
                        cost_text(spec.specialised) +
                        "; of the general case: " + cost_text(spec.general) + ".");
  if (!spec.hamiltonian.empty()) {
    text += comment_lines("dx/dt = {x, H},  H = " + spec.hamiltonian);
  }
  for (const LeftOut& left : spec.left_out) {
    text += comment_lines("Left out: " + left.kind + " " + left.name + ", " + left.reason + ".");
  }
  return text;
}

std::string codegen::ownership_comment() {
  return "//\n"
         "// This file belongs to whoever had it generated, to use, change and pass on under any\n"
         "// terms: the licence of casimir does not extend to it.\n";
}

bool needs_math_library(const Specialisation& spec) {
  return codegen::calls_functions(spec.rhs) || codegen::calls_functions(spec.invariants) ||
         codegen::calls_functions(spec.jacobian.program);
}

std::string emit_module(const Specialisation& spec, const std::string& kernel_source,
                        const KernelNeeds& needs) {
  return ModuleText(spec).run(kernel_source, needs);
}

}  // namespace casimir
