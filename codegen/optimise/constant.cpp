// Values of instructions that depend on no input.
#include <cln/cln.h>

#include <cstdlib>
#include <sstream>

#include "codegen/emit/number_literal.hpp"
#include "runtime/program/function_table.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/error.hpp"

namespace casimir::codegen {

namespace {

constexpr int kFirstDigits = 60;
constexpr int kMostDigits = 4000;

const Instruction& at(const Program& program, int i) {
  return program.code[static_cast<std::size_t>(i)];
}

cln::cl_RA number(const Program& program, const Instruction& code) {
  return program.constants[static_cast<std::size_t>(code.a)];
}

cln::cl_RA rational_value(const Program& program, int i) {
  const Instruction& code = at(program, i);
  if (code.op == Op::constant) return number(program, code);
  const cln::cl_RA a = rational_value(program, code.a);
  switch (code.op) {
    case Op::neg:
      return -a;
    case Op::add:
      return a + rational_value(program, code.b);
    case Op::sub:
      return a - rational_value(program, code.b);
    case Op::mul:
      return a * rational_value(program, code.b);
    default: {
      const cln::cl_RA b = rational_value(program, code.b);
      if (b == 0) throw ModelError("division by zero in a constant");
      return a / b;
    }
  }
}

cln::cl_R real(const cln::cl_N& value, const Program& program, int i) {
  if (!cln:: instanceof (value, cln::cl_R_ring)) {
    throw ModelError("the constant " + constant_text(program, i) + " is not a real number");
  }
  return cln::the<cln::cl_R>(value);
}

/// Sines of giants take pi to as many digits as these have, and exponentials of them are no
/// numbers.
cln::cl_R checked(const cln::cl_R& value, const Program& program, int i, const Limits& limits) {
  const auto bits = static_cast<long>(limits.bits);
  if (!cln::zerop(value) && std::abs(cln::float_exponent(cln::cl_float(value))) > bits)
    throw TooLarge("the constant " + printable(constant_text(program, i), 200) + " has more than " +
                       std::to_string(bits) + " bits",
                   limits, &Limits::bits);
  return value;
}

cln::cl_R approximate(const Program& program, int i, const cln::float_format_t& format,
                      const Limits& limits) {
  const Instruction& code = at(program, i);
  if (code.op == Op::constant) return cln::cl_float(number(program, code), format);
  if (code.op == Op::pi) return cln::pi(format);
  const cln::cl_R a =
      checked(approximate(program, code.a, format, limits), program, code.a, limits);
  const cln::cl_R b = code.b < 0 ? cln::cl_R(0) : approximate(program, code.b, format, limits);
  switch (code.op) {
    case Op::add:
      return a + b;
    case Op::sub:
      return a - b;
    case Op::mul:
      return a * b;
    case Op::div:
      if (cln::zerop(b)) throw ModelError("division by zero in a constant");
      return a / b;
    case Op::neg:
      return -a;
    case Op::pow:
      return real(cln::expt(cln::cl_N(a), number(program, at(program, code.b))), program, i);
    case Op::sqrt:
      return real(cln::sqrt(cln::cl_N(a)), program, i);
    case Op::sin:
      return cln::sin(a);
    case Op::cos:
      return cln::cos(a);
    case Op::tan:
      return cln::tan(a);
    case Op::sinh:
      return cln::sinh(a);
    case Op::cosh:
      return cln::cosh(a);
    case Op::tanh:
      return cln::tanh(a);
    case Op::exp:
      return cln::exp(a);
    case Op::log:
      return real(cln::log(cln::cl_N(a)), program, i);
    case Op::asin:
      return real(cln::asin(cln::cl_N(a)), program, i);
    case Op::acos:
      return real(cln::acos(cln::cl_N(a)), program, i);
    case Op::abs:
      return cln::abs(a);
    case Op::sign:
      return cln::signum(a);
    default:
      return cln::atan(b, a);
  }
}

std::string binary(const Program& program, const Instruction& code, const char* sign) {
  return "(" + constant_text(program, code.a) + sign + constant_text(program, code.b) + ")";
}

/// CLN says by errors of its own that a number is too large or too small for it.
cln::cl_R value_with(const Program& program, int i, int digits, const Limits& limits) {
  try {
    return checked(approximate(program, i, cln::float_format(digits), limits), program, i, limits);
  } catch (const cln::runtime_exception&) {
    throw ModelError("the constant " + printable(constant_text(program, i), 200) +
                     " is too large or too small");
  }
}

}  // namespace

bool is_rational(const Program& program, int i) {
  const Instruction& code = at(program, i);
  switch (code.op) {
    case Op::constant:
      return true;
    case Op::neg:
      return is_rational(program, code.a);
    case Op::add:
    case Op::sub:
    case Op::mul:
    case Op::div:
      return is_rational(program, code.a) && is_rational(program, code.b);
    default:
      return false;
  }
}

cln::cl_RA constant_value(const Program& program, int i, const Limits& limits) {
  if (is_rational(program, i)) return rational_value(program, i);
  // Two precisions that agree to far more digits than are printed: cancellation has been overcome.
  const cln::cl_RA tolerance = 1 / cln::expt(cln::cl_RA(10), kFirstDigits - 10);
  cln::cl_RA previous = 0;
  for (int digits = kFirstDigits; digits <= kMostDigits; digits *= 2) {
    const cln::cl_RA value = cln::rational(value_with(program, i, digits, limits));
    if (value != 0 && cln::abs(value - previous) <= tolerance * cln::abs(value)) return value;
    previous = value;
  }
  return 0;  // zero to four thousand digits, such as sqrt(2)*sqrt(3) - sqrt(6)
}

std::string constant_text(const Program& program, int i) {
  const Instruction& code = at(program, i);
  switch (code.op) {
    case Op::constant: {
      std::ostringstream out;
      out << number(program, code);
      return printable(out.str());
    }
    case Op::pi:
      return "Pi";
    case Op::add:
      return binary(program, code, " + ");
    case Op::sub:
      return binary(program, code, " - ");
    case Op::mul:
      return constant_text(program, code.a) + "*" + constant_text(program, code.b);
    case Op::div:
      return constant_text(program, code.a) + "/" + constant_text(program, code.b);
    case Op::pow:
      return constant_text(program, code.a) + "^(" + constant_text(program, code.b) + ")";
    case Op::neg:
      return "-" + constant_text(program, code.a);
    case Op::atan2:
      return "atan2" + binary(program, code, ", ");
    case Op::abs:
      return "|" + constant_text(program, code.a) + "|";
    default:
      return std::string(function_row(code.op).name) + "(" + constant_text(program, code.a) + ")";
  }
}

}  // namespace casimir::codegen
