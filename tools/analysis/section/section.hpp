#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "tools/analysis/frequency/rotation.hpp"
#include "tools/analysis/section/cycles.hpp"
#include "tools/analysis/section/orbits.hpp"
#include "tools/analysis/section/validated_cycles.hpp"

namespace casimir {

/// What is asked of `section`.
struct PoincareOptions {
  SectionRequest request = {};  ///< plane, level, plotted pair; without it those of the case
  std::size_t orbits = 40, points = 500;
  std::vector<std::vector<double>> seeds = {};  ///< states on the level that orbits begin at;
                                                ///< without any they are spread over the domain
  double tolerance = 1e-14;
  std::size_t longest_cycle = 0;       ///< cycles of up to so many crossings are looked for
  bool prove_cycles = false;           ///< and enclosed: see `enclose_cycles`
  bool rotation = false;               ///< rotation numbers of the orbits
  int jobs = 0;                        ///< threads; 0: one for each processor
  std::function<bool()> give_up = {};  ///< asked now and then; true ends it
  std::function<void(double share)> progress = {};  ///< told now and then what share is done
};

/// Orbits on one level of energy and Casimir functions, cut with a plane.
struct PoincareSection {
  std::unique_ptr<const SectionProblem> problem;  ///< plane, level, and what is plotted
  std::vector<OrbitReport> orbits;       ///< with their crossings and whether they are chaotic
  std::vector<Rotation> rotations = {};  ///< one for each orbit, or none
  CycleSearch cycles = {};
  std::vector<ProvedCycle> proofs = {};  ///< one for each cycle, or none

  /// The number of crossings of all orbits.
  std::size_t crossings() const;
};

/// The Poincare section of a scene's level: orbits spread over the domain of possible motion, each
/// cut until it has its points, checked against the level, and judged. Without orbits where nothing
/// that moves on the level returns to the plane.
/// \throws RequestError      for systems that have no such section: see section_problem.
/// \throws EnvironmentError  where the equations need a compiler and there is none.
PoincareSection section(const Model& model, const Scene& scene,
                        const PoincareOptions& options = {});

}  // namespace casimir
