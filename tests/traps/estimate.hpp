#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace casimir::traps {

/// What to compare.
struct EstimateRequest {
  std::vector<std::string> methods{"taylor", "dop853", "gauss8"};
  std::vector<std::string> tolerances{"1e-6", "1e-9", "1e-12"};
  std::string program{};    ///< casimir
  std::string only{};       ///< the case of this name alone
  std::uint64_t every = 1;  ///< only each so many-th of the scenes
  double seconds = 20;      ///< of a processor for a truth, and for a run
  int jobs = 2;
};

/// Compares the error that the program estimates with the true one, which a run with 20 digits
/// gives, over the scenes of the bundled cases. Errors are relative to what a state is at both
/// ends, as the estimates are. Prints what is below a third, and the median.
/// \return  whether the median is within 30, and what is below a third of the truth is warned of
bool compare_estimates(const EstimateRequest& request);

}  // namespace casimir::traps
