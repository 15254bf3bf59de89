#include "codegen/wasm/values_body.hpp"

#include <algorithm>
#include <string_view>

#include "codegen/emit/number_literal.hpp"
#include "codegen/optimise/lower.hpp"
#include "runtime/program/function_table.hpp"

namespace casimir::codegen::wasm {
namespace {

/// Functions that are instructions, or a few of them.
bool is_built_in(Op op) {
  return !is_function(op) || op == Op::sqrt || op == Op::abs || op == Op::sign;
}

}  // namespace

Imports imported_functions(ModuleWriter& module, const std::vector<const Program*>& programs) {
  Imports imports;
  const auto need = [&](Op op) {
    if (is_built_in(op) || imports.contains(op)) return;
    const std::size_t operands = op == Op::pow || op == Op::atan2 ? 2 : 1;
    imports[op] =
        module.import(function_row(op).name, {std::vector<Type>(operands, Type::f64), {Type::f64}});
  };
  for (const Program* program : programs) {
    for (const Instruction& line : program->code) {
      need(line.op);
      // The recurrences of two functions need both.
      if (is_function(line.op)) need(function_row(line.op).partner);
    }
  }
  return imports;
}

int add_values(Body& body, const Program& whole, const Imports& imports, int inputs, int outputs,
               const Limits& limits) {
  const Program program = without_dead_code(whole);
  const std::vector<bool> constant = constant_instructions(program);
  const auto value = [&](int line) {
    return [&body, &program, &constant, &limits, line] {
      if (constant[static_cast<std::size_t>(line)])
        body.number(nearest<double>(constant_value(program, line, limits)));
      else
        body.get(line);
    };
  };
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    const Instruction& line = program.code[i];
    if (constant[i]) continue;
    if (line.op == Op::input)
      body.load_at(inputs + kDouble * line.a);
    else
      add_operation(body, line.op, imports, value(line.a), value(line.b < 0 ? line.a : line.b));
    body.set(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < program.outputs.size(); ++i) {
    body.integer(0);
    value(program.outputs[i])();
    body.store(outputs + kDouble * static_cast<int>(i));
  }
  return static_cast<int>(program.code.size());
}

}  // namespace casimir::codegen::wasm
