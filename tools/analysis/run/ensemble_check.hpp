#pragma once

#include <vector>

#include "runtime/ensemble.hpp"
#include "tools/analysis/estimate/error_estimate.hpp"

namespace casimir {

/// What is known of a member of an ensemble that was integrated again by itself.
struct CheckedMember {
  std::size_t member = 0;
  ErrorEstimate trust;  ///< of the end state that it has in the ensemble
};

/// How a member ended, as far as that tells whether it is to be checked.
struct MemberEnd {
  bool arrived = true;
  unsigned long long steps = 0;
  double size = 0;  ///< the largest number in its end state, without its sign
};

/// How each member ended, in the order of the ensemble.
std::vector<MemberEnd> ends_of(const EnsembleResult& result);

/// The members that are checked: the first, the last and one between them of those that reached the
/// end, in their order, the one that took most steps by far, since something was in its way, and
/// some of those that ended far beyond the others, perhaps at a pole.
std::vector<std::size_t> members_to_check(const std::vector<MemberEnd>& ends);

/// What a scene is checked for, of members: their equations have a meaning off the constraints,
/// too, but what is proved of the case does not hold there.
/// \return  a warning on members that leave a constraint of the case; empty where none does
/// \throws RequestError  for a member that violates an assumption; the message names the first
std::string require_members(const Model& model, const Scene& scene, const Specialisation& s,
                            const Ensemble& ensemble);

/// Integrates some members again by themselves, each for no more than about `budget` seconds, with
/// an estimate of their errors. One that does not reach the end in that time is unconfirmed, and so
/// are those after it. Members have no estimate of their own, and what
/// rounding or a step does to one of them it mostly does to its neighbours as well.
/// \param run    what the members are, but for their initial states and parameters.
/// \param which  of the members, as of `members_to_check`
std::vector<CheckedMember> check_members(const PreparedScene& run, const Method& method,
                                         const Settings& settings, const Ensemble& ensemble,
                                         const EnsembleResult& result,
                                         const std::vector<std::size_t>& which, double budget = 2);

/// Whether members may pass over what lies between the ends of a step: a constant step is not
/// looked into, and the equations have functions that hide something from one. Of members nobody
/// says it but those that are checked.
bool may_pass_over(const PreparedScene& run, const Settings& settings);

}  // namespace casimir
