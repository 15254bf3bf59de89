#pragma once

#include <string>

#include "tests/adversary/judge.hpp"
#include "tests/adversary/search_case.hpp"

namespace casimir::adversary {

/// Runs the search. It fails if it says that there is nothing else where something is known to be,
/// or shows as an integral what is none, or a constant, or refutes its own finding.
/// \param what  why, where it fails
Outcome judge_search(const SearchCase& claim, Random& random, std::string& what);

}  // namespace casimir::adversary
