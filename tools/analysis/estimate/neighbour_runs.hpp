#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "runtime/integrate.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// What is left of the tolerance, at most, to a run that is repeated.
inline constexpr double kHundredth = 0.01;

/// The largest difference of two states, each component relative to a size.
double relative_distance(const std::vector<double>& a, const std::vector<double>& b,
                         const std::vector<double>& sizes);

/// Runs beside the one that is assessed. Borrows all that it is made of.
class NeighbourRuns {
 public:
  /// \param settings    of the run that is assessed
  /// \param trajectory  that run, which reached its end
  /// \param sizes       of the states: distances are relative to these
  NeighbourRuns(const PreparedScene& run, const CompiledModule& compiled, const Method& method,
                const Settings& settings, const Trajectory& trajectory,
                const std::vector<double>& sizes);

  /// Repeats the run with a hundredth of the tolerance, or as little as series need. By an implicit
  /// method near what rounding allows, where no equations are solved to such a tolerance, with a
  /// hundred times as much of it: then the difference is an error of the other run.
  /// \return  whether it reached the end
  bool begin();
  /// The repeated run.
  const Trajectory& better() const { return better_; }

  /// How far the samples are from those of a run with a tighter tolerance.
  std::optional<double> distance_of_samples(const Trajectory& trajectory, double every) const;

  /// What becomes of runs that are apart on the way.
  struct Parting {
    /// How far, where that becomes no less with the tolerance: runs that leave an unstable motion
    /// by what their steps err by do so at times of their own.
    std::optional<double> apart = {};
    /// How far the end is from that of a run by series, or by Radau's method, to twelve digits,
    /// where these agree on the way: a motion that turns at once does so a little earlier or later.
    double at_end = 0;
  };
  /// Compares the run with others at the ends of its steps. Nothing where they are nowhere further
  /// apart than `least`, or one of them fails.
  Parting parted_on_the_way(double least) const;

  /// How far the end is moved where each state of the scene that has been rounded begins at the
  /// next double on the other side of its exact value: by more than what small changes grow to
  /// where the rounded start rests and the exact one does not. Infinite where that run fails, also
  /// with the tolerance of the first; nothing where no state was rounded.
  std::optional<double> moved_by_rounding() const;

  /// How many times a relative change of a state has grown at the end; nothing if a run fails.
  std::optional<double> growth_of_state(std::size_t j) const;

  /// How far the end is moved by the rounding of a parameter at run time: by what a larger change
  /// grows to, or by the next doubles on both sides, where these move it far more: cos(a) of a
  /// giant a turns over and over within that change. Infinite where a run fails.
  double moved_by_parameter(std::size_t j) const;

 private:
  /// States at times in order.
  struct Way {
    bool reached = false;  ///< the end
    std::vector<double> end, times;
    std::vector<std::vector<double>> states;
  };
  Way way_of(Settings settings) const;
  Way at_times(const std::vector<double>& times, Settings settings, const Module& module,
               const Method& method) const;
  Way reference(const std::vector<double>& times, double rtol) const;
  double largest_distance(const Way& a, const Way& b) const;
  std::optional<Trajectory> with_parameter(std::size_t j, double value) const;
  std::optional<double> growth(const std::function<Trajectory(double change)>& neighbour_at) const;

  const PreparedScene& run_;
  const CompiledModule& compiled_;
  const Method& method_;
  const Trajectory& first_;
  Settings own_, tight_;
  double refined_ = 0;  ///< how many times a hundredth of the tolerance is what was taken
  const std::vector<double>& sizes_;
  Trajectory better_;
};

}  // namespace casimir
