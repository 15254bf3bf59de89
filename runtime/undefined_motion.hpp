#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/integrate.hpp"
#include "runtime/program.hpp"

namespace casimir {

/// Finds out of runs that what they follow is no motion: the right-hand side has no value all
/// along, whatever an integrator takes for it, or leads back to a jump from both sides of it.
class UndefinedMotion {
 public:
  /// Borrows the right-hand side, not beyond the lifetime of this.
  explicit UndefinedMotion(const Program& rhs);

  /// What signs are taken of, in their order, and the two arguments of each angle.
  const Program& arguments() const { return arguments_; }
  /// Whether there is anything that may have no value.
  bool looks() const { return !arguments_.outputs.empty(); }

  /// Why a run, or a step, is none of a motion, the status of which is then `at_jump`; or empty.
  ///
  /// One that reached its end: at both ends, and to first order beside them, a sign is taken of 0,
  /// or an angle of the origin. A motion that only passes such a point, or comes back to it, is one
  /// on both sides. One that went no further: a sign jumps where it ended, and the rates on either
  /// side lead to the other one, as those of x' = -sign(x) do at x = 0: no solution goes on from
  /// there (one in Filippov's sense does, along the jump).
  /// \param start, end  values of the inputs of the right-hand side
  std::string why(Status status, const std::vector<double>& start,
                  const std::vector<double>& end) const;

  /// Whether a sign is another one, or 0, at the end of a step, and the rates on both sides lead
  /// back from there.
  /// \param before, behind  values of `arguments` at the start of the step and at its end
  /// \param way  the time since the run began
  /// \throws std::domain_error  where something has no value.
  bool turns_back(const std::vector<double>& before, const std::vector<double>& behind,
                  const std::vector<double>& end, double way) const;
  /// The same of a run: whether it has no value from the one place to the other.
  bool is_undefined_along(const std::vector<double>& start, const std::vector<double>& end) const;

 private:
  bool leads_back_to_jump(std::size_t k, const std::vector<double>& end, double way) const;

  const Program& rhs_;
  Program arguments_;               ///< of signs, and of angles in pairs
  std::vector<std::size_t> signs_;  ///< their lines in the right-hand side
  std::size_t angles_ = 0;          ///< how many pairs come behind those of the signs
};

/// The same on the way of a run: where it stays for a part of it.
class UndefinedSteps {
 public:
  /// Borrows the right-hand side, not beyond the lifetime of this.
  /// \param duration  of the run
  UndefinedSteps(const Program& rhs, std::vector<double> parameters, double duration)
      : motion_(rhs), parameters_(std::move(parameters)), duration_(duration) {}

  bool looks() const { return motion_.looks(); }
  /// Sees the start of a run, and then the end of each step.
  void see(double t, const double* x, std::size_t states);
  /// Why there is no motion on the way; or empty.
  const std::string& why() const { return why_; }

 private:
  bool stays_undefined(const std::vector<double>& now, const std::vector<double>& values);

  UndefinedMotion motion_;
  std::vector<double> parameters_;
  double duration_;
  std::optional<double> begin_;             ///< of the run
  std::vector<double> last_;                ///< arguments at the end of the last step
  std::vector<std::vector<double>> since_;  ///< of each argument: where it became 0, or empty
  std::string why_;
};

}  // namespace casimir
