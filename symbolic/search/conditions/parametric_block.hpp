#pragma once

#include <utility>
#include <vector>

#include "symbolic/search/modular/dense_rows.hpp"
#include "symbolic/search/modular/linear_map.hpp"

namespace casimir::search {

/// The equations of one block with coefficients that are polynomials in parameters.
struct ParametricBlock {
  using Row = std::vector<std::pair<std::uint32_t, Polynomial>>;  ///< ascending columns
  std::size_t columns = 0;
  std::vector<Row> rows;

  /// Solves equations for unknowns with a constant coefficient and removes both: where the rest
  /// loses rank, and nowhere else, the block does.
  void eliminate_constants();

  /// Gives a parameter a value, a polynomial in the others; zeros and empty rows are left out.
  void put(std::size_t place, const Polynomial& value);

  /// The coefficients at a point; columns and rows without any are left out.
  DenseRows at(const Point& point, const Modulus& modulus) const;
};

/// The same equations as `make_equations`, split into blocks.
std::vector<ParametricBlock> parametric_blocks(const System& system, const Fields& fields,
                                               const Monomials& ansatz,
                                               const std::vector<Relation>& relations);

}  // namespace casimir::search
