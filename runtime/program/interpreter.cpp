#include "runtime/program/interpreter.hpp"

#include "runtime/program/operation.hpp"

namespace casimir {

Interpreter::Interpreter(const Program& program) : program_(program), values_(program.code.size()) {
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    if (is_literal(program.code[i]))
      values_[i] = literal_value(program, program.code[i], Arithmetic<double>{});
  }
}

void Interpreter::operator()(const double* inputs, double* outputs) const {
  const auto at = [this](int line) { return values_[static_cast<std::size_t>(line)]; };
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Instruction& line = program_.code[i];
    if (line.op == Op::input)
      values_[i] = inputs[line.a];
    else if (!is_literal(line))
      values_[i] = applied(line.op, at(line.a), line.b < 0 ? 0. : at(line.b), Arithmetic<double>{});
  }
  for (std::size_t k = 0; k < program_.outputs.size(); ++k) outputs[k] = at(program_.outputs[k]);
}

}  // namespace casimir
