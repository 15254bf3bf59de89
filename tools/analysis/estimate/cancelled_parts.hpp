#pragma once

#include <ginac/ginac.h>

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

/// What the equations were written with and no longer show, as sqrt(x) of sqrt(x)^2, or of
/// sqrt(x)^a where the scene says a = 2, in terms of the variables, the time and whatever `binding`
/// leaves open; terms that the scene makes zero are not there at all: a solution is one of the case
/// only as long as all of it has values. Numbers have them, and are left out.
/// \throws ModelError  for one that has no value whatever the variables are
std::vector<GiNaC::ex> cancelled_parts(const Model& model, const Scene& binding);

/// A warning that these are not watched, for runs that do not; empty where there are none.
std::string unwatched_parts(const Model& model, const Scene& scene);

/// Watches along a run in double precision that these parts have values.
class CancelledParts {
 public:
  /// Parts of which a variable is not integrated, or whose parameters have no known value, are not
  /// watched.
  CancelledParts(const Model& model, const PreparedScene& run);

  /// Whether there is anything to watch.
  bool any() const { return !texts_.empty(); }
  /// Looks at the state after a step: whether all parts still have a value.
  bool see(double t, const double* x);
  /// Whether one had none.
  bool lost() const { return lost_.has_value(); }
  /// The run cut off at the last step at which all had values, as a singularity.
  void end(Trajectory& trajectory) const;

 private:
  bool has_time_;
  std::vector<std::string> texts_;
  std::vector<bool> changes_sign_;  ///< of each function: it is lost where it does, as p of 1/p^2
  std::optional<Interpreter> values_;
  std::vector<std::size_t> places_;  ///< among the inputs of `values_`, of each state
  std::vector<double> inputs_, now_, before_;
  double time_ = 0;  ///< of the last step at which all had values
  std::vector<double> state_;
  std::optional<std::size_t> lost_;
  double lost_time_ = 0;  ///< of the first step after that
};

}  // namespace casimir
