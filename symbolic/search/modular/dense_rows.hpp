#pragma once

#include <cstddef>
#include <vector>

#include "symbolic/search/modular/modular.hpp"

namespace casimir::search {

/// A matrix of residues, row by row.
struct DenseRows {
  std::size_t rows = 0, columns = 0;
  std::vector<Residue> entries;

  DenseRows() = default;
  DenseRows(std::size_t row_count, std::size_t column_count)
      : rows(row_count), columns(column_count), entries(row_count * column_count, 0) {}
  Residue* row(std::size_t i) { return entries.data() + i * columns; }
  const Residue* row(std::size_t i) const { return entries.data() + i * columns; }
};

/// c -= a * b. The product is summed in 64-bit words and reduced once for each entry of c.
void subtract_product(DenseRows& c, const DenseRows& a, const DenseRows& b, const Modulus& modulus);

/// Reduced row echelon form with ones as pivots; zero rows are removed.
/// \return  the column of each row's pivot.
std::vector<std::size_t> reduce_rows(DenseRows& matrix, const Modulus& modulus);

/// The columns of `columns` (ascending) as a matrix of their own; they are removed from `matrix`.
DenseRows take_columns(DenseRows& matrix, const std::vector<std::size_t>& columns);

}  // namespace casimir::search
