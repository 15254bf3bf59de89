#pragma once

#include <string>

#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"

namespace casimir {

/// A proof that another program checks.
struct Certificate {
  std::string text;                   ///< of the file
  std::vector<std::string> left_out;  ///< claims of other kinds: proved, but not certified
};

/// A file for the proof assistant Coq (8.16) that proves the Jacobi identity and the claims about
/// Casimirs, integrals and invariant relations of a case, or the candidates, anew: each partial
/// derivative is stated and proved to be one, then each identity, all by Coq's `ring`.
///
/// Everything is a polynomial with integer coefficients over the integers; an identity there is an
/// identity of polynomials, and so holds over the reals.
/// \throws ModelError  for a claim that is not proved or that is not about polynomials: there is no
///                     certificate then.
Certificate coq_certificate(const Model& model, const Candidates& candidates = {});

}  // namespace casimir
