#pragma once

#include <array>
#include <optional>
#include <string>

#include "tests/traps/program.hpp"
#include "tests/traps/scene.hpp"

namespace casimir::traps {

/// What an answer is worth.
enum class Outcome {
  right,        ///< as near to the truth as the program says it is
  cautious,     ///< right, with a warning
  warned,       ///< wrong, with a warning
  understated,  ///< wrong, with a warning, and an estimate that claims digits which it has not
  refused,      ///< none, where there is one to be had
  silent,       ///< wrong, and nothing is said: the defect
  hang,         ///< none in time
  broken,       ///< the program died, or takes the file for bad input
  dropped       ///< the truth is not certain
};
inline constexpr std::size_t kOutcomes = 9;

std::string to_string(Outcome outcome);
/// Whether the tester fails with it.
bool is_failure(Outcome outcome);

struct Verdict {
  Outcome outcome = Outcome::dropped;
  Real error = 0;       ///< of the worst state, relative to its size
  double estimate = 0;  ///< what the program says of it; 0 where it says nothing
  std::string what{};   ///< in a few words
};

/// \param truth  the end state; not used where the solution ends before
Verdict judge(const Scene& scene, const std::optional<Truth>& truth, const Said& said);

}  // namespace casimir::traps
