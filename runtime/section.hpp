#pragma once

#include <functional>
#include <vector>

#include "runtime/ensemble/lane_kernel.hpp"
#include "runtime/integrate.hpp"

namespace casimir {

/// A surface in phase space that orbits are to be cut with: function = 0, crossed in one direction.
struct SectionPlane {
  Program function;     ///< inputs as a right-hand side, of which only the states are used
  bool upwards = true;  ///< from negative values to positive ones
  /// > 0: the function is known up to multiples of this, as angles are, and every multiple counts
  /// as zero.
  double period = 0;
};

/// How many crossings, and how exactly.
struct SectionSettings {
  std::size_t points = 0;  ///< crossings of each orbit
  double rtol = 1e-14, atol = 1e-16;
  int jobs = 0;  ///< threads; 0: one for each processor
  /// An orbit that has not crossed for so many steps does not return.
  unsigned long long steps_between = 20000;
  /// Of the states of the kernel the first so many are those of the system. What follows them is
  /// one deviation or several, of the same size, that obey the variational equations.
  std::size_t states = 0;
  /// Keep the deviations with the states of each crossing, as they come. Otherwise the only
  /// deviation is made small again whenever it has grown large, and its growth is kept.
  bool keep_deviations = false;
  std::function<bool()> give_up;              ///< asked now and then from several threads
  std::function<void(double)> progress = {};  ///< told the share that is done, in this thread
};

/// The crossings of an orbit.
struct SectionOrbit {
  Status status = Status::stopped;  ///< ok: all crossings were found
  /// Somewhere on the way the function of the plane has no value or no convergent series: a
  /// crossing may be missed there.
  bool uncertain = false;
  bool returns = true;         ///< false: not for SectionSettings::steps_between steps
  double time = 0;             ///< at the end
  std::vector<double> state;   ///< there
  std::vector<double> times;   ///< of each crossing
  std::vector<double> states;  ///< at each crossing, one after the other
  /// The logarithm of the growth of the deviation up to each crossing, unless that is kept itself.
  std::vector<double> growth;
  unsigned long long steps = 0;

  /// The number of crossings.
  std::size_t size() const { return times.size(); }
};

/// What came of all seeds, in their order.
struct SectionResult {
  std::vector<SectionOrbit> orbits;
  double seconds = 0;
  int jobs = 1;
};

/// Integrates from each seed until it has crossed the plane so many times, one orbit in each lane
/// of a register, on several threads. What becomes of an orbit depends on nothing but its seed and
/// the settings.
///
/// Crossings are the zeros of the Taylor polynomial of the function along each step: all of them,
/// however many there are in a step. A seed that lies on the plane is not one of its crossings.
/// \param seeds  states of the kernel, one seed after the other.
/// \throws std::invalid_argument  for a function of more than the states, or bad tolerances.
SectionResult cut(const LaneKernel& kernel, const SectionPlane& plane,
                  const std::vector<double>& seeds, std::size_t seed_size,
                  const SectionSettings& settings);

}  // namespace casimir
