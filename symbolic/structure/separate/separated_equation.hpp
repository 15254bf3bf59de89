#pragma once

#include "symbolic/structure/separate/multipliers.hpp"

namespace casimir::structure {

/// The equation denominator * u^shift * {u, G}^2 = sum of coefficient * u^power * G^degree for a
/// root u and the sum G = sum_j s_j(u) F_j of Staeckel's form. That {u, G} is a function of u and G
/// follows from the form; that its square is a polynomial in them does not, and is found and
/// checked.
struct SeparatedEquation {
  struct Term {
    std::size_t power, degree;
    Polynomial coefficient;  ///< of parameters and Casimir functions
  };
  std::vector<Term> terms;
  Polynomial denominator;  ///< of parameters
  std::size_t shift = 0;
};

/// Empty where there is none of a moderate degree, or the polynomials become too long.
/// \param a  of all roots where the multipliers are for all; of one root r, -r alone
std::optional<SeparatedEquation> separated_equation(const Leaves& leaves, const RootCoefficients& a,
                                                    const Multipliers& s,
                                                    const std::vector<Polynomial>& integrals,
                                                    const std::vector<Polynomial>& casimirs,
                                                    const search::Watch& watch);

}  // namespace casimir::structure
