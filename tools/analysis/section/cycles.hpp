#pragma once

#include <array>
#include <complex>
#include <string>
#include <vector>

#include "tools/analysis/equilibria/spectral_stability.hpp"
#include "tools/analysis/section/orbits.hpp"

namespace casimir {

/// Cycles whose derivative has an eigenvalue that is nearer to 1 are taken for members of families:
/// this is the value of its characteristic polynomial at 1, 2 - trace where areas are kept.
inline constexpr double kDegenerateCycle = 1e-5;

/// A cycle of the return map; one of length 1 is a fixed point.
struct Cycle {
  std::vector<PlacedPoint> points;  ///< in the order in which they are visited
  double period = 0;                ///< time for all of it
  double trace = 0;                 ///< of the derivative of the return map's n-th iterate
  double determinant = 1;           ///< of the same; 1 but for errors where the map keeps the area
  double residual = 0;              ///< distance of the point that it returns to, in phase space
  bool keeps_area = true;           ///< as a flow does whose bracket satisfies the Jacobi identity

  /// How many times it crosses the plane.
  std::size_t length() const { return points.size(); }
  /// "elliptic", "hyperbolic", "inverse hyperbolic" or "parabolic or nearly so". Where areas need
  /// not be kept: "attracting", "unstable" or "near the unit circle".
  std::string kind() const;
  /// What the trace tells, and the determinant where areas need not be kept. An elliptic cycle is
  /// spectrally stable, and may be unstable all the same where a power up to 4 of its multipliers
  /// is 1 (Levi-Civita 1901; Arnold, Mathematical Methods of Classical Mechanics, app. 7). Nothing
  /// is told of a trace that is 2 or -2 within its error.
  SpectralStability stability() const;
  /// The two Floquet multipliers of the periodic orbit that are not 1 by the motion along it and
  /// across the levels: the roots of m^2 - trace*m + d, with d the determinant, which is 1 where
  /// areas are kept.
  std::array<std::complex<double>, 2> multipliers() const;
};

/// The cycles that a search found.
struct CycleSearch {
  std::vector<Cycle> cycles;
  std::size_t degenerate = 0;  ///< members of families: the trace is 2, as in integrable systems
};

/// Where Newton's method for cycles is begun: at points all over the section, and where orbits
/// nearly close after 1, 2, .. `longest` crossings.
std::vector<PlacedPoint> cycle_starts(const LevelSet& level, const std::vector<PlacedPoint>& domain,
                                      const std::vector<OrbitReport>& orbits, std::size_t longest);

/// Cycles up to a length, by Newton's method on the return map from each of the starts. Its
/// derivative follows from the variational equations, along the level and the plane. Finds what
/// the starts lead to: there may be others.
/// \param keeps_area  as of a Cycle: see `verdict_on_jacobi`
/// \param progress    told the share that is done.
CycleSearch find_cycles(const LevelSet& level, const OrbitCutter& cutter,
                        const std::vector<PlacedPoint>& starts, std::size_t longest,
                        bool keeps_area, const std::function<void(double)>& progress);

}  // namespace casimir
