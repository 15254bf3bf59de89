#pragma once

#include "runtime/methods.hpp"
#include "tools/analysis/estimate/error_estimate.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir::test {

/// Integrates a scene and assesses the run, which is written to `trajectory`.
inline ErrorEstimate estimate_of(const Model& model, const Scene& scene, const char* name,
                                 const Settings& settings, Trajectory* trajectory, double budget) {
  const PreparedScene run = prepare(model, scene);
  const Method& method = *find_method(name);
  const CompiledModule compiled = compile_for(run, method);
  *trajectory = integrate(compiled.module, method, settings, run.initial, run.parameters);
  return assess(run, compiled, method, settings, *trajectory, budget);
}

}  // namespace casimir::test
