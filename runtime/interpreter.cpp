#include "runtime/interpreter.hpp"

#include <cmath>

#include "runtime/number.hpp"

namespace casimir {

Interpreter::Interpreter(const Program& program) : program_(program), values_(program.code.size()) {
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    const Instruction& line = program.code[i];
    if (line.op == Op::constant)
      values_[i] = Arithmetic<double>::from(program.constants[static_cast<std::size_t>(line.a)]);
    if (line.op == Op::pi) values_[i] = Arithmetic<double>::pi();
  }
}

void Interpreter::operator()(const double* inputs, double* outputs) const {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Instruction& line = program_.code[i];
    if (line.op == Op::constant || line.op == Op::pi) continue;
    values_[i] = line.op == Op::input ? inputs[line.a] : value_of(line);
  }
  for (std::size_t k = 0; k < program_.outputs.size(); ++k) outputs[k] = at(program_.outputs[k]);
}

double Interpreter::value_of(const Instruction& line) const {
  const double a = at(line.a), b = line.b >= 0 ? at(line.b) : 0;
  switch (line.op) {
    case Op::add:
      return a + b;
    case Op::sub:
      return a - b;
    case Op::mul:
      return a * b;
    case Op::div:
      return a / b;
    case Op::neg:
      return -a;
    case Op::pow:
      return std::pow(a, b);
    case Op::sqrt:
      return std::sqrt(a);
    case Op::sin:
      return std::sin(a);
    case Op::cos:
      return std::cos(a);
    case Op::tan:
      return std::tan(a);
    case Op::exp:
      return std::exp(a);
    case Op::log:
      return std::log(a);
    case Op::asin:
      return std::asin(a);
    case Op::acos:
      return std::acos(a);
    default:
      return std::atan2(a, b);
  }
}

}  // namespace casimir
