#include "symbolic/structure/separate/separated_equation.hpp"

#include <algorithm>

#include "symbolic/structure/separate/constant_kernel.hpp"
#include "symbolic/structure/separate/with_root.hpp"

namespace casimir::structure {
namespace {

constexpr std::size_t kHighestPowerOfRoot = 8, kHighestPowerOfSum = 2, kHighestShift = 2;
constexpr std::size_t kMostTermsOfSeparated = 150000;  ///< of all columns together

struct Column {
  std::size_t power, degree, constant;
};

/// The columns of one set of equations, times one function so that no denominator is left.
std::vector<std::vector<Polynomial>> without_denominators(
    const Leaves& leaves, const std::vector<WithRoot::Element>& columns) {
  std::vector<Polynomial> all;
  for (const WithRoot::Element& own : columns) all.insert(all.end(), own.begin(), own.end());
  all = leaves.system().functions().common_numerators(std::move(all));
  std::vector<std::vector<Polynomial>> result;
  std::size_t next = 0;
  for (const WithRoot::Element& own : columns) {
    result.emplace_back();
    for (std::size_t i = 0; i < own.size(); ++i)
      result.back().push_back(leaves.reduced(all[next++]));
  }
  return result;
}

std::size_t terms_of(const WithRoot::Element& element) {
  std::size_t sum = 0;
  for (const Polynomial& p : element) sum += p.terms();
  return sum;
}

class EquationSearch {
 public:
  EquationSearch(const Leaves& leaves, const RootCoefficients& a, const Multipliers& s,
                 const std::vector<Polynomial>& integrals, std::vector<Polynomial> constants)
      : leaves_(leaves), with_root_(leaves, a), constants_(std::move(constants)) {
    sum_ = with_root_.constant(Polynomial(leaves.ring()));
    WithRoot::Element rate = sum_;
    for (std::size_t j = 0; j < s.size(); ++j) {
      const WithRoot::Element own = with_root_.reduced(s[j]);
      sum_ = with_root_.sum(sum_, with_root_.product(own, with_root_.constant(integrals[j])));
      rate = with_root_.sum(rate, with_root_.product(own, with_root_.moved(integrals[j])));
    }
    const WithRoot::Element slope = with_root_.slope();
    slope_squared_ = with_root_.product(slope, slope);
    rate_squared_ = with_root_.product(rate, rate);
  }

  /// The equation of lowest degree in G, and then in u; with a power of u before it where there is
  /// none without.
  std::optional<SeparatedEquation> run(const search::Watch& watch) {
    for (std::size_t highest = 1; highest <= kHighestPowerOfSum; ++highest) {
      for (shift_ = 0; shift_ <= (highest == 1 ? kHighestShift : 0); shift_ += 2) {
        begin(highest);
        for (std::size_t power = 0; power <= kHighestPowerOfRoot; ++power) {
          if (!add_power(power)) break;
          if (auto result = solved(watch)) return result;
        }
      }
    }
    return std::nullopt;
  }

 private:
  void begin(std::size_t highest) {
    columns_.assign(1, rate_squared_);
    for (std::size_t k = 0; k < shift_; ++k)
      columns_[0] = with_root_.product(columns_[0], with_root_.root());
    places_.clear();
    powers_of_sum_.assign(1, slope_squared_);
    while (powers_of_sum_.size() <= highest)
      powers_of_sum_.push_back(with_root_.product(powers_of_sum_.back(), sum_));
    terms_ = terms_of(columns_.front());
  }
  /// False where the polynomials become too long.
  bool add_power(std::size_t power) {
    for (std::size_t degree = 0; degree < powers_of_sum_.size(); ++degree) {
      WithRoot::Element& own = powers_of_sum_[degree];
      if (power > 0) own = with_root_.product(own, with_root_.root());
      for (std::size_t c = 0; c < constants_.size(); ++c) {
        places_.push_back({power, degree, c});
        columns_.push_back(with_root_.product(own, with_root_.constant(constants_[c])));
        terms_ += terms_of(columns_.back());
      }
    }
    return terms_ <= kMostTermsOfSeparated;
  }

  std::optional<SeparatedEquation> solved(const search::Watch& watch) const {
    const std::vector<std::vector<Polynomial>> columns = without_denominators(leaves_, columns_);
    for (const ParametricRow& solution : constant_kernel(leaves_.system(), columns, watch).basis) {
      if (!solution.contains(0)) continue;
      std::vector<Polynomial> sums(columns.front().size(), Polynomial(leaves_.ring()));
      SeparatedEquation result{{}, solution.at(0), shift_};
      for (const auto& [k, number] : solution) {
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += number * columns[k][i];
        if (k == 0) continue;
        const Column& own = places_[k - 1];
        result.terms.push_back({own.power, own.degree, -(number * constants_[own.constant])});
      }
      if (std::ranges::all_of(sums, [&](const Polynomial& p) { return leaves_.vanishes(p); }))
        return result;
    }
    return std::nullopt;
  }

  const Leaves& leaves_;
  WithRoot with_root_;
  std::vector<Polynomial> constants_;
  WithRoot::Element sum_, slope_squared_, rate_squared_;  ///< the last of D'(u) {u, G}
  std::size_t shift_ = 0;
  std::vector<WithRoot::Element> powers_of_sum_;
  std::vector<WithRoot::Element> columns_;  ///< what is to be a sum of the others first
  std::vector<Column> places_;              ///< of the others
  std::size_t terms_ = 0;
};

}  // namespace

std::optional<SeparatedEquation> separated_equation(const Leaves& leaves, const RootCoefficients& a,
                                                    const Multipliers& s,
                                                    const std::vector<Polynomial>& integrals,
                                                    const std::vector<Polynomial>& casimirs,
                                                    const search::Watch& watch) {
  return EquationSearch(leaves, a, s, integrals, leaf_constants(leaves, casimirs)).run(watch);
}

}  // namespace casimir::structure
