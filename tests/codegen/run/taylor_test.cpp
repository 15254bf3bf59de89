// The method of Taylor series in its three forms: table-driven, compiled, interpreted.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <new>

#include "runtime/evaluate.hpp"
#include "runtime/program/term_size.hpp"
#include "runtime/undefined_motion.hpp"
#include "tests/bundled_cases.hpp"
#include "tests/codegen/run/ensemble_forms.hpp"
#include "tests/codegen/run/taylor_forms.hpp"

namespace {
unsigned long long allocations = 0;
}

// Not inlined: the compiler would see malloc's memory go to the standard operator.
__attribute__((noinline)) void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
__attribute__((noinline)) void operator delete(void* memory) noexcept { std::free(memory); }
__attribute__((noinline)) void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace casimir {
namespace {

using testing::compiled;
using testing::distance;
using testing::equations;
using testing::forms;
using testing::kKovalevskaya;
using testing::run_taylor;
using testing::settings_for;
using testing::specialised;
using testing::start_of;
using testing::taylor;
using testing::truth;

TEST(EveryCase, OfItsKindAgreesWithTheReferenceAndDop853) {
  constexpr double kDuration = 4;  // short of what magnifies rounding errors
  for (const auto& path : test::kinds_to_go_through()) {
    const Model model = build_model(read_case(path));
    const Specialisation s = specialise(model, model.scene("default"));
    const std::vector<double> from = start_of(s), end = truth(s, from, kDuration);
    const Module other = compiled(s, "dop853");
    const Trajectory yardstick =
        integrate(other, *find_method("dop853"), settings_for(kDuration), from);
    EXPECT_LT(distance(yardstick.state, end), 1e-13) << path;
    for (const auto& [name, module] : forms(s)) {
      const Trajectory orbit = run_taylor(module, settings_for(kDuration), from);
      ASSERT_EQ(orbit.status, Status::ok) << path << name << orbit.reason;
      EXPECT_LT(distance(orbit.state, end), 1e-13) << path << ' ' << name;
      EXPECT_LT(orbit.steps, yardstick.steps);
      // The twin: another time is another state.
      EXPECT_GT(distance(run_taylor(module, settings_for(kDuration * (1 + 1e-9)), from).state, end),
                1e-12);
    }
  }
}

/// Every operation of the expression language, along a solution that is known in closed form.
TEST(Taylor, EveryOperationHasItsRecurrence) {
  const std::vector<std::pair<std::string, std::string>> rates = {
      // x' = f(x) with y the time from 1/2, so that the truth is the reference's
      {"product", "x*y - x*x/3"},
      {"quotient", "y/(1 + x*x) + 1/x"},
      {"root", "sqrt(1 + x*x + y)"},
      {"power", "(1 + x*x)^(1/3) - y^(-3/2)"},
      {"sine", "sin(x*y) + cos(x)"},
      {"tangent", "tan(x/4)*y"},
      {"cotangent", "cot(1 + x)*y"},
      {"hyperbolic sine", "sinh(x - y)/2"},
      {"hyperbolic cosine", "cosh(x*y)/4"},
      {"hyperbolic sines", "cosh(x)/3 - sinh(x)*cosh(y)/5"},
      {"hyperbolic tangent", "tanh(2*x - y) + tanh(x)*sinh(x/3)"},
      {"modulus and sign", "abs(x - 3) - sign(x)*y"},
      {"exponential", "exp(-x*y)"},
      {"logarithm", "log(1 + x + y)"},
      {"arcsine", "asin(x/9) + y"},
      {"arccosine", "acos(x/9) - y/5"},
      {"angle", "atan2(x, y)"},
      {"fixed angle", "atan2(x, 2) + atan2(3, y)"},
      {"sines", "cos(x) + sin(x) + sin(x)*cos(y)"},
      {"negative", "-x - (-y)"},
  };
  for (const auto& [name, rate] : rates) {
    const Specialisation s = specialised(equations({{"x", rate}, {"y", "1"}}));
    const std::vector<double> from = {0.75, 0.5}, end = truth(s, from, 1);
    for (const auto& [form, module] : forms(s)) {
      const Trajectory orbit = run_taylor(module, settings_for(1), from);
      ASSERT_EQ(orbit.status, Status::ok) << name << ' ' << form << ' ' << orbit.reason;
      EXPECT_LT(distance(orbit.state, end), 4e-15) << name << ' ' << form;
    }
  }
}

/// What a recurrence forms besides the terms themselves may leave the range of numbers: y/b where
/// y = a/b, which is a/b^2.
TEST(Taylor, QuotientsAndPowersHoldAtEveryScale) {
  const auto expect_end = [](const std::string& rate, double b, double d, double end) {
    const Specialisation s =
        specialised(equations({{"b", "b"}, {"c", "2*c"}, {"d", "0"}, {"z", rate}}));
    for (const auto& [form, module] : forms(s)) {
      const Trajectory orbit = run_taylor(module, settings_for(1, 1e-13), {b, b, d, 0});
      EXPECT_EQ(orbit.status, Status::ok) << rate << ' ' << form << ' ' << b << orbit.reason;
      EXPECT_NEAR(orbit.state[3], end, 1e-13) << rate << ' ' << form << ' ' << b;
      EXPECT_LT(orbit.steps, 20U) << rate << ' ' << form << ' ' << b;
    }
  };
  for (const double scale : {1e170, 1e158, 1., 1e-155, 1e-170})
    expect_end("(1/b + 1/c)*d", scale, scale, 1.5 - std::exp(-1.) - std::exp(-2.) / 2);
  for (const double scale : {1e90, 1., 1e-90})
    expect_end("b^(-5/3)*d", scale, std::pow(scale, 5. / 3), 0.6 * (1 - std::exp(-5. / 3)));
}

/// A sign that was taken of the bits of a NaN would be a number that nobody sees through.
TEST(Taylor, OfWhatHasNoValueThereIsNoSign) {
  const Specialisation s = specialised(equations({{"x", "1"}, {"y", "sign(log(x))"}}));
  for (const auto& [form, module] : forms(s)) {
    for (const auto& [x, sign] : {std::pair{0.5, -1.}, {2., 1.}, {-0.5, std::nan("")}}) {
      const std::vector<double> state = {x, 0};
      std::vector<double> rates(2);
      module.functions().rhs(0, state.data(), nullptr, rates.data());
      EXPECT_TRUE(std::isnan(sign) ? std::isnan(rates[1]) : rates[1] == sign) << form << ' ' << x;
    }
    EXPECT_NE(run_taylor(module, settings_for(0.25), {-0.5, 0}).status, Status::ok) << form;
  }
}

/// A parabola that comes back to the jump leaves it in between.
TEST(Taylor, TheSignOfZeroIsTakenAllAlongWhereTheMotionStays) {
  const Specialisation s = specialised(equations({{"q", "p"}, {"p", "-sign(q)"}}));
  const auto at = [&](double p, double t) {
    std::vector<double> inputs = {0, p};
    inputs.resize(s.rhs.inputs.size(), t);
    return inputs;
  };
  const UndefinedMotion undefined(s.rhs);
  EXPECT_FALSE(undefined.why(Status::ok, at(0, 0), at(0, 2)).empty());
  EXPECT_EQ(undefined.why(Status::ok, at(1, 0), at(-1, 2)), "");
}

TEST(Taylor, WhatLeadsBackToAJumpFromBothSidesGoesNoFurther) {
  const auto why = [](const char* rate, Status status) {
    const Specialisation s = specialised(equations({{"x", rate}}));
    const UndefinedMotion undefined(s.rhs);
    const auto at = [&](double x, double t) {
      std::vector<double> inputs = {x};
      inputs.resize(s.rhs.inputs.size(), t);
      return inputs;
    };
    return undefined.why(status, at(0.5, 0), at(1e-16, 0.5));
  };
  EXPECT_NE(why("-sign(x)", Status::step_underflow), "");
  EXPECT_EQ(why("-sign(x)", Status::max_steps), "");
  EXPECT_EQ(why("-2 - sign(x)", Status::step_underflow), "");  // passes it
  EXPECT_EQ(why("sign(x)", Status::step_underflow), "");       // leaves it
}

/// A long way, on which straight lines along the rates of either side would part.
TEST(Taylor, WhatPassesEveryJumpGoesOnAlsoAfterALongTime) {
  const Specialisation s = specialised(equations({{"x", "2 + sign(sin(x))"}}));
  const UndefinedMotion undefined(s.rhs);
  const auto at = [&](double x, double t) {
    std::vector<double> inputs = {x};
    inputs.resize(s.rhs.inputs.size(), t);
    return inputs;
  };
  for (const double way : {1., 300., 1e3, 1077., 1e4, 1e6, -1e3})
    for (const double zero : {M_PI, 2 * M_PI, 500 * M_PI})
      EXPECT_FALSE(undefined.turns_back({std::sin(zero - 1e-12)}, {std::sin(zero + 1e-12)},
                                        at(zero + 1e-12, 1), way))
          << way;
}

/// cos(t) is 1 among doubles up to t = 10^(-8).
TEST(Taylor, AMotionThatBeginsAtADoubleZeroIsNoneThatStays) {
  const Specialisation s = specialised(equations({{"x", "v"}, {"v", "-x"}, {"z", "sign(x - 1)"}}));
  UndefinedSteps steps(s.rhs, {}, 60);
  for (const double t : {0., 5e-9, 9e-9, 1e-4, 1e-2, 1., 6.})
    steps.see(t, std::array{std::cos(t), -std::sin(t), -t}.data(), 3);
  EXPECT_EQ(steps.why(), "");
  UndefinedSteps resting(s.rhs, {}, 60);
  for (const double t : {0., 5e-9, 9e-9, 1e-4, 1e-2, 1., 6.})
    resting.see(t, std::array{1., 0., -t}.data(), 3);
  EXPECT_NE(resting.why(), "");
}

/// A rate that is another state as it is must not see that state's next coefficient, in whatever
/// order the states stand.
TEST(Taylor, RatesThatAreBareStates) {
  const std::vector<std::pair<std::string, std::string>> cycle = {
      {"u", "v"}, {"v", "w"}, {"w", "-u"}, {"x", "sqrt(1 + u*u)"}};
  std::vector<std::pair<std::string, std::string>> reversed(cycle.rbegin(), cycle.rend());
  for (const auto& rates : {cycle, reversed}) {
    const Specialisation s = specialised(equations(rates));
    const std::vector<double> from = {0.75, 0.5, 0.25, 0.125}, end = truth(s, from, 2);
    for (const auto& [form, module] : forms(s)) {
      const Trajectory orbit = run_taylor(module, settings_for(2), from);
      ASSERT_EQ(orbit.status, Status::ok) << form << ' ' << orbit.reason;
      EXPECT_LT(distance(orbit.state, end), 4e-15) << form;
    }
  }
}

TEST(Taylor, TimeAndParametersEnter) {
  const std::string toml = equations({{"x", "a*x*cos(t)"}},
                                     "[parameters]\na = {}\n[[scene]]\nname = \"default\"\n"
                                     "parameters = { a = \"2\" }\n");
  std::string with_time = toml;
  with_time.replace(with_time.find("[equations]"), 0, "time = \"t\"\n");
  SpecialiseOptions general;
  general.fold_parameters = false;
  const Specialisation s = specialised(with_time, general);
  for (const Module& module :
       {compiled(s), uncompiled_module(s.rhs, s.invariants, std::nullopt, {2})}) {
    const Trajectory orbit = integrate(module, taylor(), settings_for(3), {0.5}, {2});
    ASSERT_EQ(orbit.status, Status::ok);
    EXPECT_NEAR(orbit.state[0], 0.5 * std::exp(2 * std::sin(3.)), 1e-14);
    const Trajectory other = integrate(module, taylor(), settings_for(3), {0.5}, {1});
    EXPECT_NEAR(other.state[0], 0.5 * std::exp(std::sin(3.)), 1e-14);
  }
}

TEST(Taylor, ErrorFallsWithTheTolerance) {
  const Specialisation s = specialised(kKovalevskaya);
  const std::vector<double> from = start_of(s), end = truth(s, from, 20);
  for (const auto& [name, module] : forms(s)) {
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
      const double error =
          distance(run_taylor(module, settings_for(20, tolerance), from).state, end);
      EXPECT_LT(error, 100 * tolerance) << name;
      EXPECT_GT(error, 1e-5 * tolerance) << name;  // nothing is given away
    }
  }
}

TEST(Taylor, FloorOfTheErrorOverAHundredUnits) {
  const Specialisation s = specialised(kKovalevskaya);
  const std::vector<double> from = start_of(s), end = truth(s, from, 100);
  for (const auto& [name, module] : forms(s))
    EXPECT_LT(distance(run_taylor(module, settings_for(100), from).state, end), 5e-14) << name;
}

/// With a constant step the order is the highest one, and the error behaves so.
TEST(Taylor, ObservedOrder) {
  constexpr int kOrder = 24;
  constexpr double kDuration = 12;
  const Specialisation s = specialised(kKovalevskaya);
  const std::vector<double> from = start_of(s), end = truth(s, from, kDuration);
  for (const auto& [name, module] : forms(s)) {
    const auto error = [&, &module = module](double step) {
      Settings settings = settings_for(kDuration);
      settings.fixed_step = step;
      const Trajectory orbit = run_taylor(module, settings, from);
      EXPECT_EQ(orbit.status, Status::ok) << orbit.reason;
      return distance(orbit.state, end);
    };
    const double coarse = error(1), fine = error(0.75);
    EXPECT_GT(fine, 1e-14) << "rounding hides the order";
    EXPECT_NEAR(std::log(coarse / fine) / std::log(1 / 0.75), kOrder, 3) << name;
  }
}

constexpr const char* kTops[] = {"kovalevskaya", "clebsch",  "euler",
                                 "steklov",      "lagrange", "manakov-so4"};

Specialisation top(const std::string& name) {
  const Model model = build_model(
      read_case(std::filesystem::path(CASIMIR_SOURCE_DIR) / "cases" / (name + ".toml")));
  return specialise(model, model.scene("default"));
}

TEST(Taylor, FloorOfTheErrorOfEveryTop) {
  for (const char* name : kTops) {
    const Specialisation s = top(name);
    const std::vector<double> from = start_of(s), end = truth(s, from, 100);
    const Module module =
        uncompiled_module(s.rhs, s.invariants, quadratic_form(s.rhs, s.limits), {});
    EXPECT_LT(distance(run_taylor(module, settings_for(100), from).state, end), 5e-14) << name;
  }
}

/// Half a million units of time, a million steps: what truncation does to an invariant would show.
TEST(Taylor, InvariantsOfLongRuns) {
  for (const char* name : kTops) {
    const Specialisation s = top(name);
    const Module module =
        uncompiled_module(s.rhs, s.invariants, quadratic_form(s.rhs, s.limits), {});
    Settings settings = settings_for(5e5);
    settings.invariant_terms = [&](double t, const double* x, long double* values,
                                   long double* sizes) {
      std::vector<SizedNumber> inputs;
      for (std::size_t i = 0; i < s.states.size(); ++i)
        inputs.push_back(Arithmetic<SizedNumber>::plain(x[i]));
      inputs.push_back(Arithmetic<SizedNumber>::plain(t));
      for (const SizedNumber& number : evaluate(s.invariants, inputs)) {
        *values++ = number.value;
        *sizes++ = number.size;
      }
    };
    const Trajectory orbit = run_taylor(module, settings, start_of(s));
    ASSERT_EQ(orbit.status, Status::ok) << name;
    ASSERT_EQ(orbit.invariants.size(), s.invariant_names.size());
    for (std::size_t i = 0; i < orbit.invariants.size(); ++i)
      EXPECT_LT(orbit.invariants[i].drift, 1e-12) << name << ' ' << s.invariant_names[i];
  }
}

TEST(Taylor, SolutionsPolynomialInTimeAreExact) {
  const Specialisation s = specialised(equations({{"x", "y*z + 1"}, {"y", "z"}, {"z", "1"}}));
  for (const auto& [name, module] : forms(s)) {
    const Trajectory orbit = run_taylor(module, settings_for(8), {0, 0, 0});
    // z = t, y = t^2/2, x = t + t^4/8
    EXPECT_EQ(orbit.state, (std::vector<double>{520, 32, 8})) << name;
    EXPECT_LT(orbit.steps, 20u) << name;
  }
}

TEST(Taylor, TermsBeyondTheOrderAreNoticed) {
  // x = t^31 and more: all coefficients that the first step has are zero.
  const Specialisation s =
      specialised(equations({{"a", "b^2"}, {"b", "c^2"}, {"c", "d^2"}, {"d", "e^2"}, {"e", "1"}}));
  for (const auto& [name, module] : forms(s)) {
    const Trajectory orbit = run_taylor(module, settings_for(2), {0, 0, 0, 0, 0});
    const double d = std::pow(2., 3) / 3, c = std::pow(2., 7) / 63, b = std::pow(2., 15) / 59535;
    ASSERT_EQ(orbit.status, Status::ok) << name;
    EXPECT_NEAR(orbit.state[3], d, 1e-14) << name;
    EXPECT_NEAR(orbit.state[2], c, 1e-14) << name;
    EXPECT_NEAR(orbit.state[1], b, 1e-14) << name;
    EXPECT_NEAR(orbit.state[0] * 31 * 59535. * 59535. / std::pow(2., 31), 1, 1e-10) << name;
  }
}

TEST(Taylor, DenseOutputIsARestart) {
  const Specialisation s = specialised(kKovalevskaya);
  const std::vector<double> from = start_of(s);
  for (const auto& [name, module] : forms(s)) {
    Settings settings = settings_for(3);
    settings.sample_every = 0.17;
    const Trajectory orbit = run_taylor(module, settings, from);
    ASSERT_EQ(orbit.samples.size(), 19u);
    for (std::size_t k = 1; k < orbit.samples.size(); ++k) {
      const Trajectory restart = run_taylor(module, settings_for(orbit.sample_times[k]), from);
      EXPECT_LT(distance(orbit.samples[k], restart.state), 2e-15) << name << k;
    }
  }
}

TEST(Taylor, BackwardsReturnsToTheStart) {
  const Specialisation s = specialised(kKovalevskaya);
  const std::vector<double> from = start_of(s);
  for (const auto& [name, module] : forms(s)) {
    const Trajectory there = run_taylor(module, settings_for(10), from);
    const Trajectory back = run_taylor(module, settings_for(-10), there.state);
    EXPECT_LT(distance(back.state, from), 1e-13) << name;
    EXPECT_GT(distance(there.state, from), 1e-2) << name;
  }
}

TEST(Taylor, InstructionSetsAgreeToRounding) {
  for (const std::string& toml :
       {std::string(kKovalevskaya), equations({{"x", "y*z"}, {"y", "-2*z*x"}, {"z", "x*y"}}),
        equations({{"a", "b*c + d^2"},
                   {"b", "-a*c"},
                   {"c", "e*f - a*d"},
                   {"d", "-a*c - c*f"},
                   {"e", "-c*f + b*a - b*f"},
                   {"f", "-e*c + e*b + b - f"}})}) {
    const Specialisation s = specialised(toml);
    const auto form = quadratic_form(s.rhs, s.limits);
    ASSERT_TRUE(form);
    std::vector<std::vector<double>> ends;
    for (const std::string& target : quadratic_targets()) {
      std::vector<double> x = start_of(s);
      casimir_run how = {};
      how.t_end = 3;
      how.rtol = how.atol = 1e-15;
      casimir_outcome out = {};
      QuadraticKernel(*form, target).integrate(&how, x.data(), &out);
      EXPECT_EQ(out.status, CASIMIR_OK) << target;
      ends.push_back(x);
      EXPECT_LT(distance(ends.front(), x), 2e-14) << target;
    }
    EXPECT_LT(distance(run_taylor(compiled(s), settings_for(3), start_of(s)).state, ends.front()),
              2e-14);
  }
}

TEST(Taylor, StepsAllocateNothing) {
  const Specialisation angles = specialised(equations({{"x", "sin(y)/2"}, {"y", "-sin(x)"}}));
  const Specialisation top = specialised(kKovalevskaya);
  const auto count = [](const Module& module, double duration, std::vector<double> x) {
    casimir_run how = {};
    how.t_end = duration;
    how.rtol = how.atol = 1e-12;
    casimir_outcome out = {};
    const unsigned long long before = allocations;
    module.functions().integrate(&how, x.data(), &out);
    EXPECT_GT(out.steps, duration / 4);
    return allocations - before;
  };
  for (const auto& [s, x] :
       {std::pair(angles, std::vector<double>{1, 0.5}), std::pair(top, start_of(top))}) {
    for (const auto& [name, module] : forms(s)) {
      count(module, 5, x);  // the first run of a process finds out what the processor has
      const unsigned long long before_steps = count(module, 5, x);
      EXPECT_EQ(count(module, 50, x), before_steps) << name;
      // The twin: storage for the series of a program is allocated, and is seen.
      EXPECT_EQ(before_steps > 0, name == "interpreted") << name;
    }
  }
}

TEST(Taylor, InterpreterTakesManyStates) {
  // Oscillators of frequencies 1, 2, ..: more states than have a kernel of their own.
  std::vector<std::pair<std::string, std::string>> rates;
  for (int i = 1; i <= 50; ++i) {
    const std::string n = std::to_string(i);
    rates.emplace_back("x" + n, n + "/50*y" + n);
    rates.emplace_back("y" + n, "-" + n + "/50*x" + n);
  }
  const Specialisation s = specialised(equations(rates));
  ASSERT_FALSE(has_quadratic_kernel(*quadratic_form(s.rhs, s.limits)));
  std::vector<double> from;
  for (int i = 0; i < 50; ++i) from.insert(from.end(), {1, 0});
  const Module module = uncompiled_module(s.rhs, s.invariants, std::nullopt, {});
  const Trajectory orbit = run_taylor(module, settings_for(3), from);
  ASSERT_EQ(orbit.status, Status::ok);
  for (int i = 0; i < 50; ++i)
    EXPECT_NEAR(orbit.state[static_cast<std::size_t>(2 * i)], std::cos(3 * (i + 1) / 50.), 1e-14);
}

TEST(Ensemble, StepsAllocateNothing) {
  const Specialisation top = specialised(kKovalevskaya);
  const Specialisation angles = specialised(equations({{"x", "sin(y)/2"}, {"y", "-sin(x)"}}));
  const auto count = [](const LaneKernel& kernel, std::vector<double> from, double duration) {
    struct Source {
      std::vector<double> from;
      int left = 20;
    } source{std::move(from)};
    casimir_ensemble run = {};
    run.t_end = duration;
    run.rtol = run.atol = 1e-12;
    run.source = &source;
    run.next = [](void* self, double* x, const double** numbers) -> long long {
      Source& s = *static_cast<Source*>(self);
      std::copy(s.from.begin(), s.from.end(), x);
      static constexpr double kOnes[32] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
      *numbers = kOnes;
      return --s.left;
    };
    run.done = [](void*, long long, const double*, const casimir_outcome* out) {
      EXPECT_GT(out->steps, 0u);
    };
    const unsigned long long before = allocations;
    kernel.run(&run);
    EXPECT_LT(source.left, 0);
    return allocations - before;
  };
  for (const auto& [name, kernel] : testing::lane_kernels(top))
    EXPECT_EQ(count(kernel, start_of(top), 1), count(kernel, start_of(top), 50)) << name;
  EXPECT_EQ(count(testing::lanes_of_recurrences(angles), {1, 0.5}, 50), 0u);
}

TEST(Taylor, ConstantStepDividesTheInterval) {
  const Specialisation s = specialised(equations({{"x", "y"}, {"y", "-x"}}));
  for (const auto& [name, module] : forms(s)) {
    Settings settings = settings_for(1);
    settings.fixed_step = 0.3;
    const Trajectory orbit = run_taylor(module, settings, {1, 0});
    EXPECT_EQ(orbit.steps, 4u) << name;
    EXPECT_NEAR(orbit.state[0], std::cos(1.), 1e-15) << name;
    settings.duration = 1000;
    settings.fixed_step = 100;
    EXPECT_NE(run_taylor(module, settings, {1, 0}).status, Status::ok) << name;
  }
}

}  // namespace
}  // namespace casimir
