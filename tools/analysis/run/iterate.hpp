#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// What came of iterating a map in double precision.
struct Iterated {
  std::uint64_t steps = 0;  ///< that were done
  bool finite = true;    ///< false: there is no next state, `state` is the last one that there is
  std::string reason;    ///< why not
  bool stopped = false;  ///< by `give_up`
  std::vector<std::string> names;
  std::vector<double> state;
  std::vector<double> before;  ///< the state one step before that one; empty at the start
  std::vector<std::uint64_t> sample_steps;
  std::vector<std::vector<double>> samples;
  struct Invariant {
    std::string name;
    double initial = 0, final = 0;
    double drift = 0;  ///< as of the interface, at some thousand states and at the end
  };
  std::vector<Invariant> invariants;
  /// How far orbits are from the last state in which every number of every state, the first one
  /// included, is moved by one unit of its last digit, up or down at random: the largest of the
  /// distances, relative to the largest value that the number has on the way. In two of the three
  /// so are, in all steps alike, the numbers of the map that are no doubles. Rounding does somewhat
  /// less, and grows in the same way. Empty where the orbit did not get to its end, or took too
  /// long to be repeated.
  std::optional<double> error_estimate;
  bool from_cache = false;
  double generate_seconds = 0, compile_seconds = 0, seconds = 0;
};

/// What takes more seconds is not repeated.
constexpr double kLongestRepeated = 2;
/// From this estimate on nothing is known of the last state.
constexpr double kSpoiledOrbit = 0.1;

/// Compiles the step of a scene and iterates it.
/// \param every  steps between samples; 0: none are kept
/// \param with_estimate  of the error, which takes three more orbits
/// \throws EnvironmentError  where there is no compiler
Iterated iterate(const MapModel& map, const Scene& scene, std::uint64_t steps, std::uint64_t every,
                 const std::function<bool()>& give_up, bool with_estimate = true);

}  // namespace casimir
