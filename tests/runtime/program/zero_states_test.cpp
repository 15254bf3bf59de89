// States that start at 0 and stay there: which do, and which only seem to.
#include "runtime/program/zero_states.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/runtime/programs.hpp"

namespace casimir::test {
namespace {

using States = std::vector<std::size_t>;

/// x' = M1 (a M2) - M2 (a M1 + b x), as on a relation of Hess, for the third state.
TEST(ZeroStates, StayWhereTheirRatesCancel) {
  Builder b({"M1", "M2", "x", "a", "b"});
  const auto mul = [&](int x, int y) { return b.op(Op::mul, x, y); };
  b.output(b.op(Op::neg, 1));
  b.output(0);
  b.output(b.op(Op::sub, mul(0, mul(3, 1)), mul(1, b.op(Op::add, mul(3, 0), mul(4, 2)))));
  EXPECT_EQ(states_that_stay_zero(b.program(), {false, false, true}), States{2});
  // From elsewhere it moves, whatever the others do.
  EXPECT_EQ(states_that_stay_zero(b.program(), {false, false, false}), States{});
  // M1' = -M2 and M2' = M1 stay only together.
  EXPECT_EQ(states_that_stay_zero(b.program(), {true, false, true}), States{2});
  EXPECT_EQ(states_that_stay_zero(b.program(), {true, true, true}), (States{0, 1, 2}));
}

/// The rate of one state of x' = f(x, y, t), y' = 1, from x = 0.
bool stays(const std::function<int(Builder&)>& rate) {
  Builder b({"x", "y"});
  b.output(rate(b));
  b.output(b.number(1));
  return !states_that_stay_zero(b.program(), {true, false}).empty();
}

TEST(ZeroStates, MayBeMultipliedByAnything) {
  EXPECT_TRUE(stays([](Builder& b) { return b.op(Op::mul, 0, b.op(Op::log, b.time())); }));
  EXPECT_TRUE(stays([](Builder& b) { return b.op(Op::sin, 0); }));
  EXPECT_TRUE(
      stays([](Builder& b) { return b.op(Op::sub, b.op(Op::exp, 0), b.op(Op::div, 1, 1)); }));
  EXPECT_TRUE(stays([](Builder& b) { return b.op(Op::div, 0, 1); }));
  EXPECT_FALSE(stays([](Builder& b) { return b.op(Op::sin, 1); }));
  EXPECT_FALSE(stays([](Builder& b) { return b.op(Op::cos, 0); }));
  EXPECT_FALSE(stays([](Builder& b) { return b.number(cln::cl_RA("2147483647")); }));
  EXPECT_FALSE(stays([](Builder& b) { return b.number(cln::cl_RA("2147483629/7")); }));
}

/// Where a rate has an edge at 0, more than one solution may begin there: x' = x^(2/3) has t^3/27.
TEST(ZeroStates, AreNotSoughtWhereTheirRatesHaveEdges) {
  EXPECT_FALSE(stays([](Builder& b) { return b.op(Op::sqrt, 0); }));
  EXPECT_FALSE(stays([](Builder& b) { return b.op(Op::abs, 0); }));
  EXPECT_FALSE(stays([](Builder& b) { return b.op(Op::pow, 0, b.number(cln::cl_RA("2/3"))); }));
  EXPECT_FALSE(stays([](Builder& b) { return b.op(Op::div, 0, b.op(Op::mul, 0, 0)); }));
  // An edge in another state is none in x.
  EXPECT_TRUE(stays([](Builder& b) { return b.op(Op::mul, 0, b.op(Op::sqrt, 1)); }));
}

TEST(ZeroStates, RestWithoutTheirRates) {
  Builder b({"x", "y"});
  b.output(0);
  b.output(1);
  const Program rest = at_rest(b.program(), {0});
  EXPECT_EQ(rest.outputs[1], 1);
  const Instruction& line = rest.code[static_cast<std::size_t>(rest.outputs[0])];
  ASSERT_EQ(line.op, Op::constant);
  EXPECT_TRUE(cln::zerop(rest.constants[static_cast<std::size_t>(line.a)]));
}

}  // namespace
}  // namespace casimir::test
