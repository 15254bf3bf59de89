#pragma once

#include <cstddef>
#include <vector>

#include "symbolic/search/modular/dense_rows.hpp"
#include "symbolic/search/modular/equations.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::search {

/// The equations of one block, eliminated: sparsely, the shortest rows first and the pivot in the
/// least used column, until rows fill up; then densely, in batches of rows that a random vector of
/// the present null space does not satisfy, so that hardly any row is reduced to nothing.
class Echelon {
 public:
  /// \param modulus  borrowed
  /// \throws TooMuchMemory, TimeUp
  Echelon(const Modulus& modulus, std::vector<std::vector<Entry>> rows, std::size_t columns,
          const Watch& watch);

  std::size_t columns() const { return columns_; }
  std::size_t rank() const { return pivot_columns_.size() + dense_pivots_.size(); }
  /// An upper bound for the dimension of the null space, and with a probability next to 1 equal.
  std::size_t nullity() const { return columns_ - rank(); }

  /// A basis of the null space in echelon form: each vector has a last column that is 1 there and 0
  /// in the others; in ascending order of that column. Where columns ascend in degree, what has
  /// low degree comes first.
  std::vector<std::vector<Residue>> null_basis() const;

 private:
  void reduce(const std::vector<Entry>& row);
  void keep_reduced();
  void clear();
  void eliminate_sparse(std::vector<std::vector<Entry>>& rows, const Watch& watch);
  void eliminate_dense(std::vector<std::vector<Entry>>& rows, const Watch& watch);
  std::vector<std::vector<Entry>> take_violated(std::vector<std::vector<Entry>>& rows,
                                                std::mt19937_64& random) const;
  void complete(std::vector<Residue>& vector) const;
  void add_batch(const std::vector<std::vector<Entry>>& batch);

  const Modulus& modulus_;
  std::size_t columns_;
  std::size_t next_row_ = 0;        ///< the first that the sparse stage left
  std::vector<std::uint32_t> use_;  ///< how many equations a column occurs in
  std::vector<Entry> entries_;      ///< of the sparse pivot rows, without their pivots
  std::vector<std::size_t> starts_{0};
  std::vector<std::uint32_t> pivot_columns_;
  std::vector<int> pivot_of_;  ///< for each column: the sparse pivot row, or -1
  // The row under work.
  std::vector<std::uint64_t> sums_;
  std::vector<char> touched_;
  std::vector<std::uint32_t> nonzero_;
  std::vector<int> heap_;
  // The dense stage: row i says x[dense_pivots_[i]] = -sum_j dense_(i, j) * x[free_[j]].
  std::vector<std::uint32_t> free_;  ///< columns without a pivot
  std::vector<std::uint32_t> dense_pivots_;
  DenseRows dense_;
};

/// The same basis in that echelon form.
void make_echelon(std::vector<std::vector<Residue>>& basis, const Modulus& modulus);

}  // namespace casimir::search
