#include "runtime/judgement.hpp"

#include <algorithm>
#include <cmath>

namespace casimir {
namespace {

/// So far off, in sizes of the state, a state has nothing to do with the motion.
constexpr double kElsewhere = 0.1;
/// An error that leaves three digits.
constexpr double kThreeDigits = 1e-3;
/// How much of an error a tolerance asks for: runs have many steps.
constexpr double kAskedFor = 100;

}  // namespace

std::string to_string(Judgement judgement) {
  switch (judgement) {
    case Judgement::right:
      return "right";
    case Judgement::warned:
      return "warned";
    case Judgement::refused:
      return "refused";
    case Judgement::inaccurate:
      return "inaccurate";
    case Judgement::wrong:
      return "wrong";
    default:
      return "unknown";
  }
}

Judgement judge(const Answer& answer) {
  if (!answer.ok) return Judgement::refused;
  if (!answer.has_end || !answer.finite) return Judgement::wrong;
  if (answer.meets_pole) return answer.warned ? Judgement::warned : Judgement::wrong;
  if (std::isnan(answer.error)) return Judgement::unknown;
  const bool elsewhere = !(answer.error <= answer.explained) || answer.error >= kElsewhere;
  const bool coarse = answer.error >= std::max(kThreeDigits, kAskedFor * answer.tolerance);
  if (!elsewhere && !coarse) return Judgement::right;
  if (answer.warned) return Judgement::warned;
  return elsewhere ? Judgement::wrong : Judgement::inaccurate;
}

}  // namespace casimir
