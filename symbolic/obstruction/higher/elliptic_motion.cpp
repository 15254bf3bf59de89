#include "symbolic/obstruction/higher/elliptic_motion.hpp"

#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

/// Weierstrass's function with the cubic 4 w^3 - g2 w - g3.
LaurentSeries weierstrass(const cln::cl_RA& g2, const cln::cl_RA& g3, long terms) {
  std::vector<cln::cl_RA> c(static_cast<std::size_t>(terms) + 4, 0);
  c[2] = g2 / 20;
  c[3] = g3 / 28;
  for (std::size_t k = 4; k < c.size(); ++k) {
    for (std::size_t m = 2; m + 2 <= k; ++m) c[k] = c[k] + c[m] * c[k - m];
    c[k] = 3 * c[k] / cln::cl_RA(static_cast<long>((2 * k + 1) * (k - 3)));
  }
  std::vector<cln::cl_RA> coefficients(2 * c.size(), 0);
  coefficients[0] = 1;
  for (std::size_t k = 2; k < c.size(); ++k) coefficients[2 * k] = c[k];
  return {-2, Univariate(coefficients), terms};
}

/// z with z'^2 = S(z): z = a w + b.
LaurentSeries inverse_of_integral(const Univariate& s, long terms) {
  const cln::cl_RA a = 4 / s.coefficient(3), b = -s.coefficient(2) / (3 * s.coefficient(3));
  const Univariate own = s.composed(Univariate({b, a})) * Univariate(1 / (a * a));
  const LaurentSeries w = weierstrass(-own.coefficient(1), -own.coefficient(0), terms);
  return LaurentSeries(a) * w + LaurentSeries(b);
}

bool is_polynomial(const RationalFunction& f) { return f.denominator().is_constant(); }

}  // namespace

EllipticMotion elliptic_motion(const ParticularCurve<RationalFunction>& curve, long terms) {
  const auto& speed = curve.speed;
  if (curve.field.squares().size() != 1 || speed.size() != 1 || speed.begin()->first != 1)
    throw NotDecided("the curve is not elliptic");
  const RationalFunction factor = speed.begin()->second;
  const RationalFunction square = factor * factor * curve.field.squares().front();
  EllipticMotion result;
  result.cubic = square.numerator();
  if (!is_polynomial(square) || result.cubic.degree() != 3)
    throw NotDecided("the curve is not elliptic with one point at infinity");
  result.degenerate = gcd(result.cubic, result.cubic.derivative()).degree() > 0;
  result.z = inverse_of_integral(result.cubic, terms);
  result.speed = result.z.derivative();
  const LaurentSeries rest =
      result.speed * result.speed - at_series(RationalFunction(result.cubic), result.z);
  if (!rest.vanishes()) throw std::logic_error("an elliptic function does not solve its equation");
  for (const CurveElement<RationalFunction>& element : curve.values) {
    LaurentSeries value;
    for (const auto& [roots, coefficient] : element) {
      const RationalFunction own = roots == 0 ? coefficient : coefficient / factor;
      if (!is_polynomial(own)) throw NotDecided("a variable is infinite at a finite point");
      const LaurentSeries at = at_series(own, result.z);
      value = value + (roots == 0 ? at : at * result.speed);
    }
    result.values.push_back(value);
  }
  return result;
}

}  // namespace casimir::obstruction
