#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/program/interpreter.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// All that the equations, or the Hamiltonian and the bracket, were written with and that may have
/// no value: functions, roots and quotients, in terms of the variables, the time and whatever
/// `binding` leaves open. The case is about states at which all of it has values.
/// \throws ModelError  for one that has no value whatever the variables are
std::vector<GiNaC::ex> written_parts(const Model& model, const Scene& binding);

/// Whether the states of a motion are connected, as those of a flow are, or apart, as those of a
/// map: these may go from one side of a pole to the other.
enum class States { connected, apart };

/// What the equations were written with and no longer show, as sqrt(x) of sqrt(x)^2, or of
/// sqrt(x)^a where the scene says a = 2, in terms of the variables, the time and whatever `binding`
/// leaves open; terms that the scene makes zero are not there at all: a solution is one of the case
/// only as long as all of it has values. Numbers have them, and are left out.
/// \throws ModelError  for one that has no value whatever the variables are
std::vector<GiNaC::ex> cancelled_parts(const Model& model, const Scene& binding,
                                       States states = States::connected);

/// A warning that these are not watched, for runs that do not; empty where there are none.
std::string unwatched_parts(const Model& model, const Scene& scene,
                            States states = States::connected);

/// Watches along a run in double precision, or an orbit of a map, that these parts have values.
class CancelledParts {
 public:
  /// Parts of which a variable is not integrated, or whose parameters have no known value, are not
  /// watched.
  CancelledParts(const Model& model, const PreparedScene& run, States states = States::connected);

  /// Whether there is anything to watch.
  bool any() const { return !texts_.empty(); }
  /// Looks at the state after a step: whether all parts still have a value.
  bool see(double t, const double* x);
  /// The same all along the step: at places within it, and where a part comes nearest to having
  /// none.
  /// \param state_at  writes the state at a time within the step
  bool see(double t, const double* x, const std::function<void(double t, double* x)>& state_at);
  /// Has a run that these settings are for watched, which ends where a part has no value; nothing
  /// where there is nothing to watch. Borrowed by the settings.
  void watch(Settings& settings);
  /// Whether one had none.
  bool lost() const { return lost_.has_value(); }
  /// Which one, where one had none.
  const std::string& lost_part() const { return texts_[*lost_]; }
  /// The run cut off at the last step at which all had values, as a singularity.
  void end(Trajectory& trajectory) const;

 private:
  /// How a function shows that a part has no value.
  enum class Shown {
    by_value,  ///< it has none itself
    by_sign,   ///< it changes its sign, as p of 1/p^2
    below_zero,
    far_below_zero  ///< by more than the error of the state may make of zero
  };

  double size_of(std::size_t which) const;
  void evaluate(double t, const double* x, std::vector<double>& values);
  std::vector<double> places_within(double t,
                                    const std::function<void(double t, double* x)>& state_at);

  bool has_time_, are_apart_;
  std::vector<std::string> texts_;  ///< of the part that each function is of
  std::vector<Shown> shown_;        ///< of each function
  Program program_;                 ///< of the functions
  std::optional<Interpreter> values_;
  double little_ = 1e-12;            ///< what the error of the state may be
  std::vector<std::size_t> places_;  ///< among the inputs of `values_`, of each state
  std::vector<double> inputs_, now_, before_, within_;
  double time_ = 0;  ///< of the last step at which all had values
  std::vector<double> state_;
  std::optional<std::size_t> lost_;
  double lost_time_ = 0;  ///< of the first step after that
};

}  // namespace casimir
