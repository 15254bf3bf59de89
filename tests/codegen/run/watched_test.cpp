// What steps are watched for, as compiled code beside the interpreted program.
#include <cln/dfloat.h>
#include <gtest/gtest.h>

#include <cmath>

#include "codegen/emit_watched.hpp"
#include "runtime/program/interpreter.hpp"
#include "runtime/step/step_watch.hpp"
#include "tests/codegen/run/taylor_forms.hpp"

namespace casimir {
namespace {

/// Every kind of argument: branches, domains, peaks, fronts, powers, phases.
const char* const kX =
    "sqrt((y - 1/3)^2) + sqrt(1 + x^2/4)/(1 + 40*(x - y)^4) + atan2(y, x - 3) + tan(x/5)";
const char* const kY =
    "-x + exp(-50*(y - sin(7*t))^2) + tanh(x*y) + cosh(y/9) + (x/4)^12 + asin(y/9)";

Specialisation watched_system(bool keep_parameter = false) {
  SpecialiseOptions options;
  options.fold_parameters = !keep_parameter;
  const std::string y = std::string(kY) + " + a*sqrt((x + a)^2)";
  std::string text = testing::equations(
      {{"x", kX}, {"y", y}},
      "[parameters]\na = {}\n[[scene]]\nname = \"default\"\nparameters = { a = \"1/4\" }");
  const std::string with_time = "[phase_space]\ntime = \"t\"\n";
  text.replace(text.find("[phase_space]\n"), std::string("[phase_space]\n").size(), with_time);
  return testing::specialised(text, options);
}

Module with_watch(const Specialisation& s, const char* method) {
  const Method& m = *find_method(method);
  const std::string text = emit_module(s, kernel_source(m), {.series = m.series});
  Module module = Module::load(compile(text + emit_watched(s, StepWatch(s.rhs).arguments())).path);
  module.know_equations(s.rhs);
  return module;
}

TEST(WatchedArguments, AreCompiledAsTheProgramSays) {
  for (const bool keep : {false, true}) {
    const Specialisation s = watched_system(keep);
    const StepWatch watch(s.rhs);
    const std::size_t count = watch.arguments().outputs.size();
    ASSERT_GT(count, 8U);
    const Interpreter interpreted(watch.arguments());
    for (const char* method : {"taylor", "dop853", "radau5"}) {
      const Module module = with_watch(s, method);
      ASSERT_TRUE(module.watch() && module.watch()->compiled()) << method;
      testing::Points points;
      for (int round = 0; round < 20; ++round) {
        const auto number = [&] { return cln::double_approx(points.next()); };
        const double x[] = {number(), number()}, p[] = {0.25}, t = number();
        std::vector<double> inputs{x[0], x[1]};
        if (keep) inputs.push_back(p[0]);
        inputs.push_back(t);
        std::vector<double> ours(count), theirs(count);
        interpreted(inputs.data(), ours.data());
        module.watch()->compiled()(t, x, keep ? p : nullptr, theirs.data());
        for (std::size_t i = 0; i < count; ++i)
          EXPECT_NEAR(theirs[i], ours[i], 1e-12 * std::max(1., std::abs(ours[i]))) << i;
      }
    }
  }
}

/// x' = |y - 1/3| + a pulse, y' = cos(2 t), past five kinks.
TEST(WatchedArguments, MakeNoDifferenceToARun) {
  std::string text =
      testing::equations({{"x", "sqrt((y - 1/3)^2) + exp(-500*(y - 1/2)^2)"}, {"y", "cos(2*t)"}});
  const std::string space = "[phase_space]\n";
  text.replace(text.find(space), space.size(), space + "time = \"t\"\n");
  const Specialisation s = testing::specialised(text);
  const std::vector<double> start = testing::start_of(s);
  for (const char* name : {"taylor", "dop853"}) {
    const Method& method = *find_method(name);
    const Settings settings = testing::settings_for(4, 1e-11);
    const Trajectory compiled = integrate(with_watch(s, name), method, settings, start);
    Module plain = testing::compiled(s, name);
    plain.know_equations(s.rhs);
    ASSERT_FALSE(plain.watch()->compiled());
    const Trajectory interpreted = integrate(plain, method, settings, start);
    ASSERT_EQ(compiled.status, Status::ok) << compiled.reason;
    EXPECT_LT(testing::distance(compiled.state, interpreted.state), 1e-9) << name;
    // A kink is ended at, or hundreds of steps are lost there.
    EXPECT_NEAR(static_cast<double>(compiled.steps), static_cast<double>(interpreted.steps),
                0.1 * static_cast<double>(interpreted.steps));
  }
}

TEST(WatchedArguments, OfOtherEquationsAreNotBelieved) {
  Module module = with_watch(watched_system(), "taylor");
  const Specialisation other =
      testing::specialised(testing::equations({{"x", "sqrt((x - y)^2)"}, {"y", "1"}}));
  module.know_equations(other.rhs);
  ASSERT_TRUE(module.watch());
  EXPECT_FALSE(module.watch()->compiled());
}

TEST(WatchedArguments, AreLeftOutWhereNothingIsWatched) {
  const Specialisation s = testing::specialised(testing::kKovalevskaya);
  const Program none = StepWatch(s.rhs).arguments();
  EXPECT_TRUE(none.outputs.empty());
  EXPECT_EQ(emit_watched(s, none), "");
}

}  // namespace
}  // namespace casimir
