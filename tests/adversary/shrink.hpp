#pragma once

#include <cstdint>
#include <string>

#include "tests/adversary/judge.hpp"

namespace casimir::adversary {

/// Makes the claim of that index smaller as long as it is judged with the same outcome: what it
/// does not need is left out, and parts of its expressions are replaced by their own parts or by
/// small numbers. What is true of each smaller claim is found by the oracle anew. Each is judged in
/// a child process, which may crash or hang as the claim does.
/// \param seconds  for all of it \return the file of the smallest claim
std::string shrunk(std::uint64_t seed, std::uint64_t index, Outcome outcome, double seconds);

}  // namespace casimir::adversary
