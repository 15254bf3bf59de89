#include "symbolic/algebra/ideal.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

#include "symbolic/case/limits.hpp"

namespace casimir {
namespace {

using PowerProduct = std::vector<unsigned long>;

PowerProduct leading_monomial(const Polynomial& p) { return p.term_list().front().second; }

PowerProduct least_common_multiple(const PowerProduct& a, const PowerProduct& b) {
  PowerProduct result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = std::max(a[i], b[i]);
  return result;
}

bool divides(const PowerProduct& a, const PowerProduct& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](unsigned long x, unsigned long y) { return x <= y; });
}

bool coprime(const PowerProduct& a, const PowerProduct& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](unsigned long x, unsigned long y) { return std::min(x, y) == 0; });
}

unsigned long degree(const PowerProduct& m) { return std::accumulate(m.begin(), m.end(), 0UL); }

Polynomial power_product(const PolynomialRing& ring, const PowerProduct& exponents) {
  Polynomial result = ring.constant(1);
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    if (exponents[i] > 0) result *= ring.variable(i).pow(exponents[i]);
  }
  return result;
}

/// `p`, with leading coefficient 1, times what lifts its leading monomial to `multiple`.
Polynomial lifted(const Polynomial& p, const PowerProduct& leading, const PowerProduct& multiple) {
  PowerProduct factor(multiple.size());
  for (std::size_t i = 0; i < factor.size(); ++i) factor[i] = multiple[i] - leading[i];
  return p * power_product(p.ring(), factor);
}

/// Buchberger's algorithm: the pair with the smallest common multiple first, without the pairs that
/// his two criteria show to be superfluous.
class Buchberger {
 public:
  Buchberger(const std::vector<Polynomial>& generators, const GroebnerLimits& limits)
      : limits_(limits) {
    for (const Polynomial& g : generators) {
      const Polynomial rest = reduced(g);
      if (!rest.is_zero()) insert(rest);
    }
  }

  std::vector<Polynomial> basis() {
    for (std::size_t done = 0; !pairs_.empty(); ++done) {
      // What is left out below makes the rest no basis of the ideal unless everything is done.
      if (done == limits_.reductions || elements_.size() > limits_.elements) return elements_;
      const auto [size, i, j] = *pairs_.begin();
      pairs_.erase(pairs_.begin());
      const PowerProduct multiple = least_common_multiple(leading_[i], leading_[j]);
      if (superfluous(i, j, multiple)) continue;
      const Polynomial rest = reduced(lifted(elements_[i], leading_[i], multiple) -
                                      lifted(elements_[j], leading_[j], multiple));
      if (rest.terms() > limits_.terms || rest.bits() > limits_.bits) return elements_;
      if (!rest.is_zero()) insert(rest);
    }
    std::vector<Polynomial> result;
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      if (!redundant_[i]) result.push_back(elements_[i]);
    }
    return result;
  }

 private:
  /// Products of terms with long numbers count as often as these have words.
  Polynomial reduced(const Polynomial& p) const {
    constexpr double kWord = 64;
    if (elements_.empty()) return p;
    std::vector<Polynomial> quotients;
    Polynomial rest = p.remainder(elements_, &quotients);
    double products = 0;
    for (std::size_t i = 0; i < elements_.size(); ++i)
      products +=
          static_cast<double>(quotients[i].terms()) * static_cast<double>(elements_[i].terms());
    WorkMeter::spend(products * static_cast<double>(p.ring().size()) *
                     (1 + (rest.is_zero() ? 0 : rest.bits()) / kWord));
    return rest;
  }

  void insert(const Polynomial& p) {
    const std::size_t index = elements_.size();
    elements_.push_back(p.scaled(1 / p.term_list().front().first));
    leading_.push_back(leading_monomial(p));
    for (std::size_t i = 0; i < index; ++i) {
      if (redundant_[i]) {
        never_.emplace(i, index);
        continue;
      }
      redundant_[i] = divides(leading_[index], leading_[i]);
      if (!coprime(leading_[i], leading_[index])) {
        pairs_.emplace(degree(least_common_multiple(leading_[i], leading_[index])), i, index);
      }
    }
    redundant_.push_back(false);
  }

  bool done(std::size_t i, std::size_t j) const {
    const auto [first, second] = std::minmax(i, j);
    const PowerProduct multiple = least_common_multiple(leading_[first], leading_[second]);
    return !pairs_.contains({degree(multiple), first, second}) && !never_.contains({first, second});
  }

  /// Whether another element links the two by pairs that are done.
  bool superfluous(std::size_t i, std::size_t j, const PowerProduct& multiple) const {
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      if (k == i || k == j || redundant_[k] || !divides(leading_[k], multiple)) continue;
      if (done(i, k) && done(j, k)) return true;
    }
    return false;
  }

  const GroebnerLimits& limits_;
  std::vector<Polynomial> elements_;  ///< with leading coefficient 1
  std::vector<PowerProduct> leading_;
  std::vector<bool> redundant_;  ///< reduced by a later element
  std::set<std::tuple<unsigned long, std::size_t, std::size_t>> pairs_;
  std::set<std::pair<std::size_t, std::size_t>> never_;  ///< pairs with a redundant element
};

}  // namespace

std::vector<Polynomial> groebner_basis(const std::vector<Polynomial>& generators,
                                       const GroebnerLimits& limits) {
  return Buchberger(generators, limits).basis();
}

std::vector<SolvedRelation> triangular_set(
    std::vector<Polynomial> relations, std::size_t coordinates,
    const std::function<bool(const Polynomial&)>& uses_coordinates) {
  std::vector<SolvedRelation> set;
  const auto pick = [&]() -> bool {
    for (std::size_t k = 0; k < relations.size(); ++k) {
      for (std::size_t v = 0; v < coordinates; ++v) {
        if (!relations[k].uses(v)) continue;
        const bool alone = std::count_if(relations.begin(), relations.end(),
                                         [&](const Polynomial& f) { return f.uses(v); }) == 1;
        Polynomial leading = relations[k].coefficients(v).back();
        if (!alone || uses_coordinates(leading)) continue;
        set.push_back({relations[k], v, std::move(leading)});
        relations.erase(relations.begin() + static_cast<std::ptrdiff_t>(k));
        return true;
      }
    }
    return false;
  };
  while (!relations.empty()) {
    if (!pick()) return {};
  }
  return set;
}

Polynomial pseudo_remainder(const Polynomial& p, const std::vector<SolvedRelation>& set) {
  Polynomial rest = p;
  for (const SolvedRelation& solved : set) {
    const long degree = solved.relation.degree(solved.variable);
    for (long k = rest.degree(solved.variable); k >= degree; k = rest.degree(solved.variable)) {
      const Polynomial top = rest.coefficients(solved.variable).back();
      const Polynomial shift =
          p.ring().variable(solved.variable).pow(static_cast<unsigned long>(k - degree));
      rest = rest * solved.leading - top * shift * solved.relation;
    }
  }
  return rest;
}

}  // namespace casimir
