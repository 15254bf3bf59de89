#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/module_abi.h"
#include "runtime/program/interpreter.hpp"
#include "runtime/step/chatter.hpp"
#include "runtime/step/step_poles.hpp"
#include "runtime/step/step_watch.hpp"

namespace casimir {

/// Looks at the steps of one run: see casimir_run::look.
class StepLook {
 public:
  /// Borrows the watch.
  /// \param parameters  null if there are none; borrowed as well.
  /// \param state       at the start; null if it is not known.
  StepLook(const StepWatch& watch, std::size_t states, const double* parameters,
           const double* state);

  /// Another run begins, with the same arguments.
  void begin(const double* parameters, const double* state);

  /// A run ends where something that is divided by passes zero, instead of going on behind it: for
  /// those that nobody warns of it.
  void end_at_poles() { ends_at_poles_ = true; }

  /// A run ends before a pole that one of its steps would go over: see StepPoles. The steps towards
  /// it become shorter until the time does not move any more.
  void end_before_poles();
  /// Whether that is why the run could not go on.
  bool at_pole() const { return at_pole_; }

  /// Steps end so many times as far behind branches: what the wrong branch does there is so many
  /// times as large, and shows in the difference of two runs.
  void land_further(double times) { further_ = times; }
  double lands_further() const { return further_; }

  /// The numbers of the run have no largest one, as those of many digits.
  void no_largest_number() { beyond_ = std::numeric_limits<double>::infinity(); }

  /// 1 for a step that may be taken; or how much of it may be tried instead. A step that passes a
  /// branch is to end just behind it, at a distance that is 1e-12 of what the argument is in the
  /// step: what the wrong branch does on that way is its square. Behind a jump it ends at once; 2
  /// for a step that does. 0 where the run chatters: thousands of steps end behind branches, and
  /// the time does not move. Fields that point at each other on both sides of a jump hold a
  /// solution there that is none of the equations.
  double operator()(const casimir_step& trial) { return is_quiet(trial) ? 1 : within(trial); }

  /// The same of a step that is not quiet.
  /// \param middle  the state at `place_within`, if that is known.
  double within(const casimir_step& trial, const double* middle = nullptr);

  /// Whether the step may be taken for what its end shows, without a look within: no argument
  /// changes by much in it, nor did in the step before, which was not much shorter. So smooth a
  /// function does not come to anything in between.
  bool is_quiet(const casimir_step& trial);

  /// The part of the next step at which it is looked at first. It follows the golden section, as no
  /// motion does.
  double place_within() const;

  /// Whose branch the last step was to end behind; null if that was not why it was cut.
  const StepWatch::Watched* met() const { return met_; }

 private:
  /// At the ends and between them.
  static constexpr std::size_t kPlaces = 6;
  using Values = std::array<double, kPlaces>;

  /// The arguments at an end of a step, which is the beginning of the next.
  struct End {
    bool known = false;
    double t = 0;
    std::vector<double> x, values;
  };

  const End& first() const { return ends_[begins_at_]; }
  const End& last() const { return ends_[1 - begins_at_]; }
  void arguments(double t, const double* x, double* values);
  void arguments_within(const casimir_step& trial, double part, bool exactly, double* values);
  double value(const casimir_step& trial, const StepWatch::Watched& watched, double part) {
    arguments_within(trial, part, true, aside_.data());
    return aside_[watched.place];
  }
  void take_ends(const casimir_step& trial) {
    if (last().t == trial.t0) begins_at_ = 1 - begins_at_;
    take(ends_[begins_at_], trial.t0, trial.x0);
    take(ends_[1 - begins_at_], trial.t1, trial.x1);
  }
  void take(End& end, double t, const double* x);
  bool is_calm(const casimir_step& trial, double part, const double* middle);
  std::pair<double, double> range_of(const StepWatch::Watched& watched) const;
  bool turns(const casimir_step& trial);
  bool hardly_changes(const StepWatch::Watched& watched) const;
  bool ends_behind_jump(const casimir_step& trial) const;
  bool passes_pole() const;
  std::optional<double> up_to_pole(const casimir_step& trial);
  bool may_go_over_pole() const;
  bool is_calm(const StepWatch::Watched& watched, std::size_t index);
  void sample(const casimir_step& trial);
  Values sampled_at(const StepWatch::Watched& watched) const;
  double resolved(const StepWatch::Watched& watched, std::size_t index);
  double resolved_power(const StepWatch::Watched& watched, std::size_t index);
  double up_to_branch(const casimir_step& trial, const StepWatch::Watched& watched);
  double up_to_dip(const StepWatch::Watched& watched) const;
  double part_of_turn(const StepWatch::Watched& watched) const;
  double defined(const casimir_step& trial, const StepWatch::Watched& watched);
  double landing(const casimir_step& trial, const StepWatch::Watched& watched, double before,
                 double behind, double size);

  const StepWatch& watch_;
  const double* parameters_ = nullptr;
  std::vector<StepWatch::Watched> watched_;  ///< what is watched in this run
  const std::size_t states_;
  std::optional<Interpreter> evaluate_;  ///< where nothing is compiled
  std::vector<double> inputs_;
  End ends_[2];
  std::size_t begins_at_ = 0;   ///< which of them a step begins at
  std::vector<double> middle_;  ///< the arguments at the place between the ends ..
  std::vector<double> aside_;   ///< .. and at another one
  std::vector<double> sampled_[kPlaces];
  std::vector<double> highest_;  ///< of the exponents of powers, so far
  double negligible_ = 0;        ///< what an exponent has to be above ..
  /// .. and below: e to this power is beyond all doubles, and what the equations do with infinity
  /// is the same whatever the exponent.
  double beyond_ = 711;
  double further_ = 1;
  Values places_ = {};
  double shift_ = 0.5;
  bool ends_at_poles_ = false, at_pole_ = false;
  std::optional<StepPoles> poles_;
  double quiet_until_ = 0, quiet_for_ = 0;  ///< the end and the size of the last quiet step
  const StepWatch::Watched* met_ = nullptr;
  std::optional<double> jump_;  ///< when a step that was cut is to end behind a jump
  Chatter chatter_;
};

}  // namespace casimir
