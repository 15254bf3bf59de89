#pragma once

#include <optional>

#include "tests/traps/scene.hpp"

namespace casimir::traps {

/// How a run of the reference integrator is done.
struct Pains {
  Real step = 1;            ///< times the limit of the scene
  Real tolerance = 1e-15L;  ///< of a step, relative to state and change
  Real least_size = 1e-3L;  ///< errors in what is smaller are measured against this
  int columns = 7;          ///< of the extrapolation: its order is twice that
  unsigned long long most_evaluations = 8'000'000;
};

/// The end state by extrapolation of the modified midpoint rule (Gragg, Bulirsch and Stoer; Hairer,
/// Norsett and Wanner, Solving Ordinary Differential Equations I, II.9) in `Real`, with steps that
/// are never longer than the limit of the scene. Nothing where it cannot be reached.
std::optional<Truth> integrate(const Scene& scene, const Pains& pains = {});

/// The same twice, the second time with half the steps, a tenth of the tolerance and another order:
/// nothing where the two differ by more than `certain`.
std::optional<Truth> reference(const Scene& scene, Real certain = 1e-11L);

}  // namespace casimir::traps
