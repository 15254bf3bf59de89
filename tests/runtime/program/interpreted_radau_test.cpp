// Stiff systems without a compiler: the same steps as by the kernel with a system of its own.
#include "runtime/program/interpreted_radau.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "runtime/uncompiled.hpp"
#include "tests/runtime/programs.hpp"
#include "tests/runtime/systems.hpp"

namespace casimir::test {
namespace {

/// Van der Pol's oscillator beside x' = p (cos t - x): three states in a room for four.
struct Mixed {
  static constexpr int n = 3;
  static void rhs(double t, const double* y, const double* p, double* d) {
    d[0] = y[1];
    d[1] = ((1 - y[0] * y[0]) * y[1] - y[0]) * p[0];
    d[2] = p[0] * (std::cos(t) - y[2]);
  }
  static void jacobian(double, const double* y, const double* p, double* J) {
    const double columns[9] = {
        0, (-2 * y[0] * y[1] - 1) * p[0], 0, 1, (1 - y[0] * y[0]) * p[0], 0, 0, 0, -p[0]};
    std::copy_n(columns, 9, J);
  }
};

Program mixed_program() {
  Builder b({"x", "y", "z", "p"});
  const int one = b.number(1);
  const auto mul = [&](int u, int v) { return b.op(Op::mul, u, v); };
  const auto sub = [&](int u, int v) { return b.op(Op::sub, u, v); };
  b.output(1);
  b.output(mul(sub(mul(sub(one, mul(0, 0)), 1), 0), 3));
  b.output(mul(3, sub(b.op(Op::cos, b.time()), 2)));
  return b.program();
}

JacobianProgram mixed_jacobian() {
  Builder b({"x", "y", "z", "p"});
  const int one = b.number(1), two = b.number(2);
  const auto mul = [&](int u, int v) { return b.op(Op::mul, u, v); };
  const auto sub = [&](int u, int v) { return b.op(Op::sub, u, v); };
  b.output(mul(b.op(Op::neg, b.op(Op::add, mul(two, mul(0, 1)), one)), 3));
  b.output(one);
  b.output(mul(sub(one, mul(0, 0)), 3));
  b.output(b.op(Op::neg, 3));
  return {b.program(), {{1, 0}, {0, 1}, {1, 1}, {2, 2}}};
}

/// The same programs `copies` times side by side.
std::pair<Program, JacobianProgram> copies_of_mixed(int copies) {
  const Program one = mixed_program();
  const JacobianProgram matrix = mixed_jacobian();
  const auto repeated = [copies](const Program& part) {
    Program all;
    const int n = 3 * copies;
    for (int i = 0; i < n; ++i) all.inputs.push_back("x" + std::to_string(i));
    all.inputs.insert(all.inputs.end(), {"p", "t"});
    for (int c = 0; c < copies; ++c) {
      const int first = static_cast<int>(all.code.size());
      const int constants = static_cast<int>(all.constants.size());
      all.constants.insert(all.constants.end(), part.constants.begin(), part.constants.end());
      for (Instruction line : part.code) {
        if (line.op == Op::input)
          line.a += line.a < 3 ? 3 * c : n - 3;
        else if (line.op == Op::constant)
          line.a += constants;
        else {
          line.a += first;
          if (line.b >= 0) line.b += first;
        }
        all.code.push_back(line);
      }
      for (const int output : part.outputs) {
        all.outputs.push_back(first + output);
        all.output_names.push_back("d");
      }
    }
    return all;
  };
  JacobianProgram all{repeated(matrix.program), {}};
  for (int c = 0; c < copies; ++c)
    for (const auto& [row, column] : matrix.entries)
      all.entries.emplace_back(row + 3 * c, column + 3 * c);
  return {repeated(one), all};
}

Module interpreted_module(const Program& rhs, const JacobianProgram& jacobian, int stages) {
  ModuleFunctions functions = uncompiled_module(rhs, {}, {}, {1000.}).functions();
  functions.integrate = interpreted_radau(rhs, jacobian, stages);
  return Module::from_functions(functions);
}

Settings stiff_settings() {
  Settings settings;
  settings.duration = 3;
  settings.rtol = settings.atol = 1e-9;
  settings.sample_every = 0.37;
  return settings;
}

class InterpretedRadau : public testing::TestWithParam<int> {};

TEST_P(InterpretedRadau, TakesTheStepsOfTheCompiledKernel) {
  const int stages = GetParam();
  const std::string name = stages == 5 ? "radau9" : "radau5";
  const std::vector<double> start{2, 0, 0.5}, parameters{1000};
  const Trajectory truth = run<Mixed>(name, stiff_settings(), start, parameters);
  ASSERT_EQ(truth.status, Status::ok);
  for (const int copies : {1, 3, 9}) {
    const auto [rhs, jacobian] = copies_of_mixed(copies);
    const Module module = interpreted_module(rhs, jacobian, stages);
    std::vector<double> many;
    for (int c = 0; c < copies; ++c) many.insert(many.end(), start.begin(), start.end());
    const Trajectory orbit =
        integrate(module, *find_method(name), stiff_settings(), many, parameters);
    ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
    EXPECT_NEAR(double(orbit.steps), double(truth.steps), 0.02 * double(truth.steps)) << copies;
    ASSERT_EQ(orbit.samples.size(), truth.samples.size());
    for (std::size_t i = 0; i < many.size(); ++i) {
      EXPECT_NEAR(orbit.state[i], truth.state[i % 3], 1e-8) << copies << ' ' << i;
      for (std::size_t k = 0; k < truth.samples.size(); ++k)
        EXPECT_NEAR(orbit.samples[k][i], truth.samples[k][i % 3], 1e-8) << copies << ' ' << k;
    }
  }
}

// The twin: with an entry of the Jacobian left out nothing contracts, and it takes more steps.
TEST_P(InterpretedRadau, NeedsTheRightJacobian) {
  JacobianProgram bent = mixed_jacobian();
  bent.entries[3] = {0, 0};
  const Method& method = *find_method(GetParam() == 5 ? "radau9" : "radau5");
  const Trajectory right =
      integrate(interpreted_module(mixed_program(), mixed_jacobian(), GetParam()), method,
                stiff_settings(), {2, 0, 0.5}, {1000});
  const Trajectory wrong = integrate(interpreted_module(mixed_program(), bent, GetParam()), method,
                                     stiff_settings(), {2, 0, 0.5}, {1000});
  EXPECT_TRUE(wrong.status != Status::ok || wrong.evaluations > 2 * right.evaluations);
}

INSTANTIATE_TEST_SUITE_P(Stages, InterpretedRadau, testing::Values(3, 5));

TEST(InterpretedRadauRooms, WhatHasNoRoomIsRefused) {
  const auto [rhs, jacobian] = copies_of_mixed(18);  // 54 states
  EXPECT_THROW(interpreted_radau(rhs, jacobian, 5), std::invalid_argument);
  EXPECT_THROW(interpreted_radau(mixed_program(), mixed_jacobian(), 4), std::invalid_argument);
}

}  // namespace
}  // namespace casimir::test
