#include "runtime/ensemble/part_of_step.hpp"

#include <algorithm>
#include <cstdint>

namespace casimir {
namespace {

/// Horner's scheme, again and again: from a polynomial in s to that in s - from, in each lane.
/// Where the number of lanes is known a register does them at once.
template <std::size_t lanes>
void shift(double* c, int order, const double* from) {
  for (int done = 0; done < order; ++done)
    for (int k = order - 1; k >= done; --k) {
      double* const at = c + static_cast<std::size_t>(k) * lanes;
      for (std::size_t lane = 0; lane < lanes; ++lane) at[lane] += from[lane] * at[lane + lanes];
    }
}

void shift(double* c, int order, const double* from, std::size_t lanes) {
  if (lanes == 8)
    shift<8>(c, order, from);
  else if (lanes == 4)
    shift<4>(c, order, from);
  else
    shift<2>(c, order, from);
}

}  // namespace

const casimir_lane_step& PartOfStep::take(const casimir_lane_step& whole, std::int64_t which,
                                          std::int64_t parts) {
  const auto lanes = static_cast<std::size_t>(whole.lanes),
             entries = static_cast<std::size_t>(whole.order + 1) * lanes,
             states = static_cast<std::size_t>(whole.states);
  constexpr std::size_t kAligned = 8;  // numbers in the widest register
  step_ = whole;
  times_.assign(2 * kAligned, 0);
  lengths_.assign(2 * kAligned, 0);
  memory_.resize(states * entries + kAligned);
  rows_.resize(states);
  const auto aligned = [](std::vector<double>& numbers) {
    const auto address = reinterpret_cast<std::uintptr_t>(numbers.data());
    return numbers.data() + (64 - address % 64) % 64 / sizeof(double);
  };
  double *const times = aligned(times_), *const lengths = aligned(lengths_),
                *const memory = aligned(memory_);
  std::vector<double> from(lanes);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    from[lane] = whole.taken[lane] * static_cast<double>(which) / static_cast<double>(parts);
    lengths[lane] = whole.taken[lane] / static_cast<double>(parts);
    times[lane] = whole.t[lane] + from[lane] * whole.unit[lane];
  }
  for (std::size_t i = 0; i < states; ++i) {
    double* const c = memory + i * entries;
    std::copy_n(whole.rows[i], entries, c);
    shift(c, whole.order, from.data(), lanes);
    rows_[i] = c;
  }
  step_.rows = rows_.data();
  step_.t = times;
  step_.taken = lengths;
  return step_;
}

}  // namespace casimir
