#pragma once

#include <functional>
#include <vector>

#include "symbolic/discrete/prove_map.hpp"
#include "symbolic/prove.hpp"

namespace casimir {

/// `prove` with a time limit. The proofs run in a process of their own, which is ended when the
/// time is up: exact algebra cannot be asked to stop in the middle of a product. What was not
/// reached is undecided and says so.
/// \param seconds  0: no limit, and no further process.
std::vector<Proof> prove_within(double seconds, const Model& model, const Candidates& candidates,
                                const std::function<void(const Proof&)>& report);

/// The same for the case of a map.
std::vector<Proof> prove_within(double seconds, const MapModel& map, const Candidates& candidates,
                                const std::function<void(const Proof&)>& report);

}  // namespace casimir
