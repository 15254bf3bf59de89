#pragma once

#include <functional>
#include <vector>

#include "symbolic/search/exponents.hpp"

namespace casimir {

/// Balances that were found in numbers.
struct NumericBalances {
  std::vector<search::Balance> balances;  ///< with exponents that are numeric
  std::size_t starts = 0;                 ///< of Newton's iteration
  /// Whether an exponent has an imaginary part that rounding does not explain.
  bool has_complex_exponents = false;
};

/// Balances by Newton's iteration from random complex starts, and the eigenvalues of
/// dF/dx(c) + diag(g): what it finds is there to rounding, but that is no proof, nor that there are
/// no others. Of a family of balances with the same exponents one is kept.
/// \param system  with numbers in place of parameters
/// \param tick  called with the share that is done
NumericBalances find_numeric_balances(const search::LeadingSystem& system,
                                      const std::function<void(double)>& tick);

/// Puts numeric balances in the place of exact ones that are not all: what these have shown stays
/// among the conclusions.
/// \param report  with the leading system: all its parameters are numbers
/// \return  the starts of the iteration
std::size_t take_numeric_balances(search::ExponentReport& report,
                                  const std::function<void(double)>& tick);

}  // namespace casimir
