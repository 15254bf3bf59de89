#include "runtime/taylor/jet_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "runtime/program/function_table.hpp"
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
    case Op::atan2:
      return CASIMIR_JET_ATAN2;
    case Op::input:
      throw std::invalid_argument("a section function cannot depend on the time");
    default:
      return CASIMIR_JET_FUNCTION;
  }
}

template <Op op>
double value_at(double a) {
  return applied(op, a, 0., Arithmetic<double>{});
}

using FunctionOfOne = double (*)(double);

template <std::size_t... i>
constexpr std::array<FunctionOfOne, sizeof...(i)> functions_of_one(std::index_sequence<i...>) {
  return {value_at<function_table()[i].op>...};
}

/// The function of one argument that an operation is.
FunctionOfOne function_of(Op op) {
  static constexpr auto all = functions_of_one(std::make_index_sequence<function_table().size()>());
  return all[static_cast<std::size_t>(&function_row(op) - function_table().data())];
}

casimir_jet_rule rule_of(SeriesRule rule) {
  switch (rule) {
    case SeriesRule::integral:
      return CASIMIR_JET_INTEGRAL;
    case SeriesRule::quotient:
      return CASIMIR_JET_QUOTIENT;
    case SeriesRule::root:
      return CASIMIR_JET_ROOT;
    default:
      return CASIMIR_JET_SQUARES;
  }
}

/// Writes the recurrence of a function down for a line whose rows begin at `row`.
/// \return  how many rows that are.
int add_recurrence(Op op, int argument, int row, casimir_jet_line& line) {
  int rows = 1;
  const auto place = [&](Slot slot) {
    const Slot own = own_slot(op, slot);
    if (own == Slot::argument) return argument;
    const int behind = own == Slot::value ? 0 : own == Slot::helper ? 1 : 2;
    rows = std::max(rows, behind + 1);
    return row + behind;
  };
  for (const SeriesStep& step : series_steps(op)) {
    FunctionOfOne first = nullptr;
    if (step.rule != SeriesRule::root && own_slot(op, step.target) == Slot::value)
      first = function_of(op);
    else if (step.rule == SeriesRule::integral)
      first = function_of(function_row(op).partner);
    line.step[line.steps++] = {rule_of(step.rule),
                               place(step.target),
                               place(step.of),
                               place(step.by),
                               static_cast<double>(step.sign),
                               first};
  }
  return rows;
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
    case CASIMIR_JET_ATAN2:
      return std::atan2(a, b);
    default:
      break;
  }
  for (int i = 0; i < line.steps; ++i)
    if (line.step[i].row == line.row)
      return line.step[i].first ? line.step[i].first(a) : std::sqrt(a);
  return line.value;
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
    layout.lines.push_back({op, a, b, layout.rows, value, 0, {}});
    layout.rows += op == CASIMIR_JET_ATAN2 ? 2 : 1;
    return static_cast<int>(layout.lines.size()) - 1;
  };
  const auto add_function = [&](Op op, int a) {
    casimir_jet_line line{CASIMIR_JET_FUNCTION, a, -1, layout.rows, 0, 0, {}};
    const int argument = layout.lines[static_cast<std::size_t>(a)].row;
    layout.rows += add_recurrence(op, argument, layout.rows, line);
    layout.lines.push_back(line);
    return static_cast<int>(layout.lines.size()) - 1;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Instruction& line = program.code[i];
    const bool has_operands = line.op != Op::input && !is_literal(line);
    const int a = has_operands ? at(line.a) : line.a, b = at(line.b);
    int made = -1;
    if (line.op == Op::abs || line.op == Op::sign) {
      made = add_function(Op::sqrt, add(CASIMIR_JET_MUL, a, a, 0));
      if (line.op == Op::sign) made = add(CASIMIR_JET_DIV, a, made, 0);
    } else if (is_literal(line)) {
      made = add(CASIMIR_JET_CONSTANT, -1, -1, literal_value(program, line, arithmetic));
    } else if (line.op == Op::input && static_cast<std::size_t>(line.a) < states) {
      made = add(CASIMIR_JET_STATE, a, b, 0);
    } else if (const casimir_jet_op op = operation(line.op); op == CASIMIR_JET_FUNCTION) {
      made = add_function(line.op, a);
    } else {
      const bool power = line.op == Op::pow;
      made = add(op, a, b, power ? layout.lines[static_cast<std::size_t>(b)].value : 0);
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
