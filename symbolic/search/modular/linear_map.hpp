#pragma once

#include <vector>

#include "symbolic/search/modular/equations.hpp"
#include "symbolic/search/modular/monomials.hpp"
#include "symbolic/search/system.hpp"

namespace casimir::search {

/// Vector fields: for each of some variables of the ring (their places) its rate along each field.
struct Fields {
  std::vector<std::size_t> places;
  std::vector<std::vector<Polynomial>> rates;  ///< [field][variable]
  /// The same fields up to a common function of each, as short as they are: see `System`. Needed
  /// where the variables obey relations.
  std::vector<std::vector<Polynomial>> plain{};
};

/// A function on whose zero level the fields need to annihilate only, with the monomials of its
/// cofactor.
struct Relation {
  Polynomial function;
  Monomials multipliers;
};

/// The equations field(F) = sum of cofactor * relation for the coefficients of an ansatz F and of
/// the cofactors, modulo a prime. Columns: the multipliers of all relations, then the monomials of
/// F. Variables of the ring that are not among the places have the values of `constants`.
/// \throws TooMuchMemory
Equations make_equations(const Fields& fields, const Monomials& ansatz,
                         const std::vector<Relation>& relations, const Point& constants,
                         const Modulus& modulus);

/// What the equations for all monomials up to a weighted degree take, in bytes.
double bytes_of_equations(const Fields& fields, const std::vector<int>& weights, int degree);

}  // namespace casimir::search
