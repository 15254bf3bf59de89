// The parts of a header that fit it to Boost.Odeint and CVODE.
#include <algorithm>
#include <string_view>

#include "codegen/emit/header_context.hpp"
#include "codegen/emit/identifiers.hpp"
#include "runtime/program/function_table.hpp"

namespace casimir::codegen {

namespace {

/// How an adapter that holds p hands it on: a template deduces it from the state.
std::string member(const HeaderContext& c) {
  if (!c.has_parameters()) return "";
  return c.is_template ? "  parameters<Real> p{};\n\n" : "  parameters p{};\n\n";
}

std::string odeint_system(const HeaderContext& c) {
  std::string text = "// For Boost.Odeint: integrate_adaptive(stepper, system{}, x, t0, t1, dt).\n";
  if (c.is_template && c.has_parameters()) text += "template <class Real>\n";
  const std::string time = c.spec.uses_time ? " t" : " /*t*/";
  text += "struct system {\n" + member(c) +
          "  template <class State, class Derivative, class Time>\n"
          "  void operator()(const State& x, Derivative& dxdt, Time" +
          time +
          ") const {\n"
          "    rhs(" +
          c.arguments("&x[0]") + "&dxdt[0]);\n  }\n};\n\n";
  return text;
}

/// The same with what depends on parameters only computed once.
std::string prepared_system(const HeaderContext& c) {
  if (!c.has_parameters()) return "";
  const std::string time = c.spec.uses_time ? " t" : " /*t*/";
  return std::string("// The same for one set of parameters: prepared_system{prepare(p)}.\n") +
         (c.is_template ? "template <class Real>\nstruct prepared_system {\n  prepared<Real> p;\n\n"
                        : "struct prepared_system {\n  prepared p;\n\n") +
         "  template <class State, class Derivative, class Time>\n"
         "  void operator()(const State& x, Derivative& dxdt, Time" +
         time + ") const {\n    rhs(" + c.arguments("&x[0]") + "&dxdt[0]);\n  }\n};\n\n";
}

std::string stiff_system(const HeaderContext& c) {
  return "// For the implicit steppers of Boost.Odeint: std::pair(system{}, stiff_system{}).\n"
         "struct stiff_system {\n" +
         member(c) +
         "  template <class State, class Matrix, class Time, class Derivative>\n"
         "  void operator()(const State& x, Matrix& J, const Time& /*t*/, Derivative& dfdt) "
         "const {\n"
         "    " +
         c.style.real +
         " columns[dimension * dimension];\n"
         "    jacobian(" +
         c.arguments("&x[0]") +
         "columns);\n"
         "    for (unsigned j = 0; j < dimension; ++j) {\n"
         "      for (unsigned i = 0; i < dimension; ++i) J(i, j) = columns[i + dimension * j];\n"
         "      dfdt[j] = 0;\n"
         "    }\n"
         "  }\n};\n\n";
}

std::string sundials(const HeaderContext& c) {
  const std::string user = c.has_parameters() ? "void* user" : "void* /*user*/";
  const std::string time = c.spec.uses_time ? "double t" : "double /*t*/";
  const std::string parameters = c.has_parameters()
                                     ? "  const parameters p = user ? *static_cast<const "
                                       "parameters*>(user) : parameters{};\n"
                                     : "";
  std::string text = "// For CVODE: CVodeInit(memory, sundials_rhs<N_Vector>, t0, y).";
  text += c.has_parameters() ? " User data: parameters, or null.\n" : "\n";
  text += "template <class Vector>\nint sundials_rhs(" + time + ", Vector y, Vector ydot, " + user +
          ") {\n" + parameters + "  rhs(" + c.arguments("N_VGetArrayPointer(y)") +
          "N_VGetArrayPointer(ydot));\n  return 0;\n}\n\n";
  if (!c.spec.has_jacobian) return text;
  text +=
      "// For CVODE: CVodeSetJacFn(memory, sundials_jacobian<N_Vector, SUNMatrix>), dense "
      "matrices.\n"
      "template <class Vector, class Matrix>\nint sundials_jacobian(" +
      time + ", Vector y, Vector /*fy*/, Matrix J, " + user +
      ",\n"
      "                      Vector /*tmp1*/, Vector /*tmp2*/, Vector /*tmp3*/) {\n" +
      parameters + "  jacobian(" + c.arguments("N_VGetArrayPointer(y)") +
      "SUNDenseMatrix_Data(J));\n  return 0;\n}\n\n";
  return text;
}

}  // namespace

std::string using_declarations(const Program& program) {
  std::string text;
  const auto add = [&](Op op, std::string_view name) {
    const bool called =
        std::ranges::any_of(program.code, [op](const Instruction& c) { return c.op == op; });
    const std::string line = "  using std::" + std::string(name) + ";\n";
    if (called && text.find(line) == std::string::npos) text += line;
  };
  for (const FunctionRow& row : function_table()) {
    if (row.op == Op::atan2) add(Op::pi, "acos");
    add(row.op, row.c_name);
  }
  return text;
}

std::string adapters(const HeaderContext& c) {
  std::string text = odeint_system(c) + prepared_system(c);
  if (c.spec.has_jacobian && !c.spec.uses_time && !c.is_template) text += stiff_system(c);
  if (c.style.scalar == Scalar::real64) text += sundials(c);
  return text;
}

}  // namespace casimir::codegen
