// Where functions may jump on the way of a motion.
#include <algorithm>

#include "symbolic/algebra/ideal.hpp"
#include "symbolic/proof/one_sided_poles.hpp"
#include "symbolic/proof/prover.hpp"

namespace casimir {
namespace {

constexpr GroebnerLimits kBasisOfMeeting{200, 60, 2000};

/// Of what is so long no bases are looked for.
bool is_long(const Polynomial& p) { return p.terms() > 60; }

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

/// Their ideal is seen to contain a product of what vanishes nowhere and of such factors.
bool Prover::meet_only_where(const Polynomial& a, const Polynomial& b,
                             const std::function<bool(const Polynomial&)>& is_such) {
  const std::vector<Polynomial>& identities = square_relations();
  return std::ranges::any_of(basis_of_zeros({a, b}), [&](const Polynomial& f) {
    if (std::find(identities.begin(), identities.end(), f) != identities.end()) return false;
    const auto factors = f.factors();
    return std::ranges::all_of(factors, [&](const auto& factor) {
      if (factor.first.is_constant()) return !factor.first.is_zero();
      return ring_.is_assumed_nonzero(factor.first) || is_such(factor.first);
    });
  });
}

bool Prover::may_meet(const Polynomial& a, const Polynomial& b) {
  return !meet_only_where(a, b, [](const Polynomial&) { return false; });
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
  for (int i = 0; i <= kSquarings; ++i) {
    power = power.remainder(basis, &quotients);
    if (power.is_zero()) return false;
    if (is_long(power)) break;
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

/// The same for each value of the parameters where the equations have a pole at f: where g is zero,
/// p^2/2 + g/q^2 has none. Where the coefficient of the pole is zero with f, so is a function of
/// the parameters, and where this one is, the Hamiltonian has no pole at f; the bracket has none.
bool Prover::ends_motions_at_poles(const Polynomial& f) {
  if (!model_.hamiltonian || model_.time || !model_.poisson) return false;
  for (std::size_t i = 0; i < dimension(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::ranges::count(ring_.pole_factors(bracket_entry(i, j)), f) > 0) return false;
  if (!one_sided_poles_) one_sided_poles_ = one_sided_poles(*this);
  if (std::ranges::any_of(*one_sided_poles_,
                          [&](const auto& own) { return own == f || own == -f; }))
    return true;
  const Polynomial energy = convert(*model_.hamiltonian);
  constexpr std::size_t kMostPoles = 6;
  if (ring_.pole_factors(energy).size() > kMostPoles) return false;
  const auto coefficient = ring_.pole_coefficient(energy, f);
  if (!coefficient || is_long(*coefficient)) return false;
  const auto terms = ring_.lowest_terms(energy);
  Polynomial rest = terms.second, quotient(ring_.ring()), pole = ring_.ring().constant(1);
  for (; rest.divide(f, &quotient); rest = quotient) pole = pole * f;
  const auto has_none_where_zero = [&](const Polynomial& factor) {
    if (varies(factor) || pole.is_constant()) return false;
    std::vector<Polynomial> unused(1, pole);
    const Polynomial left = terms.first.remainder({factor}, &unused);
    return left.is_zero() || left.divide(pole, &quotient);
  };
  return meet_only_where(*coefficient, f, has_none_where_zero);
}

/// Whether the bracket, which has no pole at f, moves it where it is zero: with {x, z} = x^4 all
/// motions of H = z/x^4 come to x = 0 with z = 0 there.
bool Prover::is_moved_by_bracket(const Polynomial& f) {
  if (!model_.poisson) return false;
  for (std::size_t i = 0; i < dimension(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::ranges::count(ring_.pole_factors(bracket_entry(i, j)), f) > 0) return false;
  const std::vector<Polynomial> flow = flow_of(gradient(f));
  return std::ranges::any_of(flow, [&](const Polynomial& rate) {
    Polynomial quotient(ring_.ring());
    return !rate.is_zero() && !rate.divide(f, &quotient);
  });
}

/// Whether the motion keeps g = 0 where f is zero, and has no pole in it there.
bool Prover::is_kept_where_zero(const Polynomial& g, const Polynomial& f) {
  const auto [top, bottom] = ring_.lowest_terms(rate(g));
  Polynomial quotient(ring_.ring());
  return top.is_zero() || (top.divide(f, &quotient) && !bottom.divide(f, &quotient));
}

/// The conserved Hamiltonian is infinite at almost all points where f is zero: it is c/d^k + .., d
/// is zero there, and c, a function without roots and of few poles, is not. Where a factor of c is
/// zero as well, motions may pass, and all of them if they are led there: those of p1 p2/q1^2 come
/// to q1 = 0 with p1 = 0. What the motion keeps zero there, as an integral, leads none.
bool Prover::ends_almost_all_motions(const Polynomial& f) {
  if (!model_.hamiltonian || model_.time || !is_moved_by_bracket(f)) return false;
  const auto leading = ring_.leading_divided_by(convert(*model_.hamiltonian), f);
  if (!leading || is_long(*leading) || !ring_.radicand_factors(*leading).empty()) return false;
  const auto [top, bottom] = ring_.lowest_terms(*leading);
  Polynomial quotient(ring_.ring());
  if (!ring_.pole_factors(top).empty() || top.divide(f, &quotient)) return false;
  return std::ranges::all_of(top.factors(), [&](const auto& factor) {
    const Polynomial& g = factor.first;
    return !varies(g) || ring_.is_assumed_nonzero(g) || !may_meet(g, f) || is_kept_where_zero(g, f);
  });
}

bool Prover::varies(const Polynomial& p) const {
  return ring_.depends_on_first(p, dimension()) ||
         (model_.time && ring_.depends_on(p, dimension() + model_.parameters.size()));
}

/// What stands under roots in the rates of motions, or is divided by there, if these may pass it: a
/// motion is analytic where none of it is zero. Along x' = 1, y' = 2*y/x^3 each side of x = 0 has
/// its own y*exp(1/x^2).
std::vector<Polynomial> Prover::kinks_of(
    const std::vector<Polynomial>& rates,
    const std::function<bool(const Polynomial&)>& is_passed_pole) {
  std::vector<Polynomial> kinks;
  const auto add = [&](const Polynomial& f) {
    if (varies(f) && std::find(kinks.begin(), kinks.end(), f) == kinks.end()) kinks.push_back(f);
  };
  for (const Polynomial& rate : rates) {
    for (const Polynomial& f : ring_.radicand_factors(rate)) add(f);
    for (const Polynomial& f : ring_.pole_factors(rate))
      if (!ring_.is_assumed_nonzero(f) && is_passed_pole(f)) add(f);
  }
  return kinks;
}

/// \param almost  without the poles that all motions end at but for those of a smaller set
const std::vector<Polynomial>& Prover::kinks_of_motion(bool almost) {
  std::optional<std::vector<Polynomial>>& known = almost ? kinks_almost_ : kinks_;
  if (!known && !has_motion()) known.emplace();
  if (!known)
    known = kinks_of(field(), [&](const Polynomial& f) {
      return !(almost && ends_almost_all_motions(f)) && !keeps_sign(f, {}) &&
             !ends_motions_at_poles(f);
    });
  return *known;
}

std::vector<Polynomial> Prover::passed_poles() {
  std::vector<Polynomial> result = kinks_of_motion(true);
  std::erase_if(result, [&](const Polynomial& f) {
    return std::ranges::none_of(field(), [&](const Polynomial& rate) {
      return std::ranges::count(ring_.pole_factors(rate), f) > 0;
    });
  });
  return result;
}

std::vector<Polynomial> Prover::kinks_of_flows() {
  std::vector<Polynomial> entries;
  for (std::size_t i = 0; model_.poisson && i < dimension(); ++i)
    for (std::size_t j = 0; j < i; ++j) entries.push_back(bracket_entry(i, j));
  return kinks_of(entries, [](const Polynomial&) { return true; });
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
  jumps.add(ring_.jump_factors(function, cuts, every ? kinks_of_flows() : kinks_of_motion(true)),
            false);
  jumps.add(ring_.split_jump_factors(function), true);
  return std::move(jumps).passed();
}

void Prover::say_where_it_jumps(Proof& proof, const Polynomial& function, bool cuts, bool every) {
  for (const Polynomial& jump : passed_jumps(function, cuts, every)) {
    std::string place = ring_.text(jump) + " = 0";
    if (std::find(proof.jumps.begin(), proof.jumps.end(), place) == proof.jumps.end())
      proof.jumps.push_back(std::move(place));
  }
}

}  // namespace casimir
