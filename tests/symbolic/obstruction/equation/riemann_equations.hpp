#pragma once

#include "symbolic/obstruction/equation/kimura.hpp"
#include "symbolic/obstruction/equation/univariate.hpp"

namespace casimir::obstruction {

inline cln::cl_RA over(long a, long b) { return cln::cl_RA(a) / b; }

/// r of Riemann's P equation with differences sqrt(s_i) at 0, 1 and infinity.
inline RationalFunction riemann(const SquaredDifferences& s) {
  const Univariate z = Univariate::variable();
  const cln::cl_RA a = (s[0] - 1) / 4, b = (s[1] - 1) / 4, c = (s[2] - 1) / 4;
  const RationalFunction at_zero = RationalFunction(Univariate(a), z * z);
  const RationalFunction at_one = RationalFunction(Univariate(b), (z - 1) * (z - 1));
  return at_zero + at_one + RationalFunction(Univariate(c - a - b), z * (z - 1));
}

/// The normal form of the equation pulled back by z = f(x): {f, x} is Schwarz's derivative.
inline RationalFunction pulled_back(const RationalFunction& r, const RationalFunction& f) {
  const auto composed = [&](const Univariate& p) {
    RationalFunction result;
    for (long i = p.degree(); i >= 0; --i) result = result * f + RationalFunction(p.coefficient(i));
    return result;
  };
  const RationalFunction slope = f.derivative(), second = slope.derivative() / slope;
  const RationalFunction schwarzian =
      second.derivative() - RationalFunction(over(1, 2)) * second * second;
  return composed(r.numerator()) / composed(r.denominator()) * slope * slope -
         RationalFunction(over(1, 2)) * schwarzian;
}

}  // namespace casimir::obstruction
