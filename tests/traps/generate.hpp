#pragma once

#include <cstdint>

#include "tests/traps/scene.hpp"

namespace casimir::traps {

/// The scene of this number: the same everywhere. The kinds take turns, and in each its shapes.
Scene generated(std::uint64_t seed, std::uint64_t index);

/// The names of the kinds.
Texts kinds();

}  // namespace casimir::traps
