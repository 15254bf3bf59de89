#include "symbolic/search/modular/samples.hpp"

#include <algorithm>
#include <stdexcept>

namespace casimir::search {

Samples::Samples(const System& system, const Fields& fields, const Modulus& modulus,
                 std::uint64_t seed)
    : system_(system), fields_(fields), modulus_(modulus), random_(seed) {
  for (const std::vector<Polynomial>& rates : fields.plain) {
    rates_.emplace_back();
    for (const Polynomial& rate : rates) rates_.back().push_back(flat(rate));
  }
}

Samples::Terms Samples::flat(const Polynomial& p) const {
  Terms result;
  for (const auto& [number, exponents] : p.term_list()) {
    const std::optional<Residue> residue = modulus_.reduce(number);
    if (!residue) throw std::domain_error("the prime divides a denominator");
    result.push_back({*residue, {}});
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] != 0)
        result.back().powers.emplace_back(static_cast<std::uint32_t>(i),
                                          static_cast<std::uint32_t>(exponents[i]));
    }
  }
  return result;
}

Residue Samples::value(const Terms& terms, const Point& point) const {
  Residue sum = 0;
  for (const Term& term : terms) {
    Residue product = term.number;
    for (const auto& [place, exponent] : term.powers) {
      const Residue factor = exponent == 1 ? point[place] : modulus_.power(point[place], exponent);
      product = modulus_.multiply(product, factor);
    }
    sum = modulus_.add(sum, product);
  }
  return sum;
}

/// Of several fields a random combination, another one for each point, says as much as all of them.
/// \return  false where a variable is zero, which has no growth
bool Samples::add(Point point) {
  Sample sample{std::move(point), std::vector<Residue>(fields_.places.size(), 0)};
  for (const std::size_t place : fields_.places)
    if (sample.point[place] == 0) return false;
  for (const std::vector<Terms>& rates : rates_) {
    const Residue share = rates_.size() == 1 ? 1 : modulus_.random(random_);
    for (std::size_t i = 0; i < rates.size(); ++i) {
      if (rates[i].empty()) continue;
      const Residue rate = modulus_.multiply(share, value(rates[i], sample.point));
      sample.growth[i] = modulus_.add(sample.growth[i], rate);
    }
  }
  for (std::size_t i = 0; i < fields_.places.size(); ++i) {
    if (sample.growth[i] == 0) continue;
    const Residue inverse = modulus_.inverse(sample.point[fields_.places[i]]);
    sample.growth[i] = modulus_.multiply(sample.growth[i], inverse);
  }
  samples_.push_back(std::move(sample));
  return true;
}

bool Samples::draw(std::size_t count, const Point* constants,
                   const std::vector<std::size_t>& parameters, const Watch& watch) {
  constexpr int kTries = 50;  // each of many itself
  constexpr std::size_t kBetweenTicks = 64;
  int failures = 0;
  while (samples_.size() < count) {
    if (samples_.size() % kBetweenTicks == 0) watch.tick(0);
    std::optional<Point> own;
    if (constants == nullptr) {
      own = system_.random_point(modulus_, random_);
      for (const std::size_t place : parameters)
        if (own) (*own)[place] = modulus_.random(random_);
    }
    const Point* fixed = constants != nullptr ? constants : own ? &*own : nullptr;
    std::optional<Point> point;
    if (fixed != nullptr) point = system_.random_point(modulus_, random_, fixed);
    if (point && add(std::move(*point))) continue;
    if (++failures > kTries) return false;
  }
  return true;
}

std::vector<std::vector<Entry>> Samples::rows(Goal goal, const Monomials& monomials,
                                              const std::vector<std::uint32_t>& columns,
                                              const std::vector<std::size_t>& places,
                                              std::size_t rows) const {
  std::vector<std::vector<Entry>> result(rows);
  std::vector<std::uint8_t> highest(places.size(), 0);
  for (const std::uint32_t c : columns)
    for (std::size_t i = 0; i < places.size(); ++i)
      highest[i] = std::max(highest[i], monomials[c][i]);
  for (std::size_t r = 0; r < rows; ++r) {
    const Sample& sample = samples_[r];
    std::vector<std::vector<Residue>> powers(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      powers[i].push_back(1);
      for (int k = 0; k < highest[i]; ++k)
        powers[i].push_back(modulus_.multiply(powers[i].back(), sample.point[places[i]]));
    }
    result[r].reserve(columns.size());
    for (std::uint32_t k = 0; k < columns.size(); ++k) {
      const std::uint8_t* exponents = monomials[columns[k]];
      Residue own = 1;
      std::uint64_t growth = 0;
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (exponents[i] == 0) continue;
        own = modulus_.multiply(own, powers[i][exponents[i]]);
        // What follows the fields' variables are parameters, which rest.
        if (i < sample.growth.size()) growth += std::uint64_t{exponents[i]} * sample.growth[i];
      }
      if (goal == Goal::annihilated) own = modulus_.multiply(own, modulus_.reduce(growth));
      if (own != 0) result[r].push_back({k, own});
    }
  }
  return result;
}

}  // namespace casimir::search
