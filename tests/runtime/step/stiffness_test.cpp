#include "runtime/step/stiffness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/runtime/systems.hpp"

namespace casimir::test {
namespace {

template <class System>
Module plain(int parameters = 0, bool with_jacobian = true) {
  ModuleFunctions functions = module_of<System>(nullptr, parameters).functions();
  if (!with_jacobian) functions.jacobian = nullptr;
  return Module::from_functions(functions);
}

/// x' = -p x: nothing but a transient.
struct Decay {
  static constexpr int n = 1;
  static void rhs(double, const double* x, const double* p, double* d) { d[0] = -p[0] * x[0]; }
};

/// A spiral with the eigenvalues -a +- i b, beside a slow circle of rate 1.
struct Spiral {
  static constexpr int n = 4;
  static void rhs(double, const double* x, const double* p, double* d) {
    d[0] = -p[0] * x[0] - p[1] * x[1];
    d[1] = p[1] * x[0] - p[0] * x[1];
    d[2] = x[3];
    d[3] = -x[2];
  }
};

TEST(Stiffness, RatesAgainstTheClosedForm) {
  const double p[2] = {1e4, 300};
  for (const bool given : {true, false}) {
    const auto rates = rates_at(plain<Stiff>(1, given), 0.5, {std::cos(0.5)}, p);
    ASSERT_TRUE(rates);
    EXPECT_NEAR(rates->decay / 1e4, 1, 1e-6);
    EXPECT_EQ(rates->solution, 0);
  }
  const auto spiral = rates_at(plain<Spiral>(2), 0, {0, 0, 0.6, 0.8}, p);
  ASSERT_TRUE(spiral);
  EXPECT_NEAR(spiral->decay / 1e4, 1, 1e-6);
  EXPECT_NEAR(spiral->solution, 1, 1e-12);
  const auto top = rates_at(plain<Euler>(), 0, {0, 0, 1e-200}, nullptr);
  ASSERT_TRUE(top);
  EXPECT_LT(top->decay, 1e-200);
}

TEST(Stiffness, FastDecayBehindTheTransientIsStiff) {
  const double p[1] = {1e5};
  EXPECT_TRUE(is_stiff(plain<Stiff>(1), 1, {std::cos(1.)}, p, 10));
  EXPECT_TRUE(is_stiff(plain<Stiff>(1, false), 1, {std::cos(1.)}, p, 10));
  EXPECT_TRUE(is_stiff(plain<Stiff>(1), 1, {std::cos(1.)}, p, -10));
  // Twins: in the transient, over a short time, and where the decay is no faster than the motion.
  EXPECT_FALSE(is_stiff(plain<Stiff>(1), 1, {2}, p, 10));
  EXPECT_FALSE(is_stiff(plain<Stiff>(1), 1, {std::cos(1.)}, p, 1e-3));
  EXPECT_FALSE(is_stiff(plain<Decay>(1), 0, {1}, p, 10));
}

TEST(Stiffness, MotionWithoutDecayIsNotStiff) {
  EXPECT_FALSE(is_stiff(plain<Oscillator>(), 0, {1, 0}, nullptr, 1e6));
  EXPECT_FALSE(is_stiff(plain<Kovalevskaya>(), 0, Kovalevskaya::initial(), nullptr, 1e6));
  EXPECT_FALSE(is_stiff(plain<Square>(), 0, {1}, nullptr, 1e6));
}

TEST(Stiffness, StepsOfTheSizeOfTheDecayTimeAreHeldUpByIt) {
  const double p[1] = {1e6};
  const auto text = stiffness_at(plain<Stiff>(1), 1, {std::cos(1.)}, p, 4e-6);
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("stiff"), std::string::npos);
  EXPECT_NE(text->find("1.0e+06"), std::string::npos) << *text;
  EXPECT_NE(text->find("radau9"), std::string::npos);
  // Twins: far shorter steps have another reason, and so has a solution that itself is fast.
  EXPECT_FALSE(stiffness_at(plain<Stiff>(1), 1, {std::cos(1.)}, p, 1e-9));
  EXPECT_FALSE(stiffness_at(plain<Decay>(1), 1, {1}, p, 4e-6));
  EXPECT_FALSE(stiffness_at(plain<Oscillator>(), 1, {1, 0}, nullptr, 1));
}

TEST(Stiffness, WhatIsNotANumberIsNotJudged) {
  EXPECT_FALSE(rates_at(plain<Root>(), 0, {0}, nullptr));
  EXPECT_FALSE(rates_at(plain<Edge>(), 0, {-1}, nullptr));
  EXPECT_FALSE(rates_at(plain<Oscillator>(), 0, {NAN, 0}, nullptr));
  EXPECT_TRUE(rates_at(plain<Oscillator>(), 0, {0, 0}, nullptr));
}

// An explicit method that does not get through says why; one that does not for another reason
// keeps silent about it.
TEST(Stiffness, ExplicitMethodsNameIt) {
  Settings settings;
  settings.duration = 10;
  settings.max_steps = 5000;
  for (const char* method : {"dop853", "cvode-adams", "arkode-erk"}) {
    const Trajectory stiff = run<Stiff>(method, settings, {1}, {1e7});
    EXPECT_EQ(stiff.status, Status::max_steps) << method;
    EXPECT_NE(stiff.reason.find("stiff"), std::string::npos) << method << ": " << stiff.reason;
    EXPECT_NE(stiff.reason.find("radau9"), std::string::npos) << method;
  }
  settings.duration = 1e6;
  const Trajectory smooth = run<Oscillator>("dop853", settings, {1, 0});
  EXPECT_EQ(smooth.status, Status::max_steps);
  EXPECT_EQ(smooth.reason.find("stiff"), std::string::npos) << smooth.reason;
}

}  // namespace
}  // namespace casimir::test
