#include "symbolic/structure/pencil_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "symbolic/search/polynomial_system.hpp"

namespace casimir::structure {
namespace {

/// Of the entries of a row, of which none is zero.
Polynomial common_factor(const ParametricRow& row) {
  Polynomial common = row.begin()->second;
  for (const auto& [column, entry] : row) {
    if (common.is_constant()) break;
    common = Polynomial::gcd(common, entry);
  }
  return common;
}

class PencilSolver {
 public:
  PencilSolver(std::vector<ParametricRow> rows, std::size_t columns, const PolynomialRing& ring,
               std::size_t first, const search::Watch& watch)
      : rows_(std::move(rows)),
        has_pivot_(columns, false),
        ring_(ring),
        first_(first),
        watch_(watch) {}

  PencilSolutions run();

 private:
  struct Pivot {
    std::size_t row, column;
  };
  bool has_unknowns(const Polynomial& p) const;
  std::optional<Pivot> find_pivot() const;
  void eliminate_known();
  void shorten(ParametricRow& row) const;
  /// What an elimination over the polynomials in the unknowns needs not to vanish.
  struct Elimination {
    bool full_rank = false, too_large = false;
    std::vector<Polynomial> conditions;  ///< irreducible, with unknowns
  };
  void note(Elimination& result, const Polynomial& p) const;
  void divide_out(Elimination& result, ParametricRow& row) const;
  Elimination eliminate(std::vector<ParametricRow> rows) const;
  std::vector<std::size_t> unknowns_of(const Polynomial& p) const;
  void split(const std::vector<ParametricRow>& rows,
             const std::vector<search::SolvedUnknown>& solved);
  void split_at(const Polynomial& condition, const std::vector<ParametricRow>& rows,
                const std::vector<search::SolvedUnknown>& solved);
  void solve_by_cases(const std::vector<ParametricRow>& rows,
                      const std::vector<search::SolvedUnknown>& solved,
                      const Polynomial& condition);
  void solve_from(std::size_t leading, const PolynomialRing& larger,
                  const std::vector<ParametricRow>& rows,
                  const std::vector<search::SolvedUnknown>& solved, const Polynomial& condition);
  bool add_values(const std::vector<search::SolvedUnknown>& solved, const PolynomialRing& larger);
  void take(const search::Branch& branch, const std::vector<std::size_t>& unknowns,
            const PolynomialRing& larger);
  bool is_irrational(const search::Branch& branch, const std::vector<std::size_t>& unknowns) const;
  void leave_open(const std::string& why) {
    result_.complete = false;
    result_.reason = why;
  }

  std::vector<ParametricRow> rows_;
  std::vector<bool> has_pivot_;
  const PolynomialRing& ring_;
  std::size_t first_;
  const search::Watch& watch_;
  std::vector<std::size_t> left_;  ///< columns without a pivot
  PencilSolutions result_;
};

bool PencilSolver::has_unknowns(const Polynomial& p) const {
  for (std::size_t place = first_; place < ring_.size(); ++place)
    if (p.uses(place)) return true;
  return false;
}

/// In the shortest row that has one, the simplest entry without unknowns.
std::optional<PencilSolver::Pivot> PencilSolver::find_pivot() const {
  std::optional<Pivot> best;
  std::size_t best_cost = 0;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    std::size_t size = 0;
    for (const auto& [column, entry] : rows_[r]) size += entry.terms();
    if (best && size >= best_cost) continue;
    std::size_t best_entry = 0;
    bool found = false;
    for (const auto& [column, entry] : rows_[r]) {
      const std::size_t own = entry.is_constant() ? 0 : entry.terms();
      if ((found && own >= best_entry) || has_unknowns(entry)) continue;
      found = true;
      best_entry = own;
      best = Pivot{r, column};
      best_cost = size;
    }
  }
  return best;
}

/// Without common factors that have no unknowns: these are not zero for generic parameters.
void PencilSolver::shorten(ParametricRow& row) const {
  std::erase_if(row, [](const auto& entry) { return entry.second.is_zero(); });
  if (row.empty()) return;
  Polynomial common = common_factor(row);
  if (!common.is_constant()) {
    Polynomial known = ring_.constant(1);
    for (const auto& [factor, exponent] : common.factors())
      if (!factor.is_constant() && !has_unknowns(factor)) known = known * factor.pow(exponent);
    for (auto& [column, entry] : row) entry.divide(known, &entry);
  }
  const cln::cl_RA number = row.begin()->second.content();
  for (auto& [column, entry] : row) entry = entry.scaled(1 / number);
}

void PencilSolver::eliminate_known() {
  for (ParametricRow& row : rows_) shorten(row);
  for (std::optional<Pivot> next = find_pivot(); next; next = find_pivot()) {
    const ParametricRow pivot = std::move(rows_[next->row]);
    rows_[next->row] = std::move(rows_.back());
    rows_.pop_back();
    has_pivot_[next->column] = true;
    const Polynomial& factor = pivot.at(next->column);
    for (ParametricRow& row : rows_) {
      const auto place = row.find(next->column);
      if (place == row.end()) continue;
      const Polynomial entry = place->second;
      for (auto& [column, own] : row) own = own * factor;
      for (const auto& [column, other] : pivot) {
        const auto [own, is_new] = row.try_emplace(column, -(entry * other));
        if (!is_new) own->second -= entry * other;
      }
      shorten(row);
    }
    std::erase_if(rows_, [](const ParametricRow& row) { return row.empty(); });
    watch_.tick(0);
  }
}

/// Whether an equation of one unknown has no solution in the field.
bool PencilSolver::is_irrational(const search::Branch& branch,
                                 const std::vector<std::size_t>& unknowns) const {
  return std::ranges::any_of(branch.rest, [&](const Polynomial& relation) {
    std::vector<std::size_t> own;
    for (const std::size_t u : unknowns)
      if (relation.uses(u)) own.push_back(u);
    if (own.size() != 1) return false;
    for (const auto& [factor, exponent] : relation.factors())
      if (factor.degree(own[0]) == 1) return false;
    return true;
  });
}

/// \return  false where unknowns are left in them
bool PencilSolver::add_values(const std::vector<search::SolvedUnknown>& solved,
                              const PolynomialRing& larger) {
  std::vector<PencilValue> values;
  for (std::size_t place = first_; place < ring_.size(); ++place) {
    Polynomial top = larger.variable(place), bottom = larger.constant(1);
    for (const search::SolvedUnknown& own : solved) search::put(own, top, bottom);
    for (std::size_t u = first_; u < larger.size(); ++u)
      if (top.uses(u) || bottom.uses(u)) return false;
    values.push_back({in_ring(top, ring_), in_ring(bottom, ring_)});
  }
  result_.found.push_back(std::move(values));
  return true;
}

void PencilSolver::take(const search::Branch& branch, const std::vector<std::size_t>& unknowns,
                        const PolynomialRing& larger) {
  if (!branch.decided) {
    leave_open("some equations for the factors could not be solved exactly");
    return;
  }
  if (is_irrational(branch, unknowns)) {
    result_.irrational = true;
    return;
  }
  if (!add_values(branch.solved, larger))
    leave_open(
        "factors with coefficients that were not found as rational functions of the parameters "
        "were "
        "left out");
}

std::vector<std::size_t> PencilSolver::unknowns_of(const Polynomial& p) const {
  std::vector<std::size_t> result;
  for (std::size_t place = first_; place < ring_.size(); ++place)
    if (p.uses(place)) result.push_back(place);
  return result;
}

void PencilSolver::note(Elimination& result, const Polynomial& p) const {
  if (!has_unknowns(p)) return;
  for (const auto& [factor, exponent] : p.factors()) {
    if (has_unknowns(factor) &&
        std::ranges::find(result.conditions, factor) == result.conditions.end())
      result.conditions.push_back(factor);
  }
}

void PencilSolver::divide_out(Elimination& result, ParametricRow& row) const {
  std::erase_if(row, [](const auto& entry) { return entry.second.is_zero(); });
  if (row.empty()) return;
  Polynomial common = common_factor(row);
  if (common.is_constant()) common = ring_.constant(row.begin()->second.content());
  note(result, common);
  for (auto& [column, entry] : row) entry.divide(common, &entry);
}

/// Over the field of the parameters and the unknowns.
PencilSolver::Elimination PencilSolver::eliminate(std::vector<ParametricRow> rows) const {
  constexpr std::size_t kMostTerms = 2000;
  Elimination result;
  std::size_t rank = 0;
  for (ParametricRow& row : rows) divide_out(result, row);
  std::erase_if(rows, [](const ParametricRow& row) { return row.empty(); });
  while (!rows.empty()) {
    watch_.tick(0.5);
    const auto cost = [&](const ParametricRow& row) {
      std::size_t sum = 0;
      for (const auto& [column, entry] : row) sum += entry.terms();
      return sum;
    };
    const auto best = std::ranges::min_element(rows, {}, cost);
    const ParametricRow pivot = std::move(*best);
    *best = std::move(rows.back());
    rows.pop_back();
    const auto simplest = std::ranges::min_element(pivot, {}, [&](const auto& own) {
      return std::pair(has_unknowns(own.second), own.second.terms());
    });
    note(result, simplest->second);
    ++rank;
    for (ParametricRow& row : rows) {
      const auto place = row.find(simplest->first);
      if (place == row.end()) continue;
      const Polynomial entry = place->second;
      for (auto& [column, own] : row) own = own * simplest->second;
      for (const auto& [column, other] : pivot) {
        const auto [own, is_new] = row.try_emplace(column, -(entry * other));
        if (!is_new) own->second -= entry * other;
        result.too_large = result.too_large || own->second.terms() > kMostTerms;
      }
      if (result.too_large) return result;
      divide_out(result, row);
    }
    std::erase_if(rows, [](const ParametricRow& row) { return row.empty(); });
  }
  result.full_rank = rank == left_.size();
  return result;
}

void PencilSolver::split(const std::vector<ParametricRow>& rows,
                         const std::vector<search::SolvedUnknown>& solved) {
  if (solved.size() == ring_.size() - first_) {
    add_values(solved, ring_);
    return;
  }
  const Elimination own = eliminate(rows);
  if (own.too_large || !own.full_rank) {
    solve_by_cases(rows, solved, Polynomial(ring_));
    return;
  }
  for (const Polynomial& condition : own.conditions) split_at(condition, rows, solved);
}

void PencilSolver::split_at(const Polynomial& condition, const std::vector<ParametricRow>& rows,
                            const std::vector<search::SolvedUnknown>& solved) {
  const std::vector<std::size_t> own = unknowns_of(condition);
  for (const std::size_t u : own) {
    if (condition.degree(u) != 1) continue;
    const std::vector<Polynomial> parts = condition.coefficients(u);
    if (has_unknowns(parts[1])) continue;
    std::vector<search::SolvedUnknown> more = solved;
    more.push_back({u, -parts[0], parts[1]});
    std::vector<ParametricRow> there = rows;
    for (ParametricRow& row : there) {
      // One power of the denominator for all of a row, which is not zero.
      long highest = 0;
      for (const auto& [column, entry] : row) highest = std::max(highest, entry.degree(u));
      for (auto& [column, entry] : row) {
        const long lacks = highest - std::max(0L, entry.degree(u));
        entry = search::substituted(entry, u, -parts[0], parts[1]) *
                parts[1].pow(static_cast<unsigned long>(lacks));
      }
      shorten(row);
    }
    std::erase_if(there, [](const ParametricRow& row) { return row.empty(); });
    split(there, more);
    return;
  }
  if (own.size() == 1) {  // irreducible, of a higher degree
    if (ring_.size() == first_ + 1)
      result_.roots.push_back(condition);
    else
      result_.irrational = true;
    return;
  }
  solve_by_cases(rows, solved, condition);
}

/// Kernel vectors with 1 at a column that is left, and 0 behind it, where a condition holds too.
void PencilSolver::solve_by_cases(const std::vector<ParametricRow>& rows,
                                  const std::vector<search::SolvedUnknown>& solved,
                                  const Polynomial& condition) {
  constexpr std::size_t kMostLeft = 40;
  if (left_.size() > kMostLeft) {
    leave_open(
        fmt::format("the equations for the factors have {} unknowns that do not occur "
                    "linearly, more than the {} that are tried",
                    left_.size(), kMostLeft));
    return;
  }
  const PolynomialRing larger(ring_.size() + left_.size());
  for (std::size_t leading = 0; leading < left_.size() && result_.complete; ++leading)
    solve_from(leading, larger, rows, solved, condition);
}

void PencilSolver::solve_from(std::size_t leading, const PolynomialRing& larger,
                              const std::vector<ParametricRow>& rows,
                              const std::vector<search::SolvedUnknown>& solved,
                              const Polynomial& condition) {
  const std::size_t coefficients = ring_.size();
  std::vector<std::size_t> unknowns;
  for (std::size_t place = first_; place < coefficients + leading; ++place) {
    if (std::ranges::find(solved, place, &search::SolvedUnknown::place) == solved.end())
      unknowns.push_back(place);
  }
  std::vector<Polynomial> equations{in_ring(condition, larger)};
  for (const ParametricRow& row : rows) {
    Polynomial sum(larger);
    for (std::size_t k = 0; k <= leading; ++k) {
      const auto entry = row.find(left_[k]);
      if (entry == row.end()) continue;
      const Polynomial own = in_ring(entry->second, larger);
      sum += k == leading ? own : own * larger.variable(coefficients + k);
    }
    if (!sum.is_zero()) equations.push_back(std::move(sum));
  }
  for (search::Branch branch : search::solve_system(equations, unknowns, watch_)) {
    std::vector<search::SolvedUnknown> all;
    for (const search::SolvedUnknown& own : solved)
      all.push_back({own.place, in_ring(own.numerator, larger), in_ring(own.denominator, larger)});
    all.insert(all.end(), branch.solved.begin(), branch.solved.end());
    branch.solved = std::move(all);
    take(branch, unknowns, larger);
  }
}

PencilSolutions PencilSolver::run() {
  eliminate_known();
  for (std::size_t c = 0; c < has_pivot_.size(); ++c)
    if (!has_pivot_[c]) left_.push_back(c);
  if (!left_.empty()) split(rows_, {});
  return std::move(result_);
}

}  // namespace

PencilSolutions solve_pencil(std::vector<ParametricRow> rows, std::size_t columns,
                             const PolynomialRing& ring, std::size_t first,
                             const search::Watch& watch) {
  return PencilSolver(std::move(rows), columns, ring, first, watch).run();
}

}  // namespace casimir::structure
