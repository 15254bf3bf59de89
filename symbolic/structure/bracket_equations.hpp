#pragma once

#include <vector>

#include "symbolic/search/polynomial_system.hpp"
#include "symbolic/structure/tensor_space.hpp"

namespace casimir::structure {

/// A bivector by its components {x_i, x_j}, i < j, as polynomials.
using Bivector = std::vector<Polynomial>;

/// The entry (i, j) of a bivector in n variables.
Polynomial entry(const Bivector& p, std::size_t n, std::size_t i, std::size_t j);

/// The field P dF.
std::vector<Polynomial> hamiltonian_field(const Bivector& p, std::size_t n, const Polynomial& f);

/// The components [P, Q](x_i, x_j, x_k), i < j < k, of the Schouten bracket: that of P with itself
/// is twice the defect of the Jacobi identity, and two Poisson brackets are compatible (their sums
/// are Poisson) where theirs is zero.
std::vector<Polynomial> schouten(const Bivector& p, const Bivector& q, std::size_t n);

/// Equations for unknown constants: polynomials in the variables of a system and the unknowns that
/// have to vanish identically in the variables of the motion. The parameters have generic values.
class ConstantEquations {
 public:
  /// \param unknowns  how many
  ConstantEquations(const search::System& system, std::size_t unknowns);

  const PolynomialRing& ring() const { return ring_; }
  std::size_t unknowns() const { return unknowns_; }

  /// One summand: p times a product of unknowns.
  struct Summand {
    Polynomial p;
    std::vector<std::size_t> unknowns;
  };
  /// The sum has to vanish.
  void add(const std::vector<Summand>& sum);

  /// All solutions, by families; one that is not decided where the equations grow beyond limits.
  std::vector<search::Branch> solve(const search::Watch& watch) const;

  /// The unknowns, over the parameters, where the free ones of a family have these values; empty
  /// where that is none of the family, or where algebraic equations are left.
  std::optional<std::vector<GiNaC::ex>> values(const search::Branch& family,
                                               const std::vector<GiNaC::ex>& free) const;
  /// Which unknowns are free in a family.
  std::vector<std::size_t> free_in(const search::Branch& family) const;

 private:
  std::vector<Polynomial> independent() const;
  GiNaC::ex value(const Polynomial& p, const std::vector<GiNaC::ex>& unknowns) const;

  const search::System& system_;
  std::size_t first_, unknowns_;
  PolynomialRing ring_;
  std::vector<Polynomial> equations_;  ///< over the unknowns and the parameters
};

}  // namespace casimir::structure
