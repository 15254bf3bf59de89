#include "symbolic/search/modular/shorten.hpp"

#include <algorithm>
#include <map>

namespace casimir::search {
namespace {

/// What an entry costs that is this many times the unit: 2 for 1 and -1, more for other numbers.
int cost_of(Residue ratio, const Modulus& modulus) {
  constexpr int kUnit = 4, kSmall = 5, kFraction = 6, kOther = 9;
  if (ratio == 1 || ratio == modulus.prime() - 1) return kUnit;
  constexpr Residue kSmallest = 16;
  for (Residue d = 1; d <= 4; ++d) {
    const Residue n = modulus.multiply(ratio, d);
    if (n <= kSmallest || n >= modulus.prime() - kSmallest) return d == 1 ? kSmall : kFraction;
  }
  return kOther;
}

/// The cost of a vector where its most frequent entry, up to the sign, is the unit.
long cost_of(const std::vector<Residue>& vector, const Modulus& modulus) {
  std::map<Residue, long> counts;
  for (const Residue r : vector)
    if (r != 0) ++counts[std::min(r, modulus.prime() - r)];
  if (counts.empty()) return 0;
  long best = -1;
  // Several may be equally frequent: the cheapest counts.
  long most = 0;
  for (const auto& [value, count] : counts) most = std::max(most, count);
  int tries = 0;
  for (const auto& [unit, unit_count] : counts) {
    constexpr int kTries = 4;
    if (unit_count < most || ++tries > kTries) continue;
    const Residue inverse = modulus.inverse(unit);
    long cost = 0;
    for (const auto& [value, count] : counts)
      cost += count * cost_of(modulus.multiply(value, inverse), modulus);
    if (best < 0 || cost < best) best = cost;
  }
  return best;
}

std::vector<Residue> plus_multiple(const std::vector<Residue>& vector,
                                   const std::vector<Residue>& other, Residue factor,
                                   const Modulus& modulus) {
  std::vector<Residue> result(vector.size());
  for (std::size_t i = 0; i < vector.size(); ++i)
    result[i] = modulus.reduce(vector[i] + std::uint64_t{factor} * other[i]);
  return result;
}

/// The factors by which a multiple of `other` makes some entry zero, or two entries equal up to the
/// sign.
std::vector<Residue> useful_factors(const std::vector<Residue>& vector,
                                    const std::vector<Residue>& other, const Modulus& modulus) {
  std::map<Residue, int> votes;
  const auto vote = [&](Residue top, Residue bottom, int weight) {
    if (bottom == 0 || top == 0) return;
    votes[modulus.negative(modulus.multiply(top, modulus.inverse(bottom)))] += weight;
  };
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < vector.size(); ++i) {
    if (other[i] != 0) vote(vector[i], other[i], 2);
    if (vector[i] != 0 || other[i] != 0) places.push_back(i);
  }
  constexpr std::size_t kFewPlaces = 40;
  if (places.size() <= kFewPlaces) {
    for (std::size_t a = 0; a < places.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const std::size_t i = places[a], j = places[b];
        vote(modulus.add(vector[i], modulus.negative(vector[j])),
             modulus.add(other[i], modulus.negative(other[j])), 1);
        vote(modulus.add(vector[i], vector[j]), modulus.add(other[i], other[j]), 1);
      }
    }
  }
  std::vector<std::pair<int, Residue>> order;
  for (const auto& [factor, count] : votes) order.emplace_back(-count, factor);
  std::sort(order.begin(), order.end());
  constexpr std::size_t kTries = 24;
  if (order.size() > kTries) order.resize(kTries);
  std::vector<Residue> result;
  for (const auto& [count, factor] : order) result.push_back(factor);
  return result;
}

}  // namespace

std::vector<Residue> shortened(std::vector<Residue> vector,
                               const std::vector<std::vector<Residue>>& others,
                               const Modulus& modulus) {
  long cost = cost_of(vector, modulus);
  constexpr int kRounds = 20;
  for (int round = 0; round < kRounds; ++round) {
    const long before = cost;
    for (const std::vector<Residue>& other : others) {
      for (const Residue factor : useful_factors(vector, other, modulus)) {
        std::vector<Residue> candidate = plus_multiple(vector, other, factor, modulus);
        const long candidate_cost = cost_of(candidate, modulus);
        if (candidate_cost >= cost) continue;
        cost = candidate_cost;
        vector = std::move(candidate);
      }
    }
    if (cost == before) break;
  }
  return vector;
}

}  // namespace casimir::search
