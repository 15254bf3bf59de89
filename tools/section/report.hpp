#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/analysis/frequency/rotation.hpp"
#include "tools/analysis/section/cycles.hpp"
#include "tools/analysis/section/orbits.hpp"
#include "tools/analysis/section/validated_cycles.hpp"

namespace casimir::tools {

/// A section that was computed, and all that is said of it.
struct SectionReport {
  const SectionProblem& problem;
  std::vector<OrbitReport> orbits;
  CycleSearch cycles;
  std::vector<std::string> warnings;
  double tolerance = 0;
  double compile_seconds = 0, seconds = 0;  ///< to get the kernel; of the integration alone
  int jobs = 1, lanes = 1;
  std::string instruction_set = {};
  bool from_cache = false;
  std::vector<ProvedCycle> proofs = {};  ///< one for each cycle, or none
  std::string ranges = {};               ///< of parameters that the proofs are for, or empty
  std::vector<Rotation> rotations = {};  ///< one for each orbit, or none

  std::size_t crossings() const;
  std::size_t chaotic() const;
  double off_level() const;
  unsigned long long steps() const;
  /// How many cycles are proved.
  std::size_t proved() const;
};

/// That the plotted functions have no value at some of the crossings (or what else the points are
/// called); empty where they have one at all.
std::string lost_places(const std::vector<OrbitReport>& orbits, const char* points);

/// A table of orbit, n, t, u, v and the variables, as the name of the file says.
void write_crossings(const SectionReport& report, const std::string& path);

/// \param points  with the crossings.
nlohmann::ordered_json to_json(const SectionReport& report, bool points);

void print_text(const SectionReport& report);

/// The rotation of an orbit; null for what is not known.
nlohmann::ordered_json to_json(const Rotation& rotation);

/// A table of the rotation numbers of all orbits.
void print_rotations(const std::vector<Rotation>& rotations);

}  // namespace casimir::tools
