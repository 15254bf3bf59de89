#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/ensemble/lane_kernel.hpp"
#include "runtime/integrate.hpp"

namespace casimir {

/// Many trajectories of one system: initial states and, where they differ, parameters.
struct Ensemble {
  std::size_t states = 0;       ///< entries of a state, n
  std::size_t parameters = 0;   ///< run-time parameters of a member, m
  std::vector<double> initial;  ///< n for each member, one member after the other
  std::vector<double> values;   ///< m for each member
  /// Absolute tolerance of each member, in the place of that of the settings; empty: theirs.
  /// Members of one tolerance share registers, so that few different ones are better than many.
  std::vector<double> atol = {};

  /// The number of members.
  std::size_t size() const { return states > 0 ? initial.size() / states : 0; }
  /// The initial state of a member.
  const double* state(std::size_t member) const { return initial.data() + member * states; }
  /// Its parameters.
  const double* values_of(std::size_t member) const { return values.data() + member * parameters; }
  /// Its absolute tolerance, where the settings have that of the others.
  double atol_of(std::size_t member, double of_settings) const {
    return atol.empty() ? of_settings : atol[member];
  }
};

/// What came of a member: see Trajectory. Its invariants are compared at the end of the run, not at
/// every step: those with angles by `least_differences`.
struct MemberResult {
  Status status = Status::stopped;
  double time = 0;
  std::vector<double> state;
  std::vector<InvariantRecord> invariants;
  unsigned long long steps = 0, rejected = 0;
};

/// What came of all of them, in the order of the ensemble.
struct EnsembleResult {
  std::vector<MemberResult> members;
  double seconds = 0;  ///< of the integration alone
  int jobs = 1;        ///< threads that took part
};

/// Integrates every member from time 0 by Taylor series, one in each lane of a register, on several
/// threads. What becomes of a member depends on nothing but the member and the settings: not on
/// the others, their order, or the number of threads.
/// \param invariants  with the inputs of a right-hand side; outputs: values to compare.
/// \param settings  no fixed step and no samples. `give_up` is asked from several threads.
/// \param jobs  threads; 0: one for each processor.
/// \throws std::invalid_argument  as `integrate` does.
EnsembleResult integrate_in_lanes(const Ensemble& ensemble, const LaneKernel& kernel,
                                  const Program& invariants, const Settings& settings,
                                  int jobs = 0);

/// The same by any method, member by member.
/// \param module_for_thread  called once by each thread that takes part.
EnsembleResult integrate_members(const Ensemble& ensemble,
                                 const std::function<Module()>& module_for_thread,
                                 const Method& method, const Program& invariants,
                                 const Settings& settings, int jobs = 0);

}  // namespace casimir
