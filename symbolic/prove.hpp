#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/model.hpp"

namespace casimir {

/// The outcome of a proof attempt. "Undecided" is an answer of its own and never shown as another.
enum class Verdict { proved, undecided, refuted };

/// "proved", "undecided" or "refuted".
std::string to_string(Verdict verdict);

/// What a claim says; the names are those of the interface.
enum class ClaimKind {
  skew,
  jacobi,
  casimir,
  integral,
  conditional,         ///< an integral on a level
  invariant_relation,  ///< a zero level that the flow keeps
  lax,
  map,
  measure,
  identity,
  involution,
  independence,
  rank,
  liouville,
  conjugacy,  ///< of the case's map to another one
  judgement,  ///< what else is known of a candidate; its findings say
};

/// "casimir", "integral", ..
std::string to_string(ClaimKind kind);

/// The kind of that name, or nothing.
std::optional<ClaimKind> claim_kind_of(const std::string& name);

/// A point at which a claimed identity fails.
struct Witness {
  std::vector<std::pair<std::string, std::string>> point;  ///< exact value of every symbol
  std::string value;                                       ///< of the residual there; not zero
};

/// What the integrals are enough for that a Lax pair gives.
struct SpectrumCount {
  Verdict involution = Verdict::undecided;  ///< of all of them
  std::size_t leaf = 0;                     ///< dimension of the generic leaves; 0 where not known
  std::optional<std::size_t> on_leaves;     ///< so many are independent there, or more
  /// Whether they are enough for Liouville's theorem: as many as half the dimension, in involution.
  Verdict verdict = Verdict::undecided;
  std::vector<std::string> where;  ///< what that depends on, beyond the claim
  /// Of a pair on a level: the point of it around which that is said.
  std::string at;
  std::string reason;  ///< where it is undecided
};

/// What came of a claim.
struct Proof {
  ClaimKind kind = ClaimKind::integral;
  std::string name;
  Verdict verdict = Verdict::undecided;
  std::optional<std::size_t> rank;  ///< of the structure matrix, as far as it was found
  bool fact = false;                ///< about the system; see `counts`
  bool note = false;                ///< said beside the claims; never counts
  double seconds = 0;
  std::vector<std::string> on;      ///< the relations that define the level, as written
  std::string evidence;             ///< for what is proved: what was found, in words
  std::string residual;             ///< what should have been zero
  std::string reason;               ///< for what is not proved
  double Limits::*limit = nullptr;  ///< of which `reason` says that it was reached; or null
  std::optional<Witness> witness;
  /// What the verdict depends on beyond the assumptions, as "a != 0"; only of what is proved.
  std::vector<std::string> where;
  std::vector<std::string> nonzero;   ///< what was divided by
  std::vector<std::string> positive;  ///< or zero: so that its roots and logarithms are real
  std::vector<std::string> not_zero;  ///< which of `positive` have to be more than zero
  /// Of an integral: equations of where it may jump, which motions may cross; none of its angles,
  /// which can be followed. Of the Jacobi identity: the same of the bracket.
  std::vector<std::string> jumps;
  std::vector<std::string> integrals;     ///< that a Lax pair gives
  std::optional<SpectrumCount> spectrum;  ///< of a proved Lax pair: what these are enough for
  std::vector<Proof> findings;            ///< of a judgement: what else is known of the candidate
};

/// What a user wants to know beyond, or instead of, the claims of the file.
struct Candidates {
  std::vector<Text> integrals, casimirs, invariant_relations;
  std::vector<Text> identities;  ///< "LEFT = RIGHT"
  std::vector<Text> on;
  std::optional<ClaimKind> only{};  ///< without candidates: only claims and facts of this kind
  bool judged = true;  ///< whether a note says of each whether it is new beside what the case has
  /// Whether there is none, so that the claims of the file are what is asked for.
  bool empty() const {
    return integrals.empty() && casimirs.empty() && invariant_relations.empty() &&
           identities.empty();
  }
};

/// Proves or refutes every claim of the case file and the facts about it, in the order of the
/// file; or, where `candidates` has any, those instead. `report` is called with each as it is done
/// and may return false to stop.
/// \throws CaseError   for a candidate that cannot be read
/// \throws ModelError  for a case that has no meaning, as a division by zero
std::vector<Proof> prove(const Model& model, const Candidates& candidates = {},
                         const std::function<bool(const Proof&)>& report = {});

/// Proves or refutes that an expression over the symbols of the model is of this kind: a Casimir
/// function, an integral (`conditional` where a level is given), or an invariant relation.
/// \param f  its name is for messages
/// \param on  the common zero level that the claim is restricted to; empty for all of the phase
///     space
/// \throws ModelError  for other kinds, and for a Casimir function where there is no bracket
Proof prove_claim(const Model& model, ClaimKind kind, const NamedExpression& f,
                  const std::vector<NamedExpression>& on = {});

/// What `prove` would decide, in its order, all still undecided.
std::vector<Proof> pending(const Model& model, const Candidates& candidates = {});

/// Whether the verdict of the case depends on it: a claim, or a fact where the file claims
/// integrability. Where it claims superintegrability, of the facts the rank of the bracket and the
/// counts of integrals: those that do not commute or depend on others are named and do not count.
bool counts(const Model& model, const Proof& proof);

/// The worst verdict among the claims; facts count where the file claims integrability.
Verdict overall(const Model& model, const std::vector<Proof>& proofs);

}  // namespace casimir
