#pragma once

#include <span>
#include <vector>

#include "symbolic/proof/claims/claim.hpp"

namespace casimir {

class CertificateWriter;
struct MapModel;
struct Statement;

/// Reads the claims of one kind off a case.
using ReadClaims = std::vector<Claim> (*)(const Model&);
/// The same of a case of a map; the claims borrow it.
using ReadMapClaims = std::vector<Claim> (*)(const MapModel&);
/// The claim about one function, on a level if one is given.
using MakeClaim = Claim (*)(const NamedExpression& f, const std::vector<NamedExpression>& on);
/// The same of a map.
using MakeMapClaim = Claim (*)(const MapModel&, const NamedExpression& f,
                               const std::vector<NamedExpression>& on);

/// A kind of claims, with all that is done with it: a new kind is a file with these functions and a
/// row in `claim_kinds.cpp`. What a kind does not have is null.
struct ClaimRow {
  ClaimKind kind;
  /// Of the interface. A row without a name has more claims of a kind that has a row of its own:
  /// they are reported at another place.
  const char* name = nullptr;

  ReadClaims read = nullptr;            ///< from a case file; they know how they are proved
  ReadMapClaims read_of_map = nullptr;  ///< from the case file of a map
  void (*clear)(Model&) = nullptr;      ///< takes them out of a case

  MakeClaim make = nullptr;                             ///< about any function
  MakeMapClaim make_of_map = nullptr;                   ///< about any function, of a map
  std::vector<Text> Candidates::*candidates = nullptr;  ///< those functions that a user asks about
  const char* without_bracket = nullptr;  ///< what is said where it needs a bracket and has none

  /// Writes the theorems of a certificate.
  /// \throws NotCovered, TooLarge  nothing is written then
  void (*certify)(CertificateWriter&, const Statement&) = nullptr;
  const char* letter = nullptr;  ///< what a certificate calls candidates, before their number

  bool of_leaves = false;  ///< counts where a file claims superintegrability; see `counts`
};

/// All of them, in the order in which their claims are reported.
std::span<const ClaimRow> claim_rows();

/// The row of that kind which has its name.
const ClaimRow& claim_row(ClaimKind kind);

/// \throws CaseError  where candidates of that kind need a bracket that the case does not have; it
///                    points at the first of them
void require_bracket(const ClaimRow& row, const Model& model, const std::vector<Text>& texts);

}  // namespace casimir
