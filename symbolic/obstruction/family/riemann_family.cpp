#include "symbolic/obstruction/family/riemann_family.hpp"

#include "symbolic/obstruction/equation/lame.hpp"
#include "symbolic/obstruction/family/parameter_point.hpp"

namespace casimir::obstruction {
namespace {

using F = ParametricFunction;

/// 1 + 4 times the coefficient of (z - z0)^(-2) in r; empty where it differs at conjugate points.
std::optional<RationalFunction> square_at(const F& r, const ParameterPoint& point,
                                          unsigned long order) {
  if (order == 1) return RationalFunction(1);
  Polynomial rest = r.denominator();
  for (unsigned long i = 0; i < order; ++i) {
    Polynomial quotient(rest.ring());
    if (!rest.divide(point.polynomial, &quotient)) return std::nullopt;
    rest = std::move(quotient);
  }
  const ParameterPoint::Residue slope = point.value(point.polynomial.derivative(F::kVariable));
  const ParameterPoint::Residue below =
      point.product(point.value(rest), point.product(slope, slope));
  const ParameterPoint::Residue result =
      point.product(point.value(r.numerator()), point.inverse(below));
  if (!result.b.is_zero()) return std::nullopt;
  return (F(1) + F(4) * result.a).in_parameter();
}

RationalFunction square_at_infinity(const F& r) {
  const long order = pole_count(r) - r.numerator().degree(F::kVariable);
  if (r.is_zero() || order > 2) return RationalFunction(1);
  const RationalFunction above(parameter_coefficients(r.numerator()).back());
  const RationalFunction below(parameter_coefficients(r.denominator()).back());
  return RationalFunction(1) + RationalFunction(4) * above / below;
}

/// The points and their distances. \return  false where they are not two
bool add_points(const F& r, const CurveNames& names, RiemannFamily& result) {
  std::vector<ParameterPoint> points;
  std::size_t count = 0;
  for (const auto& [factor, order] : r.denominator().factors()) {
    if (!factor.uses(F::kVariable)) continue;
    const long degree = factor.degree(F::kVariable);
    if (order > 2 || degree > 2 || count + static_cast<std::size_t>(degree) > 2) return false;
    const ParameterPoint point = parameter_point(factor);
    const auto square = square_at(r, point, order);
    if (!square) return false;
    for (long i = 0; i < degree; ++i) {
      result.points[count] = point.text(names);
      result.squares[count++] = *square;
    }
    result.conditions.nonzero(parameter_coefficients(factor).back());
    if (degree == 2)
      result.conditions.nonzero((point.s * point.s - F(4) * point.t).in_parameter().numerator());
    points.push_back(point);
  }
  if (points.size() == 2)
    result.conditions.nonzero((points[0].t - points[1].t).in_parameter().numerator());
  return count == 2;
}

}  // namespace

std::optional<RiemannFamily> riemann_family(const F& r, const CurveNames& names) {
  if (r.is_zero() || pole_count(r) - r.numerator().degree(F::kVariable) < 2) return std::nullopt;
  RiemannFamily result;
  result.conditions.defined(r);
  if (!add_points(r, names, result)) return std::nullopt;
  result.points[2] = names.z + " = infinity";
  result.squares[2] = square_at_infinity(r);
  for (const RationalFunction& square : result.squares)
    result.conditions.nonzero(square.denominator());
  return result;
}

std::optional<RiemannFamily> lame_family(const F& p, const F& q, const F& r,
                                         const CurveNames& names) {
  if (!is_lame(p, q)) return std::nullopt;
  // No double root: the discriminant of b z^3 + .. does not vanish, nor does b.
  const std::vector<Univariate> c = parameter_coefficients(p.denominator());
  const Univariate &d0 = c[0], &d1 = c[1], &d2 = c[2], &d3 = c[3];
  RiemannFamily result;
  result.lame = true;
  result.conditions.nonzero(d3);
  result.conditions.nonzero(Univariate(18) * d3 * d2 * d1 * d0 - Univariate(4) * d2.pow(3) * d0 +
                            d2.pow(2) * d1.pow(2) - Univariate(4) * d3 * d1.pow(3) -
                            Univariate(27) * d3.pow(2) * d0.pow(2));
  for (const F* f : {&p, &q, &r}) result.conditions.defined(*f);
  const std::string root = written(F(p.denominator(), F(1).numerator()), names) + " = 0";
  result.points = {root, root, names.z + " = infinity"};
  const RationalFunction quarter(cln::cl_RA(1) / 4);
  result.squares = {quarter, quarter, square_at_infinity(r)};
  result.conditions.nonzero(result.squares[2].denominator());
  return result;
}

}  // namespace casimir::obstruction
