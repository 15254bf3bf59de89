#pragma once

#include <optional>
#include <string>

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// What holds at almost all points says something of the domain only where the assumptions leave an
/// open set: a >= 1 and a <= 1 leave a = 1 alone, and (q - 1)*p = 0 two lines, of which one point
/// is on one.
/// \return  why it is not known that they do; empty where they do.
std::optional<std::string> thin_assumptions(Prover& prover);

}  // namespace casimir
