#pragma once

#include <cln/rational.h>

#include <map>
#include <vector>

#include "symbolic/algebra/rational_matrix.hpp"

namespace casimir::structure {

/// The rational solutions of linear equations: an affine space.
class LinearFamily {
 public:
  using Row = std::map<std::size_t, cln::cl_RA>;  ///< by unknown, without zeros

  /// Takes `unknowns` numbers that nothing is known of.
  explicit LinearFamily(std::size_t unknowns) : unknowns_(unknowns) {}

  /// Adds the equation sum row[i] t_i = right.
  /// \return  false where no solution is left; then the family may not be used any more
  bool add(Row row, cln::cl_RA right);

  /// The unknowns that may have any value.
  std::vector<std::size_t> free() const;

  /// t_unknown = first + the sum of second[f] t_f over free unknowns f.
  std::pair<cln::cl_RA, Row> value(std::size_t unknown) const;

 private:
  struct Solved {
    Row row;  ///< over free unknowns only
    cln::cl_RA right;
  };
  std::size_t unknowns_;
  std::map<std::size_t, Solved> solved_;  ///< t_key + row = right
};

/// The vectors x with rows * x = 0: a basis.
RationalMatrix null_space(const RationalMatrix& rows, std::size_t columns);

/// The product of two matrices.
RationalMatrix product(const RationalMatrix& a, const RationalMatrix& b);

/// The rows as columns.
RationalMatrix transposed(const RationalMatrix& a);

/// The inverse of a regular matrix.
/// \throws std::invalid_argument  for a singular one
RationalMatrix inverse(const RationalMatrix& a);

}  // namespace casimir::structure
