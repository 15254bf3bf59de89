#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <new>

#include "tests/runtime/systems.hpp"

// Counts what is taken from the heap, to see that a step takes nothing.
namespace {
unsigned long long allocations = 0;
}
void* operator new(std::size_t size) {
  ++allocations;
  if (void* place = std::malloc(size)) return place;
  throw std::bad_alloc();
}
// Inlined, they would make the compiler warn of `free` on what `new` returned.
[[gnu::noinline]] void operator delete(void* place) noexcept { std::free(place); }
[[gnu::noinline]] void operator delete(void* place, std::size_t) noexcept { std::free(place); }

namespace casimir::test {
namespace {

Trajectory kovalevskaya(const std::string& method, double duration, double step,
                        double tolerance = 1e-10) {
  Settings settings;
  settings.duration = duration;
  settings.fixed_step = step;
  settings.rtol = settings.atol = tolerance;
  return run<Kovalevskaya>(method, settings, Kovalevskaya::initial(), {}, 4);
}

// Along 1e5 steps the quadratic invariants H, F1, F2 stay at rounding level, whatever the error of
// the step itself; K, of degree four, need not.
TEST(Invariants, GaussKeepsQuadraticOnesToRounding) {
  for (const char* method : {"gauss4", "gauss8"}) {
    const Trajectory orbit = kovalevskaya(method, 2e4, 0.2);
    ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
    EXPECT_EQ(orbit.steps, 100000u);
    for (const std::size_t k : {1u, 2u}) EXPECT_LT(orbit.invariants[k].drift, 3e-14) << method << k;
    EXPECT_LT(orbit.invariants[0].drift * orbit.invariants[0].initial, 3e-14) << method;
  }
  // The twin: K shows the error of the method of low order ..
  EXPECT_GT(kovalevskaya("gauss4", 200, 0.2).invariants[3].drift, 1e-6);
  // .. and an explicit method of the same step drifts in the quadratic ones too.
  const Trajectory orbit = kovalevskaya("dop853", 2e4, 0.2);
  ASSERT_EQ(orbit.status, Status::ok);
  EXPECT_GT(orbit.invariants[1].drift, 1e-9);
}

// The drift does not grow like a straight line: ten times the time gives far less than ten times
// the drift (a random walk gives 3.2 on average).
TEST(Invariants, RoundingIsUnbiased) {
  const double one = kovalevskaya("gauss8", 2e3, 0.1).invariants[1].drift;
  const double ten = kovalevskaya("gauss8", 2e4, 0.1).invariants[1].drift;
  EXPECT_LT(ten, 8 * one);
  EXPECT_LT(ten, 3e-14);
}

TEST(Invariants, DriftIsMeasuredAgainstTheSizeOfTheTerms) {
  Settings settings;
  settings.duration = 50;
  settings.rtol = settings.atol = 1e-6;
  const Trajectory plain = run<Kovalevskaya>("dop853", settings, Kovalevskaya::initial(), {}, 4);
  settings.invariant_terms = [](double t, const double* x, long double* values,
                                long double* sizes) {
    double invariants[4];
    Kovalevskaya::invariants(t, x, nullptr, invariants);
    std::copy_n(invariants, 4, values);
    std::fill_n(sizes, 4, 100);
  };
  const Trajectory scaled = run<Kovalevskaya>("dop853", settings, Kovalevskaya::initial(), {}, 4);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(scaled.invariants[k].drift * 100,
                plain.invariants[k].drift * static_cast<double>(plain.invariants[k].initial),
                1e-6 * plain.invariants[k].drift);
  // The record is what the state says.
  double values[4];
  Kovalevskaya::invariants(0, plain.state.data(), nullptr, values);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(plain.invariants[k].final, values[k]);
    EXPECT_GE(plain.invariants[k].drift * std::abs(plain.invariants[k].initial),
              std::abs(values[k] - plain.invariants[k].initial) * (1 - 1e-12));
  }
  const Trajectory outside =
      run<Kovalevskaya>("cvode-adams", settings, Kovalevskaya::initial(), {}, 4);
  EXPECT_GT(outside.invariants[1].drift, 0);
}

TEST(Allocation, AStepTakesNothingFromTheHeap) {
  for (const std::string& method : own_methods()) {
    const auto spent = [&](double duration) {
      const unsigned long long before = allocations;
      const Trajectory orbit = kovalevskaya(method, duration, 0);
      EXPECT_EQ(orbit.status, Status::ok);
      return allocations - before;
    };
    spent(1);
    EXPECT_EQ(spent(50), spent(1)) << method;
  }
  // The twin: samples do take memory, and are seen to.
  Settings settings;
  settings.duration = 10;
  const Trajectory bare = run<Kovalevskaya>("dop853", settings, Kovalevskaya::initial());
  const unsigned long long before = allocations;
  settings.sample_every = 0.01;
  const Trajectory sampled = run<Kovalevskaya>("dop853", settings, Kovalevskaya::initial());
  EXPECT_GT(allocations - before, 900u);
}

}  // namespace
}  // namespace casimir::test
