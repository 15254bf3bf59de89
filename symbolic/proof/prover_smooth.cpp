// Whether functions may be differentiated on a level.
#include <fmt/format.h>

#include <algorithm>

#include "symbolic/algebra/ideal.hpp"
#include "symbolic/proof/prover.hpp"

namespace casimir {

bool Prover::keeps_sign(const Polynomial& u, const Level& level) {
  const auto [top, bottom] = ring_.lowest_terms(rate(u));
  Polynomial cofactor(ring_.ring());
  return (top.is_zero() || top.divide(u, &cofactor)) &&
         vanishes_nowhere_on(bottom, level, Divisors::of_motion);
}

/// Whether the equations of motion have roots of the irreducible f, and are not seen to grow
/// without bound where it vanishes: q/|q| is bounded, and runs go on behind such a place. (Of a
/// Hamiltonian itself is known what it divides by, and not its derivatives.)
bool Prover::is_kink_of_motion(const Polynomial& f) const {
  if (!has_motion() || model_.hamiltonian) return false;
  bool kink = false;
  for (const Polynomial& rate : field()) {
    const std::vector<Polynomial> rough = ring_.radicand_factors(rate);
    kink = kink || std::ranges::any_of(rough, [&](const auto& r) { return r == f || r == -f; });
    if (ring_.grows_towards_zero(rate, f)) return false;
  }
  return kink;
}

/// Whether two functions may vanish at one point of the constraints: their ideal, with the
/// relations that the ring knows, is not seen to contain what vanishes nowhere.
bool Prover::may_meet(const Polynomial& a, const Polynomial& b) {
  std::vector<Polynomial> ideal = square_relations();
  for (const Polynomial& f : {a, b}) {
    const std::vector<Polynomial> zeros = ring_.real_zeros(f);
    ideal.insert(ideal.end(), zeros.begin(), zeros.end());
    ideal.push_back(f);
  }
  const std::vector<Polynomial>& within = level(model_.constraints).numerators;
  ideal.insert(ideal.end(), within.begin(), within.end());
  constexpr GroebnerLimits kLimits{200, 60, 2000};
  const std::vector<Polynomial>& identities = square_relations();
  return std::ranges::none_of(groebner_basis(ideal, kLimits), [&](const Polynomial& f) {
    if (std::find(identities.begin(), identities.end(), f) != identities.end()) return false;
    const auto factors = f.factors();
    return std::ranges::all_of(factors, [&](const auto& factor) {
      return factor.first.is_constant() ? !factor.first.is_zero()
                                        : ring_.is_assumed_nonzero(factor.first);
    });
  });
}

bool Prover::has_pole(const Polynomial& p, const Polynomial& f) {
  const auto coefficient = ring_.pole_coefficient(p, f);
  if (!coefficient) return false;
  const auto factors = coefficient->factors();
  return std::ranges::none_of(factors, [&](const auto& factor) {
    return ring_.depends_on_first(factor.first, dimension()) && may_meet(factor.first, f);
  });
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
  const auto ends_in_pole = [&](const Polynomial& f) {
    return has_motion() && model_.hamiltonian && has_pole(ring_.convert(*model_.hamiltonian), f);
  };
  const auto is_passed = [&](const Polynomial& f, bool split) {
    // A motion passes where a function of the claim alone has no value.
    const bool implied = ring_.is_nowhere_zero(f);
    if (!split && implied && ends_in_pole(f)) return false;
    const bool strictly = split || implied;
    return !ring_.is_assumed_nonzero(f) && !(strictly ? divides(f) : ends_the_motion(f)) &&
           !is_kept(f);
  };
  const auto add = [&](Polynomial&& f) {
    if (std::find(passed.begin(), passed.end(), f) == passed.end()) passed.push_back(std::move(f));
  };
  const auto add_passed = [&](std::vector<functions::JumpPlace> places, bool split) {
    for (functions::JumpPlace& place : places) {
      if (!is_passed(place.zero, split)) continue;
      if (place.with && !(ring_.depends_on_first(*place.with, dimension()) &&
                          is_passed(*place.with, split) && may_meet(place.zero, *place.with)))
        continue;
      add(std::move(place.zero));
    }
  };
  add_passed(ring_.jump_factors(function, cuts), false);
  add_passed(ring_.split_jump_factors(function), true);
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
      const Divisors which = continuous ? Divisors::of_motion_without_kinks : Divisors::all;
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
