// Liouville's count on a level of Casimir functions, with the integrals that the case claims there:
// the Goryachev-Chaplygin top is integrable where (M, gamma) = 0.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/claims/ranks.hpp"
#include "symbolic/proof/claims/real_functions.hpp"
#include "symbolic/proof/generic_rank.hpp"

namespace casimir {
namespace {

using Functions = std::vector<NamedExpression>;

/// The Hamiltonian, the integrals, and those on the same level.
Functions integrals_on(const Model& model, const Functions& level) {
  Functions functions{hamiltonian_of(model)};
  functions.insert(functions.end(), model.integrals.begin(), model.integrals.end());
  for (const LevelClaim& claim : model.conditionals) {
    if (names_of(claim.on) == names_of(level)) functions.push_back(claim.expression);
  }
  return functions;
}

/// Whether all brackets between the functions vanish on the level.
bool in_involution(Prover& prover, const Functions& functions, const Level& level) {
  for (std::size_t i = 0; i < functions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const GiNaC::ex f = functions[i].value;
      const GiNaC::ex g = functions[j].value;
      Proof proof;
      prover.decide(proof,
                    {{"bracket", prover.bracket(prover.convert(f), prover.convert(g)),
                      [&prover, f, g] { return prover.model().poisson->bracket(f, g); }}},
                    level);
      if (proof.verdict != Verdict::proved) return false;
    }
  }
  return true;
}

void decide(Prover& prover, Proof& proof, const Functions& on) {
  Functions all = on;
  all.insert(all.end(), prover.model().constraints.begin(), prover.model().constraints.end());
  if (!std::all_of(all.begin(), all.end(),
                   [&](const NamedExpression& f) { return is_casimir(prover, f); })) {
    proof.reason = "the level is no level of Casimir functions";
    return;
  }
  if (!is_poisson(prover)) {
    proof.reason =
        "the Jacobi identity is not proved at points where all functions of the claim have values";
    return;
  }
  const Level level = prover.level(all);
  if (has_complex_motion(prover)) {
    proof.reason = "the Hamiltonian or the bracket is not real";
    return;
  }
  Functions functions = real_ones(prover, integrals_on(prover.model(), on));
  const std::string left_out = take_out_jumping(prover, functions);
  PolynomialRows flows;
  for (const NamedExpression& f : functions) flows.push_back(prover.flow(f.value));
  std::optional<RealPoint> point = prover.exact_point(level);
  if (!point) {
    proof.reason = "no exact point of the level was found";
    return;
  }
  // A leaf has the dimension of its tangent space at any of its points; those of the level have no
  // larger one where it is that of all leaves.
  PolynomialRows bracket;
  for (std::size_t i = 0; i < prover.dimension(); ++i) {
    bracket.emplace_back();
    for (std::size_t j = 0; j < prover.dimension(); ++j)
      bracket.back().push_back(prover.bracket_entry(i, j));
  }
  const auto generic = generic_rank(prover, bracket, [&] {
    std::vector<KernelCandidate> candidates;
    for (const NamedExpression& f : prover.model().casimirs)
      candidates.push_back({prover.gradient(prover.convert(f.value))});
    return candidates;
  });
  const std::size_t leaf = point->rank(bracket);
  if (!generic || !generic->exact || generic->rank != leaf) {
    proof.reason = "the dimension of the leaves on the level is not known";
    return;
  }
  const std::size_t independent = point->rank(flows);
  const std::size_t needed = leaf / 2;
  if (independent < needed || functions.size() > needed ||
      !in_involution(prover, functions, level)) {
    proof.reason =
        fmt::format("its leaves of dimension {} need {} independent integrals in involution{}",
                    leaf, needed, left_out);
    return;
  }
  proof.verdict = Verdict::proved;
  proof.evidence =
      fmt::format("{} are in involution there and independent on leaves of dimension {} (at {})",
                  fmt::join(names_of(functions), ", "), leaf, point->text());
  // One point shows nothing of other components of the level, or of other pieces.
  proof.where.push_back("around " + point->text());
  say_where(proof, "", where_beside_poles(prover, functions));
}

/// Whether f is in involution with every variable, as far as expanding shows it.
bool expands_to_casimir(const Model& model, const NamedExpression& f) {
  return std::all_of(model.variables.begin(), model.variables.end(), [&](const GiNaC::symbol& x) {
    return model.poisson->bracket(f.value, x).expand().is_zero();
  });
}

/// Only levels of Casimir functions are unions of leaves; nothing is to be said about another.
bool is_union_of_leaves(const Model& model, const Functions& on) {
  return std::all_of(on.begin(), on.end(),
                     [&](const NamedExpression& f) { return expands_to_casimir(model, f); });
}

}  // namespace

std::vector<Claim> level_liouville_notes(const Model& model) {
  std::vector<Claim> notes;
  if (!model.poisson || model.time) return notes;
  for (const LevelClaim& claim : model.conditionals) {
    const Functions on = claim.on;
    const bool known = std::any_of(notes.begin(), notes.end(),
                                   [&](const Claim& note) { return note.on == names_of(on); });
    if (known || !is_union_of_leaves(model, on)) continue;
    Claim note{ClaimKind::liouville,
               "Liouville integrability",
               false,
               [on](Prover& prover, Proof& proof) { decide(prover, proof, on); },
               names_of(on),
               values_of(on)};
    for (const GiNaC::ex& value : values_of(integrals_on(model, on)))
      note.expressions.push_back(value);
    note.note = true;
    notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace casimir
