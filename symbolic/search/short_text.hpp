#pragma once

#include <string>

#include "symbolic/function_ring.hpp"

namespace casimir::search {

/// A polynomial as a person would write it: as a product of powers where it is one, and with the
/// simplest terms first.
std::string short_text(const FunctionRing& ring, const Polynomial& p);

}  // namespace casimir::search
