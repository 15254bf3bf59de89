#include "symbolic/algebra/rational_matrix.hpp"

#include <cln/integer.h>
#include <flint/fmpq_mat.h>

#include <algorithm>

#include "symbolic/algebra/flint_conversion.hpp"

namespace casimir {
namespace {

slong as_slong(std::size_t i) { return static_cast<slong>(i); }

/// The reduced row echelon form, by FLINT.
class Echelon {
 public:
  explicit Echelon(const RationalMatrix& rows) : columns_(rows.empty() ? 0 : rows[0].size()) {
    fmpq_mat_init(matrix_, as_slong(rows.size()), as_slong(columns_));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = 0; j < columns_; ++j) {
        fmpq* const entry = fmpq_mat_entry(matrix_, as_slong(i), as_slong(j));
        to_fmpz(fmpq_numref(entry), cln::numerator(rows[i][j]));
        to_fmpz(fmpq_denref(entry), cln::denominator(rows[i][j]));
      }
    }
    rank_ = static_cast<std::size_t>(fmpq_mat_rref(matrix_, matrix_));
  }
  ~Echelon() { fmpq_mat_clear(matrix_); }
  Echelon(const Echelon&) = delete;
  Echelon& operator=(const Echelon&) = delete;

  std::size_t rank() const { return rank_; }

  /// The columns of the pivots, from the left.
  std::vector<std::size_t> pivots() const {
    std::vector<std::size_t> result;
    std::size_t column = 0;
    for (std::size_t row = 0; row < rank_; ++row, ++column) {
      while (fmpq_is_zero(entry(row, column))) ++column;
      result.push_back(column);
    }
    return result;
  }

  cln::cl_RA value(std::size_t row, std::size_t column) const {
    const fmpq* const number = entry(row, column);
    const cln::cl_I top = from_fmpz(fmpq_numref(number));
    return fmpz_is_one(fmpq_denref(number)) ? cln::cl_RA(top)
                                            : top / from_fmpz(fmpq_denref(number));
  }

 private:
  const fmpq* entry(std::size_t row, std::size_t column) const {
    return fmpq_mat_entry(matrix_, as_slong(row), as_slong(column));
  }

  std::size_t columns_, rank_ = 0;
  fmpq_mat_t matrix_;
};

}  // namespace

std::size_t rank(const RationalMatrix& rows) { return Echelon(rows).rank(); }

std::vector<std::size_t> independent_columns(const RationalMatrix& rows) {
  return Echelon(rows).pivots();
}

std::optional<std::vector<cln::cl_RA>> solve_unique(const RationalMatrix& equations) {
  if (equations.empty()) return std::nullopt;
  const std::size_t unknowns = equations[0].size() - 1;
  const Echelon echelon(equations);
  const std::vector<std::size_t> pivots = echelon.pivots();
  if (pivots.size() != unknowns || (unknowns > 0 && pivots.back() == unknowns)) return std::nullopt;
  std::vector<cln::cl_RA> solution;
  for (std::size_t i = 0; i < unknowns; ++i) solution.push_back(echelon.value(i, unknowns));
  return solution;
}

std::vector<std::vector<cln::cl_I>> null_space(const RationalMatrix& rows, std::size_t columns) {
  const Echelon echelon(rows);
  const std::vector<std::size_t> pivots = echelon.pivots();
  std::vector<std::vector<cln::cl_I>> result;
  for (std::size_t free = 0; free < columns; ++free) {
    if (std::ranges::binary_search(pivots, free)) continue;
    std::vector<cln::cl_RA> vector(columns, 0);
    vector[free] = 1;
    cln::cl_I denominator = 1, divisor = 0;
    for (std::size_t row = 0; row < pivots.size(); ++row) {
      vector[pivots[row]] = -echelon.value(row, free);
      denominator = cln::lcm(denominator, cln::denominator(vector[pivots[row]]));
    }
    for (cln::cl_RA& entry : vector) {
      entry = entry * denominator;
      divisor = cln::gcd(divisor, cln::numerator(entry));
    }
    std::vector<cln::cl_I>& own = result.emplace_back();
    for (const cln::cl_RA& entry : vector)
      own.push_back(cln::exquo(cln::numerator(entry), divisor));
  }
  return result;
}

}  // namespace casimir
