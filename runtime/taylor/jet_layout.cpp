#include "runtime/taylor/jet_layout.hpp"

#include <cmath>
#include <stdexcept>

#include "runtime/program/operation.hpp"

extern "C" {
#ifdef CASIMIR_X86_KERNELS
casimir_jet_kernel casimir_jet_avx512;
casimir_jet_kernel casimir_jet_avx2;
#endif
casimir_jet_kernel casimir_jet_baseline;
}

namespace casimir {
namespace {

casimir_jet_op operation(Op op) {
  switch (op) {
    case Op::add:
      return CASIMIR_JET_ADD;
    case Op::sub:
      return CASIMIR_JET_SUB;
    case Op::mul:
      return CASIMIR_JET_MUL;
    case Op::div:
      return CASIMIR_JET_DIV;
    case Op::neg:
      return CASIMIR_JET_NEG;
    case Op::pow:
      return CASIMIR_JET_POW;
    case Op::sqrt:
      return CASIMIR_JET_SQRT;
    case Op::sin:
      return CASIMIR_JET_SIN;
    case Op::cos:
      return CASIMIR_JET_COS;
    case Op::tan:
      return CASIMIR_JET_TAN;
    case Op::exp:
      return CASIMIR_JET_EXP;
    case Op::log:
      return CASIMIR_JET_LOG;
    case Op::asin:
      return CASIMIR_JET_ASIN;
    case Op::acos:
      return CASIMIR_JET_ACOS;
    case Op::atan2:
      return CASIMIR_JET_ATAN2;
    default:
      throw std::invalid_argument("a section function cannot depend on the time");
  }
}

/// Rows of a line: its series and what its recurrence needs.
int rows_of(int op) {
  switch (op) {
    case CASIMIR_JET_SIN:
    case CASIMIR_JET_COS:
    case CASIMIR_JET_TAN:
    case CASIMIR_JET_ATAN2:
      return 2;
    case CASIMIR_JET_ASIN:
    case CASIMIR_JET_ACOS:
      return 3;
    default:
      return 1;
  }
}

double value_of_line(const casimir_jet_line& line, double a, double b) {
  switch (line.op) {
    case CASIMIR_JET_ADD:
      return a + b;
    case CASIMIR_JET_SUB:
      return a - b;
    case CASIMIR_JET_MUL:
      return a * b;
    case CASIMIR_JET_DIV:
      return a / b;
    case CASIMIR_JET_NEG:
      return -a;
    case CASIMIR_JET_POW:
      return std::pow(a, line.value);
    case CASIMIR_JET_SQRT:
      return std::sqrt(a);
    case CASIMIR_JET_SIN:
      return std::sin(a);
    case CASIMIR_JET_COS:
      return std::cos(a);
    case CASIMIR_JET_TAN:
      return std::tan(a);
    case CASIMIR_JET_EXP:
      return std::exp(a);
    case CASIMIR_JET_LOG:
      return std::log(a);
    case CASIMIR_JET_ASIN:
      return std::asin(a);
    case CASIMIR_JET_ACOS:
      return std::acos(a);
    case CASIMIR_JET_ATAN2:
      return std::atan2(a, b);
    default:
      return line.value;
  }
}

}  // namespace

double value_of(const JetLayout& layout, const double* states, std::vector<double>& values) {
  values.clear();
  for (const casimir_jet_line& line : layout.lines) {
    const auto at = [&](int i) { return i < 0 ? 0 : values[static_cast<std::size_t>(i)]; };
    values.push_back(line.op == CASIMIR_JET_STATE ? states[line.a]
                     : line.op == CASIMIR_JET_CONSTANT
                         ? line.value
                         : value_of_line(line, at(line.a), at(line.b)));
  }
  return values.back();
}

JetLayout jet_layout(const Program& program, std::size_t states) {
  JetLayout layout;
  const Arithmetic<double> arithmetic;
  const auto count = static_cast<std::size_t>(program.outputs.at(0)) + 1;
  std::vector<int> place;  // of each line of the program
  const auto at = [&](int i) { return i < 0 ? i : place[static_cast<std::size_t>(i)]; };
  const auto add = [&](int op, int a, int b, double value) {
    layout.lines.push_back({op, a, b, layout.rows, value});
    layout.rows += rows_of(op);
    return static_cast<int>(layout.lines.size()) - 1;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Instruction& line = program.code[i];
    const bool has_operands = line.op != Op::input && !is_literal(line);
    const int a = has_operands ? at(line.a) : line.a, b = at(line.b);
    int made = -1;
    if (line.op == Op::abs || line.op == Op::sign) {
      made = add(CASIMIR_JET_SQRT, add(CASIMIR_JET_MUL, a, a, 0), -1, 0);
      if (line.op == Op::sign) made = add(CASIMIR_JET_DIV, a, made, 0);
    } else if (is_literal(line)) {
      made = add(CASIMIR_JET_CONSTANT, -1, -1, literal_value(program, line, arithmetic));
    } else if (line.op == Op::input && static_cast<std::size_t>(line.a) < states) {
      made = add(CASIMIR_JET_STATE, a, b, 0);
    } else {
      const bool power = line.op == Op::pow;
      made = add(operation(line.op), a, b,
                 power ? layout.lines[static_cast<std::size_t>(b)].value : 0);
    }
    place.push_back(made);
  }
  return layout;
}

casimir_jet_kernel* jet_kernel(int lanes) {
#ifdef CASIMIR_X86_KERNELS
  if (lanes == 8) return casimir_jet_avx512;
  if (lanes == 4) return casimir_jet_avx2;
#endif
  if (lanes == 2) return casimir_jet_baseline;
  throw std::invalid_argument("there is no kernel for series in so many lanes");
}

}  // namespace casimir
