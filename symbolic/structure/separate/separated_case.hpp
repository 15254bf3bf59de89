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

/// A case file, or why there is none.
struct SeparatedCase {
  std::string text;                  ///< that was read back; or empty
  Verdict map = Verdict::undecided;  ///< what the prover of claims says of its map
  std::string reason;                ///< where there is no text
};

/// A case file with the bracket and the Hamiltonian of the system and a `[[map]]` to the separated
/// variables: for each root u, G and w with
///   {u, G} = w,  {u, w} = (dR/dG)/2,  {w, G} = (dR/du)/2,  w^2 = R(u, G),
/// the bracket of a surface in space, whose Casimir function is w^2 - R. None where an equation
/// has Casimir functions in it, which are no parameters of the target, or names are taken.
SeparatedCase separated_case(const Leaves& leaves, const std::vector<Polynomial>& integrals,
                             const std::vector<SeparatedPair>& pairs);

/// Whether the map of such a case is a Poisson map: proved, refuted or undecided as any other.
/// \throws CaseError, ModelError  where the text is no case
Verdict verdict_of_map(const std::string& case_text, const Limits& limits);

}  // namespace casimir::structure
