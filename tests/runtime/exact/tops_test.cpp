// Gyrostats and tops in closed form, against runs with many digits: every kind of curve, the places
// where it degenerates, and what is refused.
#include <gtest/gtest.h>

#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "tests/runtime/exact/forms.hpp"

namespace casimir::test {
namespace {

constexpr double kClose = 3e-16;
const Rational half = Rational(1) / 2, one_third = Rational(1) / 3, tenth = Rational(1) / 10;

/// x' = x * (A x + k), A as its elements 11, 22, 33, 12, 13, 23.
Program gyrostat(const Start& A, const Start& k) {
  Builder b({"x", "y", "z"});
  const auto at = [&](int i, int j) {
    return i == j ? A[static_cast<std::size_t>(i)] : A[static_cast<std::size_t>(i + j + 2)];
  };
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    std::vector<Monomial> rate{{k[static_cast<std::size_t>(l)], j},
                               {-k[static_cast<std::size_t>(j)], l}};
    for (int n = 0; n < 3; ++n) {
      rate.push_back({at(l, n), j, n});
      rate.push_back({-at(j, n), l, n});
    }
    add_rate(b, rate);
  }
  return b.program();
}

struct Top {
  Rational a1, a3, k, r;
};
/// Lagrange's top with a rotor: H = (a1 (x^2 + y^2) + a3 z^2)/2 + k z + r w.
Program top(const Top& of) {
  Builder b({"x", "y", "z", "u", "v", "w"});
  const Rational d = of.a3 - of.a1;
  add_rate(b, {{d, 1, 2}, {of.k, 1}, {of.r, 4}});
  add_rate(b, {{-d, 0, 2}, {-of.k, 0}, {-of.r, 3}});
  add_rate(b, {});
  add_rate(b, {{of.a3, 2, 4}, {of.k, 4}, {-of.a1, 5, 1}});
  add_rate(b, {{of.a1, 5, 0}, {-of.a3, 2, 3}, {-of.k, 3}});
  add_rate(b, {{of.a1, 3, 1}, {-of.a1, 4, 0}});
  return b.program();
}

TEST(ClosedGyrostat, OfThreeMoments) {
  const Start k{tenth, Rational(1) / 5, one_third};
  for (const Start& A : {Start{1, half, one_third, 0, 0, 0}, Start{-1, half, 3, 0, 0, 0},
                         Start{1, half, one_third, Rational(1) / 7, -one_third, tenth}})
    for (const Start& x : {Start{1, half, one_third}, Start{-one_third, 2, 0}, Start{0, 0, -1}})
      for (const Rational& t : {Rational(1) / 1000, Rational(-20) / 3})
        EXPECT_LT(error(gyrostat(A, k), x, t), kClose) << A[0] << ' ' << x[0] << ' ' << t;
}

TEST(ClosedGyrostat, OfEqualMoments) {
  const Start x{1, half, one_third};
  for (const Start& A : {Start{1, 1, one_third, 0, 0, 0}, Start{2, one_third, 2, 0, 0, 0},
                         Start{1, 1, 1, 0, 0, 0}, Start{0, 0, 0, 0, 0, 0}})
    for (const Start& k :
         {Start{tenth, Rational(1) / 5, one_third}, Start{0, 0, one_third}, Start{1, 0, 0}})
      EXPECT_LT(error(gyrostat(A, k), x, 10), kClose) << A[0] << ' ' << k[0];
  // Almost equal: the poles go far away.
  const Rational near = 1 + 1 / cln::expt(Rational(10), 12);
  EXPECT_LT(error(gyrostat({1, near, one_third, 0, 0, 0}, {tenth, 0, one_third}), x, 40), kClose);
}

TEST(ClosedGyrostat, OnOneAxisAndWithoutARotor) {
  const Start x{1, half, one_third};
  const Start A{1, half, one_third, 0, 0, 0};
  for (const Start& k : {Start{0, 0, 3}, Start{0, half, 0}, Start{Rational(-1) / 5, 0, 0}})
    EXPECT_LT(error(gyrostat(A, k), x, 10), kClose) << k[0];
  // Turned axes of the free body.
  EXPECT_LT(error(gyrostat({1, half, one_third, tenth, 0, 0}, {0, 0, 0}), x, 30), kClose);
  EXPECT_LT(error(gyrostat(A, {0, 0, 1000}), x, 2), kClose);
}

// Rotation about the middle axis with a rotor too weak to steady it.
TEST(ClosedGyrostat, NextToASeparatrix) {
  const Start A{1, half, one_third, 0, 0, 0}, k{0, Rational(1) / 20, 0};
  for (const int digits : {3, 6, 12, 25}) {
    const Rational tiny = 1 / cln::expt(Rational(10), digits);
    EXPECT_LT(error(gyrostat(A, k), {tiny, 1, tiny}, 100), kClose) << digits;
    EXPECT_LT(error(gyrostat(A, k), {tiny, 1, 0}, -100), kClose) << digits;
  }
}

TEST(ClosedGyrostat, OnASeparatrix) {
  // Of the energy of (0, 1, 0), which is unstable: x^2 - z^2 = 2 c (1 - y) on the unit sphere.
  bool seen = false;
  for (int n = 1; n < 60 && !seen; ++n)
    for (int m = 1; m < n && !seen; ++m) {
      const Rational x = Rational(n) / 60, z = Rational(m) / 60;
      cln::cl_RA y;
      if (!cln::sqrtp(1 - x * x - z * z, &y) || y == 0) continue;
      const Rational c = (x * x - z * z) / (2 * (1 - y));
      if (cln::abs(c) >= 1) continue;
      seen = true;
      const Program program = gyrostat({1, 0, -1, 0, 0, 0}, {0, c, 0});
      const Recognised found = closed_form(program, exact({x, y, z}));
      ASSERT_TRUE(found.form) << found.reason;
      EXPECT_TRUE(std::isfinite(found.form->horizon()));
      for (const int t : {1, 8, -15}) EXPECT_LT(error(program, {x, y, z}, t), kClose) << t;
    }
  EXPECT_TRUE(seen);
}

TEST(ClosedGyrostat, StaysWhereItRests) {
  EXPECT_EQ(error(gyrostat({1, half, one_third, 0, 0, 0}, {0, 1, 0}), {0, 5, 0}, 1000), 0);
}

TEST(ClosedTop, OfEveryKind) {
  const Top common{1, half, 0, 1};
  for (const Top& of : {common, Top{1, Rational(3) / 4, one_third, 1}, Top{2, 5, -1, -one_third},
                        Top{-1, half, tenth, 1}})
    for (const Start& x : {Start{half, one_third, 2, Rational(3) / 5, 0, Rational(4) / 5},
                           Start{1, half, Rational(1) / 4, Rational(3) / 5, 0, Rational(4) / 5},
                           Start{-1, 2, -half, 0, Rational(3) / 5, Rational(-4) / 5},
                           Start{half, one_third, 2, 1, 2, 3}})  // a direction of another length
      for (const Rational& t : {Rational(1) / 1000, Rational(-10) / 3})
        EXPECT_LT(error(top(of), x, t), kClose) << of.a1 << ' ' << x[0] << ' ' << t;
}

TEST(ClosedTop, WithoutWeight) {
  const Start x{half, one_third, 2, Rational(3) / 5, 0, Rational(4) / 5};
  EXPECT_LT(error(top({1, half, one_third, 0}), x, 30), kClose);
  EXPECT_LT(error(top({1, 1, 0, 0}), x, 30), kClose);
  EXPECT_LT(error(top({1, half, 0, 0}), {0, 0, 2, half, half, half}, 30), kClose);
  EXPECT_LT(error(top({1, half, 0, 0}), {half, one_third, 0, half, half, half}, 30), kClose);
}

// M = 0 at the start, a plane pendulum to and fro and around, no momentum along the vertical or
// along the axis: the places where a modulus or a phase is special.
TEST(ClosedTop, FromSpecialStarts) {
  const Top of{1, half, 0, 1};
  const Rational g1 = Rational(3) / 5, g3 = Rational(4) / 5;
  for (const Start& x :
       {Start{0, 0, 0, g1, 0, g3}, Start{0, 0, 1, g1, 0, g3}, Start{0, half, 0, g1, 0, g3},
        Start{0, 3, 0, g1, 0, g3}, Start{g3, 0, -g1, g1, 0, g3}, Start{1, 0, 0, g1, 0, g3},
        Start{half, one_third, 1, 0, 0, 0}, Start{0, one_third, 1, 0, 0, 1},
        Start{0, one_third, 1, 0, 0, -1}, Start{0, one_third, 0, 0, 0, -1}})
    EXPECT_LT(error(top(of), x, 5), kClose) << x[0] << ' ' << x[1];
  // Where M vanishes on the way.
  EXPECT_LT(error(top(of), {0, 0, 3, g1, 0, g3}, 12), kClose);
}

TEST(ClosedTop, SteadyPrecession) {
  const Start x{0, Rational(2) / 5, Rational(23) / 10, 0, Rational(4) / 5, Rational(3) / 5};
  EXPECT_LT(error(top({1, half, 0, 1}), x, 100), kClose);
  Start near = x;
  near[1] = near[1] + 1 / cln::expt(Rational(10), 20);
  EXPECT_LT(error(top({1, half, 0, 1}), near, 100), kClose);
}

TEST(ClosedTop, Sleeping) {
  const Top of{1, half, 0, 1};
  for (const int spin : {1, 2, 3}) {  // falls, just stays, stays
    EXPECT_EQ(error(top(of), {0, 0, spin, 0, 0, 1}, 1000), 0) << spin;
    for (const int digits : {6, 12, 25}) {
      const Rational tiny = 1 / cln::expt(Rational(10), digits);
      EXPECT_LT(error(top(of), {tiny, 0, spin, 0, 0, 1}, 60), kClose) << spin << ' ' << digits;
    }
  }
}

// It comes up to the vertical in infinite time: with M = (x, y, s) and g = (u, 0, w), the two
// integrals of the upright position are x u + s w = s and x^2 + y^2 = 2 (1 - w).
TEST(ClosedTop, OnItsSeparatrix) {
  const auto of = [](int part) { return Rational(part) / 25; };
  const Program program = top({1, half, 0, 1});
  for (const int way : {24, -24}) {
    const Start at{of(18), of(way), of(24), of(24), 0, of(7)};
    const Recognised found = closed_form(program, exact(at));
    ASSERT_TRUE(found.form) << found.reason;
    EXPECT_TRUE(std::isfinite(found.form->horizon()));
    for (const int t : {1, 8, -12}) EXPECT_LT(error(program, at, t), kClose) << t;
  }
}

// The pendulum on a sphere in the space frame has the same equations with the other sign; axis and
// order of the states play no part.
TEST(ClosedTop, SphericalPendulumsAndOtherOrders) {
  const Rational m = 1, w = 1;
  Builder b({"N1", "N2", "N3", "e1", "e2", "e3"});
  add_rate(b, {{-w, 4}});
  add_rate(b, {{w, 3}});
  add_rate(b, {});
  add_rate(b, {{1 / m, 1, 5}, {-1 / m, 2, 4}});
  add_rate(b, {{1 / m, 2, 3}, {-1 / m, 0, 5}});
  add_rate(b, {{1 / m, 0, 4}, {-1 / m, 1, 3}});
  const Rational e1 = Rational(3) / 5, e3 = Rational(4) / 5;
  for (const Start& x : {Start{e3, half, -e1, e1, 0, e3}, Start{0, 0, 0, e1, 0, e3},
                         Start{half, 1, 1, Rational(2) / 7, Rational(3) / 7, Rational(6) / 7},
                         Start{0, half, 0, e1, 0, e3}})  // zero vertical component of the momentum
    EXPECT_LT(error(b.program(), x, 50), kClose) << x[0];
  // Lagrange's top with the direction first and the axis in the middle.
  Builder turned({"w1", "w2", "w3", "m1", "m2", "m3"});
  const int g3 = 1, g1 = 2, g2 = 0, M3 = 4, M1 = 5, M2 = 3;
  std::vector<std::vector<Monomial>> field(6);
  field[M1] = {{-half, M2, M3}, {1, g2}};
  field[M2] = {{half, M1, M3}, {-1, g1}};
  field[g1] = {{half, M3, g2}, {-1, g3, M2}};
  field[g2] = {{1, g3, M1}, {-half, M3, g1}};
  field[g3] = {{1, g1, M2}, {-1, g2, M1}};
  for (const auto& rate : field) add_rate(turned, rate);
  EXPECT_LT(error(turned.program(), {0, e3, e1, one_third, 2, half}, 50), kClose);
}

// What is zero along a motion stays so, and is no small number.
TEST(ClosedTop, StaysInItsPlane) {
  const Program program = top({1, half, 0, 1});
  for (const Rational& speed : {Rational(1) / 1000000, half, Rational(2), Rational(3)})
    for (const Start& x :
         {Start{0, speed, 0, 0, 0, 1}, Start{0, speed, 0, Rational(3) / 5, 0, Rational(4) / 5}}) {
      if (speed == 2 && x[5] == 1) continue;  // its separatrix has the horizon that it has
      const std::vector<double> state = closed_state(program, x, 30);
      EXPECT_EQ(state[0], 0);
      EXPECT_EQ(state[2], 0);
      EXPECT_EQ(state[4], 0);
    }
}

// Whole turns are taken off with many digits: what a period is wrong by would show a million times.
// The height of the top with Boost's functions of a hundred digits, where it is u1 + (u2 - u1) sn^2
// between the two lower roots of (1 - u^2)(E - 2 u) - (c - l u)^2.
TEST(ClosedTop, AMillionPeriods) {
  using Big = boost::multiprecision::cpp_bin_float_100;
  const Program program = top({1, half, 0, 1});
  const Recognised found =
      closed_form(program, exact({half, one_third, 2, Rational(3) / 5, 0, Rational(4) / 5}));
  ASSERT_TRUE(found.form);
  const Big l = 2, E = Big(1) / 4 + Big(1) / 9 + Big(8) / 5, c = Big(3) / 10 + Big(8) / 5;
  // 2 u^3 - (E + l^2) u^2 + (2 c l - 2) u + E - c^2, by Viete's cosines.
  const Big b = -(E + l * l) / 2, p = c * l - 1, d = (E - c * c) / 2;
  const Big P = b * b / 9 - p / 3, Q = b * p / 6 - b * b * b / 27 - d / 2;
  const Big third_of_turn = boost::math::constants::two_pi<Big>() / 3;
  const Big angle = acos(Q / sqrt(P * P * P)) / 3;
  std::array<Big, 3> u;
  for (int i = 0; i < 3; ++i)
    u[static_cast<std::size_t>(i)] = 2 * sqrt(P) * cos(angle + i * third_of_turn) - b / 3;
  std::sort(u.begin(), u.end());
  const Big k = sqrt((u[1] - u[0]) / (u[2] - u[0])), rate = sqrt((u[2] - u[0]) / 2);
  const Big u0 = Big(4) / 5, sine = sqrt((u0 - u[0]) / (u[1] - u[0]));
  // It rises at first if g1 M2 - g2 M1 > 0, which it is.
  const Big start = boost::math::ellint_1(k, asin(sine)), period = 2 * boost::math::ellint_1(k);
  for (const double t : {1., 1e3, 6e6 + 1. / 3}) {
    double x[6];
    found.form->at({t, 0}, x);
    const Big sn = boost::math::jacobi_sn(k, Big(fmod(rate * Big(t) + start, 2 * period)));
    EXPECT_NEAR(x[5], static_cast<double>(u[0] + (u[1] - u[0]) * sn * sn), 2e-16) << t;
  }
  EXPECT_GT(6e6, 1e6 * found.form->period());
}

// The precession, and the states of a gyrostat, after a hundred periods and more.
TEST(ClosedTop, ManyPeriodsAgainstManyDigits) {
  EXPECT_LT(
      error(top({1, half, 0, 1}), {half, one_third, 2, Rational(3) / 5, 0, Rational(4) / 5}, 400),
      kClose);
  EXPECT_LT(error(gyrostat({1, half, one_third, 0, 0, 0}, {tenth, Rational(1) / 5, one_third}),
                  {1, half, one_third}, 1500),
            kClose);
}

// Each hypothesis left out: a moment that is not equal, weight off the axis, another sign, a matrix
// that is not symmetric, a constant term.
TEST(ClosedTop, RefusesAllElse) {
  const auto refused = [](const Builder& b, const Start& start) {
    const Recognised found = closed_form(b.program(), exact(start));
    EXPECT_NE(found.form != nullptr, !found.reason.empty());
    return found.form == nullptr;
  };
  const auto bent = [&](int rate, const Monomial& term) {
    Builder b({"x", "y", "z", "u", "v", "w"});
    std::vector<std::vector<Monomial>> field{
        {{-half, 1, 2}, {1, 4}},    {{half, 0, 2}, {-1, 3}},    {},
        {{half, 2, 4}, {-1, 5, 1}}, {{1, 5, 0}, {-half, 2, 3}}, {{1, 3, 1}, {-1, 4, 0}}};
    if (rate >= 0) field[static_cast<std::size_t>(rate)].push_back(term);
    for (const auto& terms : field) add_rate(b, terms);
    return refused(b, {half, one_third, 2, 1, 0, 2});
  };
  EXPECT_FALSE(bent(-1, {0, 0}));
  EXPECT_TRUE(bent(0, {tenth, 1, 2}));
  EXPECT_TRUE(bent(0, {tenth, 5}));
  EXPECT_TRUE(bent(1, {tenth, 3}));
  EXPECT_TRUE(bent(2, {tenth, 3}));
  EXPECT_TRUE(bent(3, {tenth, 5, 1}));
  EXPECT_TRUE(bent(4, {1 / cln::expt(Rational(10), 200), 2, 3}));
  EXPECT_TRUE(bent(5, {tenth, 5, 5}));
  const auto skew = [&](int rate, const Monomial& term) {
    Builder b({"x", "y", "z"});
    std::vector<std::vector<Monomial>> field{
        {{-half, 1, 2}, {1, 1}}, {{1, 2, 0}, {-1, 0}}, {{-half, 0, 1}}};
    if (rate >= 0) field[static_cast<std::size_t>(rate)].push_back(term);
    for (const auto& terms : field) add_rate(b, terms);
    return refused(b, {half, one_third, 2});
  };
  EXPECT_FALSE(skew(-1, {0, 0}));
  EXPECT_TRUE(skew(0, {tenth, 1, 2}));
  EXPECT_TRUE(skew(0, {tenth, 1}));
  EXPECT_TRUE(skew(1, {tenth, 1, 1}));
  EXPECT_TRUE(skew(2, {tenth, 2}));
}

}  // namespace
}  // namespace casimir::test
