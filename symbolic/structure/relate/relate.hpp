#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::structure {

/// A number that two brackets had to have in common.
struct Difference {
  std::string name, first, second;
};

/// Whether one case is another in linear coordinates.
struct Relation {
  bool with_hamiltonian = false;  ///< it was asked for
  /// `proved`: there is such a map, and it is given. `refuted`: there is none, with real
  /// coefficients. Else `undecided`.
  Verdict verdict = Verdict::undecided;
  std::vector<std::pair<std::string, std::string>> map;  ///< variables of B over those of A
  std::vector<GiNaC::ex> expressions;                    ///< the same over A's symbols
  std::string factor;                                    ///< c of H_B(T x) = c*H_A(x) + F(x)
  std::string casimir_part;                              ///< F, a function of A's Casimir functions
  std::vector<Difference> differences;                   ///< by which there is none
  std::string reason;                                    ///< for what is not proved
};

/// Is there a regular real matrix T for which y = T x takes the bracket of A to that of B,
/// {(Tx)_i, (Tx)_j}_A = {y_i, y_j}_B at y = T x? And, with Hamiltonians, a number c that is not
/// zero and a polynomial F in the Casimir functions of A with H_B(T x) = c H_A(x) + F(x)? Brackets
/// and Hamiltonians have to be polynomials with rational coefficients.
///
/// A map that is found is proved by the prover as a Poisson map; its determinant is not zero, and
/// the Hamiltonians are compared as an identity. That there is none follows from a number that
/// differs (`linear_invariants`) or from polynomial equations without a complex solution
/// (`solve_family`, `match`), for Hamiltonians only where all polynomial Casimir functions of A up
/// to the degree of the Hamiltonians are known.
/// \throws ModelError  for what is not polynomial, has parameters without numbers, or no bracket
Relation relate(const Model& a, const Model& b, bool with_hamiltonian,
                const search::Watch& watch = {});

}  // namespace casimir::structure
