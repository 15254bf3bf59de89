// Whether functions may be differentiated on a level.
#include <fmt/format.h>

#include <algorithm>

#include "symbolic/proof/prover.hpp"

namespace casimir {

bool Prover::keeps_sign(const Polynomial& u, const Level& level) {
  const auto [top, bottom] = ring_.lowest_terms(rate(u));
  Polynomial cofactor(ring_.ring());
  return (top.is_zero() || top.divide(u, &cofactor)) &&
         vanishes_nowhere_on(bottom, level, Divisors::of_motion);
}

std::vector<Polynomial> Prover::passed_jumps(const Polynomial& function, bool cuts, bool every) {
  std::vector<Polynomial> passed;
  if (ring_.is_polynomial()) return passed;
  every = every || !has_motion();
  // The motion goes through kinks of the Hamiltonian, though its equations have |x|/x there.
  std::vector<Polynomial> kinks;
  if (has_motion())
    for (const Polynomial& own : field())
      for (Polynomial& f : ring_.radicand_factors(own)) kinks.push_back(std::move(f));
  const auto may_end_the_motion = [&](const Polynomial& f) {
    return !every && std::find(kinks.begin(), kinks.end(), f) == kinks.end();
  };
  const auto ends_the_motion = [&](const Polynomial& f) {
    return may_end_the_motion(f) && vanishes_nowhere_on(f, {}, Divisors::of_motion);
  };
  const auto is_kept = [&](const Polynomial& f) {
    if (!every) return keeps_sign(f, {});
    const std::vector<Polynomial> flow = flow_of(gradient(f));
    return std::all_of(flow.begin(), flow.end(), [&](const Polynomial& p) { return is_zero(p); });
  };
  const auto divides = [&](const Polynomial& f) {
    return may_end_the_motion(f) &&
           std::ranges::any_of(explicit_divisors(Divisors::of_motion),
                               [&](const Polynomial& d) { return d == f || d == -f; });
  };
  // The Hamiltonian is infinite there, and no motion comes to such a place but by a collision.
  const auto has_pole = [&](const Polynomial& f) {
    return has_motion() && model_.hamiltonian &&
           ring_.vanishes_with(ring_.lowest_terms(ring_.convert(*model_.hamiltonian)).second, f);
  };
  const auto add = [&](Polynomial& f, bool split) {
    // A motion passes where a function of the claim alone has no value.
    const bool implied = ring_.is_nowhere_zero(f);
    if (!split && implied && has_pole(f)) return;
    const bool strictly = split || implied;
    if (!ring_.is_assumed_nonzero(f) && !(strictly ? divides(f) : ends_the_motion(f)) &&
        !is_kept(f) && std::find(passed.begin(), passed.end(), f) == passed.end())
      passed.push_back(std::move(f));
  };
  for (Polynomial& f : ring_.jump_factors(function, cuts)) add(f, false);
  for (Polynomial& f : ring_.split_jump_factors(function)) add(f, true);
  return passed;
}

void Prover::say_where_differentiable(Proof& proof, const std::vector<GiNaC::ex>& functions) {
  if (proof.verdict != Verdict::proved) return;
  for (const GiNaC::ex& function : functions) {
    const Polynomial& value = convert(function);
    if (ring_.is_polynomial()) continue;
    for (const Polynomial& radicand : ring_.radicand_factors(value, true)) {
      if (!ring_.depends_on_first(radicand, dimension()) ||
          ring_.is_smooth_across(value, radicand) || vanishes_nowhere_on(radicand, {}))
        continue;
      std::string condition = ring_.text(radicand) + " != 0";
      if (std::find(proof.where.begin(), proof.where.end(), condition) == proof.where.end())
        proof.where.push_back(std::move(condition));
    }
  }
}

bool Prover::is_smooth_on(Proof& proof, const Level& level,
                          const std::vector<NamedExpression>& list, Smooth smooth) {
  if (ring_.is_polynomial()) return true;
  const bool continuous = smooth == Smooth::without_jumps;
  for (const NamedExpression& f : list) {
    const Polynomial& value = convert(f.value);
    for (const Polynomial& radicand : ring_.radicand_factors(value, continuous)) {
      if (ring_.is_smooth_across(value, radicand)) continue;
      // What only the claim divides by, the motion passes: x/|x| is 1 until it is -1.
      const Divisors which = continuous ? Divisors::of_motion : Divisors::all;
      if (vanishes_nowhere_on(radicand, level, which)) continue;
      // Unless what is not zero never becomes it: x/|x| stays 1 where dx/dt = x.
      if (continuous && vanishes_nowhere_on(radicand, level, Divisors::all) &&
          keeps_sign(radicand, level))
        continue;
      if (smooth != Smooth::everywhere && ring_.is_rough_in_absolute_value_alone(value, radicand) &&
          keeps_sign(radicand, level))
        continue;
      proof.verdict = Verdict::undecided;
      proof.evidence.clear();
      proof.reason = fmt::format(
          "{} need not be differentiable where {} = 0, which is not excluded on the level", f.name,
          ring_.text(radicand));
      return false;
    }
  }
  return true;
}

}  // namespace casimir
