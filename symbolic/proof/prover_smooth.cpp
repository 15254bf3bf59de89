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
  const auto ends_the_motion = [&](const Polynomial& f) {
    return !every && std::find(kinks.begin(), kinks.end(), f) == kinks.end() &&
           vanishes_nowhere_on(f, {}, Divisors::of_motion);
  };
  const auto is_kept = [&](const Polynomial& f) {
    if (!every) return keeps_sign(f, {});
    const std::vector<Polynomial> flow = flow_of(gradient(f));
    return std::all_of(flow.begin(), flow.end(), [&](const Polynomial& p) { return is_zero(p); });
  };
  for (Polynomial& f : ring_.jump_factors(function, cuts))
    if (!ring_.is_nowhere_zero(f) && !ends_the_motion(f) && !is_kept(f))
      passed.push_back(std::move(f));
  return passed;
}

std::vector<std::string> Prover::where_without_jumps(const std::vector<Polynomial>& functions,
                                                     bool every) {
  std::vector<std::string> where;
  for (const Polynomial& function : functions) {
    for (const Polynomial& f : passed_jumps(function, true, every)) {
      std::string condition = fmt::format("on motions that do not cross {} = 0", ring_.text(f));
      if (std::find(where.begin(), where.end(), condition) == where.end())
        where.push_back(std::move(condition));
    }
  }
  return where;
}

std::vector<std::string> Prover::where_without_jumps(const std::vector<NamedExpression>& functions,
                                                     bool every) {
  std::vector<Polynomial> values;
  for (const NamedExpression& f : functions) values.push_back(convert(f.value));
  return where_without_jumps(values, every);
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
