#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "symbolic/search/polynomial_system.hpp"
#include "symbolic/structure/relate/linear_case.hpp"
#include "symbolic/structure/relate/linear_family.hpp"

namespace casimir::structure {

/// A linear map y = T x with what it does to the Hamiltonian.
struct LinearMap {
  std::vector<std::vector<GiNaC::ex>> matrix;  ///< T, by rows
  GiNaC::ex factor = 1;                        ///< c in H_B(T x) = c H_A(x) + sum_k m_k C_k(x)
  std::vector<GiNaC::ex> multiples;            ///< the m_k
};

/// What linear maps are looked for: from `a` onto `b`.
struct Pair {
  LinearCase a, b;              ///< of one dimension
  std::vector<Terms> casimirs;  ///< of `a`; with the constant 1; empty where no Hamiltonian counts
  bool with_hamiltonian() const { return a.hamiltonian && b.hamiltonian; }
};

/// What came of equations for T.
struct MapSearch {
  std::optional<LinearMap> map;  ///< with a regular matrix of real numbers
  bool none = false;             ///< there is no regular T, even with complex numbers
};

/// The regular maps in a linear family of matrices, the unknown T_ij being number i n + j of the
/// family: the polynomial equations for the bracket and the Hamiltonian are solved exactly.
/// \param factor, multiples  known ones, or empty
///
/// Theorem for `none`: the equations, with s c det(T) = 1 among them, are split into cases that
/// together have all their complex solutions; all were decided and none is left.
MapSearch solve_family(const Pair& pair, const LinearFamily& family,
                       const std::optional<cln::cl_RA>& factor,
                       const std::vector<std::optional<cln::cl_RA>>& multiples,
                       const search::Watch& watch);

/// Real values of all unknowns of a family of solutions, tried one after the other until `accept`
/// takes one: simple values of the free ones, then roots of what algebraic equations are left, of
/// degree 1 and 2.
/// \param unknowns  their places in the ring
/// \return  whether one was accepted
bool find_real_values(const search::Branch& branch, const std::vector<std::size_t>& unknowns,
                      std::size_t ring_size,
                      const std::function<bool(const std::vector<GiNaC::ex>&)>& accept);

}  // namespace casimir::structure
