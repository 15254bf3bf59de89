#include "symbolic/proof/claims/spectrum_count.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/model/given_functions.hpp"
#include "symbolic/proof/claims/ranks.hpp"
#include "symbolic/proof/claims/real_functions.hpp"
#include "symbolic/proof/generic_rank.hpp"

namespace casimir {
namespace {

/// Whether all brackets between them vanish, on the level if there is one.
Verdict involution_of(Prover& prover, const std::vector<Polynomial>& functions,
                      const Level& level) {
  std::vector<Residual> left;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Polynomial bracket = prover.bracket(functions[i], functions[j]);
      if (prover.is_zero(bracket)) continue;
      left.push_back({"a bracket of two coefficients", std::move(bracket),
                      [&prover, f = functions[i], g = functions[j]] {
                        const FunctionRing& ring = prover.ring();
                        return prover.model().poisson->bracket(ring.expression(f),
                                                               ring.expression(g));
                      }});
    }
  }
  if (left.empty()) return Verdict::proved;
  Proof proof;
  prover.decide(proof, left, level);
  return proof.verdict;
}

/// Why no count can be made; empty where it can.
std::string why_not_counted(Prover& prover, const std::vector<Polynomial>& found,
                            const std::optional<GiNaC::symbol>& spectral) {
  const Model& model = prover.model();
  if (!model.poisson || !model.hamiltonian) return "there is no bracket, or no Hamiltonian";
  if (model.time) return "the motion depends on time";
  if (!constraints_are_casimirs(prover))
    return "the motion is on constraints that are no Casimir functions";
  if (has_arbitrary_functions(model)) return "the case has arbitrary functions";
  if (found.empty()) return "there is none";
  if (has_complex_motion(prover) ||
      std::ranges::any_of(found, [&](const auto& f) { return may_be_complex(prover, f); }))
    return "some may have complex values";
  if (std::ranges::any_of(found,
                          [&](const auto& f) { return !prover.passed_jumps(f, true).empty(); }))
    return "some may jump where motions pass";
  // Of a function of it each value gives another integral.
  if (spectral && std::ranges::any_of(found, [&](const auto& f) {
        return prover.ring().expression(f).has(*spectral);
      }))
    return "the spectral parameter is in functions of the state";
  if (!is_poisson(prover)) return "the Jacobi identity is not proved";
  return {};
}

/// On a level of Casimir functions, around a point of it.
void count_on_level(Prover& prover, const std::vector<Polynomial>& found,
                    const std::vector<NamedExpression>& on, SpectrumCount& count) {
  std::vector<NamedExpression> all = on;
  all.insert(all.end(), prover.model().constraints.begin(), prover.model().constraints.end());
  if (!std::ranges::all_of(all, [&](const auto& f) { return is_casimir(prover, f); })) {
    count.reason = "the level is no level of Casimir functions";
    return;
  }
  const Level level = prover.level(all);
  count.involution = involution_of(prover, found, level);
  std::optional<RealPoint> point = prover.exact_point(level);
  if (!point) {
    count.reason = "no exact point of the level was found";
    return;
  }
  PolynomialRows bracket, flows;
  for (std::size_t i = 0; i < prover.dimension(); ++i) {
    bracket.emplace_back();
    for (std::size_t j = 0; j < prover.dimension(); ++j)
      bracket.back().push_back(prover.bracket_entry(i, j));
  }
  for (const Polynomial& f : found) flows.push_back(prover.flow_of(prover.gradient(f)));
  const auto generic = bracket_rank(prover);
  const std::size_t leaf = point->rank(bracket);
  if (!generic || !generic->exact || generic->rank != leaf) {
    count.reason = "the dimension of the leaves on the level is not known";
    return;
  }
  count.at = point->text();
  count.leaf = leaf;
  count.on_leaves = point->rank(flows);
  if (count.involution != Verdict::proved)
    count.reason = "whether all of them commute on the level is undecided, or they do not";
  else if (*count.on_leaves < leaf / 2)
    count.reason = "at this point there are fewer than half the dimension of its leaf";
  else
    count.verdict = Verdict::proved;
}

}  // namespace

SpectrumCount count_of_spectrum(Prover& prover, const std::vector<Polynomial>& found,
                                const std::optional<GiNaC::symbol>& spectral,
                                const std::vector<NamedExpression>& on) {
  SpectrumCount count;
  count.reason = why_not_counted(prover, found, spectral);
  if (!count.reason.empty()) return count;
  if (!on.empty() || !prover.model().constraints.empty()) {
    count_on_level(prover, found, on, count);
    return count;
  }
  count.involution = involution_of(prover, found, {});
  const auto leaf = bracket_rank(prover);
  if (!leaf || !leaf->exact || !leaf->uneven.empty()) {
    count.reason = "the dimension of the generic leaves is not known";
    return count;
  }
  count.leaf = leaf->rank;
  PolynomialRows flows;
  for (const Polynomial& f : found) flows.push_back(prover.flow_of(prover.gradient(f)));
  const auto rank = rank_with_conditions(prover, flows);
  if (!rank || !rank->uneven.empty()) {
    count.reason = !rank ? "no point of the domain was found" : rank->uneven;
    return count;
  }
  count.on_leaves = rank->rank;
  const std::size_t needed = leaf->rank / 2;
  if (rank->exact && rank->rank < needed) {
    // Where the leaves are smaller, fewer are needed.
    if (leaf->where.empty() && leaf->nonzero.empty() && rank->where.empty())
      count.verdict = Verdict::refuted;
    else
      count.reason = "they are too few on the largest leaves, and others may be smaller";
    return count;
  }
  if (count.involution != Verdict::proved) {
    count.reason = count.involution == Verdict::refuted ? "not all of them are in involution"
                                                        : "whether they commute is undecided";
    return count;
  }
  if (rank->rank < needed) {
    count.reason = fmt::format("they are only known to have {} or more on leaves", rank->rank);
    return count;
  }
  count.verdict = Verdict::proved;
  Proof where;
  say_where(where, leaf->where, leaf->nonzero);
  say_where(where, rank->where != leaf->where ? rank->where : "", rank->nonzero);
  count.where = std::move(where.where);
  return count;
}

}  // namespace casimir
