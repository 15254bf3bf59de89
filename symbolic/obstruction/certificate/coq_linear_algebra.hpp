#pragma once

#include <string>
#include <vector>

#include "symbolic/obstruction/obstruct.hpp"

namespace casimir::obstruction {

/// A file for the proof assistant Coq (8.16) with the linear algebra of a proof.
struct LinearCertificate {
  std::string text;                   ///< of the file
  std::vector<std::string> left_out;  ///< what has no theorem in it, with the reason
};

/// Of each step "there is no such polynomial" of the decisive equation the theorem that its linear
/// equations have no solution. Coq computes the equations itself, from the coefficients of the
/// differential equation, and checks for each unknown a combination of them that contains it alone.
/// What else a proof needs (exponents, the theorem of Kovacic and that of Morales-Ruiz and Ramis)
/// is not part of the file. Nothing of the text of a case gets into it: numbers only.
/// \throws NoCertificate  where nothing is proved, or the proof has no linear algebra
LinearCertificate linear_certificate(const Obstruction& obstruction);

/// Why there is none.
class NoCertificate : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace casimir::obstruction
