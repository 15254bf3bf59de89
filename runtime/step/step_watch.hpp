#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "runtime/program.hpp"

namespace casimir {

/// What there is in equations of motion that a step of a numerical method may not see, because the
/// step knows them at the points alone at which it evaluates them: functions that are anything but
/// negligible only where their argument is in a narrow range, those that go on by another formula
/// where it passes zero, and quotients that are large only where what they divide by is small.
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
    power,     ///< u^n with n of ten and more: the same for n log|u|
    divisor,   ///< 1/u^n: no dip of u within a step that its places do not show
    phase      ///< sin(u), cos(u), tan(u) in an argument that is watched: no turn within a step
  };
  struct Watched {
    Kind kind;
    std::size_t place;   ///< of u among the outputs of `arguments`; v, if there is one, is the next
    double exponent;     ///< of a power or a divisor
    bool faint = false;  ///< watched only where numbers are extreme: see `is_extreme`
    bool pole = false;   ///< of a divisor: what is divided by it has a pole where it is zero
  };

  /// \param rhs  a right-hand side, with the inputs of one.
  explicit StepWatch(const Program& rhs);

  bool empty() const { return watched_.empty(); }
  /// Whether numbers so large or so small are in play that what a method sees from afar otherwise
  /// may be hidden from it: the tail of 10^(-16)/cos(q)^2 is below any tolerance up to the pole.
  /// \param parameters  null if there are none
  /// \param state       at the start; null if it is not known
  bool is_extreme(const double* parameters, const double* state) const;
  /// Whether there is anything to be watched with these numbers.
  bool looks(const double* parameters, const double* state) const;
  const std::vector<Watched>& watched() const { return watched_; }
  /// The places of divisors that may have both signs, among the outputs of `arguments`.
  const std::vector<std::size_t>& signed_divisors() const { return signed_divisors_; }
  /// The rates, and behind them these divisors, as functions of the inputs of the right-hand side.
  const Program& rates_and_divisors() const { return rates_and_divisors_; }
  /// The arguments, as functions of the inputs of the right-hand side.
  const Program& arguments() const { return arguments_; }
  /// Writes the values of the outputs of `arguments`.
  using Values = void(double t, const double* x, const double* p, double* values);
  /// Compiled code for `arguments`; or null.
  Values* compiled() const { return compiled_; }
  /// Takes compiled code in the place of the program.
  /// \param object  a loaded module. Where it has no such code (`casimir_watched` of module_abi.h),
  ///                or for another number of arguments, nothing happens.
  /// \param open    what keeps it open; null: it is open for as long as this is used.
  void take_compiled(void* object, const std::shared_ptr<void>& open = nullptr);
  /// The logarithm of all large numbers in the equations together: what is multiplied by them is
  /// not negligible for being small.
  double log_of_factors() const { return log_of_factors_; }

 private:
  Watched& watch(Kind kind, const std::vector<int>& lines, double exponent = 1, bool faint = false);
  void watch_branches(const Program& rhs, const std::vector<bool>& varies);
  void watch_powers(const Program& rhs, const std::vector<bool>& varies);
  void watch_divisors(const Program& rhs, const std::vector<bool>& varies,
                      const std::vector<bool>& watched);
  void watch_near_kinks(const Program& rhs, const std::vector<bool>& varies);
  void find_signed_divisors(const Program& rhs);
  void watch_phases(const std::vector<bool>& varies);
  std::vector<bool> within_arguments(bool faint_too) const;

  std::vector<Watched> watched_;
  std::vector<std::size_t> signed_divisors_;
  Program arguments_, rates_and_divisors_;
  Values* compiled_ = nullptr;
  std::shared_ptr<void> open_;  ///< what keeps that loaded
  double log_of_factors_ = 0, log_of_extremes_ = 0;
  std::size_t states_;
};

/// What the steps of a compiled object are watched for, with the code for that in it, if there is
/// any; null where nothing is watched.
/// \param rhs   the right-hand side.
/// \param path  of the shared object, with a slash in it.
std::shared_ptr<const StepWatch> watch_of_object(const Program& rhs, const std::string& path);

}  // namespace casimir
