#include "symbolic/obstruction/darboux_points.hpp"

#include <fmt/format.h>

#include "symbolic/obstruction/curve_field.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

/// A function of q1, q2 on the line (1, z), or (z, 1).
RationalFunction on_line(const GiNaC::ex& function, const HomogeneousPotential& system,
                         bool second_is_one) {
  const CurveField field;
  const CurveElement one = CurveField::constant(1);
  const CurveElement z = CurveField::constant(Univariate::variable());
  const GiNaC::exmap places{{system.q[0], 0}, {system.q[1], 1}};
  return CurveField::rational(field.value(
      function, places,
      second_is_one ? std::vector<CurveElement>{z, one} : std::vector<CurveElement>{one, z}));
}

/// The value of a rational function at a root of an irreducible polynomial; none at a pole.
std::optional<Univariate> at_root(const RationalFunction& f, const Univariate& direction) {
  const Univariate below = f.denominator().remainder(direction);
  if (below.is_zero()) return std::nullopt;
  return (f.numerator() * below.inverse(direction)).remainder(direction);
}

/// The derivatives of V along the lines in one of the two charts.
struct Chart {
  RationalFunction first, second, trace;

  Chart(const HomogeneousPotential& system, bool second_is_one) {
    const auto& [x, y] = system.q;
    const GiNaC::ex& v = system.potential;
    const auto divided = [](const RationalFunction& f, const cln::cl_RA& mass) {
      return f / RationalFunction(mass);
    };
    first = divided(on_line(v.diff(x), system, second_is_one), system.mass[0]);
    second = divided(on_line(v.diff(y), system, second_is_one), system.mass[1]);
    trace = divided(on_line(v.diff(x, 2), system, second_is_one), system.mass[0]) +
            divided(on_line(v.diff(y, 2), system, second_is_one), system.mass[1]);
  }
};

/// V'(d) = gamma M d: the point is c = s d with gamma s^(k-2) = 1, and V''(c) = V''(d)/gamma.
void add_point(const HomogeneousPotential& system, const RationalFunction& gamma,
               const RationalFunction& trace, DarbouxPoint point, DarbouxPoints& result) {
  const auto scale = at_root(gamma, point.direction), sum = at_root(trace, point.direction);
  if (!scale || !sum) return;  // a pole of V
  if (scale->is_zero()) {
    result.improper.push_back(point.text(system));
    return;
  }
  point.eigenvalue = (*sum * scale->inverse(point.direction)).remainder(point.direction) -
                     Univariate(cln::cl_RA(system.degree - 1));
  result.points.push_back(std::move(point));
}

}  // namespace

std::string DarbouxPoint::text(const HomogeneousPotential& system) const {
  const std::string x = system.q[0].get_name(), y = system.q[1].get_name();
  if (vertical) return x + " = 0";
  if (direction.degree() == 1) {
    const cln::cl_RA t = -direction.coefficient(0);
    return t == 0 ? y + " = 0" : fmt::format("{} = {}*{}", y, Univariate(t).text("t"), x);
  }
  return fmt::format("{} = t*{} with {} = 0", y, x, direction.text("t"));
}

std::string DarbouxPoint::eigenvalue_text() const { return eigenvalue.text("t"); }

DarbouxPoints darboux_points(const HomogeneousPotential& system) {
  DarbouxPoints result;
  const Chart chart(system, false);
  const RationalFunction z = RationalFunction(Univariate::variable());
  const RationalFunction across = chart.second - z * chart.first;
  if (across.is_zero()) {
    result.all_directions = true;
    return result;
  }
  for (const auto& [factor, exponent] : across.numerator().factors()) {
    DarbouxPoint point;
    point.direction = factor;
    add_point(system, chart.first, chart.trace, point, result);
  }
  const Chart other(system, true);
  if ((other.first - z * other.second).numerator().at(0) == 0) {
    DarbouxPoint point;
    point.vertical = true;
    point.direction = Univariate::variable();
    add_point(system, other.second, other.trace, point, result);
  }
  return result;
}

}  // namespace casimir::obstruction
