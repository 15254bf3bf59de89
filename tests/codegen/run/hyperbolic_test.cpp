// Hyperbolic functions along solutions in closed form, with every kind of method.
#include "runtime/precise_run.hpp"
#include "tests/codegen/run/taylor_forms.hpp"

namespace casimir {
namespace {

using testing::compiled;
using testing::equations;
using testing::forms;
using testing::run_taylor;
using testing::settings_for;
using testing::specialised;

/// x' = cosh x, y' = -tanh y, z' = sinh z.
const std::vector<std::pair<std::string, std::string>> kEach{
    {"x", "cosh(x)"}, {"y", "-tanh(y)"}, {"z", "sinh(z)"}};

std::vector<double> after(double t, const std::vector<double>& start) {
  const double u = std::tanh(start[0] / 2);
  return {2 * std::atanh(std::tan(t / 2 + std::atan(u))),
          std::asinh(std::sinh(start[1]) * std::exp(-t)),
          2 * std::atanh(std::tanh(start[2] / 2) * std::exp(t))};
}

std::vector<double> relative_errors(const Trajectory& orbit, const std::vector<double>& end) {
  std::vector<double> result;
  for (std::size_t i = 0; i < end.size(); ++i)
    result.push_back(std::abs(orbit.state[i] / end[i] - 1));
  return result;
}

TEST(Hyperbolic, ClosedFormsByEveryMethod) {
  const Specialisation s = specialised(equations(kEach));
  const std::vector<double> start{0.25, 1.5, 0.125};
  for (const auto& [name, module] : forms(s)) {
    const Trajectory orbit = run_taylor(module, settings_for(1), start);
    ASSERT_EQ(orbit.status, Status::ok) << name << orbit.reason;
    for (const double error : relative_errors(orbit, after(1, start)))
      EXPECT_LT(error, 1e-14) << name;
  }
  for (const char* method : {"dop853", "dopri5", "radau9", "radau5"}) {
    const Trajectory orbit =
        integrate(compiled(s, method), *find_method(method), settings_for(1, 1e-11), start);
    ASSERT_EQ(orbit.status, Status::ok) << method << orbit.reason;
    for (const double error : relative_errors(orbit, after(1, start)))
      EXPECT_LT(error, 1e-9) << method;
  }
}

/// Differences of exponentials would have six digits of sinh(1e-10).
TEST(Hyperbolic, SmallArgumentsKeepAllDigits) {
  const Specialisation s = specialised(equations(kEach));
  const std::vector<double> start{1e-10, 1e-10, -1e-10};
  for (const auto& [name, module] : forms(s)) {
    Settings settings = settings_for(1);
    settings.atol = 1e-30;
    const Trajectory orbit = run_taylor(module, settings, start);
    ASSERT_EQ(orbit.status, Status::ok) << name << orbit.reason;
    const std::vector<double> errors = relative_errors(orbit, after(1, start));
    EXPECT_LT(errors[1], 1e-14) << name;
    EXPECT_LT(errors[2], 1e-14) << name;
  }
}

/// cosh(800) is no double. tanh(800) is one.
TEST(Hyperbolic, WhatIsBeyondTheRangeOfNumbersIsRefused) {
  for (const char* rate : {"cosh(x)", "sinh(x)", "1/cosh(x)^2 + sinh(x)"}) {
    const Specialisation s = specialised(equations({{"x", rate}}));
    for (const auto& [name, module] : forms(s)) {
      const Trajectory orbit = run_taylor(module, settings_for(1), {800});
      EXPECT_EQ(orbit.status, Status::non_finite) << name << rate;
      EXPECT_EQ(orbit.time, 0) << name << rate;
    }
  }
  const Specialisation flat = specialised(equations({{"x", "-tanh(x)"}}));
  for (const auto& [name, module] : forms(flat)) {
    const Trajectory orbit = run_taylor(module, settings_for(1), {800});
    ASSERT_EQ(orbit.status, Status::ok) << name << orbit.reason;
    EXPECT_EQ(orbit.state[0], 799) << name;
  }
}

TEST(Hyperbolic, FiftyDigits) {
  const Specialisation s = specialised(equations(kEach));
  PreciseProblem problem;
  problem.rhs = &s.rhs;
  problem.start = [](int) {
    // The last is the duration.
    return std::vector<cln::cl_R>{0, cln::cl_RA(3) / 2, cln::cl_RA(1) / 8, 1};
  };
  const PreciseRun run = precise_run(problem, 50);
  ASSERT_EQ(run.status, Status::ok) << run.reason;
  const cln::float_format_t format = cln::float_format(60);
  const cln::cl_F one = cln::cl_float(1, format);
  const cln::cl_F u = cln::cl_float(cln::tan(one / 2), format);
  const cln::cl_F w = cln::cl_float(cln::sinh(one * 3 / 2) * cln::exp(-one), format);
  const cln::cl_F v = cln::cl_float(cln::tanh(one / 16) * cln::exp(one), format);
  const std::vector<cln::cl_R> end{cln::ln((1 + u) / (1 - u)), cln::ln(w + cln::sqrt(1 + w * w)),
                                   cln::ln((1 + v) / (1 - v))};
  for (std::size_t i = 0; i < end.size(); ++i)
    EXPECT_LT(cln::double_approx(cln::abs(run.state[i] - end[i])), 1e-49) << i;
}

}  // namespace
}  // namespace casimir
