#include "symbolic/search/modular/echelon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace casimir::search {
namespace {

// Rows are dense where they have one in so many of the columns that are left, on average; the
// dense stage is not worth its beginning for fewer columns.
constexpr std::size_t kSparseShare = 8;
constexpr std::size_t kFewColumns = 200;
constexpr std::size_t kWindow = 32;  // of pivot rows, for that average
constexpr std::size_t kBatch = 64;

}  // namespace

Echelon::Echelon(const Modulus& modulus, std::vector<std::vector<Entry>> rows, std::size_t columns,
                 const Watch& watch)
    : modulus_(modulus),
      columns_(columns),
      use_(columns, 0),
      pivot_of_(columns, -1),
      sums_(columns, 0),
      touched_(columns, 0) {
  for (const auto& row : rows)
    for (const Entry& entry : row) ++use_[entry.column];
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return a.size() < b.size(); });
  eliminate_sparse(rows, watch);
  for (std::uint32_t c = 0; c < columns; ++c)
    if (pivot_of_[c] < 0) free_.push_back(c);
  if (next_row_ < rows.size()) eliminate_dense(rows, watch);
}

void Echelon::clear() {
  for (const std::uint32_t c : nonzero_) {
    sums_[c] = 0;
    touched_[c] = 0;
  }
  nonzero_.clear();
}

/// Leaves the row without any sparse pivot column in `sums_`. Pivot rows are used in the order in
/// which they were made: one has entries in the pivot columns of later ones only.
void Echelon::reduce(const std::vector<Entry>& row) {
  clear();
  const auto touch = [&](std::uint32_t c) {
    if (touched_[c] != 0) return;
    touched_[c] = 1;
    nonzero_.push_back(c);
    if (pivot_of_[c] < 0) return;
    heap_.push_back(pivot_of_[c]);
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
  };
  for (const Entry& entry : row) {
    touch(entry.column);
    sums_[entry.column] = entry.value;
  }
  while (!heap_.empty()) {
    const auto k = static_cast<std::size_t>(heap_.front());
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    heap_.pop_back();
    std::uint64_t& own = sums_[pivot_columns_[k]];
    const Residue value = modulus_.reduce(own);
    own = 0;
    if (value == 0) continue;
    const std::uint64_t factor = modulus_.negative(value);
    for (std::size_t i = starts_[k]; i < starts_[k + 1]; ++i) {
      touch(entries_[i].column);
      std::uint64_t& sum = sums_[entries_[i].column];
      sum += factor * entries_[i].value;
      if ((sum >> 63) != 0) sum = modulus_.reduce(sum);
    }
  }
  for (const std::uint32_t c : nonzero_) sums_[c] = modulus_.reduce(sums_[c]);
}

/// Makes the row under work the next pivot row.
void Echelon::keep_reduced() {
  std::uint32_t best = static_cast<std::uint32_t>(columns_);
  for (const std::uint32_t c : nonzero_) {
    if (sums_[c] != 0 && (best == columns_ || use_[c] < use_[best])) best = c;
  }
  if (best == columns_) return;
  const Residue scale = modulus_.inverse(static_cast<Residue>(sums_[best]));
  for (const std::uint32_t c : nonzero_) {
    if (sums_[c] != 0 && c != best)
      entries_.push_back({c, modulus_.multiply(static_cast<Residue>(sums_[c]), scale)});
  }
  starts_.push_back(entries_.size());
  pivot_of_[best] = static_cast<int>(pivot_columns_.size());
  pivot_columns_.push_back(best);
}

void Echelon::eliminate_sparse(std::vector<std::vector<Entry>>& rows, const Watch& watch) {
  constexpr std::size_t kBetweenTicks = 64;
  for (; next_row_ < rows.size(); ++next_row_) {
    if (pivot_columns_.size() == columns_) {
      next_row_ = rows.size();
      return;
    }
    if (next_row_ % kBetweenTicks == 0) {
      watch.tick(static_cast<double>(next_row_) / static_cast<double>(rows.size()));
      if (static_cast<double>(entries_.size()) * sizeof(Entry) > watch.memory_limit) {
        throw TooMuchMemory(
            fmt::format("the elimination of {} unknowns fills up beyond the limit of {:.1f} GB",
                        columns_, watch.memory_limit / 1e9));
      }
    }
    const std::size_t rank = pivot_columns_.size();
    if (columns_ - rank > kFewColumns && rank >= kWindow &&
        (starts_[rank] - starts_[rank - kWindow]) / kWindow > (columns_ - rank) / kSparseShare) {
      return;
    }
    reduce(rows[next_row_]);
    keep_reduced();
    rows[next_row_] = {};
  }
}

/// Fills in the values at the pivots, those elsewhere are given.
void Echelon::complete(std::vector<Residue>& vector) const {
  for (std::size_t i = 0; i < dense_pivots_.size(); ++i) {
    std::uint64_t sum = 0;
    const Residue* row = dense_.row(i);
    for (std::size_t j = 0; j < free_.size(); ++j) {
      sum += std::uint64_t{row[j]} * vector[free_[j]];
      if ((sum >> 63) != 0) sum = modulus_.reduce(sum);
    }
    vector[dense_pivots_[i]] = modulus_.negative(modulus_.reduce(sum));
  }
  for (std::size_t k = pivot_columns_.size(); k-- > 0;) {
    std::uint64_t sum = 0;
    for (std::size_t i = starts_[k]; i < starts_[k + 1]; ++i) {
      sum += std::uint64_t{entries_[i].value} * vector[entries_[i].column];
      if ((sum >> 63) != 0) sum = modulus_.reduce(sum);
    }
    vector[pivot_columns_[k]] = modulus_.negative(modulus_.reduce(sum));
  }
}

/// Removes from `rows`, and returns, some that are independent of the pivot rows: a random vector
/// of the null space does not satisfy them.
std::vector<std::vector<Entry>> Echelon::take_violated(std::vector<std::vector<Entry>>& rows,
                                                       std::mt19937_64& random) const {
  std::vector<Residue> vector(columns_, 0);
  for (const std::uint32_t c : free_) vector[c] = modulus_.random(random);
  complete(vector);
  std::vector<std::vector<Entry>> taken;
  for (std::vector<Entry>& row : rows) {
    if (taken.size() == kBatch) break;
    std::uint64_t sum = 0;
    for (const Entry& entry : row) {
      sum += std::uint64_t{entry.value} * vector[entry.column];
      if ((sum >> 63) != 0) sum = modulus_.reduce(sum);
    }
    if (modulus_.reduce(sum) == 0) continue;
    taken.push_back(std::move(row));
    row.clear();
  }
  std::erase_if(rows, [](const auto& row) { return row.empty(); });
  return taken;
}

void Echelon::add_batch(const std::vector<std::vector<Entry>>& batch) {
  DenseRows fresh(batch.size(), free_.size());
  DenseRows factors(batch.size(), dense_pivots_.size());
  for (std::size_t i = 0; i < batch.size(); ++i) {
    reduce(batch[i]);
    for (std::size_t j = 0; j < free_.size(); ++j)
      fresh.row(i)[j] = static_cast<Residue>(sums_[free_[j]]);
    for (std::size_t j = 0; j < dense_pivots_.size(); ++j)
      factors.row(i)[j] = static_cast<Residue>(sums_[dense_pivots_[j]]);
  }
  subtract_product(fresh, factors, dense_, modulus_);
  std::vector<std::size_t> pivots = reduce_rows(fresh, modulus_);
  for (const std::size_t pivot : pivots) dense_pivots_.push_back(free_[pivot]);
  std::sort(pivots.begin(), pivots.end());
  // The identity in the new rows' pivot columns is in their order of `pivots` before sorting: it
  // is read off, not assumed.
  const DenseRows identity = take_columns(fresh, pivots);
  DenseRows own = take_columns(dense_, pivots);
  DenseRows ordered(own.rows, own.columns);
  for (std::size_t k = 0; k < identity.rows; ++k) {
    for (std::size_t p = 0; p < identity.columns; ++p) {
      if (identity.row(k)[p] == 0) continue;
      for (std::size_t i = 0; i < own.rows; ++i) ordered.row(i)[k] = own.row(i)[p];
    }
  }
  for (std::size_t p = pivots.size(); p-- > 0;)
    free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(pivots[p]));
  subtract_product(dense_, ordered, fresh, modulus_);
  dense_.rows += fresh.rows;
  dense_.entries.insert(dense_.entries.end(), fresh.entries.begin(), fresh.entries.end());
}

void Echelon::eliminate_dense(std::vector<std::vector<Entry>>& rows, const Watch& watch) {
  std::mt19937_64 random(7);
  rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(next_row_));
  dense_.columns = free_.size();
  const std::size_t start = free_.size();
  const double bytes = static_cast<double>(start) * static_cast<double>(start);
  if (bytes > watch.memory_limit) {
    throw TooMuchMemory(fmt::format(
        "a block of {} unknowns without structure would take {:.1f} GB, more than the limit of "
        "{:.1f} GB",
        columns_, bytes / 1e9, watch.memory_limit / 1e9));
  }
  while (!free_.empty() && !rows.empty()) {
    const std::vector<std::vector<Entry>> batch = take_violated(rows, random);
    if (batch.empty()) break;
    add_batch(batch);
    const double left = static_cast<double>(free_.size()) / static_cast<double>(start);
    watch.tick(1 - left * left);
  }
  clear();
}

std::vector<std::vector<Residue>> Echelon::null_basis() const {
  std::vector<std::vector<Residue>> basis;
  for (const std::uint32_t c : free_) {
    std::vector<Residue>& vector = basis.emplace_back(columns_, 0);
    vector[c] = 1;
    complete(vector);
  }
  make_echelon(basis, modulus_);
  return basis;
}

void make_echelon(std::vector<std::vector<Residue>>& basis, const Modulus& modulus) {
  if (basis.empty()) return;
  // Columns in reverse, so that the first pivots are the last columns.
  DenseRows matrix(basis.size(), basis[0].size());
  for (std::size_t i = 0; i < basis.size(); ++i)
    std::copy(basis[i].rbegin(), basis[i].rend(), matrix.row(i));
  reduce_rows(matrix, modulus);
  std::vector<std::pair<std::ptrdiff_t, std::size_t>> order;
  for (std::size_t i = 0; i < matrix.rows; ++i) {
    const Residue* row = matrix.row(i);
    const Residue* lead = std::find_if(row, row + matrix.columns, [](Residue r) { return r != 0; });
    order.emplace_back(-(lead - row), i);
  }
  std::sort(order.begin(), order.end());
  basis.assign(matrix.rows, {});
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Residue* row = matrix.row(order[i].second);
    basis[i].assign(std::reverse_iterator(row + matrix.columns), std::reverse_iterator(row));
  }
}

}  // namespace casimir::search
