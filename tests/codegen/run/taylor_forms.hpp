#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "codegen/compile.hpp"
#include "codegen/emit_cpp.hpp"
#include "codegen/quadratic.hpp"
#include "runtime/integrate.hpp"
#include "runtime/reference.hpp"
#include "runtime/taylor/quadratic_targets.hpp"
#include "runtime/uncompiled.hpp"
#include "tests/codegen/support.hpp"

namespace casimir::testing {

inline const Method& taylor() { return *find_method("taylor"); }

inline Module compiled(const Specialisation& s, const char* method = "taylor") {
  const Method& m = *find_method(method);
  return Module::load(compile(emit_module(s, kernel_source(m), {.series = m.series})).path);
}

/// Every form of the method that the system has, and its name.
inline std::vector<std::pair<std::string, Module>> forms(const Specialisation& s) {
  std::vector<std::pair<std::string, Module>> result;
  if (const auto form = quadratic_form(s.rhs, s.limits))
    result.emplace_back("tables", uncompiled_module(s.rhs, s.invariants, form, {}));
  result.emplace_back("compiled", compiled(s));
  result.emplace_back("interpreted", uncompiled_module(s.rhs, s.invariants, std::nullopt, {}));
  return result;
}

inline Settings settings_for(double duration, double tolerance = 1e-15) {
  Settings settings;
  settings.duration = duration;
  settings.rtol = settings.atol = tolerance;
  return settings;
}

inline Trajectory run_taylor(const Module& module, const Settings& settings,
                             const std::vector<double>& from) {
  return integrate(module, taylor(), settings, from);
}

inline double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]) / std::max(1., std::abs(b[i])));
  return std::isnan(largest) ? std::numeric_limits<double>::infinity() : largest;
}

inline std::vector<double> start_of(const Specialisation& s) {
  std::vector<double> x;
  Program start = s.start;
  for (std::size_t i = 0; i < s.states.size(); ++i)
    x.push_back(cln::double_approx(codegen::constant_value(start, start.outputs[i], {})));
  return x;
}

/// The state after `duration` from the rounded start, in 40 digits.
inline std::vector<double> truth(const Specialisation& s, const std::vector<double>& from,
                                 double duration) {
  std::vector<cln::cl_R> exact;
  for (const double x : from) exact.push_back(cln::rational(cln::cl_DF(x)));
  const Reference reference =
      reference_solution(s.rhs, exact, cln::rational(cln::cl_DF(duration)), 25);
  EXPECT_TRUE(reference.reached) << reference.reason;
  std::vector<double> state;
  for (const cln::cl_F& x : reference.state) state.push_back(cln::double_approx(x));
  return state;
}

}  // namespace casimir::testing
