// Values of instructions that depend on no input.
#include <cln/cln.h>

#include <cstdlib>
#include <map>
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

/// The values of instructions in one precision, each computed once: integrals of Carlson's are a
/// thousand instructions, of which each uses the three before.
class Approximation {
 public:
  Approximation(const Program& program, int digits, const Limits& limits)
      : program_(program), format_(cln::float_format(digits)), limits_(limits) {}

  cln::cl_R operator()(int i) {
    const auto known = values_.find(i);
    if (known != values_.end()) return known->second;
    return values_.emplace(i, computed(i)).first->second;
  }

 private:
  cln::cl_R computed(int i) {
    const Instruction& code = at(program_, i);
    if (code.op == Op::constant) return cln::cl_float(number(program_, code), format_);
    if (code.op == Op::pi) return cln::pi(format_);
    const cln::cl_R a = checked((*this)(code.a), program_, code.a, limits_);
    const cln::cl_R b = code.b < 0 ? cln::cl_R(0) : (*this)(code.b);
    return applied(i, code, a, b);
  }

  cln::cl_R applied(int i, const Instruction& code, const cln::cl_R& a, const cln::cl_R& b) const {
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
        return real(cln::expt(cln::cl_N(a), number(program_, at(program_, code.b))), program_, i);
      case Op::sqrt:
        return real(cln::sqrt(cln::cl_N(a)), program_, i);
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
        return real(cln::log(cln::cl_N(a)), program_, i);
      case Op::asin:
        return real(cln::asin(cln::cl_N(a)), program_, i);
      case Op::acos:
        return real(cln::acos(cln::cl_N(a)), program_, i);
      case Op::abs:
        return cln::abs(a);
      case Op::sign:
        return cln::signum(a);
      default:
        if (cln::zerop(a) && cln::zerop(b))
          throw ModelError("the constant " + constant_text(program_, i) + " has no value");
        return cln::atan(b, a);
    }
  }

  const Program& program_;
  cln::float_format_t format_;
  const Limits& limits_;
  std::map<int, cln::cl_R> values_;
};

/// The texts of constants, cut off behind a length: each instruction may stand in those of several.
class ConstantText {
 public:
  explicit ConstantText(const Program& program) : program_(program) {}

  std::string operator()(int i) {
    if (left_ <= 0) return "..";
    const std::string text = written(at(program_, i));
    left_ -= 1;
    return text;
  }

 private:
  std::string written(const Instruction& code) {
    switch (code.op) {
      case Op::constant: {
        std::ostringstream out;
        out << number(program_, code);
        left_ -= static_cast<long>(out.str().size());
        return printable(out.str());
      }
      case Op::pi:
        return "Pi";
      case Op::add:
        return binary(code, " + ");
      case Op::sub:
        return binary(code, " - ");
      case Op::mul: {
        const std::string a = (*this)(code.a);
        return a + "*" + (*this)(code.b);
      }
      case Op::div: {
        const std::string a = (*this)(code.a);
        return a + "/" + (*this)(code.b);
      }
      case Op::pow: {
        const std::string a = (*this)(code.a);
        return a + "^(" + (*this)(code.b) + ")";
      }
      case Op::neg:
        return "-" + (*this)(code.a);
      case Op::atan2:
        return "atan2" + binary(code, ", ");
      case Op::abs:
        return "|" + (*this)(code.a) + "|";
      default:
        return std::string(function_row(code.op).name) + "(" + (*this)(code.a) + ")";
    }
  }
  std::string binary(const Instruction& code, const char* sign) {
    const std::string a = (*this)(code.a);
    return "(" + a + sign + (*this)(code.b) + ")";
  }

  const Program& program_;
  long left_ = 400;
};

/// CLN says by errors of its own that a number is too large or too small for it.
cln::cl_R value_with(const Program& program, int i, int digits, const Limits& limits) {
  try {
    return checked(Approximation(program, digits, limits)(i), program, i, limits);
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

std::string constant_text(const Program& program, int i) { return ConstantText(program)(i); }

}  // namespace casimir::codegen
