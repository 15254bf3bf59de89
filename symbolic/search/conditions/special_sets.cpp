#include "symbolic/search/conditions/special_sets.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "symbolic/search/conditions/rank_conditions.hpp"

namespace casimir::search {
namespace {

constexpr double kMostWorkOfSets = 4e9;  // operations modulo a prime
constexpr std::size_t kMostSets = 40;

class SetSearch {
 public:
  SetSearch(const System& system, const std::vector<ParametricBlock>& blocks,
            const std::vector<std::size_t>& free, const Watch& watch);

  std::vector<SpecialSet> run(const std::vector<Polynomial>& surfaces);

 private:
  using Conditions = std::vector<Polynomial>;
  struct Known {
    Conditions conditions;
    std::size_t rank;
  };
  void add(std::vector<Polynomial>& list, Polynomial condition) const;
  void collect();
  std::optional<std::size_t> solvable(const Polynomial& condition) const;
  std::optional<SpecialSet> solved(const Conditions& conditions) const;
  static Polynomial reduced(Polynomial p, const SpecialSet& set);
  std::size_t rank_at(const SpecialSet& set) const;
  std::size_t rank_around(const SpecialSet& set) const;
  void look_at(const Conditions& conditions);
  void look_for_factors(const Polynomial& condition);
  bool spent() const { return work_ > kMostWorkOfSets || found_.size() >= kMostSets; }

  const System& system_;
  const std::vector<std::size_t>& free_;
  const Watch& watch_;
  std::vector<ParametricBlock> blocks_;
  std::vector<Polynomial> simple_, further_;
  double cost_ = 0;  ///< of a rank
  mutable double work_ = 0;
  std::size_t generic_ = 0;
  std::vector<Known> known_;
  std::vector<SpecialSet> found_;
};

SetSearch::SetSearch(const System& system, const std::vector<ParametricBlock>& blocks,
                     const std::vector<std::size_t>& free, const Watch& watch)
    : system_(system), free_(free), watch_(watch) {
  for (ParametricBlock block : blocks) {
    block.eliminate_constants();
    const bool matters = std::any_of(block.rows.begin(), block.rows.end(), [&](const auto& row) {
      return std::any_of(row.begin(), row.end(), [&](const auto& entry) {
        return std::any_of(free.begin(), free.end(),
                           [&](std::size_t p) { return entry.second.uses(p); });
      });
    });
    if (!matters) continue;
    const auto rows = static_cast<double>(block.rows.size());
    const auto columns = static_cast<double>(block.columns);
    cost_ += rows * columns * (std::min(rows, columns) + 50);
    blocks_.push_back(std::move(block));
  }
}

/// A parameter that is a polynomial in the others there.
std::optional<std::size_t> SetSearch::solvable(const Polynomial& condition) const {
  for (const std::size_t p : free_)
    if (condition.degree(p) == 1 && condition.coefficients(p)[1].is_constant()) return p;
  return std::nullopt;
}

void SetSearch::add(std::vector<Polynomial>& list, Polynomial condition) const {
  if (condition.is_constant() || !solvable(condition)) return;
  condition = condition.scaled(1 / condition.content());
  for (const auto* other : {&simple_, &further_})
    if (std::find(other->begin(), other->end(), condition) != other->end()) return;
  list.push_back(std::move(condition));
}

void SetSearch::collect() {
  const PolynomialRing& ring = system_.ring();
  const Polynomial one = ring.constant(1);
  std::vector<std::size_t> others;
  for (const std::size_t p : system_.parameters())
    if (p < system_.functions().symbols().size()) others.push_back(p);
  for (const std::size_t p : free_) add(simple_, ring.variable(p));
  constexpr std::size_t kMostTerms = 4, kMostFactors = 40;
  for (const ParametricBlock& block : blocks_) {
    for (const auto& row : block.rows) {
      for (const auto& [column, entry] : row) {
        if (entry.terms() > kMostTerms * kMostTerms || simple_.size() > kMostFactors) continue;
        for (const auto& [factor, exponent] : entry.factors())
          if (factor.terms() <= kMostTerms) add(simple_, factor);
      }
    }
  }
  for (const std::size_t p : free_) {
    const Polynomial v = ring.variable(p);
    add(simple_, v - one);
    for (const std::size_t q : others)
      if (q != p) add(simple_, v - ring.variable(q));
  }
  for (const std::size_t p : free_) {
    const Polynomial v = ring.variable(p);
    for (const int n : {2, -1, -2, 3, 4}) add(further_, v - ring.constant(n));
    add(further_, v + v - one);
    for (const std::size_t q : others) {
      if (q == p) continue;
      add(further_, v + ring.variable(q));
      add(further_, v - ring.variable(q).scaled(2));
      add(further_, v.scaled(2) - ring.variable(q));
    }
  }
}

Polynomial SetSearch::reduced(Polynomial p, const SpecialSet& set) {
  const Polynomial one = p.ring().constant(1);
  for (const auto& [place, value] : set.values) p = substituted(p, place, value, one);
  return p;
}

/// One condition after the other; empty where one follows from those before it, or contradicts.
std::optional<SpecialSet> SetSearch::solved(const Conditions& conditions) const {
  SpecialSet set;
  for (const Polynomial& condition : conditions) {
    const Polynomial own = reduced(condition, set);
    const std::optional<std::size_t> place = solvable(own);
    if (!place) return std::nullopt;
    const std::vector<Polynomial> parts = own.coefficients(*place);
    const Polynomial value = parts[0].scaled(-1 / parts[1].term_list()[0].first);
    for (auto& [earlier, old] : set.values)
      old = substituted(old, *place, value, old.ring().constant(1));
    set.values.emplace_back(*place, value);
  }
  return set;
}

/// The larger of the ranks at two random points modulo two primes.
std::size_t SetSearch::rank_at(const SpecialSet& set) const {
  std::size_t best = 0;
  for (const std::size_t i : {0, 1}) {
    const Modulus modulus = Modulus::nth(i);
    std::mt19937_64 random(91 + i);
    std::optional<Point> point = system_.random_point(modulus, random);
    if (!point) continue;
    for (const auto& [place, value] : set.values)
      (*point)[place] = value_at(value, *point, modulus).value_or(0);
    std::size_t rank = 0;
    for (const ParametricBlock& block : blocks_) {
      DenseRows matrix = block.at(*point, modulus);
      rank += reduce_rows(matrix, modulus).size();
    }
    best = std::max(best, rank);
    work_ += cost_;
  }
  watch_.tick(std::min(1., work_ / kMostWorkOfSets));
  return best;
}

/// The least rank on what is known and contains the set.
std::size_t SetSearch::rank_around(const SpecialSet& set) const {
  std::size_t least = generic_;
  for (const Known& known : known_) {
    const bool contains =
        std::all_of(known.conditions.begin(), known.conditions.end(),
                    [&](const Polynomial& c) { return reduced(c, set).is_zero(); });
    if (contains) least = std::min(least, known.rank);
  }
  return least;
}

void SetSearch::look_at(const Conditions& conditions) {
  if (spent()) return;
  std::optional<SpecialSet> set = solved(conditions);
  if (!set) return;
  const std::size_t rank = rank_at(*set);
  if (rank >= rank_around(*set)) return;
  Conditions own;
  for (const auto& [place, value] : set->values)
    own.push_back(system_.ring().variable(place) - value);
  known_.push_back({own, rank});
  found_.push_back(std::move(*set));
}

/// Where the condition holds, common factors of minors that are not there in general.
void SetSearch::look_for_factors(const Polynomial& condition) {
  constexpr std::size_t kLargest = 16, kMostFactors = 6;
  const std::optional<SpecialSet> set = solved({condition});
  if (!set) return;
  std::vector<std::size_t> rest = free_;
  std::erase(rest, set->values[0].first);
  for (ParametricBlock block : blocks_) {
    if (spent() || block.columns > kLargest || block.rows.size() > 4 * kLargest) continue;
    block.put(set->values[0].first, set->values[0].second);
    if (block.rows.empty()) continue;
    work_ += kMostWorkOfSets / 500;
    const RankConditions own = rank_conditions(system_, block, rest, watch_);
    if (own.factors.size() > kMostFactors) continue;
    for (const Polynomial& factor : own.factors) look_at({condition, factor});
  }
}

std::vector<SpecialSet> SetSearch::run(const std::vector<Polynomial>& surfaces) {
  // A bound parameter could not be put to a value without the others.
  if (blocks_.empty() || !system_.bound_parameter().empty()) return {};
  generic_ = rank_at({});
  for (const Polynomial& surface : surfaces) {
    const std::optional<SpecialSet> set = solved({surface});
    known_.push_back({{surface}, set ? rank_at(*set) : generic_ - 1});
  }
  collect();
  std::vector<Polynomial> all = simple_;
  all.insert(all.end(), further_.begin(), further_.end());
  for (const Polynomial& c : all) look_at({c});
  for (std::size_t i = 0; i < simple_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) look_at({simple_[j], simple_[i]});
  for (const Polynomial& c : simple_) look_for_factors(c);
  for (std::size_t i = 0; i < simple_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) look_at({simple_[k], simple_[j], simple_[i]});
  for (std::size_t i = simple_.size(); i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) look_at({all[j], all[i]});
  return std::move(found_);
}

}  // namespace

std::vector<SpecialSet> special_sets(const System& system,
                                     const std::vector<ParametricBlock>& blocks,
                                     const std::vector<std::size_t>& free,
                                     const std::vector<Polynomial>& surfaces, const Watch& watch) {
  return SetSearch(system, blocks, free, watch).run(surfaces);
}

}  // namespace casimir::search
