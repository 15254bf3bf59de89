#include "symbolic/obstruction/equation/kovacic.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace casimir::obstruction {

RationalFunction reduced_form(const RationalFunction& p, const RationalFunction& q) {
  const RationalFunction half(cln::cl_RA(1) / 2);
  const RationalFunction own = half * p;
  return own * own + own.derivative() - q;
}

namespace {

/// The degrees of invariants, and the group that each shows once those before have none.
struct Degree {
  long m;
  GaloisCase shows;
  const char* what;
};

constexpr Degree kDegrees[] = {
    {2, GaloisCase::reducible, "case 1, two solutions conjugate over Q: invariants of degree 2"},
    {4, GaloisCase::imprimitive, "case 2: invariants of degree 4"},
    {6, GaloisCase::finite, "case 3, tetrahedral: invariants of degree 6"},
    {8, GaloisCase::finite, "case 3, octahedral: invariants of degree 8"},
    {12, GaloisCase::finite, "case 3, icosahedral: invariants of degree 12"},
};

/// The polynomial for y'/y that belongs to an invariant. That of degree 4 is the square of a
/// quadratic form unless the group is the quaternions'.
std::vector<RationalFunction> polynomial_of(const RationalFunction& r,
                                            const RationalFunction& invariant, long m) {
  const RationalFunction phi = invariant.derivative() / invariant;
  if (m == 4) {
    const RationalFunction half(cln::cl_RA(1) / 2);
    std::vector<RationalFunction> quadratic = form_polynomial(r, half * phi, 2);
    if (!quadratic.empty()) return quadratic;
  }
  return form_polynomial(r, phi, m);
}

void check(const LiouvillianResult& result, const RationalFunction& r) {
  if (result.solution.empty() || !solves_riccati(result.solution, r))
    throw std::logic_error("a Liouvillian solution does not solve its equation");
}

/// Whether exp(integral of w) is no algebraic function: w has a pole that is not simple, or a part
/// at infinity that does not vanish, or a residue that is not rational.
bool is_transcendental(const RationalFunction& w) {
  if (w.numerator().degree() >= w.denominator().degree() && !w.is_zero()) return true;
  for (const auto& [factor, exponent] : w.denominator().factors()) {
    if (exponent > 1) return true;
    const Univariate below =
        (w.denominator().divided(factor).first * factor.derivative()).remainder(factor);
    if (!(w.numerator() * below.inverse(factor)).remainder(factor).is_constant()) return true;
  }
  return false;
}

/// Whether the group, which leaves the line of exp(integral of w) invariant, is all of the
/// triangular matrices: its identity component is not abelian then. With a second invariant line,
/// or with all, the product of two solutions would be a rational invariant of degree 2; so there is
/// none, and a group of triangular matrices that is not diagonal contains all unipotent ones. It
/// acts on the line by infinitely many numbers where exp(integral of w) is transcendental.
void add_borel(const RationalFunction& r, const RationalFunction& w,
               const std::function<void()>& tick, const std::string& z, LiouvillianResult& result) {
  if (!is_transcendental(w)) return;
  const std::string what = "a second solution of degree 1: invariants of degree 2";
  const InvariantSearch second = rational_invariant(r, result.singular, 2, tick, z);
  result.borel = !second.invariant;
  result.attempts.push_back({what, second.invariant ? "found" : second.why_not, second.steps});
}

void decide(const RationalFunction& r, const std::function<void()>& tick, const std::string& z,
            LiouvillianResult& result) {
  const std::string first = fmt::format("case 1: w in Q({})", z);
  const RiccatiSearch riccati = rational_riccati(r, result.singular, tick, z);
  if (riccati.solution) {
    result.galois = GaloisCase::reducible;
    result.solution = {-*riccati.solution, RationalFunction(1)};
    result.attempts.push_back({first, "found"});
    check(result, r);
    add_borel(r, *riccati.solution, tick, z, result);
    return;
  }
  result.attempts.push_back({first, riccati.why_not, riccati.steps});
  for (const Degree& degree : kDegrees) {
    const InvariantSearch search = rational_invariant(r, result.singular, degree.m, tick, z);
    if (!search.invariant) {
      result.attempts.push_back({degree.what, search.why_not, search.steps});
      continue;
    }
    result.attempts.push_back({degree.what, "found"});
    result.galois = degree.shows;
    result.solution = polynomial_of(r, *search.invariant, degree.m);
    check(result, r);
    return;
  }
  result.galois = GaloisCase::sl2;
}

}  // namespace

LiouvillianResult decide_liouvillian(const RationalFunction& r, const std::function<void()>& tick,
                                     const std::string& z) {
  LiouvillianResult result;
  result.singular = singularities(r);
  try {
    decide(r, tick, z, result);
  } catch (const NotDecided& problem) {
    result.galois = GaloisCase::undecided;
    result.reason = problem.what();
  }
  return result;
}

}  // namespace casimir::obstruction
