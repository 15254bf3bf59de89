#pragma once

#include <random>
#include <string>
#include <vector>

#include "codegen/optimise/differentiate.hpp"
#include "runtime/validated_run.hpp"
#include "tests/runtime/programs.hpp"

namespace casimir::test {

/// A program without inputs whose outputs are these numbers.
inline Program numbers(const std::vector<cln::cl_RA>& values) {
  Program program;
  for (const cln::cl_RA& value : values) {
    program.constants.push_back(value);
    program.code.push_back({Op::constant, static_cast<int>(program.constants.size()) - 1});
    program.outputs.push_back(static_cast<int>(program.code.size()) - 1);
    program.output_names.push_back("x" + std::to_string(program.outputs.size()));
  }
  return program;
}

/// \param start  the states, and the duration.
inline ValidatedProblem problem_of(const Program& rates, const std::vector<cln::cl_RA>& start) {
  ValidatedProblem problem;
  problem.rates = rates;
  const SparseProgram jacobian = codegen::jacobian(rates, rates.outputs.size());
  problem.jacobian = jacobian.program;
  problem.entries = jacobian.entries;
  problem.start = numbers(start);
  return problem;
}

inline KnownIntegral integral(const std::string& name, const Program& value, std::size_t states) {
  const SparseProgram gradient = codegen::gradients(value, states);
  KnownIntegral known{.name = name, .value = value, .gradient = gradient.program, .states = {}};
  for (const auto& [state, output] : gradient.entries) known.states.push_back(state);
  return known;
}

/// Right-hand sides of one to three states from every operation of the language.
class RandomSystem {
 public:
  explicit RandomSystem(unsigned seed) : random_(seed) {}

  int whole(int low, int high) { return std::uniform_int_distribution<>(low, high)(random_); }
  cln::cl_RA number(int size) { return cln::cl_RA(whole(-60 * size, 60 * size)) / whole(37, 61); }

  Program program() {
    const int n = whole(1, 3);
    Builder b = n == 1 ? Builder({"x"}) : n == 2 ? Builder({"x", "y"}) : Builder({"x", "y", "z"});
    std::vector<int> lines;
    for (int i = 0; i <= n; ++i) lines.push_back(i);
    lines.push_back(b.number(number(2)));
    const auto any = [&] {
      return lines[static_cast<std::size_t>(whole(0, static_cast<int>(lines.size()) - 1))];
    };
    for (int i = whole(2, 7); i > 0; --i) lines.push_back(operation(b, any(), any()));
    for (int i = 0; i < n; ++i) {
      const int last = lines[lines.size() - 1 - static_cast<std::size_t>(i) % lines.size()];
      b.output(whole(0, 2) == 0 ? last : b.op(Op::mul, b.number(number(1)), b.op(Op::sin, last)));
    }
    return b.program();
  }

 private:
  /// Arguments are moved into the domain of the operation, more often than not.
  int operation(Builder& b, int x, int y) {
    const bool moved = whole(0, 4) > 0;
    const int positive =
        moved ? b.op(Op::add, b.number(cln::cl_RA(whole(1, 9)) / 7), b.op(Op::mul, x, x)) : x;
    const int small = moved ? b.op(Op::div, x, b.op(Op::add, b.number(2), b.op(Op::mul, x, x))) : x;
    switch (whole(0, 19)) {
      case 0:
        return b.op(Op::add, x, y);
      case 1:
        return b.op(Op::sub, x, y);
      case 2:
      case 3:
        return b.op(Op::mul, x, y);
      case 4:
        return b.op(Op::div, y, positive);
      case 5:
        return b.op(Op::neg, x);
      case 6:
        return b.op(Op::pow, positive, b.number(cln::cl_RA(whole(-5, 5)) / 3));
      case 7:
        return b.op(Op::sqrt, positive);
      case 8:
        return b.op(Op::sin, x);
      case 9:
        return b.op(Op::cos, x);
      case 10:
        return b.op(Op::tan, small);
      case 11:
        return b.op(Op::exp, small);
      case 12:
        return b.op(Op::log, positive);
      case 13:
        return b.op(Op::asin, small);
      case 14:
        return b.op(Op::acos, small);
      case 15:
        return b.op(Op::atan2, y, positive);
      case 16:
        return b.op(Op::sinh, small);
      case 17:
        return b.op(Op::cosh, small);
      case 18:
        return b.op(Op::tanh, x);
      default:
        return b.op(Op::mul, b.op(Op::abs, moved ? positive : x), b.op(Op::pi));
    }
  }

  std::mt19937 random_;
};

}  // namespace casimir::test
