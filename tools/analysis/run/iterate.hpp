#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// What came of iterating a map in double precision.
struct Iterated {
  std::uint64_t steps = 0;  ///< that were done
  bool finite = true;    ///< false: the next state is not finite, `state` is the last one that is
  bool stopped = false;  ///< by `give_up`
  std::vector<std::string> names;
  std::vector<double> state;
  std::vector<std::uint64_t> sample_steps;
  std::vector<std::vector<double>> samples;
  struct Invariant {
    std::string name;
    double initial = 0, final = 0;
    double drift = 0;  ///< as of the interface, at up to a thousand states and at the end
  };
  std::vector<Invariant> invariants;
  bool from_cache = false;
  double generate_seconds = 0, compile_seconds = 0, seconds = 0;
};

/// Compiles the step of a scene and iterates it.
/// \param every  steps between samples; 0: none are kept
/// \throws EnvironmentError  where there is no compiler
Iterated iterate(const MapModel& map, const Scene& scene, std::uint64_t steps, std::uint64_t every,
                 const std::function<bool()>& give_up);

}  // namespace casimir
