// Each operation of balls in doubles against Arb with 300 bits, at points of the balls.
#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

#include "runtime/validated/arb_ball.hpp"

namespace casimir::validated {
namespace {

using Points = std::vector<ArbBall>;
using Arb = Arithmetic<ArbBall>;
using Double = Arithmetic<MidRad>;

/// Balls of all sizes: most moderate, some exact, some as large or small as doubles are.
class RandomBalls {
 public:
  explicit RandomBalls(unsigned seed) : random_(seed) {}

  double uniform() { return std::uniform_real_distribution<>(-1, 1)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<>(low, high)(random_); }

  /// \param exponents  the range of the binary exponents of the middles.
  MidRad ball(int exponents = 8) {
    double mid = std::ldexp(uniform(), whole(-exponents, exponents));
    if (whole(0, 9) == 0) mid = whole(-4, 4);
    if (whole(0, 19) == 0) mid = 0;
    if (whole(0, 2) == 0) return MidRad(mid);
    return {mid, std::ldexp(std::abs(mid) + (whole(0, 9) == 0 ? 1. : 0.), -whole(1, 70))};
  }

  /// A number of the ball: an end, the middle, or any; exact in Arb.
  ArbBall point(const MidRad& ball) {
    ArbBall result(ball.mid), off(ball.rad);
    const int where = whole(0, 3);
    const double share = where == 0 ? -1 : where == 1 ? 1 : where == 2 ? 0 : uniform();
    arb_mul(off.raw(), off.raw(), ArbBall(share).raw(), ARF_PREC_EXACT);
    arb_add(result.raw(), result.raw(), off.raw(), ARF_PREC_EXACT);
    return result;
  }

 private:
  std::mt19937 random_;
};

/// Whether the whole of Arb's result, which is a point but for 300 bits, is in the ball.
bool holds(const MidRad& ball, const ArbBall& truth) {
  ArbBall outside(0.);
  arb_set_d(outside.raw(), ball.mid);
  arf_t radius;
  arf_init(radius);
  arf_set_d(radius, ball.rad);
  ArbBall low, high;
  arf_sub(arb_midref(low.raw()), arb_midref(outside.raw()), radius, ARF_PREC_EXACT, ARF_RND_DOWN);
  arf_add(arb_midref(high.raw()), arb_midref(outside.raw()), radius, ARF_PREC_EXACT, ARF_RND_DOWN);
  arf_clear(radius);
  // Arb's own doubt must not count against the ball where both are one exact number.
  if (is_exact(ball)) return arb_contains(truth.raw(), outside.raw()) != 0;
  return arb_lt(truth.raw(), low.raw()) == 0 && arb_gt(truth.raw(), high.raw()) == 0;
}

struct Binary {
  const char* name;
  std::function<MidRad(const MidRad&, const MidRad&)> ball;
  std::function<ArbBall(const ArbBall&, const ArbBall&)> point;
};

/// How many of so many trials miss; refusals are none. \param told  counts what was not refused.
int misses(const Binary& operation, int trials, int exponents, int* told = nullptr) {
  const BallPrecision precision(300);
  RandomBalls random(17);
  int missed = 0;
  for (int i = 0; i < trials; ++i) {
    const MidRad a = random.ball(exponents), b = random.ball(exponents);
    MidRad result;
    try {
      result = operation.ball(a, b);
    } catch (const std::domain_error&) {
      continue;
    }
    if (!is_usable(result)) continue;
    if (told) ++*told;
    const ArbBall x = random.point(a), y = random.point(b);
    if (!holds(result, operation.point(x, y))) ++missed;
  }
  return missed;
}

const std::vector<Binary>& operations() {
  static const std::vector<Binary> all = {
      {"+", [](auto a, auto b) { return a + b; }, [](auto& x, auto& y) { return x + y; }},
      {"-", [](auto a, auto b) { return a - b; }, [](auto& x, auto& y) { return x - y; }},
      {"*", [](auto a, auto b) { return a * b; }, [](auto& x, auto& y) { return x * y; }},
      {"/", [](auto a, auto b) { return a / b; }, [](auto& x, auto& y) { return x / y; }},
      {"pow", [](auto a, auto b) { return Double::power(a, b); },
       [](auto& x, auto& y) { return Arb::power(x, y); }},
      {"atan2", [](auto a, auto b) { return Double::atan2(a, b); },
       [](auto& x, auto& y) { return Arb::atan2(x, y); }},
      {"sqrt", [](auto a, auto) { return Double::sqrt(a); },
       [](auto& x, auto&) { return Arb::sqrt(x); }},
      {"sin", [](auto a, auto) { return Double::function(Op::sin, a); },
       [](auto& x, auto&) { return Arb::function(Op::sin, x); }},
      {"cos", [](auto a, auto) { return Double::function(Op::cos, a); },
       [](auto& x, auto&) { return Arb::function(Op::cos, x); }},
      {"tan", [](auto a, auto) { return Double::function(Op::tan, a); },
       [](auto& x, auto&) { return Arb::function(Op::tan, x); }},
      {"sinh", [](auto a, auto) { return Double::function(Op::sinh, a); },
       [](auto& x, auto&) { return Arb::function(Op::sinh, x); }},
      {"cosh", [](auto a, auto) { return Double::function(Op::cosh, a); },
       [](auto& x, auto&) { return Arb::function(Op::cosh, x); }},
      {"tanh", [](auto a, auto) { return Double::function(Op::tanh, a); },
       [](auto& x, auto&) { return Arb::function(Op::tanh, x); }},
      {"exp", [](auto a, auto) { return Double::function(Op::exp, a); },
       [](auto& x, auto&) { return Arb::function(Op::exp, x); }},
      {"log", [](auto a, auto) { return Double::log(a); },
       [](auto& x, auto&) { return Arb::log(x); }},
      {"asin", [](auto a, auto) { return Double::asin(a); },
       [](auto& x, auto&) { return Arb::asin(x); }},
      {"acos", [](auto a, auto) { return Double::acos(a); },
       [](auto& x, auto&) { return Arb::acos(x); }},
  };
  return all;
}

TEST(BallArithmetic, ContainsTheValueAtEveryPointOfTheArguments) {
  for (const Binary& operation : operations()) {
    int told = 0;
    EXPECT_EQ(misses(operation, 20000, 8, &told), 0) << operation.name;
    EXPECT_GT(told, 1000) << operation.name << " refuses nearly everything";
  }
}

TEST(BallArithmetic, ContainsTheValueWhereNumbersUnderflowOrOverflow) {
  for (const Binary& operation : operations()) {
    // Sines of giants take long, and say nothing that moderate arguments do not.
    const bool four = operation.name[1] == 0;
    EXPECT_EQ(misses(operation, 20000, four ? 1060 : 300), 0) << operation.name;
  }
}

// What the tests above are worth: without the term for rounding they fail.
TEST(BallArithmetic, MissesWithoutTheTermForRounding) {
  const Binary sum{"+", [](auto a, auto b) { return MidRad(a.mid + b.mid, a.rad + b.rad); },
                   [](auto& x, auto& y) { return x + y; }};
  const Binary product{"*",
                       [](auto a, auto b) {
                         return MidRad(a.mid * b.mid,
                                       std::abs(a.mid) * b.rad + a.rad * (std::abs(b.mid) + b.rad));
                       },
                       [](auto& x, auto& y) { return x * y; }};
  EXPECT_GT(misses(sum, 20000, 8), 100);
  EXPECT_GT(misses(product, 20000, 8), 100);
}

// .. and so they do without the one for underflow.
TEST(BallArithmetic, MissesWithoutTheTermForUnderflow) {
  const Binary product{
      "*",
      [](auto a, auto b) {
        const double m = a.mid * b.mid;
        return MidRad(
            m, (std::abs(a.mid) * b.rad + a.rad * (std::abs(b.mid) + b.rad) + kUnit * std::abs(m)) *
                   kUpwards);
      },
      [](auto& x, auto& y) { return x * y; }};
  EXPECT_EQ(misses(product, 20000, 8), 0);
  EXPECT_GT(misses(product, 20000, 1060), 10);
}

/// sum_j w_j u_j v_{k-j} of random series; misses of the ball. \param drop  radii of the result are
/// taken times it.
int convolution_misses(bool weighted, double drop) {
  const BallPrecision precision(300);
  RandomBalls random(5);
  int missed = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const int k = random.whole(0, 40);
    std::vector<MidRad> u, v;
    std::vector<ArbBall> x, y;
    for (int j = 0; j <= k; ++j) {
      u.push_back(random.ball(trial % 3 == 0 ? 200 : 3));
      v.push_back(random.ball(trial % 3 == 0 ? 200 : 3));
      if (trial % 2 == 0) u.back().rad = v.back().rad = 0;
      x.push_back(random.point(u.back()));
      y.push_back(random.point(v.back()));
    }
    const int from = random.whole(0, 1), to = k - random.whole(0, 1);
    MidRad ball =
        weighted ? Double::weighted(u, v, k, from, to) : Double::convolution(u, v, k, from, to);
    ball.rad *= drop;
    ArbBall truth(0.);
    for (int j = from; j <= to; ++j) {
      const auto i = static_cast<std::size_t>(j), other = static_cast<std::size_t>(k - j);
      truth = truth + ArbBall(weighted ? j : 1.) * x[i] * y[other];
    }
    if (is_usable(ball) && !holds(ball, truth)) ++missed;
  }
  return missed;
}

TEST(BallArithmetic, SumsOfProductsContainTheirValues) {
  EXPECT_EQ(convolution_misses(false, 1), 0);
  EXPECT_EQ(convolution_misses(true, 1), 0);
  // Rounding errors add up like a random walk: a hundredth of the bound is too little.
  EXPECT_GT(convolution_misses(false, 0.01), 10);
  EXPECT_GT(convolution_misses(true, 0.01), 10);
}

TEST(BallArithmetic, RefusesWhatHasNoValueInAllOfTheBall) {
  const MidRad wide(0.5, 1), unknown(std::nan(""), 1), infinite(INFINITY, 0);
  EXPECT_THROW(MidRad(1.) / wide, std::domain_error);
  EXPECT_THROW(MidRad(1.) / unknown, std::domain_error);
  EXPECT_THROW(MidRad(1.) / infinite, std::domain_error);
  for (const MidRad& ball : {wide, unknown, infinite}) {
    EXPECT_THROW(Double::sqrt(ball), std::domain_error);
    EXPECT_THROW(Double::log(ball), std::domain_error);
    EXPECT_THROW(Double::asin(ball), std::domain_error);
    EXPECT_THROW(Double::acos(ball), std::domain_error);
    EXPECT_THROW(Double::sign(ball), std::domain_error);
    EXPECT_THROW(Double::power(ball, MidRad(0.3)), std::domain_error);
  }
  EXPECT_THROW(Double::function(Op::exp, MidRad(-INFINITY, 0)), std::domain_error);
  EXPECT_THROW(Double::function(Op::tan, MidRad(1.5, 0.2)), std::domain_error);
  EXPECT_THROW(Double::atan2(MidRad(0., 0.1), MidRad(-1, 0.1)), std::domain_error);
  EXPECT_THROW(Double::atan2(MidRad(0., 0.1), MidRad(0, 0.1)), std::domain_error);
  EXPECT_THROW(Double::sign(MidRad(0.)), std::domain_error);
}

TEST(BallArithmetic, ConversionsFromArbGoOutwards) {
  const BallPrecision precision(300);
  RandomBalls random(3);
  for (int i = 0; i < 20000; ++i) {
    const cln::cl_RA exact =
        cln::cl_RA(random.whole(-1000000, 1000000)) / cln::cl_RA(random.whole(1, 1000000));
    const MidRad ball = Double::from(exact);
    const cln::cl_RA middle = cln::rational(cln::cl_DF(ball.mid)),
                     radius = cln::rational(cln::cl_DF(ball.rad));
    ASSERT_LE(cln::abs(exact - middle), radius);
    ASSERT_LE(ball.rad, 0x1p-52 * std::abs(ball.mid));
  }
  EXPECT_TRUE(is_exact(Double::from(cln::cl_RA(3) / 8)));
}

TEST(BallArithmetic, IntersectionsLoseNothing) {
  RandomBalls random(11);
  int empty = 0, smaller = 0;
  for (int i = 0; i < 20000; ++i) {
    const MidRad a = random.ball(4);
    const double shift = random.uniform();
    const MidRad b(a.mid + a.rad * shift * 3, a.rad * (1 + random.uniform()));
    const ArbBall x = random.point(a);
    MidRad both = a;
    const bool met = intersect(both, b);
    if (met && both.rad < a.rad) ++smaller;
    if (!met) ++empty;
    if (!holds(b, x)) continue;
    ASSERT_TRUE(met);
    ASSERT_TRUE(holds(both, x));
  }
  EXPECT_GT(smaller, 1000);
  EXPECT_GT(empty, 1000);
}

}  // namespace
}  // namespace casimir::validated
