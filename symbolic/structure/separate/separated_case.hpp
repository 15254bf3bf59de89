#pragma once

#include "symbolic/prove.hpp"
#include "symbolic/structure/separate/separated_equation.hpp"

namespace casimir::structure {

/// A root with its sum G and the equation of {u, G}.
struct SeparatedPair {
  std::string root;    ///< in the notation of case files
  RootCoefficients a;  ///< of a polynomial that has this root
  Multipliers s;
  SeparatedEquation equation;
};

/// A case file with the bracket and the Hamiltonian of the system and a `[[map]]` to the separated
/// variables: for each root u, G and w with
///   {u, G} = w,  {u, w} = (dR/dG)/2,  {w, G} = (dR/du)/2,  w^2 = R(u, G),
/// the bracket of a surface in space, whose Casimir function is w^2 - R. Empty where an equation
/// has Casimir functions in it, which are no parameters of the target, or names are taken.
std::optional<std::string> separated_case(const Leaves& leaves,
                                          const std::vector<Polynomial>& integrals,
                                          const std::vector<SeparatedPair>& pairs);

/// Whether the map of such a case is a Poisson map: proved, refuted or undecided as any other.
Verdict verdict_of_map(const std::string& case_text, const Limits& limits);

}  // namespace casimir::structure
