#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <vector>

#include "symbolic/proof/generic_rank.hpp"
#include "symbolic/proof/parameter_minors.hpp"

namespace casimir {

/// Which variables of the ring occur in a matrix.
std::vector<bool> used_variables(const PolynomialRows& rows);

/// Whether a function occurs beside the symbols, such as an inverse or a root.
bool has_generators(const FunctionRing& ring, const std::vector<Polynomial>& row);

/// Puts numerators that are reduced by all relations into the rows, and returns the factors of what
/// they were divided by; nothing where these are polynomials already.
std::optional<std::vector<Polynomial>> clear_denominators(const FunctionRing& ring,
                                                          PolynomialRows& rows);

/// Rows that are quotients of polynomials of the symbols, modulo a prime.
///
/// Theorem: where quotients have a rank at one point of a family that is given by polynomials, they
/// have it at almost all of its points, and so at some inside of any open set that the family
/// meets. That the points of the case are an open set is read off: no function but inverses is in
/// the ring, all assumptions are strict inequalities, and there are no constraints. Else no rank is
/// known.
class QuotientsModulo {
 public:
  QuotientsModulo(const Prover& prover, const PolynomialRows& numerators,
                  const std::vector<Polynomial>& denominators);

  bool are_known() const { return numerators_.has_value(); }
  /// Whether they are known to have values at the point, and at least that rank.
  bool have_rank(std::size_t rank, const std::vector<GiNaC::ex>& point) const;

 private:
  std::optional<MatrixModulo> numerators_;
  std::vector<MatrixModulo> denominators_;
};

}  // namespace casimir
