// Where functions may jump on the way of a motion.
#include <algorithm>

#include "symbolic/algebra/ideal.hpp"
#include "symbolic/proof/prover.hpp"

namespace casimir {
namespace {

constexpr GroebnerLimits kBasisOfMeeting{200, 60, 2000};

}  // namespace

/// Whether two functions may vanish at one point of the constraints: their ideal, with the
/// relations that the ring knows, is not seen to contain what vanishes nowhere.
bool Prover::may_meet(const Polynomial& a, const Polynomial& b) {
  std::vector<Polynomial> ideal = square_relations();
  for (const Polynomial& f : {a, b}) {
    const std::vector<Polynomial> zeros = ring_.real_zeros_at_edge(f);
    ideal.insert(ideal.end(), zeros.begin(), zeros.end());
    ideal.push_back(f);
  }
  const std::vector<Polynomial>& within = level(model_.constraints).numerators;
  ideal.insert(ideal.end(), within.begin(), within.end());
  const std::vector<Polynomial>& identities = square_relations();
  return std::ranges::none_of(groebner_basis(ideal, kBasisOfMeeting), [&](const Polynomial& f) {
    if (std::find(identities.begin(), identities.end(), f) != identities.end()) return false;
    const auto factors = f.factors();
    return std::ranges::all_of(factors, [&](const auto& factor) {
      return factor.first.is_constant() ? !factor.first.is_zero()
                                        : ring_.is_assumed_nonzero(factor.first);
    });
  });
}

bool Prover::has_pole(const Polynomial& p, const Polynomial& f) {
  const auto pole = ring_.pole_at(p, f);
  if (!pole) return false;
  const auto factors = pole->coefficient.factors();
  return std::ranges::none_of(factors, [&](const auto& factor) {
    return ring_.depends_on_first(factor.first, dimension()) && may_meet(factor.first, f);
  });
}

bool Prover::seems_to_have_pole(const Polynomial& p, const Polynomial& f) {
  const bool meets_few = ring_.real_zeros_at_edge(f).size() > 1;
  if (meets_few && ring_.grows_towards_zero(p, f)) return true;
  const auto pole = ring_.pole_at(p, f);
  return pole && is_nonzero_somewhere(pole->coefficient, f);
}

/// Whether `p` is not zero all over f = 0: then a power of it would be in the ideal of f, as that
/// of u is where f is u^2.
bool Prover::is_nonzero_somewhere(const Polynomial& p, const Polynomial& f) {
  std::vector<Polynomial> ideal = square_relations();
  const std::vector<Polynomial> zeros = ring_.real_zeros_at_edge(f);
  ideal.insert(ideal.end(), zeros.begin(), zeros.end());
  ideal.push_back(f);
  const std::vector<Polynomial>& within = level(model_.constraints).numerators;
  ideal.insert(ideal.end(), within.begin(), within.end());
  const std::vector<Polynomial> basis = groebner_basis(ideal, kBasisOfMeeting);
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

/// Whether a motion ends where the irreducible f, which its equations divide by, is zero. A state
/// that stays finite there would have an infinite energy, or a velocity whose integral is: like
/// 1/f or more, like 1/sqrt(f) where f is a sum of squares, of the order of t^2 on a way through
/// its zero. A bounded force ends none: q/|q| and sin(q)/q.
bool Prover::ends_motions(const Polynomial& f) {
  constexpr std::size_t kMostTerms = 300;
  if (model_.hamiltonian && has_pole(convert(*model_.hamiltonian), f)) return true;
  Polynomial squares(ring_.ring());
  for (const Polynomial& rate : field()) {
    const Polynomial bottom = ring_.lowest_terms(rate).second;
    if (!ring_.vanishes_with(bottom, f)) continue;
    if (rate.terms() * rate.terms() + squares.terms() > kMostTerms * kMostTerms) return false;
    squares += ring_.checked_product(rate, rate);
  }
  const auto pole = ring_.pole_at(squares, f);
  const double least = ring_.real_zeros_at_edge(f).size() > 1 ? 1 : 2;
  return pole && pole->order >= least && has_pole(squares, f);
}

/// The same of almost all motions that come there: one equation at least has a pole 1/f or more,
/// the coefficient of which, a polynomial of the symbols as f is, is not zero all over f = 0.
bool Prover::ends_almost_all_motions(const Polynomial& f) {
  const auto in_symbols = [&](const Polynomial& p) {
    for (std::size_t i = ring_.symbols().size(); i < ring_.ring().size(); ++i)
      if (p.uses(i)) return false;
    return true;
  };
  if (!in_symbols(f)) return false;
  return std::ranges::any_of(field(), [&](const Polynomial& rate) {
    const auto pole = ring_.pole_at(rate, f);
    return pole && pole->order >= 1 && in_symbols(pole->coefficient) &&
           is_nonzero_somewhere(pole->coefficient, f);
  });
}

/// What a motion passes of the places where a function may jump.
class PassedJumps {
 public:
  PassedJumps(Prover& prover, Prover::Motions motions)
      : prover_(prover),
        every_(motions == Prover::Motions::of_every_hamiltonian),
        almost_(motions == Prover::Motions::almost_all) {}

  /// \param split  as of `split_jump_factors`
  void add(std::vector<functions::JumpPlace> places, bool split) {
    const FunctionRing& ring = prover_.ring();
    for (functions::JumpPlace& place : places) {
      if (!is_passed(place.zero, split)) continue;
      if (place.with &&
          !(ring.depends_on_first(*place.with, prover_.dimension()) &&
            is_passed(*place.with, split) && prover_.may_meet(place.zero, *place.with)))
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
    if (!split && implied && ends_in_pole(f)) return false;
    if (almost_ && prover_.ends_almost_all_motions(f)) return false;
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

  /// The Hamiltonian is infinite there, and no motion comes to such a place but by a collision.
  bool ends_in_pole(const Polynomial& f) const {
    const Model& model = prover_.model();
    return prover_.has_motion() && model.hamiltonian &&
           prover_.has_pole(prover_.convert(*model.hamiltonian), f);
  }

  bool is_kept(const Polynomial& f) const {
    if (!every_) return prover_.keeps_sign(f, {});
    const std::vector<Polynomial> flow = prover_.flow_of(prover_.gradient(f));
    return std::all_of(flow.begin(), flow.end(),
                       [&](const Polynomial& p) { return prover_.is_zero(p); });
  }

  Prover& prover_;
  bool every_, almost_;
  std::vector<Polynomial> passed_;
};

std::vector<Polynomial> Prover::passed_jumps(const Polynomial& function, bool cuts,
                                             Motions motions) {
  if (ring_.is_polynomial()) return {};
  PassedJumps jumps(*this, has_motion() ? motions : Motions::of_every_hamiltonian);
  jumps.add(ring_.jump_factors(function, cuts), false);
  jumps.add(ring_.split_jump_factors(function), true);
  return std::move(jumps).passed();
}

}  // namespace casimir
