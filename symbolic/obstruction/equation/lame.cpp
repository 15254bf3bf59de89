#include "symbolic/obstruction/equation/lame.hpp"

#include <cln/integer.h>

#include "symbolic/obstruction/equation/parametric_function.hpp"

namespace casimir::obstruction {

std::optional<std::string> lame_class(const cln::cl_RA& square) {
  const auto root = square_root(square);
  if (!root) return std::nullopt;
  const cln::cl_I below = cln::denominator(*root);
  if (below == 2) return "Lame and Hermite: n is an integer";
  if (below == 1) return "Brioschi, Halphen and Crawford: n + 1/2 is an integer";
  if (below <= 5) return "Baldassarri: n + 1/2 is in Z/3, Z/4 or Z/5";
  return std::nullopt;
}

namespace {

RationalFunction denominator_of(const RationalFunction& f) { return f.denominator(); }
ParametricFunction denominator_of(const ParametricFunction& f) {
  return {f.denominator(), ParametricFunction(1).numerator()};
}

}  // namespace

template <class F>
bool is_lame(const F& p, const F& q) {
  const F cubic = denominator_of(p);
  if (pole_count(p) != 3) return false;
  // The denominator of P'/P has no double factor: P has simple roots only.
  if (!(p - cubic.derivative() / (F(2) * cubic)).is_zero()) return false;
  const F linear = q * cubic;
  return pole_count(linear) == 0 && total_degree(linear) <= 1;
}

template bool is_lame(const RationalFunction&, const RationalFunction&);
template bool is_lame(const ParametricFunction&, const ParametricFunction&);

}  // namespace casimir::obstruction
