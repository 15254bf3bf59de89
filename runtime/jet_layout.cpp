#include "runtime/jet_layout.hpp"

#include <cmath>
#include <stdexcept>

#include "runtime/operation.hpp"

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
  for (std::size_t i = 0; i < count; ++i) {
    const Instruction& line = program.code[i];
    const bool has_operands = line.op != Op::input && !is_literal(line);
    casimir_jet_line made = {CASIMIR_JET_CONSTANT, has_operands ? at(line.a) : line.a, at(line.b),
                             layout.rows, 0};
    if (line.op == Op::abs) {  // the root of the square
      layout.lines.push_back({CASIMIR_JET_MUL, made.a, made.a, layout.rows, 0});
      layout.rows += rows_of(CASIMIR_JET_MUL);
      made = {CASIMIR_JET_SQRT, static_cast<int>(layout.lines.size()) - 1, -1, layout.rows, 0};
    } else if (is_literal(line)) {
      made.a = made.b = -1;
      made.value = literal_value(program, line, arithmetic);
    } else if (line.op == Op::input && static_cast<std::size_t>(line.a) < states) {
      made.op = CASIMIR_JET_STATE;
    } else {
      made.op = operation(line.op);
      if (line.op == Op::pow) made.value = layout.lines[static_cast<std::size_t>(made.b)].value;
    }
    place.push_back(static_cast<int>(layout.lines.size()));
    layout.rows += rows_of(made.op);
    layout.lines.push_back(made);
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
