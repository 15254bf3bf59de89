#include "symbolic/search/degree_limit.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace casimir::search {
namespace {

constexpr int kNoBound = -1;

/// The largest exponent of a place by one limit, with the bounds of the others; kNoBound where it
/// gives none.
int bound_of(const DegreeLimit& limit, std::size_t place, const std::vector<int>& highest) {
  if (limit.weights[place] <= 0) return kNoBound;
  int left = limit.degree;
  for (std::size_t i = 0; i < highest.size(); ++i) {
    if (limit.weights[i] >= 0) continue;
    if (highest[i] == kNoBound) return kNoBound;
    left -= limit.weights[i] * highest[i];
  }
  return std::max(0, left) / limit.weights[place];
}

/// The least that the places from i on can add to a limit's degree.
std::vector<int> least_rests(const DegreeLimit& limit, const std::vector<int>& highest) {
  std::vector<int> rests(highest.size() + 1, 0);
  for (std::size_t i = highest.size(); i-- > 0;)
    rests[i] = rests[i + 1] + std::min(0, limit.weights[i] * highest[i]);
  return rests;
}

}  // namespace

int DegreeLimit::of(const std::uint8_t* exponents) const {
  int sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * exponents[i];
  return sum;
}

int DegreeLimit::of(const Polynomial& p, const std::vector<std::size_t>& places) const {
  std::optional<int> highest;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    int sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      sum += weights[i] * static_cast<int>(exponents[places[i]]);
    highest = std::max(highest.value_or(sum), sum);
  }
  return highest.value_or(0);
}

std::optional<std::size_t> unbounded_place(const std::vector<DegreeLimit>& limits,
                                           std::vector<int>& highest) {
  const std::size_t places = limits.empty() ? 0 : limits[0].weights.size();
  highest.assign(places, kNoBound);
  for (bool changed = true; changed;) {
    changed = false;
    for (const DegreeLimit& limit : limits) {
      for (std::size_t i = 0; i < places; ++i) {
        const int own = bound_of(limit, i, highest);
        if (own == kNoBound || (highest[i] != kNoBound && highest[i] <= own)) continue;
        highest[i] = own;
        changed = true;
      }
    }
  }
  const auto open = std::ranges::find(highest, kNoBound);
  if (open == highest.end()) return std::nullopt;
  return static_cast<std::size_t>(open - highest.begin());
}

int highest_degree_within(const std::vector<DegreeLimit>& limits, const std::vector<int>& order,
                          const std::vector<int>& highest) {
  int bound = std::inner_product(highest.begin(), highest.end(), order.begin(), 0);
  for (const DegreeLimit& limit : limits) {
    if (std::ranges::equal(limit.weights, order, std::greater_equal<>()))
      bound = std::min(bound, limit.degree);
  }
  return bound;
}

std::optional<Monomials> monomials_within(const std::vector<DegreeLimit>& limits,
                                          const std::vector<int>& order, double most) {
  std::vector<int> highest;
  if (unbounded_place(limits, highest)) return std::nullopt;
  std::vector<std::vector<int>> rests;
  std::vector<int> left;
  for (const DegreeLimit& limit : limits) {
    rests.push_back(least_rests(limit, highest));
    left.push_back(limit.degree);
  }
  Monomials list(order.size());
  std::vector<std::uint8_t> exponents(order.size(), 0);
  bool fits = true;
  const std::function<void(std::size_t, int)> spend = [&](std::size_t i, int degree) {
    for (std::size_t l = 0; l < limits.size(); ++l)
      if (rests[l][i] > left[l]) return;
    if (i == order.size()) {
      fits = fits && static_cast<double>(list.size()) < most;
      if (fits) list.add(exponents, degree);
      return;
    }
    for (int power = highest[i]; power >= 0 && fits; --power) {
      exponents[i] = static_cast<std::uint8_t>(power);
      for (std::size_t l = 0; l < limits.size(); ++l) left[l] -= limits[l].weights[i] * power;
      spend(i + 1, degree + order[i] * power);
      for (std::size_t l = 0; l < limits.size(); ++l) left[l] += limits[l].weights[i] * power;
    }
    exponents[i] = 0;
  };
  spend(0, 0);
  if (!fits) return std::nullopt;
  std::vector<std::size_t> ascending(list.size());
  std::iota(ascending.begin(), ascending.end(), 0);
  std::ranges::stable_sort(ascending, {}, [&](std::size_t c) { return list.degree(c); });
  Monomials result(order.size());
  for (const std::size_t c : ascending)
    result.add({list[c], list[c] + order.size()}, list.degree(c));
  return result;
}

}  // namespace casimir::search
