#pragma once

#include <string>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"

namespace casimir {

/// A claim that is proved, but has no theorem in a certificate.
struct Uncertified {
  ClaimKind kind;
  std::string name, reason;
};

/// A proof that another program checks.
struct Certificate {
  std::string text;  ///< of the file
  std::vector<Uncertified> left_out;
};

/// A file for the proof assistant Coq (8.16) that defines the bracket, the Hamiltonian and the
/// functions of the claims as the case has them, shows that what it calls their derivatives are
/// that, and states and proves the claims about the bracket, Casimirs, integrals and invariant
/// relations, each by Coq's `ring`. Who reads it has to trust nothing else of this program.
///
/// Everything is a polynomial over the rational numbers; an identity there is one of polynomials,
/// and so holds over the reals. No assumption of the case is used: a claim that needs one, or that
/// is about other functions, is left out, and the file says so. Of the text of a case only names
/// that are identifiers get into the file, behind a prefix.
///
/// \param proofs  what `prove` said of the same model and candidates.
/// \throws ModelError  where not all of them are proved, and for a case whose bracket or
///                     Hamiltonian is no polynomial: there is no certificate then.
Certificate coq_certificate(const Model& model, const Candidates& candidates,
                            const std::vector<Proof>& proofs);

}  // namespace casimir
