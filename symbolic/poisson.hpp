#pragma once

#include <ginac/ginac.h>

#include <vector>

namespace casimir {

/// A bivector on R^n: coordinates x_1..x_n and brackets J_ij = {x_i, x_j}.
///
/// Skew by construction. The Jacobi identity is not assumed: deciding it is what `jacobi_defect`
/// is for. Immutable; copying shares the expression trees.
class PoissonStructure {
 public:
  /// \param coordinates  n distinct symbols.
  /// \param upper  n(n-1)/2 brackets, row by row: {x1,x2}, {x1,x3}, .., {x2,x3}, ..
  /// \throws ModelError  if a symbol repeats or the count is wrong; the text gives both counts.
  PoissonStructure(std::vector<GiNaC::symbol> coordinates, std::vector<GiNaC::ex> upper);

  /// The number of coordinates.
  std::size_t dimension() const { return coordinates_.size(); }
  /// x_1..x_n.
  const std::vector<GiNaC::symbol>& coordinates() const { return coordinates_; }

  /// {x_i, x_j}, i and j from 0.
  GiNaC::ex operator()(std::size_t i, std::size_t j) const;

  /// {f, g} = sum_ij J_ij df/dx_i dg/dx_j, not expanded.
  GiNaC::ex bracket(const GiNaC::ex& f, const GiNaC::ex& g) const;

  /// The Hamiltonian vector field: n entries, entry i is {x_i, h}, not expanded.
  std::vector<GiNaC::ex> flow(const GiNaC::ex& h) const;

  /// {x_i,{x_j,x_k}} + cyclic, not expanded; zero for all i<j<k exactly when this is a Poisson
  /// structure (Borisov & Mamaev (1.8)).
  GiNaC::ex jacobi_defect(std::size_t i, std::size_t j, std::size_t k) const;

 private:
  std::vector<GiNaC::symbol> coordinates_;
  std::vector<GiNaC::ex> upper_;
};

}  // namespace casimir
