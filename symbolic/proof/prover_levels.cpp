// Claims on levels: what vanishes there, and whether the motion keeps to it.
#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "symbolic/algebra/where_defined.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/proof/prover.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

constexpr GroebnerLimits kSmallBasis{200, 60, 2000};

}  // namespace

std::vector<NamedExpression> Prover::functions_of(const Level& level) {
  std::vector<NamedExpression> result;
  for (std::size_t i = 0; i < level.functions.size(); ++i)
    result.push_back({level.texts[i], level.functions[i], {}});
  return result;
}

const std::vector<Polynomial>& Prover::square_relations() {
  const std::size_t end = ring_.end_of_generators();
  if (square_relations_.first == end) return square_relations_.second;
  square_relations_ = {end, {}};
  for (std::size_t i = ring_.symbols().size(); i < end; ++i) {
    const Polynomial square = ring_.ring().variable(i) * ring_.ring().variable(i);
    const Polynomial relation = square - ring_.numerator(square);
    // Not so for 1/d, whose numerator is another function.
    if (!relation.is_zero() && ring_.numerator(relation).is_zero())
      square_relations_.second.push_back(relation);
  }
  return square_relations_.second;
}

/// Simpler functions with the common real zeros of one, which may be what the level of a square or
/// of a sum of squares is invariant by: without factors that vanish nowhere, with each other factor
/// once, and the parts of what is never negative.
std::vector<NamedExpression> Prover::simplified(const NamedExpression& f, int depth) {
  const Polynomial numerator = ring_.lowest_terms(convert(f.value)).first;
  if (ring_.is_complex() || numerator.is_zero() || depth == 0) return {f};
  Polynomial product = ring_.ring().constant(1), rest = product;
  std::size_t count = 0;
  for (const auto& [factor, exponent] : numerator.factors()) {
    if (factor.is_constant()) continue;
    const bool nowhere = ring_.is_nowhere_zero(factor);
    if (nowhere || exponent > 1) rest *= nowhere ? factor : factor.pow(exponent - 1);
    if (nowhere) continue;
    product *= factor;
    ++count;
  }
  if (count == 0) return {f};
  const std::vector<Polynomial> zeros =
      count == 1 ? ring_.real_zeros(product) : std::vector<Polynomial>{product};
  if (rest.is_constant() && zeros.size() == 1 && zeros[0] == product) return {f};
  try {
    std::vector<NamedExpression> result;
    for (const Polynomial& zero : zeros) {
      const auto parts = simplified({ring_.text(zero), ring_.expression(zero), {}}, depth - 1);
      result.insert(result.end(), parts.begin(), parts.end());
    }
    return result;
  } catch (const TooLarge&) {
    return {f};  // simpler by its zeros alone
  }
}

Level Prover::make_level(const std::vector<NamedExpression>& on) {
  Level result;
  for (const NamedExpression& whole : on) {
    for (const auto& [f, numerator] : level_functions(whole)) {
      if (!f.value.is_equal(whole.value)) convert(f.value);
      result.texts.push_back(f.name);
      result.functions.push_back(f.value);
      result.numerators.push_back(numerator);
    }
  }
  // The time moves as well, and t = 0 is no part of a level.
  const std::size_t time = dimension() + model_.parameters.size();
  result.solved = triangular_set(result.numerators, dimension(), [&](const Polynomial& p) {
    return ring_.depends_on_first(p, dimension()) || (model_.time && ring_.depends_on(p, time));
  });
  result.orthogonal = orthogonal_vectors(result.numerators, dimension());
  return result;
}

const std::vector<Polynomial>& Prover::basis_of(const Level& level) {
  for (const KnownBasis& known : known_bases_)
    if (known.in_branch == in_branch_ && known.generators == level.numerators) return known.basis;
  std::vector<Polynomial> ideal = level.numerators;
  const std::vector<Polynomial>& identities = square_relations();
  ideal.insert(ideal.end(), identities.begin(), identities.end());
  std::vector<Polynomial> basis =
      level.empty() ? std::vector<Polynomial>{}
                    : groebner_basis(ideal, in_branch_ ? kSmallBasis : GroebnerLimits{});
  return known_bases_.emplace_back(KnownBasis{level.numerators, in_branch_, std::move(basis)})
      .basis;
}

std::vector<Residual> Prover::level_rates(const Level& level) {
  std::vector<Residual> result;
  for (std::size_t i = 0; i < level.functions.size(); ++i) {
    const ex f = level.functions[i];
    result.push_back({fmt::format("d({})/dt", level.texts[i]), rate(convert(f)),
                      [this, f] { return model_.rate(f); }});
  }
  return result;
}

/// What the claim, the bracket and the flow divide by, or take the logarithm of, and the squared
/// distances from the origin of which they take the angle: where one of these vanishes, nothing is
/// claimed.
const std::vector<Polynomial>& Prover::explicit_divisors(Divisors which) {
  std::optional<std::vector<Polynomial>>& known =
      which == Divisors::all ? divisors_ : motion_divisors_;
  if (known) return *known;
  known.emplace();
  const auto add_polynomial = [&](const Polynomial& p) {
    for (const auto& [f, exponent] : ring_.lowest_terms(p).first.factors()) {
      if (!f.is_constant() && std::find(known->begin(), known->end(), f) == known->end())
        known->push_back(f);
    }
  };
  std::unordered_set<ex> seen;
  const auto add = [&](const ex& base) {
    if (seen.insert(base).second) add_polynomial(ring_.convert(base));
  };
  const std::vector<ex> motion = with_dynamics(model_, {}, subject_);
  for (const ex& expression : which == Divisors::all ? domain_ : motion) {
    for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part) {
      if (GiNaC::is_exactly_a<GiNaC::power>(*part)) {
        const ex exponent = part->op(1);
        if (!GiNaC::is_exactly_a<GiNaC::numeric>(exponent) ||
            GiNaC::ex_to<GiNaC::numeric>(exponent).is_negative())
          add(part->op(0));
      } else if (GiNaC::is_exactly_a<GiNaC::function>(*part)) {
        const std::string name = GiNaC::ex_to<GiNaC::function>(*part).get_name();
        if (name == "log") add(part->op(0));
        if (name == "tan") add(GiNaC::cos(part->op(0)));
        if (name == "atan2") {
          const Polynomial& y = ring_.convert(part->op(0));
          const Polynomial& x = ring_.convert(part->op(1));
          add_polynomial(x * x + y * y);
        }
      }
    }
  }
  if (which == Divisors::of_motion && has_motion())
    std::erase_if(*known, [&](const Polynomial& f) { return !ends_motions(f); });
  return *known;
}

bool Prover::is_kept_from_zero(const Polynomial& f, Divisors which) {
  for (const KeptFromZero& known : kept_from_zero_)
    if (known.which == which && known.function == f) return known.kept;
  // The motion may pass where a function of the claim alone has no value.
  const auto factors = f.factors();
  bool kept = which == Divisors::all ? ring_.is_nowhere_zero(f)
                                     : std::ranges::all_of(factors, [&](const auto& factor) {
                                         return ring_.is_assumed_nonzero(factor.first);
                                       });
  if (!kept) {
    const auto& divisors = explicit_divisors(which);
    const Polynomial minus = -f;
    kept = std::any_of(divisors.begin(), divisors.end(),
                       [&](const Polynomial& d) { return d == f || d == minus; });
  }
  constexpr std::size_t kMostKept = 100;
  if (kept_from_zero_.size() < kMostKept) kept_from_zero_.push_back({which, f, kept});
  return kept;
}

/// A factor vanishes nowhere there that the assumptions keep from zero, that is divided by, or that
/// has no zero in common with the level: then the ideal of both contains 1, or something else that
/// vanishes nowhere (the easy half of Hilbert's Nullstellensatz).
bool Prover::vanishes_nowhere_on(const Polynomial& p, const Level& level, Divisors which) {
  const auto kept_from_zero = [&](const Polynomial& f) { return is_kept_from_zero(f, which); };
  const auto never = [&](const Polynomial& f) {
    if (f.is_constant()) return !f.is_zero();
    const auto factors = f.factors();
    return std::all_of(factors.begin(), factors.end(), [&](const auto& factor) {
      return factor.first.is_constant() || kept_from_zero(factor.first);
    });
  };
  if (p.is_constant()) return !p.is_zero();
  for (const auto& [f, exponent] : p.factors()) {
    if (f.is_constant() || kept_from_zero(f)) continue;
    if (level.empty() && seems_to_vanish(f, which)) return false;
    std::vector<Polynomial> ideal = level.numerators;
    const std::vector<Polynomial>& identities = square_relations();
    ideal.insert(ideal.end(), identities.begin(), identities.end());
    const std::vector<Polynomial> zeros =
        which == Divisors::all ? ring_.real_zeros(f) : ring_.real_zeros_at_edge(f);
    ideal.insert(ideal.end(), zeros.begin(), zeros.end());
    const std::vector<Polynomial> basis = groebner_basis(ideal, kSmallBasis);
    // Or a divisor vanishes wherever f does, so that nothing is claimed there.
    const auto& divisors = explicit_divisors(which);
    const bool undefined = std::any_of(divisors.begin(), divisors.end(), [&](const Polynomial& d) {
      std::vector<Polynomial> quotients;
      return d.remainder(basis, &quotients).is_zero();
    });
    if (undefined) continue;
    const bool excluded = std::any_of(basis.begin(), basis.end(), [&](const Polynomial& b) {
      return std::find(identities.begin(), identities.end(), b) == identities.end() && never(b);
    });
    if (!excluded) return false;
  }
  return true;
}

/// The same where relations x = value are put in first: on the level the functions may be simpler
/// than the ring knows, as sqrt(G^2 - H^2) where H = 0 and G > 0; and so may the assumptions be. It
/// is the numerator that is put in: roots that were differentiated have denominators, from which
/// the new ring would conclude that they are not zero.
bool Prover::vanishes_by_substitution(const Residual& residual, const Level& level) const {
  if (ring_.is_polynomial() || level.solved.empty()) return false;
  const auto on_level = [&](ex value) {
    for (const SolvedRelation& solved : level.solved) {
      if (!solved.leading.is_constant() || solved.relation.degree(solved.variable) != 1) continue;
      const Polynomial rest = solved.relation.coefficients(solved.variable)[0];
      const cln::cl_RA factor = -1 / solved.leading.term_list()[0].first;
      value = substituted(
          value, {{ring_.symbols()[solved.variable], ring_.expression(rest.scaled(factor))}},
          ring_.limits());
    }
    return value;
  };
  const auto vanishes = [&] {
    const ex value = on_level(ring_.expression(ring_.lowest_terms(residual.value).first));
    std::vector<Assumption> assumptions = model_.assumptions;
    for (Assumption& a : assumptions) a.difference = on_level(a.difference);
    FunctionRing fresh(ring_.symbols(), assumptions, {value}, ring_.limits());
    return fresh.numerator(fresh.convert(value)).is_zero();
  };
  try {
    return where_defined(vanishes).value_or(false);
  } catch (const ModelError&) {
    return false;  // a division by what vanishes on the level, or too large
  }
}

bool Prover::in_ideal(const Residual& residual, const Level& level) {
  const Polynomial value = ring_.lowest_terms(residual.value).first;
  std::vector<Polynomial> quotients;
  if (value.is_zero() || value.remainder(level.numerators, &quotients).is_zero()) return true;
  const Polynomial rest = level.solved.empty()
                              ? value.remainder(basis_of(level), &quotients)
                              : ring_.lowest_terms(pseudo_remainder(value, level.solved)).first;
  if (rest.is_zero()) return true;
  if (!vanishes_by_substitution(residual, level)) return false;
  // r(x) = r(x) - r(x') with x' on the level is a combination with continuous coefficients (the
  // mean values of the derivatives) only where r has continuous derivatives: sqrt(x) on x = 0 has
  // not.
  const std::vector<Polynomial> radicands = ring_.radicand_factors(residual.value, true);
  return std::all_of(radicands.begin(), radicands.end(), [&](const Polynomial& f) {
    return vanishes_nowhere_on(f, level, Divisors::of_motion);
  });
}

void Prover::decide_invariance_once(Proof& proof, std::vector<NamedExpression> functions) {
  const Proof blank = proof;
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const Level own = level(functions);
    const std::vector<Residual> rates = level_rates(own);
    proof = blank;
    decide_on(proof, rates, own);
    if (proof.verdict != Verdict::proved ||
        !is_smooth_on(proof, own, functions_of(own), Smooth::without_jumps))
      return;
    const std::size_t before = functions.size();
    for (const Residual& rate : rates) {
      if (!in_ideal(rate, own)) functions.push_back({rate.label, rate.by_ginac(), {}});
    }
    if (functions.size() == before) return say_where_motions_leave(proof, own, rates);
  }
  proof = blank;
  proof.verdict = Verdict::undecided;
  proof.reason =
      "the rates of the functions vanish on their zero level, but are no combinations of them";
}

void Prover::decide_branches(
    Proof& proof, const std::vector<NamedExpression>& functions, int depth,
    const std::function<void(Proof&, const std::vector<NamedExpression>&, int)>& decide_part) {
  if (proof.verdict != Verdict::proved) return;
  constexpr int kDepth = 2;
  const std::vector<Polynomial> leads = std::exchange(leads_, {});
  for (const Polynomial& lead : leads) {
    for (const auto& [f, exponent] : lead.factors()) {
      if (f.is_constant() || vanishes_nowhere_on(f, {})) continue;
      const std::string text = ring_.text(f);
      const std::string condition = text + " != 0";
      if (std::find(proof.where.begin(), proof.where.end(), condition) != proof.where.end())
        continue;
      Proof part;
      part.verdict = Verdict::undecided;
      if (depth < kDepth) {
        std::vector<NamedExpression> more = functions;
        more.push_back({text, ring_.expression(f), {}});
        const bool outer = std::exchange(in_branch_, true);
        decide_part(part, more, depth + 1);
        in_branch_ = outer;
      }
      if (part.verdict == Verdict::refuted) {
        part.on = proof.on;
        part.kind = proof.kind;
        part.name = proof.name;
        part.fact = proof.fact;
        part.note = proof.note;
        proof = std::move(part);
        return;
      }
      if (part.verdict != Verdict::proved || !part.where.empty()) proof.where.push_back(condition);
    }
  }
}

void Prover::decide_invariance(Proof& proof, const std::vector<NamedExpression>& functions) {
  std::function<void(Proof&, const std::vector<NamedExpression>&, int)> decide_part;
  decide_part = [&](Proof& part, const std::vector<NamedExpression>& own, int depth) {
    decide_invariance_once(part, own);
    decide_branches(part, own, depth, decide_part);
  };
  decide_part(proof, functions, 0);
  check_inhabited(proof, level(functions));
  say_conditions(proof);
}

bool Prover::vanishes_on(const Residual& residual, Polynomial& rest, const Level& level,
                         Proof& proof) {
  auto [top, bottom] = ring_.lowest_terms(residual.value);
  rest = std::move(top);
  if (rest.is_zero()) return true;
  // Numerators say nothing where the denominator, too, vanishes.
  if (!vanishes_nowhere_on(bottom, level)) {
    proof.reason = fmt::format("{} has the denominator {}, which may vanish on the level",
                               residual.label, shortened(ring_.text(bottom), bottom.terms()));
    return false;
  }
  std::vector<Polynomial> cofactors;
  const Polynomial plain = rest.remainder(level.numerators, &cofactors);
  if (plain.is_zero()) {
    for (std::size_t i = 0; i < cofactors.size(); ++i) {
      if (cofactors[i].is_zero()) continue;
      if (!proof.evidence.empty()) proof.evidence += "; ";
      proof.evidence += fmt::format("{} has the cofactor {}", residual.label,
                                    cofactor_text(cofactors[i], bottom, level, i));
    }
    rest = plain;
    return true;
  }
  bool solved_by_leads = false;
  const auto reduced = [&](const Polynomial& p) {
    if (level.solved.empty()) return p.remainder(basis_of(level), &cofactors);
    solved_by_leads = true;
    return ring_.lowest_terms(pseudo_remainder(p, level.solved)).first;
  };
  rest = reduced(rest);
  // The ideal need not contain all that vanishes on the level: cos(q) = 1 gives sin(q)^2 = 0.
  constexpr std::size_t kMaxSquared = 100;
  if (!rest.is_zero() && rest.terms() <= kMaxSquared &&
      reduced(ring_.numerator(rest * rest)).is_zero())
    rest = Polynomial(ring_.ring());
  if (!rest.is_zero()) {
    solved_by_leads = false;  // only relations x = value are put in
    if (!vanishes_by_substitution(residual, level)) return false;
  }
  for (const SolvedRelation& solved : level.solved) {
    const bool listed = std::find(leads_.begin(), leads_.end(), solved.leading) != leads_.end();
    if (solved_by_leads && !solved.leading.is_constant() && !listed)
      leads_.push_back(solved.leading);
  }
  return true;
}

void Prover::decide_on(Proof& proof, const std::vector<Residual>& residuals, const Level& level) {
  proof.verdict = Verdict::proved;
  leads_.clear();
  int searches = 0;
  for (const Residual& residual : residuals) {
    std::string singular;
    if (is_zero(residual.value)) continue;
    Polynomial rest = ring_.numerator(residual.value);
    if (rest.is_zero() && level.empty()) {
      rest = ring_.reduced(residual.value);
      singular = fmt::format(
          "{} is shown to vanish only after multiplication by what may be a divisor of zero",
          residual.label);
    } else if (!level.empty()) {
      const std::string before = std::exchange(proof.reason, {});
      const bool vanishes = vanishes_on(residual, rest, level, proof);
      singular = std::exchange(proof.reason, before);
      if (vanishes) continue;
    }
    const bool first = proof.verdict == Verdict::proved;
    // A level on which no exact point is found the first time is not searched again and again.
    const int most_searches = in_branch_ ? 1 : 2;
    std::optional<Witness> found;
    if (searches++ < most_searches || level.empty()) found = witness(rest, residual, level);
    if (!first && !found) continue;
    proof.verdict = found ? Verdict::refuted : Verdict::undecided;
    proof.residual = residual_text(residual, rest, level);
    proof.reason = found ? fmt::format("{} is not zero", residual.label)
                   : !singular.empty()
                       ? singular
                       : fmt::format(
                             "{} does not reduce to zero, and no exact point was found at which "
                             "it is not zero",
                             residual.label);
    proof.witness = std::move(found);
    if (proof.witness) break;
  }
  if (proof.verdict != Verdict::proved) proof.evidence.clear();
}

void Prover::decide(Proof& proof, const std::vector<Residual>& residuals, const Level& own) {
  const Proof blank = proof;
  holds_on_constraints_ = false;
  decide_with_branches(proof, residuals, own);
  if (proof.verdict != Verdict::refuted) return;
  Proof there = blank;
  decide_again_on_constraints(there, residuals, own);
  if (there.verdict != Verdict::refuted || there.witness) proof = std::move(there);
}

std::vector<NamedExpression> Prover::within_constraints(
    std::vector<NamedExpression> functions) const {
  if (!constraints_count_) return functions;
  for (const NamedExpression& constraint : model_.constraints) {
    const bool known =
        std::any_of(functions.begin(), functions.end(),
                    [&](const NamedExpression& f) { return f.value.is_equal(constraint.value); });
    if (!known) functions.push_back(constraint);
  }
  return functions;
}

/// Leaves a refutation without a witness where there is nothing to decide again.
void Prover::decide_again_on_constraints(Proof& proof, const std::vector<Residual>& residuals,
                                         const Level& own) {
  const std::vector<NamedExpression> given = functions_of(own);
  const std::vector<NamedExpression> functions = within_constraints(given);
  proof.verdict = Verdict::refuted;
  if (functions.size() == given.size()) return;
  decide_with_branches(proof, residuals, level(functions));
  if (proof.verdict == Verdict::refuted) return;
  holds_on_constraints_ = proof.verdict == Verdict::proved;
  proof.verdict = Verdict::undecided;
  proof.evidence.clear();
  proof.where.clear();
  proof.nonzero.clear();
  proof.reason = holds_on_constraints_
                     ? "it holds on the constraints, and not outside of them"
                     : "it does not hold outside of the constraints; on them, " + proof.reason;
}

void Prover::decide_with_branches(Proof& proof, const std::vector<Residual>& residuals,
                                  const Level& own) {
  decide_on(proof, residuals, own);
  std::function<void(Proof&, const std::vector<NamedExpression>&, int)> decide_part;
  decide_part = [&](Proof& part, const std::vector<NamedExpression>& functions, int depth) {
    decide_on(part, residuals, level(functions));
    decide_branches(part, functions, depth, decide_part);
  };
  decide_branches(proof, functions_of(own), 0, decide_part);
  check_inhabited(proof, own);
  say_conditions(proof);
}

void Prover::say_where_motion_is_unique(Proof& proof, const NamedExpression& f) {
  if (proof.verdict != Verdict::proved || ring_.is_polynomial()) return;
  std::vector<Polynomial> open = ring_.radicand_factors(convert(f.value));
  std::erase_if(open, [&](const Polynomial& p) { return is_kept_from_zero(p, Divisors::all); });
  if (open.empty()) return;
  std::vector<Polynomial> of_motion;
  for (const Polynomial& rate : field()) {
    for (Polynomial& p : ring_.radicand_factors(rate)) of_motion.push_back(std::move(p));
  }
  for (const Polynomial& p : open) {
    const bool shared = std::find(of_motion.begin(), of_motion.end(), p) != of_motion.end();
    if (shared && !vanishes_nowhere_on(p, {})) proof.where.push_back(ring_.text(p) + " != 0");
  }
}

}  // namespace casimir
