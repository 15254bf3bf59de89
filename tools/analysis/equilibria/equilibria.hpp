#pragma once

#include <complex>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "tools/analysis/equilibria/spectral_stability.hpp"

namespace casimir {

/// A state that rests, or that moves with a symmetry only.
struct Equilibrium {
  std::vector<double> state;       ///< one number for each variable
  std::vector<double> velocities;  ///< of the symmetries, one for each integral; none: at rest
  /// Of the linearised equations, seen from the moving state; parts that rounding alone may have
  /// made are 0. None where the equations have no derivative.
  std::vector<std::complex<double>> eigenvalues;
  SpectralStability stability = SpectralStability::undecided;  ///< what they tell
  std::size_t family = 0;  ///< dimension of the family of such states on the level; 0: isolated
  /// Whether the equations do not change to first order in some direction, as far as doubles tell:
  /// in one of a family, or at a multiple root, whose place is known to few digits.
  bool degenerate = false;
  double residual = 0;  ///< the largest rate that is left

  /// The largest real part of an eigenvalue, or 0.
  double growth() const;
};

/// What a search for equilibria found, and where it looked.
struct EquilibriumReport {
  std::vector<std::string> symmetries;        ///< linear integrals whose flows were allowed
  std::vector<GiNaC::ex> symmetry_functions;  ///< the same, over the symbols of the model
  std::vector<std::string> level;             ///< functions that have the values of the scene
  bool constrained = false;  ///< some are constraints and no Casimirs: eigenvalues are along them
  std::vector<Equilibrium> equilibria;  ///< isolated ones first
  std::size_t outside = 0;              ///< how many more were found, outside of the domain
  std::size_t starts = 0;               ///< of Newton's iteration
  double size = 1;                      ///< of the scene's state, by which all is measured
};

/// Equilibria of the equations of motion, and relative equilibria: critical points of H - sum v_k
/// F_k for integrals F_k of degree 1, on the level of the Casimirs (and of the F_k) that the
/// scene's initial state lies on. By Newton's iteration from random states: what it finds is there,
/// but that is no proof that there are no others.
/// \param tick  called with the share that is done
EquilibriumReport find_equilibria(const Model& model, const Scene& scene,
                                  const std::function<void(double)>& tick);

}  // namespace casimir
