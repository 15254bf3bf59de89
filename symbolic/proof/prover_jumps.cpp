// Where functions may jump on the way of a motion.
#include <algorithm>

#include "symbolic/algebra/ideal.hpp"
#include "symbolic/proof/prover.hpp"

namespace casimir {
namespace {

constexpr GroebnerLimits kBasisOfMeeting{200, 60, 2000};

}  // namespace

/// A basis of an ideal of functions that are zero at the common real zeros of these on the
/// constraints, with the relations that the ring knows.
std::vector<Polynomial> Prover::basis_of_zeros(const std::vector<Polynomial>& functions) {
  std::vector<Polynomial> ideal = square_relations();
  for (const Polynomial& f : functions) {
    const std::vector<Polynomial> zeros = ring_.real_zeros_at_edge(f);
    ideal.insert(ideal.end(), zeros.begin(), zeros.end());
    ideal.push_back(f);
  }
  const std::vector<Polynomial>& within = level(model_.constraints).numerators;
  ideal.insert(ideal.end(), within.begin(), within.end());
  return groebner_basis(ideal, kBasisOfMeeting);
}

/// Whether two functions may vanish at one point of the constraints: their ideal is not seen to
/// contain what vanishes nowhere.
bool Prover::may_meet(const Polynomial& a, const Polynomial& b) {
  const std::vector<Polynomial>& identities = square_relations();
  return std::ranges::none_of(basis_of_zeros({a, b}), [&](const Polynomial& f) {
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
    return !factor.first.is_constant() && may_meet(factor.first, f);
  });
}

bool Prover::seems_to_have_pole(const Polynomial& p, const Polynomial& f) {
  const bool meets_few = ring_.real_zeros_at_edge(f).size() > 1;
  if (meets_few && ring_.grows_towards_zero(p, f)) return true;
  const auto coefficient = ring_.pole_coefficient(p, f);
  return coefficient && is_nonzero_somewhere(*coefficient, f);
}

/// Whether `p` is not zero all over f = 0: then a power of it would be in the ideal of f, as that
/// of u is where f is u^2. Of what is long no power is looked at.
bool Prover::is_nonzero_somewhere(const Polynomial& p, const Polynomial& f) {
  const std::vector<Polynomial> basis = basis_of_zeros({f});
  std::vector<Polynomial> quotients;
  Polynomial power = p;
  constexpr int kSquarings = 3;
  constexpr std::size_t kMostTerms = 60;
  for (int i = 0; i <= kSquarings; ++i) {
    power = power.remainder(basis, &quotients);
    if (power.is_zero()) return false;
    if (power.terms() > kMostTerms) break;
    power = ring_.checked_product(power, power);
  }
  return true;
}

/// Whether a motion ends where the irreducible f, which its equations divide by, is zero: a state
/// that stays finite there would have an infinite energy, which is conserved. A velocity that is
/// infinite ends none, as x' = 1/x^2 shows, whose x is (3 t)^(1/3), nor does what is bounded.
bool Prover::ends_motions(const Polynomial& f) {
  return model_.hamiltonian && !model_.time && has_pole(convert(*model_.hamiltonian), f);
}

bool Prover::varies(const Polynomial& p) const {
  return ring_.depends_on_first(p, dimension()) ||
         (model_.time && ring_.depends_on(p, dimension() + model_.parameters.size()));
}

/// What stands under roots in the equations: a motion is analytic where none of it is zero.
std::vector<Polynomial> Prover::kinks_of_motion() const {
  std::vector<Polynomial> kinks;
  if (!has_motion()) return kinks;
  for (const Polynomial& rate : field())
    for (Polynomial& f : ring_.radicand_factors(rate))
      if (varies(f) && std::find(kinks.begin(), kinks.end(), f) == kinks.end())
        kinks.push_back(std::move(f));
  return kinks;
}

/// What a motion passes of the places where a function may jump.
class PassedJumps {
 public:
  PassedJumps(Prover& prover, bool every)
      : prover_(prover), every_(every || !prover.has_motion()) {}

  /// \param split  as of `split_jump_factors`
  void add(std::vector<functions::JumpPlace> places, bool split) {
    for (functions::JumpPlace& place : places) {
      if (!is_passed(place.zero, split)) continue;
      if (place.with && !(prover_.varies(*place.with) && is_passed(*place.with, split) &&
                          prover_.may_meet(place.zero, *place.with)))
        continue;
      if (std::find(passed_.begin(), passed_.end(), place.zero) == passed_.end())
        passed_.push_back(std::move(place.zero));
    }
  }

  std::vector<Polynomial> passed() && { return std::move(passed_); }

 private:
  /// Whether a zero of f may be passed. A motion passes where a function of the claim alone has no
  /// value: that f is not zero where it has one says nothing.
  bool is_passed(const Polynomial& f, bool split) const {
    const bool implied = prover_.ring().is_nowhere_zero(f);
    if (!split && implied && !every_ && prover_.ends_motions(f)) return false;
    const bool strictly = split || implied;
    return !prover_.ring().is_assumed_nonzero(f) && !(strictly ? divides(f) : ends_motion(f)) &&
           !is_kept(f);
  }

  bool ends_motion(const Polynomial& f) const {
    return !every_ && prover_.vanishes_nowhere_on(f, {}, Prover::Divisors::of_motion);
  }

  bool divides(const Polynomial& f) const {
    return !every_ && std::ranges::any_of(prover_.explicit_divisors(Prover::Divisors::of_motion),
                                          [&](const Polynomial& d) { return d == f || d == -f; });
  }

  bool is_kept(const Polynomial& f) const {
    if (!every_) return prover_.keeps_sign(f, {});
    const std::vector<Polynomial> flow = prover_.flow_of(prover_.gradient(f));
    return std::all_of(flow.begin(), flow.end(),
                       [&](const Polynomial& p) { return prover_.is_zero(p); });
  }

  Prover& prover_;
  bool every_;
  std::vector<Polynomial> passed_;
};

std::vector<Polynomial> Prover::passed_jumps(const Polynomial& function, bool cuts, bool every) {
  if (ring_.is_polynomial()) return {};
  PassedJumps jumps(*this, every);
  jumps.add(ring_.jump_factors(function, cuts, kinks_of_motion()), false);
  jumps.add(ring_.split_jump_factors(function), true);
  return std::move(jumps).passed();
}

}  // namespace casimir
