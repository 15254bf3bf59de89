#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/program.hpp"
#include "tools/analysis/run_request.hpp"
#include "tools/analysis/sweep/grid_point.hpp"
#include "tools/analysis/sweep/task.hpp"

namespace casimir {

/// Chaos indicators of the motion from each point of a grid, by deviations that keep to the level
/// of the integrals that are proved.
///
/// MEGNO (Cincotta & Simo, Astron. Astrophys. Suppl. 147 (2000) 205) is the mean over the time of
/// Y(t) = (2/t) integral of s d log|v|: it tends to 2 where deviations grow like the time, as
/// beside regular orbits, to 0 where they do not grow, and grows like exponent * t / 2 where they
/// grow exponentially.
///
/// GALI_k (Skokos, Bountis & Antonopoulos, Physica D 231 (2007) 30) is the volume that k deviations
/// of length 1 span, without being made orthogonal again. The first is along the motion, the others
/// are in general position on the level of the proved integrals. Where these are all, the level is
/// the torus of the motion, and no GALI up to its dimension decays; where some are missing, those
/// of more than the dimension s of the torus decay like powers of the time beside a regular orbit,
/// and all of them exponentially beside a chaotic one.
///
/// `dimension` is the number of directions of the level less those that grow: the dimension of the
/// torus where the frequencies depend on all of the integrals that are missing, and at most so much
/// smaller otherwise. It is not a number where the motion is chaotic or the time too short to tell.
class Indicators : public SweepTask {
 public:
  /// Columns GALI_2 to this one, or to the dimension of the level.
  static constexpr std::size_t kMostGali = 6;

  /// \param run  whose states and parameters the places are; all of these outlive it
  /// \throws RequestError  for equations that depend on the time
  Indicators(const Model& model, const Scene& scene, const PreparedScene& run,
             const GridPoints& places, const Method& method, const Settings& settings);
  ~Indicators() override;

  std::vector<std::string> columns() const override;
  std::string principal_column() const override { return "megno"; }
  std::string fingerprint() const override;
  std::string reason(Status status) const override;
  const GridPoints& places() const override { return places_; }
  std::vector<PointResult> run(const std::vector<std::size_t>& points, int threads,
                               const std::function<bool()>& give_up) const override;

  /// The names of the integrals whose level the deviations keep to.
  const std::vector<std::string>& proved() const { return proved_; }
  /// Those that the case has beside them, which are not proved.
  const std::vector<std::string>& left_out() const { return left_out_; }

 private:
  struct Gradients;
  struct ThreadsOwn;
  PointResult follow(const Module& module, ThreadsOwn& own, std::size_t point,
                     const std::function<bool()>& give_up) const;

  const GridPoints& places_;
  const Method& method_;
  const Settings& settings_;
  const Program& rates_;     ///< of the system
  PreparedScene deviating_;  ///< the system and one deviation
  std::vector<std::string> proved_, left_out_;
  std::unique_ptr<const Gradients> gradients_;
  std::size_t level_dimension_ = 0;  ///< at the start of the scene
};

}  // namespace casimir
