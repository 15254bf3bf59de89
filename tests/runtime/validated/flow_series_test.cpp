// Taylor coefficients in balls of doubles, against Arb's with 200 bits.
#include "runtime/validated/flow_series.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/runtime/programs.hpp"

namespace casimir::validated {
namespace {

using test::Builder;

/// A right-hand side of sums, products and quotients by constants, that may have the time in it.
Program random_polynomial(std::mt19937& random) {
  const auto whole = [&](int low, int high) {
    return std::uniform_int_distribution<>(low, high)(random);
  };
  Builder b({"x", "y", "z"});
  std::vector<int> lines{0, 1, 2, b.time()};
  const int third = b.number(cln::cl_RA(whole(1, 9)) / 3), two = b.number(2);
  const int fixed = b.op(Op::sqrt, b.op(Op::add, two, third));
  for (const int constant : {third, two, fixed}) lines.push_back(constant);
  const auto any = [&] {
    return lines[static_cast<std::size_t>(whole(0, static_cast<int>(lines.size()) - 1))];
  };
  const Op operations[] = {Op::add, Op::sub, Op::mul, Op::mul, Op::neg, Op::div};
  for (int i = 0; i < 9; ++i) {
    const Op op = operations[whole(0, 5)];
    const int by = op == Op::div ? fixed : any();
    lines.push_back(op == Op::neg ? b.op(op, any()) : b.op(op, any(), by));
  }
  for (int i = 0; i < 3; ++i) b.output(lines[lines.size() - 1 - static_cast<std::size_t>(i)]);
  return b.program();
}

/// How many coefficients of some random polynomials do not contain the true ones.
int missed(bool forget_the_time) {
  constexpr int kOrder = 12;
  const BallPrecision precision(200);
  std::mt19937 random(5);
  int count = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Program program = random_polynomial(random);
    EXPECT_TRUE(is_polynomial(program));
    PolynomialJet jet(program, kOrder);
    TaylorJet<ArbBall> truth(program, {}, {}, kOrder);
    const double sign = trial % 2 == 0 ? 1 : -1;
    const std::vector<MidRad> x{{0.7, 1e-9}, {-1.25, 0}, {0.1, 1e-16}};
    const std::vector<ArbBall> point{ArbBall(0.7), ArbBall(-1.25), ArbBall(0.1)};
    const auto& series = jet.expand(MidRad(forget_the_time ? 0 : 0.3), x, MidRad(sign));
    const auto& exact = truth.expand(ArbBall(0.3), point, ArbBall(sign));
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k <= kOrder; ++k)
        count += arb_contains(ArbBall(series[i][k]).raw(), exact[i][k].raw()) == 0 ? 1 : 0;
  }
  return count;
}

TEST(FlowSeries, OfPolynomialsContainThoseOfLongNumbers) {
  EXPECT_EQ(missed(false), 0);
  EXPECT_GT(missed(true), 100);
}

/// The same from a point and a box at once. \param share  of the radii that is left of the point's.
int missed_at_once(double share) {
  constexpr int kOrder = 40;
  const BallPrecision precision(200);
  std::mt19937 random(7);
  int count = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Program program = random_polynomial(random);
    PolynomialJet both(program, kOrder, 2), alone(program, kOrder);
    TaylorJet<ArbBall> truth(program, {}, {}, kOrder);
    const double sign = trial % 2 == 0 ? 1 : -1;
    const std::vector<MidRad> middle{MidRad(0.7), MidRad(-1.25), MidRad(0.1)};
    const std::vector<MidRad> box{{0.7, 1e-9}, {-1.25, 0}, {0.1, 1e-3}};
    both.expand_both(MidRad(0.3), middle, box, MidRad(sign));
    const auto& boxes = alone.expand(MidRad(0.3), box, MidRad(sign));
    const std::vector<ArbBall> centre{ArbBall(0.7), ArbBall(-1.25), ArbBall(0.1)};
    const std::vector<ArbBall> corner{ArbBall(0.7) + ArbBall(0.9e-9), ArbBall(-1.25),
                                      ArbBall(0.1) - ArbBall(0.9e-3)};
    for (const bool at_corner : {false, true}) {
      const auto& exact = truth.expand(ArbBall(0.3), at_corner ? corner : centre, ArbBall(sign));
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k <= kOrder; ++k) {
          MidRad ball = both.states(at_corner ? 1 : 0)[i][k];
          if (!at_corner) ball.rad *= share;
          EXPECT_EQ(boxes[i][k].mid, ball.mid);
          EXPECT_LE(both.states(1)[i][k].rad, boxes[i][k].rad * (1 + 1e-12));
          if (!is_usable(ball)) continue;
          count += arb_contains(ArbBall(ball).raw(), exact[i][k].raw()) == 0 ? 1 : 0;
        }
      }
    }
  }
  return count;
}

TEST(FlowSeries, FromAPointAndABoxAtOnceAreThoseOfEach) {
  EXPECT_EQ(missed_at_once(1), 0);
  EXPECT_GT(missed_at_once(0.001), 100);
}

TEST(FlowSeries, OfOtherFunctionsAreNoPolynomials) {
  Builder b({"x"});
  b.output(b.op(Op::div, b.number(1), 0));
  EXPECT_FALSE(is_polynomial(b.program()));
  Builder root({"x"});
  root.output(root.op(Op::mul, 0, root.op(Op::sqrt, root.number(2))));
  EXPECT_TRUE(is_polynomial(root.program()));
}

}  // namespace
}  // namespace casimir::validated
