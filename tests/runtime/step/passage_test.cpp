#include "runtime/step/passage.hpp"

#include <cln/rational.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/integrate.hpp"
#include "runtime/methods.hpp"
#include "runtime/uncompiled.hpp"
#include "tests/runtime/programs.hpp"

namespace casimir::test {
namespace {

Settings tight(double duration) {
  Settings settings;
  settings.duration = duration;
  settings.rtol = 1e-15;
  settings.atol = 1e-18;
  return settings;
}

Trajectory run_on(const Program& rhs, std::vector<double> start, const Settings& settings) {
  const Module module = uncompiled_module(rhs, {}, std::nullopt, {});
  return integrate(module, *find_method("taylor"), settings, start);
}

const cln::cl_RA kThird = cln::cl_RA(1) / 3, kHalf = cln::cl_RA(1) / 2;

/// x' = f(t)
Program of_time(Op op) {
  Builder lines({"x"});
  lines.output(lines.op(op, lines.time()));
  return lines.program();
}

/// x' = 1 + |x|^(2/3), or |x|^(1/3)
Program cube_root(bool of_square) {
  Builder lines({"x"});
  const int base = of_square ? lines.op(Op::mul, 0, 0) : lines.op(Op::abs, 0);
  const int power = lines.op(Op::pow, base, lines.number(kThird));
  lines.output(of_square ? lines.op(Op::add, lines.number(1), power) : power);
  return lines.program();
}

/// x' = 1 + |x|^(2/3): t = 3 (z - atan z) with z = x^(1/3).
double after(double start, double time) {
  const auto clock = [](double z) { return 3 * (z - std::atan(z)); };
  const double there = clock(std::cbrt(start)) + time;
  double low = -10, high = 10;
  for (int i = 0; i < 100; ++i) (clock((low + high) / 2) < there ? low : high) = (low + high) / 2;
  return low * low * low;
}

TEST(Passage, SeriesBeginBehindARoot) {
  const Trajectory root = run_on(of_time(Op::sqrt), {0}, tight(4));
  ASSERT_EQ(root.status, Status::ok);
  EXPECT_NEAR(root.state[0], 16. / 3, 1e-14);

  Builder lines({"x"});
  lines.output(lines.op(Op::acos, lines.op(Op::sub, lines.number(1), lines.time())));
  const Trajectory arc = run_on(lines.program(), {0}, tight(1.5));
  ASSERT_EQ(arc.status, Status::ok);
  const auto primitive = [](double u) { return u * std::acos(u) - std::sqrt(1 - u * u); };
  EXPECT_NEAR(arc.state[0], primitive(1) - primitive(-0.5), 1e-14);
}

TEST(Passage, RootsOfTheStateArePassedFromTheStartAndOnTheWay) {
  for (const double start : {0., -1., -0.3}) {
    const Trajectory motion = run_on(cube_root(true), {start}, tight(4));
    ASSERT_EQ(motion.status, Status::ok) << start;
    EXPECT_NEAR(motion.state[0] / after(start, 4), 1, 2e-14) << start;
  }
}

TEST(Passage, SamplesWithinItAreOfTheSolution) {
  Settings settings = tight(1);
  settings.sample_every = 1e-5;
  const Trajectory root = run_on(of_time(Op::sqrt), {0}, settings);
  ASSERT_EQ(root.status, Status::ok);
  ASSERT_EQ(root.samples.size(), 100001U);
  for (std::size_t k = 1; k < root.samples.size(); k += 7) {
    const double t = root.sample_times[k];
    EXPECT_NEAR(root.samples[k][0], 2 * t * std::sqrt(t) / 3, 3e-16) << t;
  }
}

TEST(Passage, WhereSolutionsPartThereIsNone) {
  // x' = |x|^(1/3) from 0: x = 0 and x = (2t/3)^(3/2), and what waits before it leaves.
  EXPECT_NE(run_on(cube_root(false), {0}, tight(1)).status, Status::ok);
  // x' = sqrt(1 - x^2) from 1: behind it the root has no value.
  Builder lines({"x"});
  const int one = lines.number(1);
  lines.output(lines.op(Op::sqrt, lines.op(Op::sub, one, lines.op(Op::mul, 0, 0))));
  EXPECT_NE(run_on(lines.program(), {1}, tight(1)).status, Status::ok);
}

TEST(Passage, NeitherPolesNorTheEndOfTheDomainArePassed) {
  Builder pole({"x"});  // x' = x^2 + |x|^(1/2) is beyond all bounds before t = 1
  const int size = pole.op(Op::pow, pole.op(Op::abs, 0), pole.number(kHalf));
  pole.output(pole.op(Op::add, pole.op(Op::mul, 0, 0), size));
  const Trajectory burst = run_on(pole.program(), {1}, tight(2));
  EXPECT_NE(burst.status, Status::ok);
  EXPECT_LT(burst.time, 1);

  Builder end({"x"});  // x' = sqrt(1 - t) has no value after t = 1
  end.output(end.op(Op::sqrt, end.op(Op::sub, end.number(1), end.time())));
  const Trajectory stopped = run_on(end.program(), {0}, tight(2));
  EXPECT_NE(stopped.status, Status::ok);
  EXPECT_NEAR(stopped.time, 1, 1e-3);
}

// x' = -1/|x|^(1/3) is without bound at x = 0, which x reaches at t = 3/4, and only one solution
// goes on: x^4 = (1 - 4t/3)^3 with the other sign.
TEST(Passage, ACuspIsPassedOnTheOnlySolution) {
  Builder cusp({"x"});
  const int root = cusp.op(Op::pow, cusp.op(Op::abs, 0), cusp.number(kThird));
  cusp.output(cusp.op(Op::neg, cusp.op(Op::div, cusp.number(1), root)));
  const Trajectory fallen = run_on(cusp.program(), {1}, tight(2));
  EXPECT_EQ(fallen.status, Status::ok);
  EXPECT_NEAR(fallen.state[0], -std::pow(5. / 3, 0.75), 1e-12);
}

}  // namespace
}  // namespace casimir::test
