#pragma once

#include <cln/rational.h>

#include <cstddef>
#include <string>
#include <vector>

namespace casimir {

/// One arithmetic operation of a straight-line program.
enum class Op {
  input,     ///< a = index into Program::inputs
  constant,  ///< a = index into Program::constants
  pi,        ///< the number Pi
  add,       ///< a + b
  sub,       ///< a - b
  mul,       ///< a * b
  div,       ///< a / b
  neg,       ///< -a
  pow,       ///< a ^ b, where b is a `constant` that is neither an integer nor 1/2
  sqrt,
  sin,
  cos,
  tan,
  sinh,
  cosh,
  tanh,
  exp,
  log,
  asin,
  acos,
  atan2,  ///< atan2(a, b)
  abs,    ///< |a|
  sign,   ///< -1, 0 or 1: the derivative of |a|; the last
};

/// One line of a straight-line program: the value `op(a, b)`. For all but `input` and `constant`,
/// `a` and `b` are indices of earlier instructions; unused operands are -1.
struct Instruction {
  Op op;
  int a = -1;
  int b = -1;
  /// The same operation of the same lines.
  friend bool operator==(const Instruction&, const Instruction&) = default;
};

/// A function R^inputs -> R^outputs as a list of instructions without branches.
///
/// Plain data: code generation writes it, the emitter turns it into C++, and the runtime evaluates
/// it over any number type. Constants are exact; whoever evaluates rounds them.
/// By convention the inputs of a right-hand side are the states, then the run-time parameters, then
/// the time (always present, as the last input).
struct Program {
  std::vector<std::string> inputs;
  std::vector<cln::cl_RA> constants;
  std::vector<Instruction> code;
  std::vector<int> outputs;               ///< instruction index of each output
  std::vector<std::string> output_names;  ///< one for each output, e.g. "dM1", "F1"
};

}  // namespace casimir
