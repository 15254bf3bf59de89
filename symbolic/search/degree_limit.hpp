#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"
#include "symbolic/search/modular/monomials.hpp"

namespace casimir::search {

/// An upper bound of a weighted degree: of all variables of an ansatz, or of some of them, where
/// the others weigh nothing.
struct DegreeLimit {
  std::vector<int> weights;  ///< one for each place; any sign
  int degree = 0;

  /// The degree of a monomial: the sum of weights times exponents.
  int of(const std::uint8_t* exponents) const;
  /// The highest degree of a term of p in the variables at `places`; 0 for the polynomial 0. That
  /// of a product is the sum of those of its factors.
  int of(const Polynomial& p, const std::vector<std::size_t>& places) const;
};

/// The first place whose exponent has no bound by the limits; empty where all have one, so that
/// only finitely many monomials obey the limits. A limit with negative weights bounds a place once
/// those with such weights are bounded themselves.
/// \param highest  the largest exponents by the limits, where there are some
std::optional<std::size_t> unbounded_place(const std::vector<DegreeLimit>& limits,
                                           std::vector<int>& highest);

/// An upper bound of the degree, by positive weights, of what is within the limits.
/// \param highest  the largest exponents
int highest_degree_within(const std::vector<DegreeLimit>& limits, const std::vector<int>& order,
                          const std::vector<int>& highest);

/// All monomials within all limits, by ascending order in the sense of `all_monomials` for these
/// weights, which are positive.
/// \param most  how many there may be at most; empty where there are more
std::optional<Monomials> monomials_within(const std::vector<DegreeLimit>& limits,
                                          const std::vector<int>& order, double most);

}  // namespace casimir::search
