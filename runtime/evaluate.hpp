#pragma once

#include <cassert>
#include <vector>

#include "runtime/program/operation.hpp"

namespace casimir {

/// Runs a program once over any number type with an Arithmetic: doubles, exact rationals, CLN
/// floats.
/// \param inputs  one number for each of Program::inputs.
/// \return        one number for each output.
/// \throws std::domain_error  where the arithmetic refuses: division by zero, negative roots.
template <class Number>
std::vector<Number> evaluate(const Program& program, const std::vector<Number>& inputs,
                             const Arithmetic<Number>& arithmetic = Arithmetic<Number>{}) {
  assert(inputs.size() == program.inputs.size());
  std::vector<Number> value;
  value.reserve(program.code.size());
  const auto at = [&](int i) -> const Number& { return value[static_cast<std::size_t>(i)]; };
  for (const Instruction& line : program.code) {
    if (line.op == Op::input)
      value.push_back(inputs[static_cast<std::size_t>(line.a)]);
    else if (is_literal(line))
      value.push_back(literal_value(program, line, arithmetic));
    else
      value.push_back(applied(line.op, at(line.a), at(line.b < 0 ? line.a : line.b), arithmetic));
  }
  std::vector<Number> outputs;
  for (const int i : program.outputs) outputs.push_back(at(i));
  return outputs;
}

}  // namespace casimir
