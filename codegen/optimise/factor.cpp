#include "codegen/optimise/factor.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>
#include <utility>

namespace casimir::codegen {

namespace {

constexpr std::size_t kMostPairs = 100'000;

int chain(int exponent) {
  const auto e = static_cast<unsigned>(exponent);
  return std::bit_width(e) - 1 + std::popcount(e) - 1;
}

/// Multiplications in a term.
int cost(const cln::cl_RA& coefficient, const Monomial& monomial) {
  if (monomial.empty()) return 0;
  int result = static_cast<int>(monomial.size()) - 1 + (cln::abs(coefficient) == 1 ? 0 : 1);
  for (const VariablePower& l : monomial) result += chain(l.exponent);
  return result;
}

int cost(const Term& term) { return cost(term.coefficient, term.monomial); }

Monomial common(const Monomial& a, const Monomial& b) {
  Monomial result;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (i->variable == j->variable) {
      result.push_back({i->variable, std::min(i->exponent, j->exponent)});
      ++i, ++j;
    } else if (i->variable < j->variable) {
      ++i;
    } else {
      ++j;
    }
  }
  return result;
}

/// a / b, where b divides a.
Monomial quotient(const Monomial& a, const Monomial& b) {
  Monomial result;
  auto j = b.begin();
  for (const VariablePower& l : a) {
    if (j == b.end() || j->variable != l.variable) {
      result.push_back(l);
    } else {
      if (l.exponent > j->exponent) result.push_back({l.variable, l.exponent - j->exponent});
      ++j;
    }
  }
  return result;
}

/// A term of a polynomial variable.
struct Place {
  int variable;
  int slot;
  friend auto operator<=>(const Place&, const Place&) = default;
};

/// first + ratio * second, up to a factor: indices of monomials and of the ratio; or, for products
/// (ratio = kMonomial), two variables, the first of which may stand for a coefficient.
using Key = std::array<int, 3>;
constexpr int kMonomial = -1;

/// Where the two terms of a sum stand. For a product, both are the one term.
struct Occurrence {
  Place first;
  Place second;
  friend auto operator<=>(const Occurrence&, const Occurrence&) = default;
};

/// What taking out a candidate would give.
struct Extraction {
  int gain = 0;
  Polynomial definition;
  std::vector<std::pair<Occurrence, Term>> replacements;
};

class Factoring {
 public:
  Factoring(const TermSystem& system, Preference preference)
      : system_(system), preference_(preference) {
    std::size_t pairs = 0;
    for (const Variable& v : system.variables) pairs += v.value.size() * v.value.size() / 2;
    with_sums_ = pairs <= kMostPairs;
    slots_.resize(system.variables.size());
    for (std::size_t v = 0; v < system.variables.size(); ++v) {
      if (system.variables[v].constant) continue;
      int slot = 0;
      for (const Term& t : system.variables[v].value) insert({static_cast<int>(v), slot++}, t);
    }
  }

  TermSystem run() {
    refresh();
    while (!ranking_.empty()) {
      const Key best = ranking_.begin()->second;
      apply(evaluate(best));
      refresh();
    }
    for (std::size_t v = 0; v < slots_.size(); ++v) {
      if (system_.variables[v].constant) continue;
      system_.variables[v].value.clear();
      for (const auto& [slot, term] : slots_[v]) system_.variables[v].value.push_back(term);
    }
    return std::move(system_);
  }

 private:
  const Term& at(const Place& place) const {
    return slots_[static_cast<std::size_t>(place.variable)].at(place.slot);
  }

  // --- the table of candidates, kept up to date term by term

  void insert(const Place& place, const Term& term) {
    auto& polynomial = slots_[static_cast<std::size_t>(place.variable)];
    polynomial.emplace(place.slot, term);
    update(place, [this](const Key& key, const Occurrence& o) { table_[key].insert(o); });
  }

  void remove(const Place& place) {
    update(place, [this](const Key& key, const Occurrence& o) { table_[key].erase(o); });
    slots_[static_cast<std::size_t>(place.variable)].erase(place.slot);
  }

  template <class Change>
  void update(const Place& place, const Change& change) {
    const auto& polynomial = slots_[static_cast<std::size_t>(place.variable)];
    const Term& term = polynomial.at(place.slot);
    if (with_sums_) {
      for (const auto& [slot, other] : polynomial) {
        if (slot == place.slot) continue;
        const auto [key, occurrence] = sum_of(place, term, {place.variable, slot}, other);
        change(key, occurrence);
        dirty_.insert(key);
      }
    }
    for (const Key& key : products_in(term)) {
      change(key, {place, place});
      dirty_.insert(key);
    }
  }

  std::pair<Key, Occurrence> sum_of(const Place& p, const Term& s, const Place& q, const Term& t) {
    const Monomial cube = common(s.monomial, t.monomial);
    Monomial first = quotient(s.monomial, cube);
    Monomial second = quotient(t.monomial, cube);
    if (second < first) return sum_of(q, t, p, s);
    const cln::cl_RA ratio = t.coefficient / s.coefficient;
    return {{index_of(first), index_of(second), index_of(ratio)}, {p, q}};
  }

  std::vector<Key> products_in(const Term& term) {
    std::vector<Key> result;
    const Monomial& m = term.monomial;
    for (std::size_t i = 0; i < m.size(); ++i) {
      if (cln::abs(term.coefficient) != 1) {
        result.push_back({-2 - index_of(cln::abs(term.coefficient)), m[i].variable, kMonomial});
      }
      if (m[i].exponent > 1) result.push_back({m[i].variable, m[i].variable, kMonomial});
      for (std::size_t j = i + 1; j < m.size(); ++j) {
        result.push_back({m[i].variable, m[j].variable, kMonomial});
      }
    }
    return result;
  }

  int index_of(const Monomial& monomial) {
    const auto [place, is_new] =
        monomial_index_.try_emplace(monomial, static_cast<int>(monomials_.size()));
    if (is_new) monomials_.push_back(monomial);
    return place->second;
  }

  int index_of(const cln::cl_RA& ratio) {
    const auto [place, is_new] = ratio_index_.try_emplace(ratio, static_cast<int>(ratios_.size()));
    if (is_new) ratios_.push_back(ratio);
    return place->second;
  }

  /// Brings the ranking in line with the table.
  void refresh() {
    for (const Key& key : dirty_) {
      if (const auto old = rank_.find(key); old != rank_.end()) {
        ranking_.erase({old->second, key});
        rank_.erase(old);
      }
      const auto entry = table_.find(key);
      if (entry->second.empty()) {
        table_.erase(entry);
        continue;
      }
      const int gain = evaluate(key).gain;
      if (gain <= 0) continue;
      const bool is_product = key[2] == kMonomial;
      const bool first = preference_ == Preference::best
                             ? !is_product
                             : is_product == (preference_ == Preference::products);
      const Rank rank =
          preference_ == Preference::best ? Rank{-gain, first ? 0 : 1} : Rank{first ? 0 : 1, -gain};
      rank_[key] = rank;
      ranking_.insert({rank, key});
    }
    dirty_.clear();
  }

  // --- what a candidate is worth

  Extraction evaluate(const Key& key) const {
    return key[2] == kMonomial ? evaluate_product(key) : evaluate_sum(key);
  }

  Extraction evaluate_product(const Key& key) const {
    const int next = static_cast<int>(system_.variables.size());
    Extraction result;
    Term definition{1, {{key[1], 1}}};
    if (key[0] < 0) {
      definition.coefficient = ratios_[static_cast<std::size_t>(-2 - key[0])];
    } else {
      definition.monomial = multiply({{key[0], 1}}, definition.monomial);
    }
    result.gain = -cost(definition);
    for (const Occurrence& o : table_.at(key)) {
      const Term& term = at(o.first);
      Term replaced = term;
      Monomial divisor = definition.monomial;
      if (key[0] < 0) replaced.coefficient = cln::minusp(term.coefficient) ? -1 : 1;
      int times = 1;
      while (key[0] >= 0 &&
             quotient_exists(replaced.monomial, multiply(divisor, definition.monomial))) {
        divisor = multiply(divisor, definition.monomial);
        ++times;
      }
      replaced.monomial = multiply(quotient(term.monomial, divisor), {{next, times}});
      result.gain += cost(term) - cost(replaced);
      result.replacements.push_back({o, std::move(replaced)});
    }
    result.definition = {definition};
    return result;
  }

  static bool quotient_exists(const Monomial& a, const Monomial& b) { return common(a, b) == b; }

  Extraction evaluate_sum(const Key& key) const {
    const Monomial& first = monomials_[static_cast<std::size_t>(key[0])];
    const Monomial& second = monomials_[static_cast<std::size_t>(key[1])];
    const cln::cl_RA& ratio = ratios_[static_cast<std::size_t>(key[2])];
    const auto& occurrences = table_.at(key);
    if (occurrences.size() == 1 && at(occurrences.begin()->first).monomial == first &&
        cln::abs(at(occurrences.begin()->first).coefficient) == 1) {
      return {};
    }
    std::vector<Occurrence> disjoint;
    std::set<Place> used;
    int before = 0;
    for (const Occurrence& o : occurrences) {
      if (used.contains(o.first) || used.contains(o.second)) continue;
      used.insert({o.first, o.second});
      disjoint.push_back(o);
      before += cost(at(o.first)) + cost(at(o.second)) + 1;
    }
    Extraction best;
    for (const cln::cl_RA& scale : scales(ratio, disjoint)) {
      Extraction e = scaled_sum(first, second, ratio, scale, disjoint);
      e.gain += before;
      if (best.definition.empty() || e.gain > best.gain) best = std::move(e);
    }
    return best;
  }

  /// The multiples scale * (first + ratio * second) that may be the cheapest to define.
  std::vector<cln::cl_RA> scales(const cln::cl_RA& ratio,
                                 const std::vector<Occurrence>& occurrences) const {
    std::vector<cln::cl_RA> result{cln::denominator(ratio), 1, 1 / cln::abs(ratio)};
    for (std::size_t i = 0; i < std::min<std::size_t>(3, occurrences.size()); ++i) {
      result.push_back(cln::abs(at(occurrences[i].first).coefficient));
    }
    return result;
  }

  Extraction scaled_sum(const Monomial& first, const Monomial& second, const cln::cl_RA& ratio,
                        const cln::cl_RA& scale, const std::vector<Occurrence>& places) const {
    const int next = static_cast<int>(system_.variables.size());
    Extraction result;
    result.definition = {{scale, first}, {scale * ratio, second}};
    result.gain = -cost(result.definition[0]) - cost(result.definition[1]) - 1;
    for (const Occurrence& o : places) {
      const Term& term = at(o.first);
      Term replaced{term.coefficient / scale,
                    multiply(quotient(term.monomial, first), {{next, 1}})};
      result.gain -= cost(replaced);
      result.replacements.push_back({o, std::move(replaced)});
    }
    return result;
  }

  void apply(const Extraction& extraction) {
    Variable variable;
    variable.kind = Variable::Kind::polynomial;
    variable.value = extraction.definition;
    const int added = system_.add(std::move(variable));
    slots_.emplace_back();
    for (const auto& [occurrence, term] : extraction.replacements) {
      remove(occurrence.first);
      if (occurrence.second != occurrence.first) remove(occurrence.second);
      insert(std::min(occurrence.first, occurrence.second), term);
    }
    int slot = 0;
    for (const Term& t : extraction.definition) insert({added, slot++}, t);
  }

  using Rank = std::pair<int, int>;

  TermSystem system_;
  Preference preference_;
  bool with_sums_ = true;
  std::vector<std::map<int, Term>> slots_;
  std::map<Monomial, int> monomial_index_;
  std::vector<Monomial> monomials_;
  std::map<cln::cl_RA, int> ratio_index_;
  std::vector<cln::cl_RA> ratios_;
  std::map<Key, std::set<Occurrence>> table_;
  std::map<Key, Rank> rank_;
  std::set<std::pair<Rank, Key>> ranking_;
  std::set<Key> dirty_;
};

}  // namespace

TermSystem factored(const TermSystem& system, Preference preference) {
  return Factoring(system, preference).run();
}

}  // namespace casimir::codegen
