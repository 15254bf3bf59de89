#pragma once

#include <cln/rational.h>

#include <optional>
#include <vector>

#include "symbolic/discrete/prime_field.hpp"
#include "symbolic/search/modular/monomials.hpp"

namespace casimir::discrete {

/// The values of monomials at a point.
std::vector<Element> values_at(const std::vector<Element>& point,
                               const search::Monomials& monomials);

/// The null space of a matrix modulo the prime, in reduced echelon form: every vector has a 1 where
/// all others have a 0.
std::vector<std::vector<Element>> null_space(const std::vector<std::vector<Element>>& rows,
                                             std::size_t columns);

/// The same form of the span of some vectors.
std::vector<std::vector<Element>> echelon(const std::vector<std::vector<Element>>& rows,
                                          std::size_t columns);

/// A square pencil: A v = c B v.
struct Pencil {
  std::vector<std::vector<Element>> a, b;
};

/// Eigenvalues that pencils have in common.
struct Eigenvalues {
  std::vector<Element> numbers;  ///< those of the field that are not 0
  bool others = false;           ///< there are some in an extension of the field
};

/// The numbers c at which all pencils have a vector v other than 0, or more; those with a singular
/// B say nothing.
Eigenvalues common_eigenvalues(const std::vector<Pencil>& pencils);

/// Fractions with numerators and denominators below 2^30 that are these residues; empty where there
/// are none.
std::optional<std::vector<cln::cl_RA>> rationals_from(const std::vector<Element>& residues);

}  // namespace casimir::discrete
