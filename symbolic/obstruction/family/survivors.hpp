#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/obstruction/family/kimura_family.hpp"

namespace casimir::obstruction {

/// A number at which no family excludes anything.
struct SurvivingValue {
  RealRoot value;
  std::string why;  ///< the conditions that hold, or that nothing is said there
};

/// An interval in which only numbers survive that obey conditions, infinitely many perhaps.
struct SurvivingSequence {
  std::string range;                    ///< as "c > 0"
  std::vector<std::string> conditions;  ///< all hold
};

/// The real numbers c at which all of some families of Riemann's equation have a solvable identity
/// component: at every other one at least one has not.
struct Survivors {
  bool informative = false;  ///< some family excludes something
  std::vector<SurvivingValue> values;
  std::vector<SurvivingSequence> sequences;
};

/// The real line is cut at the zeros and poles of all squares and of their derivatives and where a
/// condition vanishes. On each open cell a family that has finitely many solvable members there
/// gives candidates, and all families decide each; the cuts are decided one by one.
Survivors survivors(const std::vector<RiemannFamily>& families, const std::string& name);

}  // namespace casimir::obstruction
