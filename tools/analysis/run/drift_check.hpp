#pragma once

#include <string>
#include <vector>

#include "runtime/integrate.hpp"
#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// Invariants that drifted and say nothing about the run.
struct DriftDoubts {
  std::vector<std::size_t> which;      ///< among those of the trajectory
  std::vector<std::string> sentences;  ///< one about each
};

/// Looks at the invariants that drifted by more than the tolerance allows. One that is proved to be
/// an integral of the case turns an `ok` into `drift_exceeded`; one that is not proves nothing
/// about the run, nor does one that has no value at some state, or that changes as much where the
/// state does by what is allowed: f^2/(f - 1) is an integral where f is one, and infinite at f = 1.
/// \param run  of the trajectory; its invariants are "H" and those of the file
DriftDoubts check_drift(const Model& model, const Scene& scene, const PreparedScene& run,
                        Trajectory& trajectory);

/// The sentence about an invariant that has no value at a state of a run, or an infinite one.
std::string words_of_lost_invariant(const std::string& name);

/// What is known of an invariant along motions.
struct KnownInvariant {
  Proof proof;             ///< that it is an integral, wherever a motion goes
  bool on_domain = false;  ///< it is not proved to be one but where the case's assumptions hold
};

/// What can be proved of that invariant of the case, "H" or one of the file, as an integral, with
/// the functions of the scene: what is proved of all smooth ones says nothing of one that jumps.
/// What the case assumes of its variables is not assumed: a motion may lead to where it does not
/// hold.
KnownInvariant known_invariant(const Model& model, const Scene& scene,
                               const std::string& invariant);

/// "refuted to be an integral", "not proved to be an integral" or where it is one; of what is not
/// proved.
std::string words_of(const KnownInvariant& known);

}  // namespace casimir
