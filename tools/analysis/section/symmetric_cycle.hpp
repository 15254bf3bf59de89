#pragma once

#include <complex>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/analysis/equilibria/spectral_stability.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// A map of the phase space to itself of finite order: the image of each variable.
struct PhaseSymmetry {
  std::vector<GiNaC::ex> image;  ///< over the variables and parameters of the model
  int order = 0;                 ///< so many times it is the identity
};

/// Completes images of some variables by the others themselves, and finds the order.
/// That it is of this order and takes motions to motions, dS f = f(S), is proved: only then is
/// x(t + T/n) = S x(t) for all t where it holds for t = 0.
/// \throws RequestError  where it is of no order up to 48, or does not take motions to motions, or
///     that is not decided; the message names the variable whose rate is not that of its image
PhaseSymmetry phase_symmetry(const Model& model, const Scene& scene,
                             const std::vector<std::pair<std::string, GiNaC::ex>>& images);

/// A periodic orbit x with x(t + T/n) = S x(t).
struct SymmetricCycle {
  bool found = false;
  std::string reason;  ///< where it is not
  std::vector<double> state;
  double period = 0;
  double state_error = 0, period_error = 0;  ///< by a second solution at a coarser tolerance
  double residual = 0;  ///< |x(T/n) - S x(0)|, relative to the size of the state
  double closure = 0;   ///< |x(T) - x(0)|, the same, by a run over all of the period
  /// The n-th roots of the Floquet multipliers: the eigenvalues of the derivative of the flow over
  /// T/n behind the inverse of S.
  std::vector<std::complex<double>> multipliers;
  bool grows = false;  ///< some of them are outside the unit circle, whatever rounding has done
  /// The equations have a bracket that obeys the Jacobi identity, or two variables and no
  /// divergence, so that with each Floquet multiplier its inverse is one: none is inside of the
  /// unit circle alone.
  bool reciprocal = false;
  int rounds = 0;       ///< of Newton's method
  int order = 0;        ///< n
  int fixed_after = 0;  ///< so many times S takes the state to itself; n where no fewer do

  /// Of reciprocal multipliers stable where all are on the unit circle to 1e-5: small changes grow
  /// more slowly than exponentially, or by that much in T/n. (Of a multiple one they may still
  /// grow, as within a family of cycles.) Of others where all but the one along the motion are
  /// inside of it by more than that. Undecided where some are off it and may be on it all the same,
  /// or on it and may be off: rounding moves an m-fold one by the m-th root of its size.
  SpectralStability stability() const;
  /// Why it may be no cycle, or no isolated one: sentences.
  std::vector<std::string> warnings() const;
};

/// What is asked of `symmetric_cycle`.
struct SymmetricCycleRequest {
  double guess = 0;          ///< of the period
  bool keep_period = false;  ///< the period is as guessed, exactly
  double tolerance = 1e-14;
  std::function<bool()> give_up = {};
};

/// Newton's method on flow(T/n, x) = S x from the start of the scene, each step the shortest that
/// the linear equations allow: the cycles of a family, and those that other symmetries make of one,
/// are not told apart by them. Derivatives follow from the variational equations.
SymmetricCycle symmetric_cycle(const Model& model, const Scene& scene, const PreparedScene& run,
                               const PhaseSymmetry& symmetry, const SymmetricCycleRequest& request);

}  // namespace casimir
