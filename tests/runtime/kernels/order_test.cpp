#include <gtest/gtest.h>

#include <array>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <numbers>

#include "tests/runtime/systems.hpp"

namespace casimir::test {
namespace {

// Euler's top with a1 > a2 > a3 and the axis of a2 between: with M2 = s sn(w t), M1 = c cn(w t),
// M3 = d dn(w t) the equations M1' = (a3 - a2) M2 M3, .. give three relations for c, s, d, w, k.
std::vector<double> euler_solution(double t) {
  using boost::math::jacobi_elliptic;
  const double* a = Euler::a;
  const double c = 0.75, d = 1.25;
  const double s = c * std::sqrt((a[0] - a[2]) / (a[1] - a[2]));
  const double w = d * std::sqrt((a[0] - a[2]) * (a[1] - a[2]));
  const double k = std::sqrt((a[0] - a[1]) / (a[1] - a[2])) * c / d;
  double cn, dn;
  const double sn = jacobi_elliptic(k, w * t, &cn, &dn);
  return {c * cn, s * sn, d * dn};
}

double distance(const std::vector<double>& x, const std::vector<double>& y) {
  double size = 0;
  for (std::size_t i = 0; i < x.size(); ++i) size = std::max(size, std::abs(x[i] - y[i]));
  return size;
}

template <class System>
double fixed_step_error(const std::string& method, double step, double duration,
                        const std::vector<double>& initial, const std::vector<double>& truth) {
  Settings settings;
  settings.duration = duration;
  settings.fixed_step = step;
  const Trajectory orbit = run<System>(method, settings, initial);
  EXPECT_EQ(orbit.status, Status::ok) << orbit.reason;
  EXPECT_EQ(orbit.time, duration);
  return distance(orbit.state, truth);
}

/// Steps whose errors lie well between rounding and the size of the solution.
double coarse_step(int order) {
  return order == 2   ? 0.02
         : order == 4 ? 0.1
         : order == 5 ? 0.2
         : order == 6 ? 0.3
         : order < 10 ? 0.5
                      : 2;
}

class Order : public testing::TestWithParam<std::string> {
 protected:
  const Method& method_ = *find_method(GetParam());
  double step_ = coarse_step(method_.order);

  /// log2 of the error ratio of two steps, and the stated order must agree.
  void expect_order(double coarse, double fine) {
    EXPECT_GT(fine, 1e-15) << "rounding hides the order";
    const double observed = std::log2(coarse / fine);
    // Steps of the highest orders are long before they leave rounding, hence far from the limit.
    EXPECT_NEAR(observed, method_.order, method_.order > 12 ? 3 : method_.order > 8 ? 1.5 : 0.6);
  }
};

TEST_P(Order, EulerTopAgainstEllipticFunctions) {
  const auto error = [&](double h) {
    return fixed_step_error<Euler>(GetParam(), h, 8, euler_solution(0), euler_solution(8));
  };
  const double step = method_.order > 12 ? 4 : step_;
  expect_order(error(step), error(step / 2));
}

TEST_P(Order, TimeDependentRightHandSide) {
  const auto error = [&](double h) {
    return fixed_step_error<Forced>(GetParam(), h, 4, {1}, {std::exp(std::sin(4.))});
  };
  expect_order(error(step_), error(step_ / 2));
}

TEST_P(Order, BackwardInTime) {
  const double forward =
      fixed_step_error<Euler>(GetParam(), step_, 4, euler_solution(0), euler_solution(4));
  const double backward =
      fixed_step_error<Euler>(GetParam(), step_, -4, euler_solution(0), euler_solution(-4));
  EXPECT_LT(backward, 3 * forward);
  EXPECT_GT(backward, forward / 3);
}

TEST_P(Order, ToleranceIsProportionalToError) {
  for (const double tolerance : {1e-5, 1e-8, 1e-11}) {
    if (method_.order == 2 && tolerance < 1e-8) continue;  // a hundred million evaluations
    Settings settings;
    settings.duration = 20;
    settings.rtol = settings.atol = tolerance;
    const Trajectory orbit = run<Euler>(GetParam(), settings, euler_solution(0));
    ASSERT_EQ(orbit.status, Status::ok);
    EXPECT_LT(distance(orbit.state, euler_solution(20)), 30 * tolerance) << tolerance;
    EXPECT_EQ(orbit.time, 20);
  }
}

// The dense output of dop853 has order 7 and that of dopri5 order 4; implicit methods take a
// shorter step of their own order.
TEST_P(Order, DenseOutput) {
  const int order = GetParam() == "dop853" ? 7 : GetParam() == "dopri5" ? 4 : method_.order;
  const auto worst = [&](double h) {
    Settings settings;
    settings.duration = 4;
    settings.fixed_step = h;
    settings.sample_every = h / 7;
    const Trajectory orbit = run<Forced>(GetParam(), settings, {1});
    EXPECT_EQ(orbit.status, Status::ok);
    double error = 0;
    for (std::size_t i = 0; i < orbit.samples.size(); ++i)
      error = std::max(error,
                       std::abs(orbit.samples[i][0] - std::exp(std::sin(orbit.sample_times[i]))));
    return error;
  };
  const double observed = std::log2(worst(step_) / worst(step_ / 2));
  EXPECT_GT(observed, order - (order > 12 ? 4 : order > 8 ? 1.5 : 0.7));
  EXPECT_LT(observed, order + 1.5);
}

INSTANTIATE_TEST_SUITE_P(Runtime, Order, testing::ValuesIn(own_methods()),
                         [](const auto& one) { return test_name(one.param); });

// Two programs of one tableau take the same steps to rounding.
TEST(Dopri5, IsThatOfBoost) {
  constexpr double kStep = 0.1;
  constexpr int kSteps = 200;
  using Place = std::array<double, 3>;
  const std::vector<double> start = euler_solution(0);
  Place x{start[0], start[1], start[2]};
  boost::numeric::odeint::runge_kutta_dopri5<Place> stepper;
  const auto rhs = [](const Place& y, Place& dy, double t) {
    Euler::rhs(t, y.data(), nullptr, dy.data());
  };
  for (int i = 0; i < kSteps; ++i) stepper.do_step(rhs, x, i * kStep, kStep);
  const auto at_end = [&](const char* method) {
    Settings settings;
    settings.duration = kSteps * kStep;
    settings.fixed_step = kStep;
    return distance(run<Euler>(method, settings, start).state, {x[0], x[1], x[2]});
  };
  EXPECT_LT(at_end("dopri5"), 1e-13);
  EXPECT_GT(at_end("dop853"), 1e-10);  // the twin: another method
}

// x1 = x0 + h f((x0 + x1)/2) on the oscillator is a rotation by 2 atan(h/2), whatever the step.
TEST(Midpoint, TurnsTheOscillatorByAKnownAngle) {
  for (const double h : {0.01, 0.1, 0.5}) {
    Settings settings;
    settings.duration = 100 * h;
    settings.fixed_step = h;
    const Trajectory orbit = run<Oscillator>("midpoint", settings, {1, 0});
    ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
    const double angle = 100 * 2 * std::atan(h / 2);
    EXPECT_NEAR(orbit.state[0], std::cos(angle), 1e-13) << h;
    EXPECT_NEAR(orbit.state[1], -std::sin(angle), 1e-13) << h;
  }
}

// An outside library, by its own step control, must come to the same state.
class Outside : public testing::TestWithParam<const char*> {};
TEST_P(Outside, AgreesWithTheClosedForm) {
  Settings settings;
  settings.duration = 20;
  settings.rtol = settings.atol = 1e-10;
  settings.sample_every = 3;
  const Trajectory orbit = run<Euler>(GetParam(), settings, euler_solution(0));
  ASSERT_EQ(orbit.status, Status::ok);
  EXPECT_EQ(orbit.time, 20);
  EXPECT_LT(distance(orbit.state, euler_solution(20)), 1e-6);
  EXPECT_GT(distance(orbit.state, euler_solution(20.001)), 1e-5);  // the twin: another time
  ASSERT_EQ(orbit.samples.size(), 8u);                             // 0, 3, .., 18 and the end
  for (std::size_t i = 0; i < orbit.samples.size(); ++i)
    EXPECT_LT(distance(orbit.samples[i], euler_solution(orbit.sample_times[i])), 1e-6);
  settings.duration = -5;
  EXPECT_LT(distance(run<Euler>(GetParam(), settings, euler_solution(0)).state, euler_solution(-5)),
            1e-6);
}
INSTANTIATE_TEST_SUITE_P(Runtime, Outside,
                         testing::Values("cvode-adams", "cvode-bdf", "arkode-erk"),
                         [](const auto& one) { return test_name(one.param); });

}  // namespace
}  // namespace casimir::test
