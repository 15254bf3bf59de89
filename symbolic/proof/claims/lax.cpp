// Lax pairs: dL/dt = [L, A] = L A - A L, entry by entry and identically in the spectral parameter,
// and the integrals that the characteristic polynomial of L gives.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "symbolic/functions/spectral_coefficients.hpp"
#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/claims/on_constraints.hpp"
#include "symbolic/proof/claims/spectrum_count.hpp"
#include "symbolic/proof/generic_rank.hpp"
#include "symbolic/proof/thin_domain.hpp"

namespace casimir {
namespace {

using Matrix = std::vector<std::vector<Polynomial>>;

Matrix product(const FunctionRing& ring, const Matrix& a, const Matrix& b) {
  Matrix result(a.size(), std::vector<Polynomial>(a.size(), Polynomial(ring.ring())));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j) {
      for (std::size_t k = 0; k < a.size(); ++k) {
        if (!a[i][k].is_zero() && !b[k][j].is_zero())
          result[i][j] += ring.checked_product(a[i][k], b[k][j]);
      }
    }
  }
  return result;
}

/// The coefficients of det(mu - L) at mu^(n-1), .., mu^0, by the method of Faddeev and LeVerrier.
std::vector<Polynomial> characteristic_polynomial(const FunctionRing& ring, const Matrix& l) {
  std::vector<Polynomial> result;
  Matrix m = l;
  for (std::size_t k = 1; k <= l.size(); ++k) {
    Polynomial trace(ring.ring());
    for (std::size_t i = 0; i < l.size(); ++i) trace += m[i][i];
    result.push_back(trace.scaled(cln::cl_RA(-1) / cln::cl_I(k)));
    if (k == l.size()) break;
    for (std::size_t i = 0; i < l.size(); ++i) m[i][i] += result.back();
    m = product(ring, l, m);
  }
  return result;
}

bool proportional(const Polynomial& a, const Polynomial& b) {
  return a.terms() == b.terms() && a.scaled(1 / a.content()) == b.scaled(1 / b.content());
}

/// How many of the known functions, of the found ones, and of both are independent. Where the
/// gradients of some have the rank of all at the points that show it, one on each piece, they have
/// it at almost all points, and no larger one.
struct Ranks {
  std::optional<std::size_t> known, found, together;  ///< empty where it is not shown
};

Ranks ranks_of(Prover& prover, const std::vector<Polynomial>& known,
               const std::vector<Polynomial>& found) {
  std::vector<Polynomial> all = known;
  for (const Polynomial& f : found) {
    if (std::none_of(known.begin(), known.end(),
                     [&](const Polynomial& g) { return proportional(f, g); }))
      all.push_back(f);
  }
  const auto is_one = [](const std::optional<GenericRank>& rank) {
    return rank && rank->exact && rank->uneven.empty();
  };
  auto whole = all.empty() ? std::nullopt : gradient_rank(prover, all);
  const auto rank_of = [&](const std::vector<Polynomial>& functions) -> std::optional<std::size_t> {
    if (functions.empty()) return 0;
    if (is_one(whole) && !whole->points.empty()) {
      PolynomialRows rows;
      for (const Polynomial& f : functions) rows.push_back(prover.gradient(f));
      if (std::all_of(whole->points.begin(), whole->points.end(),
                      [&](RealPoint& point) { return point.rank(rows) == whole->rank; }))
        return whole->rank;
    }
    const auto own = gradient_rank(prover, functions);
    return is_one(own) ? std::optional(own->rank) : std::nullopt;
  };
  Ranks result{rank_of(known), rank_of(found), std::nullopt};
  if (all.empty()) result.together = 0;
  if (is_one(whole)) result.together = whole->rank;
  return result;
}

bool vanishes_on(Prover& prover, const Polynomial& f, const Level& level,
                 const std::function<GiNaC::ex()>& by_ginac) {
  Proof proof;
  prover.decide(proof, {{"the function on the level", f, by_ginac}}, level);
  return proof.verdict == Verdict::proved;
}

/// Whether the motion keeps f, on the level if there is one, where it is more than a constant. The
/// spectrum of L is kept; a part of a function that is not polynomial in the spectral parameter, as
/// of x/(s - x), need not be.
bool is_kept(Prover& prover, const Polynomial& f, const Level& level) {
  const auto by_ginac = [&] { return prover.ring().expression(f); };
  if (!level.empty() && vanishes_on(prover, f, level, by_ginac)) return false;
  const Polynomial rate = prover.rate(f);
  if (prover.is_zero(rate)) return true;
  return !level.empty() &&
         vanishes_on(prover, rate, level, [&] { return prover.model().rate(by_ginac()); });
}

/// The integrals that follow from a proved Lax pair; constants and repetitions left out. On a level
/// they are those of the motion there.
std::vector<Polynomial> integrals_of(Prover& prover, const LaxPair& pair) {
  FunctionRing& ring = prover.ring();
  const Level level = prover.level(pair.on);
  const unsigned n = pair.l.rows();
  Matrix l;
  for (unsigned i = 0; i < n; ++i) {
    l.emplace_back();
    for (unsigned j = 0; j < n; ++j) l.back().push_back(ring.convert(pair.l(i, j)));
  }
  std::vector<Polynomial> result;
  for (const Polynomial& coefficient : characteristic_polynomial(ring, l)) {
    std::vector<Polynomial> parts{coefficient};
    if (pair.spectral) {
      const auto& symbols = ring.symbols();
      const auto place = std::find_if(symbols.begin(), symbols.end(), [&](const GiNaC::symbol& s) {
        return s.is_equal(*pair.spectral);
      });
      parts = functions::spectral_coefficients(ring.table(), coefficient,
                                               static_cast<std::size_t>(place - symbols.begin()),
                                               prover.dimension());
    }
    for (Polynomial& f : parts) {
      f = ring.reduced(std::move(f));  // I^2 is -1
      const std::vector<Polynomial> slopes = prover.gradient(f);
      const bool constant = std::all_of(slopes.begin(), slopes.end(), [&](const Polynomial& slope) {
        return prover.is_zero(slope);
      });
      const bool known = std::any_of(result.begin(), result.end(),
                                     [&](const Polynomial& g) { return proportional(f, g); });
      if (constant || known) continue;
      if (is_kept(prover, f, level)) result.push_back(std::move(f));
    }
  }
  return result;
}

/// Evidence of a proved pair: what its spectrum gives, and whether that is more than is known.
void describe_integrals(Prover& prover, Proof& proof, const LaxPair& pair) {
  constexpr std::size_t kMaxTerms = 40;
  const std::vector<Polynomial> found = integrals_of(prover, pair);
  for (const Polynomial& f : found) {
    proof.integrals.push_back(f.terms() <= kMaxTerms
                                  ? prover.ring().text(f.scaled(1 / f.content()))
                                  : fmt::format("a function of {} terms", f.terms()));
    prover.say_where_it_jumps(proof, f, true);
  }
  std::vector<Polynomial> known;
  const Model& model = prover.model();
  for (const NamedExpression& f : real_everywhere(model.casimirs))
    known.push_back(prover.convert(f.value));
  if (model.hamiltonian && !model.time) known.push_back(prover.convert(*model.hamiltonian));
  for (const NamedExpression& f : real_everywhere(model.integrals))
    known.push_back(prover.convert(f.value));
  proof.evidence = fmt::format("the characteristic polynomial gives {} integral{}{}", found.size(),
                               found.size() == 1 ? "" : "s",
                               pair.on.empty() ? "" : " of the motion on the level");
  try {
    proof.spectrum = count_of_spectrum(prover, found, pair.spectral, pair.on);
  } catch (const TooLarge& limit) {
    proof.spectrum.emplace().reason = limit.what();
  }
  // The gradients of functions on a level are independent of those of the level itself or not: that
  // takes another count.
  if (!pair.on.empty()) return;
  // Where parameters have no generic values a rank at some of them says nothing of the others.
  if (thin_domain(prover)) return;
  const Ranks ranks = ranks_of(prover, known, found);
  if (ranks.found) proof.evidence += fmt::format(", {} independent", *ranks.found);
  if (ranks.known && ranks.together) {
    proof.evidence += *ranks.together == *ranks.known ? "; all follow from the known ones"
                                                      : fmt::format("; {} beyond the known ones",
                                                                    *ranks.together - *ranks.known);
  }
}

/// The equation on a level. Theorem: where the level is invariant and L is differentiable near it,
/// dL/dt = [L, A] along each motion on it, so that the spectrum of L is constant along that motion.
/// Without the invariance the equation on the level says nothing: motions leave it.
void decide_on_level(Prover& prover, Proof& proof, const std::vector<Residual>& residuals,
                     const LaxPair& pair) {
  Proof invariance;
  prover.decide_invariance(invariance, pair.on);
  if (invariance.verdict != Verdict::proved) {
    proof.verdict = invariance.verdict;
    proof.reason =
        (invariance.verdict == Verdict::refuted ? "the level is not invariant: "
                                                : "the level is not shown to be invariant: ") +
        invariance.reason;
    proof.residual = invariance.residual;
    proof.witness = invariance.witness;
    proof.nonzero = invariance.nonzero;
    return;
  }
  const Level level = prover.level(pair.on);
  prover.decide(proof, residuals, level);
  if (proof.verdict != Verdict::proved) return;
  std::vector<NamedExpression> entries;
  for (std::size_t k = 0; k < pair.l.nops(); ++k)
    entries.push_back({"an entry of L", pair.l.op(k), {}, pair.domain});
  if (!prover.is_smooth_on(proof, level, entries)) return;
  for (const std::string& condition : invariance.where) {
    if (std::find(proof.where.begin(), proof.where.end(), condition) == proof.where.end())
      proof.where.push_back(condition);
  }
}

void decide_lax(Prover& prover, Proof& proof, const LaxPair& pair) {
  prover.set_spectral(pair.spectral);
  const unsigned n = pair.l.rows();
  const auto entry = [&](const GiNaC::matrix& m, unsigned i, unsigned j) {
    return prover.convert(m(i, j));
  };
  std::vector<Residual> residuals;
  for (unsigned i = 0; i < n; ++i) {
    for (unsigned j = 0; j < n; ++j) {
      Polynomial defect = prover.rate(entry(pair.l, i, j));
      for (unsigned k = 0; k < n; ++k) {
        defect -= entry(pair.l, i, k) * entry(pair.a, k, j);
        defect += entry(pair.a, i, k) * entry(pair.l, k, j);
      }
      residuals.push_back({fmt::format("(dL/dt - [L, A])[{},{}]", i + 1, j + 1), std::move(defect),
                           [&prover, &pair, n, i, j] {
                             GiNaC::ex sum = prover.model().rate(pair.l(i, j));
                             for (unsigned k = 0; k < n; ++k)
                               sum -= pair.l(i, k) * pair.a(k, j) - pair.a(i, k) * pair.l(k, j);
                             return sum;
                           }});
    }
  }
  LaxPair on_level = pair;
  decide_within_constraints(
      prover, proof, pair.on,
      [&](Proof& own, const std::vector<NamedExpression>& on) {
        on_level.on = on;
        if (on.empty())
          prover.decide(own, residuals, {});
        else
          decide_on_level(prover, own, residuals, on_level);
      },
      [&](const Proof& open) {
        return is_open_on_constraints(prover, open) ||
               (open.verdict == Verdict::refuted && !pair.on.empty());
      });
  if (proof.verdict == Verdict::proved) {
    try {
      describe_integrals(prover, proof, on_level);
    } catch (const TooLarge& limit) {
      proof.evidence = std::string("its characteristic polynomial: ") + limit.what();
    }
  }
}

}  // namespace

std::vector<Claim> lax_claims(const Model& model) {
  std::vector<Claim> claims;
  for (std::size_t i = 0; i < model.lax_pairs.size(); ++i) {
    const std::string name =
        model.lax_pairs.size() == 1 ? "Lax pair" : fmt::format("Lax pair {}", i + 1);
    claims.push_back({ClaimKind::lax, name, false, [i](Prover& prover, Proof& proof) {
                        decide_lax(prover, proof, prover.model().lax_pairs[i]);
                      }});
    // The known integrals too: are those of the spectrum among them?
    std::vector<GiNaC::ex>& expressions = claims.back().expressions;
    for (const auto* list : {&model.casimirs, &model.integrals}) {
      for (const NamedExpression& f : real_everywhere(*list)) expressions.push_back(f.value);
    }
    claims.back().on = names_of(model.lax_pairs[i].on);
    for (const GiNaC::ex& value : values_of(model.lax_pairs[i].on)) expressions.push_back(value);
    for (const GiNaC::ex& part : model.lax_pairs[i].domain) expressions.push_back(part);
    for (const GiNaC::matrix* m : {&model.lax_pairs[i].l, &model.lax_pairs[i].a}) {
      for (std::size_t k = 0; k < m->nops(); ++k) expressions.push_back(m->op(k));
    }
  }
  return claims;
}

}  // namespace casimir
