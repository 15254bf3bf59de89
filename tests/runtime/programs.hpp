#pragma once

#include <initializer_list>
#include <string>

#include "runtime/program.hpp"

namespace casimir::test {

/// Writes straight-line programs by hand: `const int s = b.op(Op::mul, x, y);`.
class Builder {
 public:
  /// Right-hand sides: states, then parameters; the time is added as the last input.
  explicit Builder(std::initializer_list<const char*> inputs) {
    for (const char* name : inputs) program_.inputs.emplace_back(name);
    program_.inputs.emplace_back("t");
    for (int i = 0; i < static_cast<int>(program_.inputs.size()); ++i) op(Op::input, i);
  }
  /// The line of input i is i itself; the time is the last.
  int time() const { return static_cast<int>(program_.inputs.size()) - 1; }
  int op(Op op, int a = -1, int b = -1) {
    program_.code.push_back({op, a, b});
    return static_cast<int>(program_.code.size()) - 1;
  }
  int number(const cln::cl_RA& value) {
    program_.constants.push_back(value);
    return op(Op::constant, static_cast<int>(program_.constants.size()) - 1);
  }
  void output(int line) {
    program_.outputs.push_back(line);
    program_.output_names.push_back("d" + program_.inputs[program_.outputs.size() - 1]);
  }
  const Program& program() const { return program_; }

 private:
  Program program_;
};

inline Program kovalevskaya_program() {
  Builder b({"M1", "M2", "M3", "g1", "g2", "g3"});
  const int two = b.number(2);
  const int t = b.op(Op::mul, two, 2);
  const auto mul = [&](int x, int y) { return b.op(Op::mul, x, y); };
  b.output(mul(1, 2));
  b.output(b.op(Op::sub, b.op(Op::neg, mul(0, 2)), 5));
  b.output(b.op(Op::add, 4, b.number(0)));
  b.output(b.op(Op::sub, mul(4, t), mul(5, 1)));
  b.output(b.op(Op::sub, mul(5, 0), mul(3, t)));
  b.output(b.op(Op::sub, mul(3, 1), mul(4, 0)));
  return b.program();
}

}  // namespace casimir::test
