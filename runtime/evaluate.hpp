#pragma once

#include <cassert>
#include <vector>

#include "runtime/number.hpp"
#include "runtime/program.hpp"

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
  const auto constant = [&](int i) -> const cln::cl_RA& {
    return program.constants[static_cast<std::size_t>(i)];
  };
  for (const Instruction& line : program.code) {
    switch (line.op) {
      case Op::input:
        value.push_back(inputs[static_cast<std::size_t>(line.a)]);
        break;
      case Op::constant:
        value.push_back(arithmetic.from(constant(line.a)));
        break;
      case Op::pi:
        value.push_back(arithmetic.pi());
        break;
      case Op::add:
        value.push_back(at(line.a) + at(line.b));
        break;
      case Op::sub:
        value.push_back(at(line.a) - at(line.b));
        break;
      case Op::mul:
        value.push_back(at(line.a) * at(line.b));
        break;
      case Op::div:
        value.push_back(arithmetic.divide(at(line.a), at(line.b)));
        break;
      case Op::neg:
        value.push_back(-at(line.a));
        break;
      case Op::pow:
        value.push_back(arithmetic.power(
            at(line.a), constant(program.code[static_cast<std::size_t>(line.b)].a)));
        break;
      case Op::sqrt:
        value.push_back(arithmetic.sqrt(at(line.a)));
        break;
      case Op::sin:
        value.push_back(arithmetic.sin(at(line.a)));
        break;
      case Op::cos:
        value.push_back(arithmetic.cos(at(line.a)));
        break;
      case Op::tan:
        value.push_back(arithmetic.tan(at(line.a)));
        break;
      case Op::exp:
        value.push_back(arithmetic.exp(at(line.a)));
        break;
      case Op::log:
        value.push_back(arithmetic.log(at(line.a)));
        break;
      case Op::asin:
        value.push_back(arithmetic.asin(at(line.a)));
        break;
      case Op::acos:
        value.push_back(arithmetic.acos(at(line.a)));
        break;
      case Op::atan2:
        value.push_back(arithmetic.atan2(at(line.a), at(line.b)));
        break;
    }
  }
  std::vector<Number> outputs;
  for (const int i : program.outputs) outputs.push_back(at(i));
  return outputs;
}

}  // namespace casimir
