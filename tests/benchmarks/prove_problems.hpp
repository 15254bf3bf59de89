#pragma once

#include <string>
#include <vector>

#include "symbolic/prove.hpp"

namespace casimir::test {

/// How much of a problem the plain GiNaC computation may be asked to do.
enum class Size {
  small,  ///< milliseconds with GiNaC
  large,  ///< tens of seconds with GiNaC
  giant,  ///< too large for GiNaC
};

/// One identity to prove, as a case file without anything that it does not need.
struct Problem {
  std::string name;
  ClaimKind kind;  ///< `integral` or `jacobi`
  std::string toml;
  std::string bent;  ///< the same with one coefficient or sign changed: must be refuted
  Size size = Size::small;
  double limit = 0;  ///< milliseconds that the proof may take
  /// Give the prover the integral as one long sum instead of the products of the file.
  bool flat = false;
};

/// The problems by which the proof engine is measured, from the smallest to the largest.
std::vector<Problem> prove_problems();

}  // namespace casimir::test
