#pragma once

#include <optional>
#include <string>

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// What holds at almost all points says something of the domain only where that has inner points.
/// a >= 1 and a <= 1 leave a = 1 alone, and (q - 1)*p = 0 two lines, of which one point is on one;
/// acos(1 + a^2) has a real value for a = 0 alone, also where it has cancelled or stands beside a
/// factor 0.
/// \return  why it is not known that there are inner points; empty where there are
std::optional<std::string> thin_domain(Prover& prover);

}  // namespace casimir
