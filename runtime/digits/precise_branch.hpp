#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "runtime/digits/big_float.hpp"
#include "runtime/step/chatter.hpp"
#include "runtime/step/step_look.hpp"

namespace casimir {

/// A step of a multiprecision run.
struct PreciseStep {
  const BigFloat& begin;  ///< the time at which it begins
  const BigFloat& size;   ///< in time, negative for a run backwards
  /// The state at a time after the beginning.
  std::function<std::vector<BigFloat>(const BigFloat& h)> state;
};

/// Doubles showed that an argument of the equations passes zero within a step, and more digits do
/// not: by which formula the motion goes on is not known.
struct UnknownBranch {};

/// Looks at the steps of a multiprecision run: see StepLook. In double precision, which shows
/// whether there is a branch or a narrow pulse within a step; where a branch begins is then worked
/// out to all digits.
class PreciseLook {
 public:
  /// Borrows the program of a right-hand side, not beyond the construction.
  PreciseLook(const Program& rhs, const std::vector<BigFloat>& state,
              std::vector<BigFloat> parameters);

  /// The step that may be taken, or is to be tried, in the place of this one: the same size if it
  /// may be taken. One that ends where a branch begins is just so long that the argument has the
  /// sign of the other side. 0 where the run chatters about a jump.
  /// \throws UnknownBranch
  BigFloat size(const PreciseStep& step);

  /// Whether the step that may be taken ends behind a jump of the equations.
  bool ends_behind_jump() const { return jumps_; }

 private:
  /// The same where doubles see no branch: two zeros that are nearer to each other than doubles
  /// tell, as those of x^2 - 10^(-40), are passed in one step.
  BigFloat up_to_unseen_branch(const PreciseStep& step);
  /// A place within the step at which an argument has another sign than before; or nothing.
  std::optional<BigFloat> other_side(const PreciseStep& step, std::size_t place) const;
  std::optional<BigFloat> beyond_dip(const PreciseStep& step, std::size_t place,
                                     std::array<BigFloat, 3> at,
                                     std::array<BigFloat, 3> value) const;
  BigFloat argument(const PreciseStep& step, std::size_t place, const BigFloat& h) const;
  BigFloat branch(const PreciseStep& step, std::size_t place, BigFloat behind) const;

  StepWatch watch_;
  std::vector<BigFloat> parameters_;
  Chatter chatter_{256};             // a look of many digits takes as long as a thousand others
  std::unique_ptr<StepLook> look_;   ///< none where there is nothing to be watched
  std::optional<BigFloat> landing_;  ///< the size of a step that is to end behind a jump
  bool jumps_ = false;
};

}  // namespace casimir
