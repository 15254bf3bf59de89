#include "symbolic/search/own_weights.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "symbolic/search/modular/grading.hpp"
#include "symbolic/search/modular/linear_map.hpp"

namespace casimir::search {
namespace {

/// How little one would want them: first come those with the fewest that are not positive, then
/// those with the smallest numbers, and of two that differ in sign that which begins positively.
std::vector<long> rank_of(const std::vector<int>& weights) {
  long not_positive = 0, sum = 0, largest = 0;
  for (const int weight : weights) {
    not_positive += weight <= 0 ? 1 : 0;
    sum += std::abs(weight);
    largest = std::max<long>(largest, std::abs(weight));
  }
  const auto first = std::ranges::find_if(weights, [](int weight) { return weight != 0; });
  return {not_positive, largest, sum, first != weights.end() && *first < 0 ? 1 : 0};
}

}  // namespace

std::optional<std::vector<int>> own_weights(const System& system) {
  constexpr int kLargestFactor = 3;
  constexpr std::size_t kMostFactors = 5;
  constexpr std::int64_t kLargestWeight = 1000;
  const Fields fields{system.atoms(), {system.flow()}, {system.plain_flow()}};
  const std::vector<std::vector<std::int64_t>> basis = Grading(system, fields).weights();
  std::vector<std::int64_t> sum(system.atoms().size(), 0);
  std::optional<std::vector<int>> best;
  const auto take = [&] {
    std::int64_t divisor = 0;
    for (const std::int64_t w : sum) divisor = std::gcd(divisor, w);
    if (divisor == 0) return;
    std::vector<int> own;
    for (const std::int64_t w : sum) {
      if (std::abs(w / divisor) > kLargestWeight) return;
      own.push_back(static_cast<int>(w / divisor));
    }
    if (!best || rank_of(own) < rank_of(*best)) best = std::move(own);
  };
  const std::size_t count = std::min(basis.size(), kMostFactors);
  const std::function<void(std::size_t)> combine = [&](std::size_t k) {
    if (k == count) return take();
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] -= kLargestFactor * basis[k][i];
    for (int factor = -kLargestFactor; factor <= kLargestFactor; ++factor) {
      combine(k + 1);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += basis[k][i];
    }
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] -= (kLargestFactor + 1) * basis[k][i];
  };
  combine(0);
  return best;
}

}  // namespace casimir::search
