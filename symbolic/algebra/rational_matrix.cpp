#include "symbolic/algebra/rational_matrix.hpp"

namespace casimir {
namespace {

/// Row echelon form in place; the columns of the pivots.
std::vector<std::size_t> eliminate(RationalMatrix& rows) {
  std::vector<std::size_t> pivots;
  const std::size_t columns = rows.empty() ? 0 : rows[0].size();
  for (std::size_t column = 0; column < columns && pivots.size() < rows.size(); ++column) {
    const std::size_t rank = pivots.size();
    std::size_t pivot = rank;
    while (pivot < rows.size() && cln::zerop(rows[pivot][column])) ++pivot;
    if (pivot == rows.size()) continue;
    std::swap(rows[rank], rows[pivot]);
    for (std::size_t i = rank + 1; i < rows.size(); ++i) {
      const cln::cl_RA factor = rows[i][column] / rows[rank][column];
      if (cln::zerop(factor)) continue;
      for (std::size_t j = column; j < columns; ++j)
        rows[i][j] = rows[i][j] - factor * rows[rank][j];
    }
    pivots.push_back(column);
  }
  return pivots;
}

}  // namespace

std::size_t rank(RationalMatrix rows) { return eliminate(rows).size(); }

std::vector<std::size_t> independent_columns(RationalMatrix rows) { return eliminate(rows); }

std::optional<std::vector<cln::cl_RA>> solve_unique(RationalMatrix equations) {
  if (equations.empty()) return std::nullopt;
  const std::size_t unknowns = equations[0].size() - 1;
  const std::vector<std::size_t> pivots = eliminate(equations);
  if (pivots.size() != unknowns || (unknowns > 0 && pivots.back() == unknowns)) return std::nullopt;
  std::vector<cln::cl_RA> solution(unknowns, 0);
  for (std::size_t i = unknowns; i-- > 0;) {
    cln::cl_RA value = equations[i][unknowns];
    for (std::size_t j = i + 1; j < unknowns; ++j) value = value - equations[i][j] * solution[j];
    solution[i] = value / equations[i][i];
  }
  return solution;
}

}  // namespace casimir
