#pragma once

#include <cln/rational.h>

#include <map>
#include <tuple>

#include "runtime/program.hpp"

namespace casimir::codegen {

/// Appends instructions to a program, each value once: what is there already is used again.
class ProgramWriter {
 public:
  /// \param program  without instructions; outlives the writer.
  explicit ProgramWriter(Program& program) : program_(program) {}

  int number(const cln::cl_RA& value);
  int emit(Op op, int a = -1, int b = -1);

  /// base ^ exponent by squaring, exponent >= 1.
  int power(int base, int exponent);

  // Arithmetic that leaves out what exact constants decide: x + 0, x * 1, x - x, -(-x), 2 * 3.
  int sum(int a, int b);
  int difference(int a, int b);
  int product(int a, int b);
  int quotient(int a, int b);
  int negation(int a);

  /// The constant that instruction i is, or null.
  const cln::cl_RA* constant(int i) const;
  bool is_zero(int i) const;

 private:
  const Instruction& at(int i) const { return program_.code[static_cast<std::size_t>(i)]; }
  bool is_one(int i) const;
  bool is_negation(int i) const { return at(i).op == Op::neg; }

  Program& program_;
  std::map<cln::cl_RA, int> constants_;
  std::map<std::tuple<Op, int, int>, int> known_;
};

}  // namespace casimir::codegen
