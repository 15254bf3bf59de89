#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "runtime/module_abi.h"
#include "runtime/program.hpp"
#include "runtime/program/interpreter.hpp"

namespace casimir {

/// What there is in equations of motion that a step of a numerical method may not see, because the
/// step knows them at the points alone at which it evaluates them: functions that are anything but
/// negligible only where their argument is in a narrow range, and those that go on by another
/// formula where it passes zero.
///
/// A method is exact where the solution is a smooth function that its step resolves. The arguments
/// of the functions are such functions long before their values are: that of exp(-(x/w)^2) changes
/// by thousands on the way to a pulse that no value announces. So it is the arguments that are
/// watched.
class StepWatch {
 public:
  /// How an argument u is looked at.
  enum class Kind {
    side,      ///< |u|: another branch where u passes zero
    jump,      ///< sign(u): another value where u passes zero
    turn,      ///< atan2(u, v): another branch where u passes zero with v < 0
    positive,  ///< sqrt(u), log(u), a broken power: no value where u < 0
    unit,      ///< asin(u), acos(u): no value where |u| > 1
    exponent,  ///< exp(u): to be resolved where it is not negligible
    both,      ///< sinh(u), cosh(u): the same for exp(u) and exp(-u)
    front,     ///< tanh(u): the same for its slope, of the size exp(-2|u|)
    power      ///< u^n with n of ten and more: the same for n log|u|
  };
  struct Watched {
    Kind kind;
    std::size_t place;  ///< of u among the outputs of `arguments`; v, if there is one, is the next
    int exponent;       ///< of a power
  };

  /// \param rhs  a right-hand side, with the inputs of one.
  explicit StepWatch(const Program& rhs);

  bool empty() const { return watched_.empty(); }
  const std::vector<Watched>& watched() const { return watched_; }
  /// The arguments, as functions of the inputs of the right-hand side.
  const Program& arguments() const { return arguments_; }

 private:
  void watch(Kind kind, const std::vector<int>& lines, int exponent = 1);

  std::vector<Watched> watched_;
  Program arguments_;
};

/// Looks at the steps of one run: see casimir_run::look.
class StepLook {
 public:
  /// Borrows the watch.
  /// \param parameters  null if there are none.
  StepLook(const StepWatch& watch, std::size_t states, const double* parameters);

  /// Another run begins.
  /// \param parameters  null if there are none.
  void begin(const double* parameters);

  /// 1 for a step that may be taken; or how much of it may be tried instead. A step that passes a
  /// branch is to end just behind it, at a distance that is 1e-12 of what the argument is in the
  /// step: what the wrong branch does on that way is its square. Behind a jump it ends at once; 2
  /// for a step that does.
  /// \param middle  the state at `place_within`, if that is known.
  double operator()(const casimir_step& trial, const double* middle = nullptr);

  /// The part of the next step at which it is looked at first. It follows the golden section, as no
  /// motion does.
  double place_within() const;

  /// Whose branch the last step was to end behind; null if that was not why it was cut.
  const StepWatch::Watched* met() const { return met_; }

 private:
  /// At the ends and between them.
  static constexpr std::size_t kPlaces = 6;

  /// The arguments at an end of a step, which is the beginning of the next.
  struct End {
    double t = 0;
    std::vector<double> x, values;
  };

  const double* arguments(double t, const double* x);
  const double* arguments_within(const casimir_step& trial, double part, bool exactly);
  double value(const casimir_step& trial, const StepWatch::Watched& watched, double part);
  void take_ends(const casimir_step& trial);
  void take(End& end, double t, const double* x);
  bool is_calm(const casimir_step& trial, double part, const double* middle);
  bool ends_behind_jump(const casimir_step& trial) const;
  bool is_calm(const StepWatch::Watched& watched, std::size_t index, const double* middle);
  void sample(const casimir_step& trial);
  double resolved(const StepWatch::Watched& watched, std::size_t index);
  double up_to_branch(const casimir_step& trial, const StepWatch::Watched& watched);
  double defined(const casimir_step& trial, const StepWatch::Watched& watched);
  double landing(const casimir_step& trial, const StepWatch::Watched& watched, double before,
                 double behind, double size);

  const StepWatch& watch_;
  const std::size_t states_;
  Interpreter evaluate_;
  std::vector<double> inputs_, outputs_;
  End first_, last_;
  std::vector<double> sampled_[kPlaces];
  std::vector<double> highest_;  ///< of the exponents of powers, so far
  double places_[kPlaces] = {};
  double shift_ = 0.5;
  const StepWatch::Watched* met_ = nullptr;
  std::optional<double> jump_;  ///< when a step that was cut is to end behind a jump
};

}  // namespace casimir
