#include "runtime/equal_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace casimir {

WorkPrecision::WorkPrecision(std::vector<Measured> runs) {
  for (Measured& run : runs) run.error = std::max(run.error, std::numeric_limits<double>::min());
  std::sort(runs.begin(), runs.end(), [](const Measured& a, const Measured& b) {
    return a.error != b.error ? a.error < b.error : a.seconds < b.seconds;
  });
  for (const Measured& run : runs) {
    if (envelope_.empty() || run.seconds < envelope_.back().seconds) envelope_.push_back(run);
  }
  std::reverse(envelope_.begin(), envelope_.end());
}

double WorkPrecision::seconds_at(double error) const {
  if (envelope_.empty() || !(error >= envelope_.back().error))
    return std::numeric_limits<double>::quiet_NaN();
  if (error >= envelope_.front().error) return envelope_.front().seconds;
  const auto fine = std::find_if(envelope_.begin(), envelope_.end(),
                                 [&](const Measured& run) { return run.error <= error; });
  const auto coarse = std::prev(fine);
  const double share = std::log(coarse->error / error) / std::log(coarse->error / fine->error);
  return coarse->seconds * std::pow(fine->seconds / coarse->seconds, share);
}

double WorkPrecision::best_error() const {
  return envelope_.empty() ? std::numeric_limits<double>::infinity() : envelope_.back().error;
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

}  // namespace casimir
