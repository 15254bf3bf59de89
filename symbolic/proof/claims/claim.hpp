#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// A statement about a case and how to decide it.
struct Claim {
  ClaimKind kind = ClaimKind::integral;
  std::string name;
  bool fact = false;
  std::function<void(Prover&, Proof&)> decide;
  std::vector<std::string> on{};         ///< the level, as written
  std::vector<GiNaC::ex> expressions{};  ///< what it is about, beside the bracket and the flow
  bool note = false;                     ///< said beside the claims; never counts
  Subject subject = Subject::motion;     ///< what of the system it speaks of
  std::optional<LevelClaim> function{};  ///< of a claim about one function: it, and its level
};

/// What a file of each kind has, and its row in `claim_kinds.cpp` names: what reads its claims off
/// a case.
/// {

std::vector<Claim> skew_claims(const Model& model);
std::vector<Claim> jacobi_claims(const Model& model);
std::vector<Claim> casimir_claims(const Model& model);
std::vector<Claim> integral_claims(const Model& model);
std::vector<Claim> conditional_claims(const Model& model);
std::vector<Claim> invariant_relation_claims(const Model& model);
std::vector<Claim> lax_claims(const Model& model);
std::vector<Claim> map_claims(const Model& model);
std::vector<Claim> measure_claims(const Model& model);
std::vector<Claim> identity_claims(const Model& model);
std::vector<Claim> frame_claims(const Model& model);
std::vector<Claim> involution_claims(const Model& model);
std::vector<Claim> independence_claims(const Model& model);
std::vector<Claim> rank_claims(const Model& model);
std::vector<Claim> liouville_claims(const Model& model);
std::vector<Claim> level_liouville_notes(const Model& model);
std::vector<Claim> unimodularity_notes(const Model& model);
/// }

/// Those of the functions that have real values everywhere: they may help with a claim that does
/// not speak of them, without narrowing its domain.
std::vector<NamedExpression> real_everywhere(const std::vector<NamedExpression>& functions);

/// The expressions of the functions, and of one more, with those that they are defined by.
std::vector<GiNaC::ex> values_of(const std::vector<NamedExpression>& functions);
std::vector<GiNaC::ex> values_of(const std::vector<NamedExpression>& functions,
                                 const NamedExpression& more);

/// What the facts call the Hamiltonian: H, unless the file calls something else that.
std::string hamiltonian_name(const Model& model);
/// The Hamiltonian as a function among others, with what it was written with; the case has one.
NamedExpression hamiltonian_of(const Model& model);

/// {x_i, f} for every coordinate, on a level if one is given.
Claim casimir_claim(const NamedExpression& f, const std::vector<NamedExpression>& on);
/// Whether f commutes with every coordinate.
bool is_casimir(Prover& prover, const NamedExpression& f);
/// Whether all constraints of the case are: then the bracket of what is left of two functions on
/// them is what is left of their bracket. True where there are none.
bool constraints_are_casimirs(Prover& prover);
/// df/dt = 0, on an invariant level if one is given.
Claim integral_claim(const NamedExpression& f, const std::vector<NamedExpression>& on);
/// The same, under the name of its own that a case gives it on a level.
Claim conditional_claim(const NamedExpression& f, const std::vector<NamedExpression>& on);
/// What else can be said of a candidate: Casimir function, dependent on the known integrals,
/// an integral on a known level.
Claim judgement_note(const Model& model, const NamedExpression& f);
/// left = right, on a level if one is given.
Claim identity_claim(const Identity& identity);
/// f = 0 is preserved, on the level of `on` if one is given.
Claim invariant_relation_claim(const NamedExpression& f, const std::vector<NamedExpression>& on);

/// Whether it is proved that the bracket fulfils the Jacobi identity. Else it has no symplectic
/// leaves, and Liouville's theorem says nothing.
bool is_poisson(Prover& prover);

}  // namespace casimir
