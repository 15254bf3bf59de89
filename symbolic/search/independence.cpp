// When are the functions of a search independent? For generic values of the parameters, the
// functions of the moving symbols x are considered over the complex numbers C.
//
// Let K be C(x) with roots u_i^q_i = b_i adjoined. Then
//
//   (roots)  u_1, .. have the degree q_1 q_2 .. over the field of the b_i, so that there are no
//            relations beside u_i^q_i = b_i, if every b_i has a prime divisor, with a multiplicity
//            that has no common divisor with q_i, which divides no other b_j (Kummer: a product of
//            b_i^(e_i/q_i) in the field has whole multiplicities). The field has to be one of
//            rational functions, so that prime divisors are irreducible polynomials: that of the
//            symbols, of exponentials, and of t for sin = 2t/(1 + t^2), cos = (1 - t^2)/(1 + t^2).
//            Factors over Q stay without squares and without common factors over C.
//   (Kolchin and Ostrowski; Kolchin, Amer. J. Math. 90 (1968) 1151)
//            exponentials exp(v_i) with v_i' in K and logarithms log f_j with f_j in K are
//            algebraically dependent over K only if a product of whole powers of the exp(v_i) is
//            algebraic over K(the logarithms), or a sum of c_j log f_j with numbers c_j is in K.
//            For v = a sum of an algebraic function P and of N_j log f_j, exp(v) is algebraic only
//            if P is constant and the N_j are rational: dv = dg/g has residues that are rational
//            at the divisors of the f_j, and no higher poles. And a sum of c_j log f_j has the
//            residues c_j at divisors of their own.
//
// So the exponentials are independent where the differentials of the v_i, with those of the
// logarithms in them, are linearly independent over Q; sin w and cos w generate the same field as
// exp(i w). Each hypothesis is checked below; where one is not, the answer is that it is not known.
#include "symbolic/search/independence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "symbolic/expression/elliptic.hpp"
#include "symbolic/search/modular/span.hpp"

namespace casimir::search {
namespace {

using Kind = FunctionRing::Origin::Kind;

class Independence {
 public:
  explicit Independence(const System& system) : system_(system), ring_(system.functions()) {}

  std::optional<std::string> reason();

 private:
  using Places = std::vector<std::size_t>;
  using Divisors = std::vector<std::pair<Polynomial, long>>;

  void collect();
  FunctionRing::Origin origin(std::size_t place) const {
    if (has_elliptic_function(ring_.variable_value(place)))
      throw TooLarge("elliptic functions are known to proofs of claims, and not to a search");
    return ring_.origin(place);
  }
  bool is_symbol(std::size_t place) const { return place < ring_.symbols().size(); }
  Places of_kind(Kind kind, bool constant) const;
  Places uses(const Polynomial& p) const;
  bool only(const Polynomial& p, const std::set<Kind>& kinds) const;
  bool moves(const Polynomial& p) const;
  std::optional<Divisors> divisors(const Polynomial& p) const;
  bool have_own_divisors(const std::vector<std::pair<Polynomial, unsigned long>>& powers,
                         bool constant) const;
  bool roots_are_independent(bool constant) const;
  bool logarithms_are_independent(bool constant) const;
  bool exponents_are_independent(Kind kind, bool constant) const;
  bool differentials_are_independent(const std::vector<Polynomial>& functions, bool constant) const;
  bool constants_are_independent() const;

  const System& system_;
  const FunctionRing& ring_;
  std::set<std::size_t> generators_;  ///< that matter
};

Independence::Places Independence::uses(const Polynomial& p) const {
  Places result;
  for (std::size_t i = 0; i < ring_.end_of_generators(); ++i)
    if (p.uses(i)) result.push_back(i);
  return result;
}

/// Those that the ansatz and the equations have, and all in the arguments of these.
void Independence::collect() {
  Places open;
  for (const Places* list : {&system_.atoms(), &system_.parameters()})
    open.insert(open.end(), list->begin(), list->end());
  while (!open.empty()) {
    const std::size_t place = open.back();
    open.pop_back();
    if (is_symbol(place) || place >= ring_.end_of_generators()) continue;
    if (!generators_.insert(place).second) continue;
    for (const std::size_t inner : uses(origin(place).argument)) open.push_back(inner);
  }
}

Independence::Places Independence::of_kind(Kind kind, bool constant) const {
  Places result;
  for (const std::size_t g : generators_)
    if (origin(g).kind == kind && system_.is_constant()[g] == constant) result.push_back(g);
  return result;
}

/// Whether the generators in p are of these kinds.
bool Independence::only(const Polynomial& p, const std::set<Kind>& kinds) const {
  const Places list = uses(p);
  return std::all_of(list.begin(), list.end(), [&](std::size_t place) {
    return is_symbol(place) || kinds.contains(origin(place).kind);
  });
}

bool Independence::moves(const Polynomial& p) const {
  const Places list = uses(p);
  return std::any_of(list.begin(), list.end(),
                     [&](std::size_t place) { return !system_.is_constant()[place]; });
}

/// The prime divisors of p with their multiplicities in a field of rational functions; empty where
/// p is not in one.
std::optional<Independence::Divisors> Independence::divisors(const Polynomial& p) const {
  if (!only(p, {Kind::exponential, Kind::sine, Kind::cosine})) return std::nullopt;
  Divisors result;
  Polynomial top = p;
  const PolynomialRing& ring = p.ring();
  const Polynomial one = ring.constant(1);
  for (std::size_t s = ring_.symbols().size(); s < ring_.end_of_generators(); ++s) {
    if (origin(s).kind != Kind::sine || (!p.uses(s) && !p.uses(s + 1))) continue;
    const Polynomial t = ring.variable(s);
    const Polynomial bottom = one + t * t;
    unsigned long degree = 0;
    for (const auto& [number, exponents] : top.term_list())
      degree = std::max(degree, exponents[s] + exponents[s + 1]);
    Polynomial sum(ring);
    for (auto [number, exponents] : top.term_list()) {
      const unsigned long sines = exponents[s], cosines = exponents[s + 1];
      exponents[s] = exponents[s + 1] = 0;
      TermCollector rest(ring);
      rest.add(number, exponents);
      sum += rest.finish() * (t + t).pow(sines) * (one - t * t).pow(cosines) *
             bottom.pow(degree - sines - cosines);
    }
    top = std::move(sum);
    if (degree > 0) result.emplace_back(bottom, -static_cast<long>(degree));
  }
  for (const auto& [factor, exponent] : top.factors()) {
    if (factor.is_constant()) {
      if (!(factor == one) && !(factor == -one)) result.emplace_back(factor, 1);
      continue;
    }
    const auto known = std::find_if(result.begin(), result.end(), [&f = factor](const auto& d) {
      return d.first == f || d.first == -f;
    });
    if (known != result.end())
      known->second += static_cast<long>(exponent);
    else
      result.emplace_back(factor, static_cast<long>(exponent));
  }
  return result;
}

/// Whether each has a divisor that no other has, with a multiplicity without a common divisor with
/// the order.
bool Independence::have_own_divisors(
    const std::vector<std::pair<Polynomial, unsigned long>>& powers, bool constant) const {
  std::vector<Divisors> lists;
  for (const auto& [base, order] : powers) {
    const std::optional<Divisors> own = divisors(base);
    if (!own) return false;
    lists.push_back(*own);
  }
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const bool found = std::any_of(lists[i].begin(), lists[i].end(), [&](const auto& divisor) {
      const auto size = static_cast<unsigned long>(std::abs(divisor.second));
      if (std::gcd(size, powers[i].second) != 1 || moves(divisor.first) == constant) return false;
      // A number is a divisor of a root of numbers alone, which the ring has of primes only.
      if (divisor.first.is_constant() && !powers[i].first.is_constant()) return false;
      for (std::size_t j = 0; j < lists.size(); ++j) {
        if (j == i) continue;
        for (const auto& [other, exponent] : lists[j])
          if (exponent != 0 && (other == divisor.first || other == -divisor.first)) return false;
      }
      return true;
    });
    if (!found) return false;
  }
  return true;
}

bool Independence::roots_are_independent(bool constant) const {
  std::vector<std::pair<Polynomial, unsigned long>> powers;
  for (const std::size_t g : of_kind(Kind::root, constant)) {
    const FunctionRing::Origin own = origin(g);
    if (own.argument.is_constant() && cln::minusp(own.argument.term_list()[0].first)) return false;
    powers.emplace_back(own.argument, own.order);
  }
  return have_own_divisors(powers, constant);
}

/// Logarithms, and the inverse functions that are some: atan v = log((1 + i v)/(1 - i v))/(2 i).
bool Independence::logarithms_are_independent(bool constant) const {
  std::vector<std::pair<Polynomial, unsigned long>> powers;
  std::size_t others = 0;
  for (const Kind kind :
       {Kind::logarithm, Kind::arc_tangent, Kind::arc_tangent_of_two, Kind::arc_sine}) {
    for (const std::size_t g : of_kind(kind, constant)) {
      Polynomial divisor = origin(g).argument;
      if (!only(divisor, {}) || divisor.is_constant()) return false;
      if (kind == Kind::arc_tangent) divisor = divisor * divisor + divisor.ring().constant(1);
      powers.emplace_back(divisor, 1);
      others += kind == Kind::arc_sine ? 1 : 0;
    }
  }
  // Of one alone the differential is no algebraic function's: no divisor needs to be found.
  return powers.size() <= 1 || (others == 0 && have_own_divisors(powers, constant));
}

bool Independence::differentials_are_independent(const std::vector<Polynomial>& functions,
                                                 bool constant) const {
  const std::size_t symbols = ring_.symbols().size();
  std::vector<Polynomial> slopes;
  std::size_t width = 0;
  for (const Polynomial& f : functions) {
    width = 0;
    for (std::size_t i = 0; i < symbols; ++i) {
      if (system_.is_constant()[i] != constant) continue;
      slopes.push_back(ring_.derivative(f, i));
      ++width;
    }
  }
  slopes = ring_.common_numerators(std::move(slopes));
  std::map<std::pair<std::size_t, std::vector<unsigned long>>, std::size_t> columns;
  for (std::size_t k = 0; k < slopes.size(); ++k)
    for (const auto& [number, exponents] : slopes[k].term_list())
      columns.emplace(std::pair(k % width, exponents), columns.size());
  // The rank modulo a prime is at most that over Q.
  const Modulus modulus = Modulus::nth(0);
  Span span(modulus);
  for (std::size_t f = 0; f < functions.size(); ++f) {
    std::vector<Residue> row(columns.size(), 0);
    for (std::size_t i = 0; i < width; ++i) {
      for (const auto& [number, exponents] : slopes[f * width + i].term_list()) {
        const std::optional<Residue> value = modulus.reduce(number);
        if (!value) return false;
        row[columns.at({i, exponents})] = *value;
      }
    }
    span.insert(std::move(row));
  }
  return span.dimension() == functions.size();
}

/// Arguments of exponentials, or angles.
bool Independence::exponents_are_independent(Kind kind, bool constant) const {
  std::vector<Polynomial> functions;
  std::set<std::size_t> logarithms;
  for (const std::size_t g : of_kind(kind, constant)) {
    const Polynomial argument = origin(g).argument;
    if (!only(argument, {Kind::inverse, Kind::root, Kind::logarithm})) return false;
    for (const std::size_t inner : uses(argument)) {
      if (is_symbol(inner)) continue;
      const FunctionRing::Origin own = origin(inner);
      if (own.kind != Kind::logarithm) {
        if (!only(own.argument, {Kind::root})) return false;
        continue;
      }
      if (!only(own.argument, {}) || argument.degree(inner) != 1) return false;
      if (!constant && moves(argument.coefficients(inner)[1])) return false;
      logarithms.insert(inner);
    }
    if (!argument.is_constant()) functions.push_back(argument);
  }
  for (const std::size_t place : logarithms) functions.push_back(system_.ring().variable(place));
  return functions.empty() || differentials_are_independent(functions, constant);
}

/// Numbers such as Pi and exp(1) are transcendental; of two it is not known whether they are
/// independent.
bool Independence::constants_are_independent() const {
  std::size_t numbers = 0, functions = 0;
  for (const std::size_t g : generators_) {
    if (!system_.is_constant()[g]) continue;
    const FunctionRing::Origin own = origin(g);
    if (own.kind == Kind::cosine || own.kind == Kind::root || own.kind == Kind::inverse) continue;
    ++(own.argument.is_constant() ? numbers : functions);
  }
  return numbers <= 1 && (numbers == 0 || functions == 0);
}

std::optional<std::string> Independence::reason() {
  collect();
  if (generators_.empty()) return std::nullopt;
  for (const std::size_t g : generators_) {
    const Kind kind = origin(g).kind;
    const auto named = [&](const char* why) {
      return fmt::format("'{}' {}", system_.name(g), why);
    };
    if (kind == Kind::absolute) return named("is an absolute value, which is not analytic");
    if (kind == Kind::part_of_angle)
      return named(
          "is of a part of an angle, whose relations to other functions are not all known");
    if (kind == Kind::imaginary && generators_.size() > 1)
      return std::string("complex numbers occur beside other functions");
    if (kind == Kind::inverse &&
        !only(origin(g).argument, {Kind::root, Kind::sine, Kind::cosine, Kind::exponential,
                                   Kind::inverse, Kind::logarithm, Kind::arc_tangent,
                                   Kind::arc_tangent_of_two, Kind::arc_sine, Kind::constant}))
      return named("has a denominator that is not understood");
  }
  for (const auto& assumption : system_.model().assumptions)
    if (assumption.comparison == Comparison::equal)
      return "an assumption is an equation: " + assumption.text;
  const std::string may = " may obey relations that are not known";
  for (const bool constant : {false, true}) {
    const std::string those = constant ? " of parameters" : "";
    if (!roots_are_independent(constant)) return "the roots" + those + may;
    if (!logarithms_are_independent(constant))
      return "the logarithms and inverse functions" + those + may;
    for (const Kind kind : {Kind::exponential, Kind::sine})
      if (!exponents_are_independent(kind, constant))
        return (kind == Kind::sine ? "the angles" : "the exponentials") + those + may;
  }
  if (!constants_are_independent()) return "the constants" + may;
  return std::nullopt;
}

}  // namespace

std::optional<std::string> unknown_relations(const System& system) {
  return Independence(system).reason();
}

}  // namespace casimir::search
