#pragma once

#include <cassert>
#include <type_traits>

#include "runtime/program.hpp"
#include "runtime/program/number.hpp"

namespace casimir {

/// The value of an operation at numbers: what every operation of a program means. Neither `input`
/// nor `constant`, which are values already.
/// \param b  ignored by operations of one operand.
/// \throws std::domain_error  where the arithmetic refuses: division by zero, negative roots.
template <class Number>
Number applied(Op op, const Number& a, const Number& b, const Arithmetic<Number>& arithmetic) {
  switch (op) {
    case Op::add:
      return a + b;
    case Op::sub:
      return a - b;
    case Op::mul:
      return a * b;
    case Op::div:
      return arithmetic.divide(a, b);
    case Op::neg:
      return -a;
    case Op::pow:
      return arithmetic.power(a, b);
    case Op::sqrt:
      return arithmetic.sqrt(a);
    case Op::sin:
    case Op::cos:
    case Op::tan:
    case Op::sinh:
    case Op::cosh:
    case Op::tanh:
    case Op::exp:
      return arithmetic.function(op, a);
    case Op::log:
      return arithmetic.log(a);
    case Op::asin:
      return arithmetic.asin(a);
    case Op::acos:
      return arithmetic.acos(a);
    case Op::atan2:
      return arithmetic.atan2(a, b);
    case Op::abs:
      return arithmetic.sign(a) < 0 ? -a : a;
    case Op::sign:
      if constexpr (std::is_floating_point_v<Number>)
        if (a != a) return a;  // what has no value has no sign either
      return arithmetic.from(cln::cl_RA(arithmetic.sign(a)));
    default:
      assert(false);
      return a;
  }
}

/// The value of a line of a program that is free of inputs by itself: a constant, or Pi.
template <class Number>
Number literal_value(const Program& program, const Instruction& line,
                     const Arithmetic<Number>& arithmetic) {
  if (line.op == Op::pi) return arithmetic.pi();
  return arithmetic.from(program.constants[static_cast<std::size_t>(line.a)]);
}

inline bool is_literal(const Instruction& line) {
  return line.op == Op::constant || line.op == Op::pi;
}

}  // namespace casimir
