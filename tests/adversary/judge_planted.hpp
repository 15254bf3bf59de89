#pragma once

#include <string>

#include "tests/adversary/judge.hpp"
#include "tests/adversary/planted_case.hpp"
#include "tests/adversary/random.hpp"

namespace casimir::adversary {

/// What the library says of a structure that is known, compared.
/// \param what  becomes what is wrong, or why it is undecided
Outcome judge_planted(const PlantedCase& claim, Random& random, std::string& what);

}  // namespace casimir::adversary
