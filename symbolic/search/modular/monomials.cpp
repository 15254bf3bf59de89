#include "symbolic/search/modular/monomials.hpp"

#include <bit>
#include <functional>
#include <numeric>
#include <random>

namespace casimir::search {

void Monomials::add(const std::vector<std::uint8_t>& exponents, int degree) {
  exponents_.insert(exponents_.end(), exponents.begin(), exponents.end());
  degrees_.push_back(degree);
}

double count_monomials(const std::vector<int>& weights, int degree) {
  std::vector<double> ways(static_cast<std::size_t>(degree) + 1, 0);
  ways[0] = 1;
  for (const int weight : weights) {
    for (auto d = static_cast<std::size_t>(weight); d < ways.size(); ++d)
      ways[d] += ways[d - static_cast<std::size_t>(weight)];
  }
  return std::accumulate(ways.begin(), ways.end(), 0.);
}

Monomials all_monomials(const std::vector<int>& weights, int degree) {
  Monomials result(weights.size());
  std::vector<std::uint8_t> exponents(weights.size(), 0);
  // Every way to spend `left` on the variables from i on.
  const std::function<void(std::size_t, int, int)> spend = [&](std::size_t i, int left, int total) {
    if (i + 1 == weights.size()) {
      if (left % weights[i] != 0) return;
      exponents[i] = static_cast<std::uint8_t>(left / weights[i]);
      result.add(exponents, total);
      return;
    }
    for (int power = left / weights[i]; power >= 0; --power) {
      exponents[i] = static_cast<std::uint8_t>(power);
      spend(i + 1, left - power * weights[i], total);
    }
  };
  for (int total = 0; total <= degree; ++total) spend(0, total, total);
  return result;
}

std::vector<std::vector<int>> products_up_to(const std::vector<int>& degrees, int degree,
                                             std::size_t old) {
  std::vector<std::vector<int>> result;
  std::vector<int> exponents(degrees.size(), 0);
  const std::function<void(std::size_t, int, bool)> choose = [&](std::size_t i, int left,
                                                                 bool fresh) {
    if (i == degrees.size()) {
      if (fresh || old == 0) result.push_back(exponents);
      return;
    }
    for (int power = 0; power * degrees[i] <= left; ++power) {
      exponents[i] = power;
      choose(i + 1, left - power * degrees[i], fresh || (i >= old && power > 0));
    }
    exponents[i] = 0;
  };
  choose(0, degree, false);
  return result;
}

std::vector<std::uint64_t> monomial_keys(std::size_t variables, int degree) {
  const int bits = std::bit_width(static_cast<unsigned>(degree));
  std::vector<std::uint64_t> keys(variables);
  if (static_cast<std::size_t>(bits) * variables <= 64) {
    for (std::size_t i = 0; i < variables; ++i)
      keys[i] = std::uint64_t{1} << (static_cast<std::size_t>(bits) * i);
    return keys;
  }
  std::mt19937_64 random(1);
  for (std::uint64_t& key : keys) key = random() | 1;
  return keys;
}

}  // namespace casimir::search
