#pragma once

#include <cln/rational.h>

#include <optional>
#include <string>

#include "runtime/program.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir {

/// The number type of generated code.
enum class Scalar { real64, real32, long_double, float128, templated };

namespace codegen {

/// The nearest number of the type, ties to even, also among the denormal numbers.
/// \throws ModelError  if the value overflows, or is not zero and becomes zero.
template <class Real>
Real nearest(const cln::cl_RA& value);

/// A number as C++ writes it.
struct NumberText {
  std::string text;     ///< may begin with a minus
  bool is_plain;        ///< short and exact: reads well inside a formula
  std::string comment;  ///< the exact value where `text` is rounded, e.g. "1/3"; else empty
};

/// Integers as they are, others as the shortest decimal that reads back as the nearest number.
/// \param scalar  float128 and templated give exact quotients where possible.
/// \param comment  what to say if the number is rounded; empty: the fraction.
NumberText number_text(const cln::cl_RA& value, Scalar scalar, const std::string& comment = {});

/// The value of an instruction that depends on no input: exact if it is rational, otherwise an
/// approximation that rounds correctly to any Scalar.
/// \param limits  numbers on the way have at most `bits`: of the model that the program is of
/// \throws ModelError  if it is not a real number.
/// \throws TooLarge  beyond the limit
cln::cl_RA constant_value(const Program& program, int instruction, const Limits& limits);

/// Whether only additions, multiplications and the like of rationals make up that constant.
bool is_rational(const Program& program, int instruction);

/// The constant in the notation of case files, e.g. "sqrt(2)/2".
std::string constant_text(const Program& program, int instruction);

}  // namespace codegen
}  // namespace casimir
