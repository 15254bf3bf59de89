#pragma once

#include <ginac/ginac.h>

#include <utility>
#include <vector>

#include "symbolic/functions/generator_table.hpp"

namespace casimir::functions {

/// How often a term may contain its unit: the functions of the multiples are multiplied out.
constexpr long kMaxMultiple = 64;

/// The units of angles and exponents: all terms with the same monomial are whole multiples of one.
class Units {
 public:
  explicit Units(const GeneratorTable& table) : table_(table) {}
  /// The unit m/L of a monomial m in an angle or exponent, and how often the term contains it.
  /// \throws Full  where the unit has to become finer
  std::pair<Polynomial, cln::cl_I> unit_of(const std::vector<unsigned long>& monomial,
                                           const cln::cl_RA& coefficient);

 private:
  const GeneratorTable& table_;
  /// For a monomial: the least common denominator of its coefficients.
  std::vector<std::pair<GiNaC::ex, cln::cl_I>> units_;
};

}  // namespace casimir::functions
