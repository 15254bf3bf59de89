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

void decide(const RationalFunction& r, const std::function<void()>& tick, const std::string& z,
            LiouvillianResult& result) {
  const std::string first = fmt::format("case 1: w in Q({})", z);
  const RiccatiSearch riccati = rational_riccati(r, result.singular, tick, z);
  if (riccati.solution) {
    result.galois = GaloisCase::reducible;
    result.solution = {-*riccati.solution, RationalFunction(1)};
    result.attempts.push_back({first, "found"});
    check(result, r);
    return;
  }
  result.attempts.push_back({first, riccati.why_not});
  for (const Degree& degree : kDegrees) {
    const InvariantSearch search = rational_invariant(r, result.singular, degree.m, tick, z);
    if (!search.invariant) {
      result.attempts.push_back({degree.what, search.why_not});
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
