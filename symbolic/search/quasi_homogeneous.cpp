#include "symbolic/search/quasi_homogeneous.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace casimir::search {
namespace {

struct WeightedTerm {
  std::size_t rate;
  std::vector<unsigned long> exponents;
};

/// How many terms are leading; -1 where one has too much weight or a rate has no leading term.
int leading_terms(const Weights& weights, const std::vector<WeightedTerm>& terms) {
  int count = 0;
  for (const WeightedTerm& term : terms) {
    const int more = excess(weights, term.rate, term.exponents);
    if (more > 0) return -1;
    if (more == 0) ++count;
  }
  return count;
}

/// Tries all weights that are equal within groups.
void try_all(const std::vector<WeightedTerm>& terms, const std::vector<std::size_t>& group_of,
             std::size_t groups, int largest, std::optional<Weights>& best, int& best_count) {
  constexpr int kDenominators = 3;
  for (int denominator = 1; denominator <= kDenominators; ++denominator) {
    std::vector<int> choice(groups, 1);
    for (;;) {
      Weights weights{{}, denominator};
      for (const std::size_t g : group_of) weights.numerators.push_back(choice[g]);
      const int count = leading_terms(weights, terms);
      if (count > best_count) {
        best_count = count;
        best = weights;
      }
      std::size_t k = 0;
      while (k < groups && choice[k] == largest) choice[k++] = 1;
      if (k == groups) break;
      ++choice[k];
    }
  }
}

}  // namespace

int excess(const Weights& weights, std::size_t i, const std::vector<unsigned long>& exponents) {
  int sum = -weights.numerators[i] - weights.denominator;
  for (std::size_t j = 0; j < weights.numerators.size(); ++j)
    sum += weights.numerators[j] * static_cast<int>(exponents[j]);
  return sum;
}

std::optional<Weights> find_weights(const std::vector<Polynomial>& field,
                                    const std::vector<std::string>& names) {
  std::vector<WeightedTerm> terms;
  for (std::size_t i = 0; i < field.size(); ++i)
    for (auto& [number, exponents] : field[i].term_list()) terms.push_back({i, exponents});
  std::map<std::string, std::size_t> groups;
  std::vector<std::size_t> group_of, own;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t end = names[i].find_last_not_of("0123456789");
    const std::string stem = names[i].substr(0, end == std::string::npos ? 0 : end + 1);
    group_of.push_back(groups.try_emplace(stem, groups.size()).first->second);
    own.push_back(i);
  }
  std::optional<Weights> best;
  int count = 0;
  constexpr double kMostTries = 300000;
  constexpr int kLargest = 6;
  const auto tries = [](int largest, std::size_t n) {
    return std::pow(largest, static_cast<double>(n));
  };
  if (tries(kLargest, groups.size()) <= kMostTries)
    try_all(terms, group_of, groups.size(), kLargest, best, count);
  if (count < static_cast<int>(terms.size())) {
    for (int largest = 4; largest >= 2; --largest) {
      if (tries(largest, names.size()) > kMostTries) continue;
      try_all(terms, own, names.size(), largest, best, count);
      break;
    }
  }
  return best;
}

}  // namespace casimir::search
