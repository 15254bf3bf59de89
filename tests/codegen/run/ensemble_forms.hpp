#pragma once

#include "codegen/lane_form.hpp"
#include "runtime/ensemble.hpp"
#include "tests/codegen/run/taylor_forms.hpp"

namespace casimir::testing {

using Kernels = std::vector<std::pair<std::string, LaneKernel>>;

/// The recurrences of every operation, compiled.
inline LaneKernel lanes_of_recurrences(const Specialisation& s) {
  LaneKernel result = loaded_lanes(
      compile(emit_series_lanes(s, kernel_text("runtime/kernels/lanes/lane_convolved.hpp"))).path);
  result.watch_steps_of(s.rhs);
  return result;
}

/// The kernel for quadratic systems with its tables as constants, compiled.
inline LaneKernel lanes_of_constants(const LaneForm& form) {
  const std::string kernel = kernel_text("runtime/kernels/lanes/lane_quadratic.hpp");
  LaneKernel result = loaded_lanes(compile(emit_lane_module(form, kernel)).path);
  result.numbers = form.numbers;
  return result;
}

/// Every kernel that the system has, and its name.
inline Kernels lane_kernels(const Specialisation& s) {
  Kernels result;
  if (const auto form = lane_form(s.rhs, s.limits)) {
    result.emplace_back("constants", lanes_of_constants(*form));
    for (const std::string& target : lane_targets())
      result.emplace_back(target, table_driven_lanes(*form, target));
  }
  result.emplace_back("recurrences", lanes_of_recurrences(s));
  return result;
}

inline Ensemble ensemble_of(const std::vector<std::vector<double>>& states,
                            const std::vector<std::vector<double>>& parameters = {}) {
  Ensemble ensemble;
  ensemble.states = states.front().size();
  for (const auto& x : states) ensemble.initial.insert(ensemble.initial.end(), x.begin(), x.end());
  for (const auto& p : parameters) {
    ensemble.parameters = p.size();
    ensemble.values.insert(ensemble.values.end(), p.begin(), p.end());
  }
  return ensemble;
}

/// States next to one, each in another place.
inline std::vector<std::vector<double>> near(const std::vector<double>& x, std::size_t count) {
  std::vector<std::vector<double>> states(count, x);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < x.size(); ++k)
      states[i][k] *= 1 + 1e-2 * std::sin(static_cast<double>(7 * i + k));
  return states;
}

inline EnsembleResult run_lanes(const LaneKernel& kernel, const Ensemble& ensemble,
                                const Settings& settings, int jobs = 1) {
  return integrate_in_lanes(ensemble, kernel, {}, settings, jobs);
}

}  // namespace casimir::testing
