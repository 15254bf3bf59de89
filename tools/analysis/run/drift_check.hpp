#pragma once

#include <string>
#include <vector>

#include "runtime/integrate.hpp"
#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"

namespace casimir {

/// Invariants that drifted and are not proved to be integrals.
struct DriftDoubts {
  std::vector<std::size_t> which;      ///< among those of the trajectory
  std::vector<std::string> sentences;  ///< one about each
};

/// Looks at the invariants that drifted by more than the tolerance allows. One that is proved to be
/// an integral of the case turns an `ok` into `drift_exceeded`; one that is not proves nothing
/// about the run.
/// \param names  of the invariants of the trajectory, "H" and those of the file
DriftDoubts check_drift(const Model& model, const Scene& scene,
                        const std::vector<std::string>& names, Trajectory& trajectory);

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
