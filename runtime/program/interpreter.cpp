#include "runtime/program/interpreter.hpp"

#include <algorithm>

#include "runtime/program/operation.hpp"

namespace casimir {

/// Of the program only the operations are kept: inputs and constants have places of their own
/// before the results, and are no lines to be read in every run.
Interpreter::Interpreter(const Program& program) : program_(program), values_() {
  values_.resize(program.inputs.size());
  std::vector<int> place;
  const auto take = [&](bool literals) {
    for (std::size_t i = 0; i < program.code.size(); ++i) {
      const Instruction& line = program.code[i];
      if (line.op == Op::input) {
        place[i] = line.a;
      } else if (is_literal(line) == literals) {
        place[i] = static_cast<int>(values_.size());
        values_.push_back(literals ? literal_value(program, line, Arithmetic<double>{}) : 0);
      }
    }
  };
  place.resize(program.code.size());
  take(true);
  take(false);
  const auto moved = [&](int line) {
    return line < 0 ? line : place[static_cast<std::size_t>(line)];
  };
  program_.code.clear();
  for (const Instruction& line : program.code)
    if (line.op != Op::input && !is_literal(line))
      program_.code.push_back({line.op, moved(line.a), moved(line.b)});
  for (int& output : program_.outputs) output = moved(output);
}

void Interpreter::operator()(const double* inputs, double* outputs) const {
  double* const values = values_.data();
  std::copy_n(inputs, program_.inputs.size(), values);
  double* result = values + (values_.size() - program_.code.size());
  for (const Instruction& line : program_.code) {
    const double a = values[line.a];
    switch (line.op) {
      case Op::add:
        *result = a + values[line.b];
        break;
      case Op::sub:
        *result = a - values[line.b];
        break;
      case Op::mul:
        *result = a * values[line.b];
        break;
      default:
        *result = applied(line.op, a, line.b < 0 ? 0. : values[line.b], Arithmetic<double>{});
    }
    ++result;
  }
  for (const int output : program_.outputs) *outputs++ = values[output];
}

}  // namespace casimir
