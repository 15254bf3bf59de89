#include "symbolic/obstruction/family/riemann_family.hpp"

#include <stdexcept>

#include "symbolic/obstruction/equation/lame.hpp"
#include "symbolic/obstruction/family/parameter_point.hpp"

namespace casimir::obstruction {
namespace {

using F = ParametricFunction;

/// 1 + 4 times the coefficient of (z - z0)^(-2) in r; empty where it differs at conjugate points.
std::optional<F> square_at(const F& r, const ParameterPoint& point, unsigned long order) {
  if (order == 1) return F(1);
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
  return F(1) + F(4) * result.a;
}

F square_at_infinity(const F& r) {
  const long order = pole_count(r) - r.numerator().degree(F::kVariable);
  if (r.is_zero() || order > 2) return F(1);
  return F(1) + F(4) * variable_coefficients(r.numerator()).back() /
                    variable_coefficients(r.denominator()).back();
}

/// The points and their distances. \return  false where they are not two
bool add_points(const F& r, const CurveNames& names, GeneralFamily& result) {
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
    result.conditions.nonzero(variable_coefficients(factor).back());
    if (degree == 2) result.conditions.nonzero((point.s * point.s - F(4) * point.t).numerator());
    points.push_back(point);
  }
  if (points.size() == 2) result.conditions.nonzero((points[0].t - points[1].t).numerator());
  return count == 2;
}

}  // namespace

RiemannFamily of_one_parameter(const GeneralFamily& family) {
  RiemannFamily result{family.lame, family.points, {}, family.conditions};
  if (!family.conditions.several().empty())
    throw std::logic_error("a family of several parameters");
  for (std::size_t i = 0; i < 3; ++i) result.squares[i] = family.squares[i].in_parameter();
  return result;
}

std::optional<GeneralFamily> riemann_family(const F& r, const CurveNames& names) {
  if (r.is_zero() || pole_count(r) - r.numerator().degree(F::kVariable) < 2) return std::nullopt;
  GeneralFamily result;
  result.conditions.defined(r);
  if (!add_points(r, names, result)) return std::nullopt;
  result.points[2] = names.z + " = infinity";
  result.squares[2] = square_at_infinity(r);
  for (const F& square : result.squares) result.conditions.defined(square);
  return result;
}

std::optional<GeneralFamily> lame_family(const F& p, const F& q, const F& r,
                                         const CurveNames& names) {
  if (!is_lame(p, q)) return std::nullopt;
  // No double root: the discriminant of b z^3 + .. does not vanish, nor does b.
  const std::vector<F> c = variable_coefficients(p.denominator());
  const F &d0 = c[0], &d1 = c[1], &d2 = c[2], &d3 = c[3];
  GeneralFamily result;
  result.lame = true;
  result.conditions.nonzero(d3);
  result.conditions.nonzero(F(18) * d3 * d2 * d1 * d0 - F(4) * d2 * d2 * d2 * d0 +
                            d2 * d2 * d1 * d1 - F(4) * d3 * d1 * d1 * d1 -
                            F(27) * d3 * d3 * d0 * d0);
  for (const F* f : {&p, &q, &r}) result.conditions.defined(*f);
  const std::string root = written(F(p.denominator(), F(1).numerator()), names) + " = 0";
  result.points = {root, root, names.z + " = infinity"};
  const F quarter(cln::cl_RA(1) / 4);
  result.squares = {quarter, quarter, square_at_infinity(r)};
  result.conditions.defined(result.squares[2]);
  return result;
}

}  // namespace casimir::obstruction
