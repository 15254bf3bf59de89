#pragma once

#include <optional>
#include <string>

#include "symbolic/search/system.hpp"

namespace casimir::search {

/// Why it is not known that the functions of a system obey no other relations than those that its
/// ring knows; empty where that is proved. What is zero in the ring is zero: but that a polynomial
/// in the functions which is not zero in the ring is not zero as a function, on which "no other"
/// rests, needs this.
std::optional<std::string> unknown_relations(const System& system);

}  // namespace casimir::search
