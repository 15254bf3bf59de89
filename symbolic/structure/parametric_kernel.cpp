#include "symbolic/structure/parametric_kernel.hpp"

#include <algorithm>
#include <utility>

namespace casimir::structure {
namespace {

struct Pivot {
  std::size_t column;
  ParametricRow row;
};

/// Without the common factor of all entries.
void make_primitive(ParametricRow& row) {
  if (row.empty()) return;
  Polynomial common = row.begin()->second;
  for (const auto& [column, entry] : row) {
    if (common.is_constant()) break;
    common = Polynomial::gcd(common, entry);
  }
  if (common.is_constant()) {
    const cln::cl_RA number = row.begin()->second.content();
    for (auto& [column, entry] : row) entry = entry.scaled(1 / number);
    return;
  }
  for (auto& [column, entry] : row) entry.divide(common, &entry);
}

std::size_t cost_of(const Polynomial& p) { return p.is_constant() ? 0 : p.terms(); }

/// The shortest row with its simplest entry: that keeps the others short.
Pivot take_pivot(std::vector<ParametricRow>& rows) {
  const auto size = [](const ParametricRow& row) {
    std::size_t sum = row.size();
    for (const auto& [column, entry] : row) sum += cost_of(entry);
    return sum;
  };
  const auto best = std::ranges::min_element(rows, {}, size);
  ParametricRow row = std::move(*best);
  *best = std::move(rows.back());
  rows.pop_back();
  const auto entry =
      std::ranges::min_element(row, {}, [](const auto& own) { return cost_of(own.second); });
  const std::size_t column = entry->first;
  return {column, std::move(row)};
}

/// pivot * row - entry * (row of the pivot): without an entry in its column.
void eliminate(ParametricRow& row, const Pivot& pivot) {
  const auto place = row.find(pivot.column);
  if (place == row.end()) return;
  const Polynomial entry = place->second, &factor = pivot.row.at(pivot.column);
  for (auto& [column, own] : row) own = own * factor;
  for (const auto& [column, other] : pivot.row) {
    const auto [own, is_new] = row.try_emplace(column, -(entry * other));
    if (!is_new) own->second -= entry * other;
    if (own->second.is_zero()) row.erase(own);
  }
  make_primitive(row);
}

/// The vector of the kernel with 1 at a free column and 0 at the others, times a polynomial.
ParametricRow solution_of(std::size_t free, const std::vector<Pivot>& pivots,
                          const PolynomialRing& ring) {
  ParametricRow values{{free, ring.constant(1)}};
  for (std::size_t k = pivots.size(); k-- > 0;) {
    Polynomial sum(ring);
    for (const auto& [column, entry] : pivots[k].row) {
      const auto value = values.find(column);
      if (value != values.end()) sum += entry * value->second;
    }
    if (sum.is_zero()) continue;
    const Polynomial& factor = pivots[k].row.at(pivots[k].column);
    for (auto& [column, value] : values) value = value * factor;
    values.emplace(pivots[k].column, -sum);
    make_primitive(values);
  }
  return values;
}

}  // namespace

ParametricKernel kernel_of(std::vector<ParametricRow> rows, std::size_t columns,
                           const PolynomialRing& ring, const std::function<void(double)>& tick) {
  std::vector<Pivot> pivots;
  std::vector<bool> has_pivot(columns, false);
  const auto drop_empty = [&] {
    std::erase_if(rows, [](const ParametricRow& row) { return row.empty(); });
  };
  for (drop_empty(); !rows.empty(); drop_empty()) {
    pivots.push_back(take_pivot(rows));
    has_pivot[pivots.back().column] = true;
    for (ParametricRow& row : rows) eliminate(row, pivots.back());
    tick(static_cast<double>(pivots.size()) / static_cast<double>(columns));
  }
  ParametricKernel result;
  for (std::size_t column = 0; column < columns; ++column) {
    if (has_pivot[column]) continue;
    result.free.push_back(column);
    result.basis.push_back(solution_of(column, pivots, ring));
    tick(1);
  }
  return result;
}

}  // namespace casimir::structure
