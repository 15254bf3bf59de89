#pragma once

#include "symbolic/structure/separate/separated_equation.hpp"
#include "symbolic/structure/separation.hpp"

namespace casimir::structure {

/// In the notation of case files, as all that follows.
std::string text_of(const Leaves& leaves, const Polynomial& p);
/// A polynomial in u by its coefficients, in brackets where these are sums.
std::string in_powers(const Leaves& leaves, const std::vector<Polynomial>& coefficients,
                      const std::string& u);
/// The right side, {u, G}^2.
/// \param u  the name of the root
/// \param g  that of the sum
std::string text_of(const Leaves& leaves, const SeparatedEquation& equation, const std::string& u,
                    const std::string& g);
Separation::Relation relation_of(const Leaves& leaves, const Multipliers& s,
                                 const SeparationNames& names);

/// The irreducible factors of all, each once, without numbers; what is too large to be factored is
/// left whole.
std::vector<std::string> factors_of(const Leaves& leaves, const std::vector<Polynomial>& list);

void write_bivector(Separation& result, const Leaves& leaves, const Bivector& bivector);
/// The coefficients and, with them, the polynomial in `result.names.root`.
void write_roots(Separation& result, const Leaves& leaves, const RootCoefficients& a);

}  // namespace casimir::structure
