#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/analysis/run/ensemble_kernel.hpp"
#include "tools/analysis/section/level_set.hpp"
#include "tools/analysis/section/spread.hpp"

namespace casimir {

/// How orbits are followed.
struct OrbitOptions {
  double tolerance = 1e-14;
  int jobs = 0;
  std::function<bool()> give_up;
};

/// Cuts orbits of a problem with its plane. The kernel is compiled once, for the system with one
/// deviation.
class OrbitCutter {
 public:
  /// \param work  crossings to be computed in all, about: whether it is worth compiling.
  /// \throws EnvironmentError  where there is no kernel for the system.
  OrbitCutter(const SectionProblem& problem, const OrbitOptions& options, std::size_t work);

  /// What integrates them.
  const EnsembleKernel& kernel() const { return kernel_; }
  /// Of each step.
  double tolerance() const { return options_.tolerance; }

  /// So many crossings from each of these states, with the growth of a deviation.
  SectionResult orbits(const std::vector<LevelSet::Vector>& seeds, std::size_t points,
                       const std::function<void(double)>& progress = {}) const;

  /// The same, with the deviation at each crossing, from a deviation for each state.
  SectionResult with_deviations(const std::vector<LevelSet::Vector>& seeds,
                                const std::vector<LevelSet::Vector>& deviations,
                                std::size_t points) const;

  /// For `points_of_domain`.
  Returning returning() const;

  /// Whether it was asked to end.
  bool interrupted() const { return options_.give_up && options_.give_up(); }

 private:
  SectionSettings settings(std::size_t points) const;
  /// Whether the orbit is not on its way to infinity.
  bool stays(const LevelSet::Vector& seed, const SectionOrbit& orbit) const;

  const SectionProblem& problem_;
  const OrbitOptions options_;
  const EnsembleKernel kernel_;
};

/// What a section says of an orbit.
struct OrbitReport {
  SectionOrbit orbit;                         ///< crossings that keep the level only
  std::vector<std::array<double, 2>> places;  ///< in the picture
  LevelSet::Vector seed;
  /// Growth of deviations per unit of time: an estimate of the largest Lyapunov exponent.
  double exponent = 0;
  /// MEGNO of the deviation: 2 for regular motion, see `Indicators`.
  double megno = 0;
  bool judged = false;        ///< it is long enough to tell, and bounded
  bool closed = false;        ///< its crossings repeat: a cycle, which may be unstable, is no chaos
  bool chaotic = false;       ///< deviations grow faster than a power of time
  double off_level = 0;       ///< largest deviation from the level, relative to its terms
  bool leaves_level = false;  ///< a crossing was further from it than kOnLevel, and dropped
};

/// Every point of a section keeps energy and Casimir functions to this, relative to the size of
/// their terms.
inline constexpr double kOnLevel = 1e-10;

/// A state that somebody wants an orbit to begin at is on the level to this.
inline constexpr double kSeedOnLevel = 1e-9;

/// Checks and judges what was cut.
std::vector<OrbitReport> judged_orbits(const LevelSet& level, SectionResult result,
                                       const std::vector<LevelSet::Vector>& seeds);

/// Whether deviations grew faster than a power of time after the first tenth of the orbit, when
/// they have found their direction. Evidence: a short orbit that sticks to a torus may pass for
/// regular.
void judge_growth(OrbitReport& report);

}  // namespace casimir
