#include "runtime/exact/real_lattice.hpp"

#include <cln/real.h>

#include <algorithm>

#include "runtime/exact/shapes.hpp"

namespace casimir::exact {
namespace {

using N = cln::cl_F;

N real_cube_root(const N& a) {
  if (cln::zerop(a)) return a;
  const N size = cln::exp(cln::ln(cln::abs(a)) / cln::cl_float(cln::cl_RA(3), a));
  return cln::minusp(a) ? -size : size;
}

}  // namespace

RealLattice::RealLattice(const N& g2, const N& g3) {
  const auto number = [&](int value) { return cln::cl_float(cln::cl_RA(value), g2); };
  const N zero = number(0), one = number(1), two = number(2), three = number(3), four = number(4);
  low = height = rate = period = zero;
  // s^3 = p s + q for the roots e of 4 s^3 - g2 s - g3.
  const N p = g2 / four, q = g3 / four;
  const N left = q * q / four, right = p * p * p / number(27);
  const N discriminant = right - left;
  const N size = cln::abs(right) + left;
  if (cln::zerop(size)) {  // 1 / t^2
    kind = Kind::rational;
    height = rate = one;
    return;
  }
  if (cln::abs(discriminant) < undecided_part(size) * size) {
    const N e = cln::minusp(q) ? -cln::sqrt(p / three) : cln::sqrt(p / three);
    // The double root is -e, the other 2 e: p = -e + 3 |e| / sin^2 or, with e < 0, / sinh^2.
    kind = cln::plusp(e) ? Kind::circular : Kind::hyperbolic;
    low = -e;
    height = three * cln::abs(e);
    rate = cln::sqrt(height);
    if (kind == Kind::circular) period = cln::pi(g2) / rate;
    return;
  }
  if (cln::plusp(discriminant)) {
    const N angle = cln::cl_float(cln::atan(q / two, cln::sqrt(discriminant)), g2) / three;
    const N scale = two * cln::sqrt(p / three), third = two * cln::pi(g2) / three;
    for (int k = 0; k < 3; ++k)
      roots[k] = scale * cln::cl_float(cln::cos(angle - number(k) * third), g2);
    std::sort(roots, roots + 3, [](const N& a, const N& b) { return a > b; });
    kind = Kind::three;
    height = roots[0] - roots[2];
    functions = JacobiFunctions((roots[1] - roots[2]) / height, (roots[0] - roots[1]) / height);
    low = roots[2];
    rate = cln::sqrt(height);
    period = two * functions.quarter() / rate;
    return;
  }
  const N root = cln::sqrt(-discriminant);
  const N e = real_cube_root(q / two + root) + real_cube_root(q / two - root);
  kind = Kind::one;
  height = cln::sqrt(three * e * e - p);
  const N part = three * e / (four * height), half = one / two;
  functions = JacobiFunctions(half - part, half + part);
  low = e;
  rate = two * cln::sqrt(height);
  period = four * functions.quarter() / rate;
}

N height_of_tau(const RealLattice& lattice) {
  const N part =
      JacobiFunctions(lattice.functions.complement(), lattice.functions.parameter()).quarter() /
      lattice.functions.quarter();
  return lattice.kind == RealLattice::Kind::three ? part
                                                  : part / cln::cl_float(cln::cl_RA(2), part);
}

}  // namespace casimir::exact
