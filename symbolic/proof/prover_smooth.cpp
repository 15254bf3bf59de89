// Whether functions may be differentiated on a level.
#include <fmt/format.h>

#include <algorithm>

#include "symbolic/proof/prover.hpp"

namespace casimir {

bool Prover::keeps_sign(const Polynomial& u, const Level& level) {
  const auto [top, bottom] = ring_.lowest_terms(rate(u));
  const auto has_no_zero = [&](const Polynomial& f) {
    return vanishes_nowhere_on(f, level, Divisors::of_motion);
  };
  Polynomial cofactor(ring_.ring());
  return (top.is_zero() || top.divide(u, &cofactor)) && has_no_zero(bottom) &&
         std::ranges::all_of(ring_.pole_factors(cofactor), has_no_zero);
}

void Prover::say_where_motions_leave(Proof& proof, const Level& level,
                                     const std::vector<Residual>& rates) {
  const auto may_pass = [&](const Polynomial& pole) {
    const std::vector<Polynomial>& kinks = kinks_of_motion(false);
    return std::find(kinks.begin(), kinks.end(), pole) != kinks.end() &&
           !vanishes_nowhere_on(pole, level, Divisors::of_motion) && !keeps_sign(pole, level) &&
           !vanishes_nowhere_on(pole, this->level(model_.constraints), Divisors::of_motion);
  };
  for (const Residual& rate : rates) {
    for (const Polynomial& pole : ring_.pole_factors(rate.value)) {
      if (!may_pass(pole)) continue;
      std::string condition = fmt::format("on motions that do not cross {} = 0", ring_.text(pole));
      if (std::find(proof.where.begin(), proof.where.end(), condition) == proof.where.end())
        proof.where.push_back(std::move(condition));
    }
  }
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
  const auto kinks = continuous ? kinks_of_motion(false) : std::vector<Polynomial>{};
  const bool analytic = std::ranges::all_of(kinks, [&](const auto& kink) {
    return vanishes_nowhere_on(kink, level, Divisors::of_motion);
  });
  for (const NamedExpression& f : list) {
    const Polynomial& value = convert(f.value);
    // Along analytic motions a quotient that is constant has no pole; y/x^2 has one value along
    // (t, t^2) and another along (t, -t^2).
    const Polynomial bottom = ring_.lowest_terms(value).second;
    const auto poles = analytic ? std::vector<Polynomial>{} : ring_.pole_factors(value);
    const auto pole = std::ranges::find_if_not(poles, [&](const Polynomial& own) {
      return vanishes_nowhere_on(own, level, Divisors::of_motion);
    });
    if (pole != poles.end()) {
      proof.verdict = Verdict::undecided;
      proof.evidence.clear();
      proof.reason =
          fmt::format("{} need not be finite where {} = 0, where a motion that has kinks may pass",
                      f.name, ring_.text(*pole));
      return false;
    }
    for (const Polynomial& radicand : ring_.radicand_factors(value, continuous)) {
      // What only the claim divides by, the motion passes: x/|x| is 1 until it is -1.
      const Divisors which = continuous ? Divisors::of_motion : Divisors::all;
      // y*|y| is smooth, y*|y|/y^2 is not.
      if (ring_.is_smooth_across(value, radicand) && vanishes_nowhere_on(bottom, level, which))
        continue;
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
