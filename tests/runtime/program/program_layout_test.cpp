// The tables of a program give the same Taylor coefficients as the program line by line.
#include "runtime/taylor/program_layout.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "runtime/program/program_series.hpp"
#include "runtime/taylor/quadratic_targets.hpp"
#include "tests/runtime/programs.hpp"

namespace casimir::test {
namespace {

constexpr int kSeriesOrder = 20;

int width_of(const std::string& target) {
  return target == "avx512" ? 8 : target == "avx2" ? 4 : 2;
}

/// The largest difference of a coefficient, relative to the largest coefficient of its order.
double difference(const Program& program, const std::vector<double>& x,
                  const std::vector<double>& parameters, double t, double unit, int width) {
  TaylorJet<double> jet(program, Arithmetic<double>{}, parameters, kSeriesOrder);
  const auto& truth = jet.expand(t, x, unit);
  auto layout = ProgramLayout::of(program, parameters.size(), width);
  if (!layout) return 1;
  layout->start(kSeriesOrder, parameters.data());
  const std::size_t n = x.size();
  std::vector<double> rows((kSeriesOrder + 1) * n);
  std::copy(x.begin(), x.end(), rows.begin());
  double worst = 0;
  for (int repeat = 0; repeat < 2; ++repeat) {  // nothing is left of the first expansion
    layout->expand(t, unit, rows.data(), static_cast<int>(n));
    for (std::size_t k = 0; k <= kSeriesOrder; ++k) {
      double size = 0, apart = 0;
      for (std::size_t i = 0; i < n; ++i) {
        size = std::max(size, std::abs(truth[i][k]));
        apart = std::max(apart, std::abs(truth[i][k] - rows[k * n + i]));
      }
      worst = std::max(worst, size > 0 ? apart / size : apart);
    }
  }
  return worst;
}

/// A program of random operations in all kinds, at every level, with values near 1.
Program random_program(unsigned seed) {
  std::mt19937 random(seed);
  Builder b({"x", "y", "z", "p"});
  std::vector<int> lines{0, 1, 2, 3, b.time(), b.number(cln::cl_RA(3) / 7), b.number(2)};
  const int half = b.number(cln::cl_RA(3) / 2), four = b.number(4);
  lines.push_back(b.op(Op::mul, 3, half));  // depends on the parameter only
  const auto any = [&] { return lines[random() % lines.size()]; };
  // Sines keep what grows in bounds, and 4 + sin is a base for all functions.
  const auto bounded = [&] { return b.op(Op::add, four, b.op(Op::sin, any())); };
  for (int i = 0; i < 40; ++i) {
    const Op all[] = {Op::add, Op::sub, Op::neg, Op::mul, Op::div, Op::sqrt,
                      Op::pow, Op::exp, Op::log, Op::sin, Op::cos};
    const Op op = all[random() % std::size(all)];
    const int line = op == Op::div                     ? b.op(op, any(), bounded())
                     : op == Op::pow                   ? b.op(op, bounded(), half)
                     : op == Op::sqrt || op == Op::log ? b.op(op, bounded())
                     : op == Op::exp                   ? b.op(op, b.op(Op::sin, any()))
                     : op == Op::add || op == Op::sub || op == Op::mul ? b.op(op, any(), any())
                                                                       : b.op(op, any());
    lines.push_back(line);
    if (op == Op::mul) lines.back() = b.op(Op::cos, line);
  }
  for (int i = 0; i < 3; ++i) b.output(b.op(Op::sin, lines[lines.size() - 1 - i]));
  return b.program();
}

class ProgramLayouts : public testing::TestWithParam<std::string> {};

TEST_P(ProgramLayouts, EveryOperationHasTheSeriesOfTheProgramLineByLine) {
  for (unsigned seed = 1; seed <= 60; ++seed)
    EXPECT_LT(
        difference(random_program(seed), {0.3, -0.7, 1.1}, {0.6}, 0.4, 0.25, width_of(GetParam())),
        1e-11)
        << seed;
}

TEST_P(ProgramLayouts, RightHandSidesOfConstantsTimeAndStates) {
  Builder b({"x", "y", "p"});
  b.output(b.time());
  b.output(2);  // the parameter itself
  EXPECT_LT(difference(b.program(), {1, 2}, {0.3}, 5, 0.5, width_of(GetParam())), 1e-15);
  Builder c({"x", "y"});
  c.output(1);
  c.output(c.number(cln::cl_RA(1) / 3));
  EXPECT_LT(difference(c.program(), {1, 2}, {}, 5, 0.5, width_of(GetParam())), 1e-15);
}

// What has no group is left to the program itself.
TEST_P(ProgramLayouts, AreRefusedForOperationsWithoutAGroup) {
  for (const Op op : {Op::tan, Op::sinh, Op::cosh, Op::tanh, Op::asin, Op::acos, Op::abs}) {
    Builder b({"x"});
    b.output(b.op(op, 0));
    EXPECT_FALSE(ProgramLayout::of(b.program(), 0, width_of(GetParam())));
  }
  Builder b({"x", "p"});
  b.output(b.op(Op::mul, 0, b.op(Op::tan, 1)));  // of a parameter anything may be taken
  EXPECT_TRUE(ProgramLayout::of(b.program(), 1, width_of(GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Targets, ProgramLayouts, testing::ValuesIn(quadratic_targets()));

}  // namespace
}  // namespace casimir::test
