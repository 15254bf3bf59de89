#include "symbolic/obstruction/darboux_points.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/obstruction/curve_field.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

/// A power that is no integer makes more than one branch.
bool has_roots(const GiNaC::ex& expression) {
  if (GiNaC::is_a<GiNaC::power>(expression) && !expression.op(1).info(GiNaC::info_flags::integer))
    return true;
  return std::any_of(expression.begin(), expression.end(), has_roots);
}

bool is_canonical(const HamiltonianSystem& system) {
  const std::size_t n = system.variables.size() / 2;
  for (std::size_t i = 0; i < 2 * n; ++i)
    for (std::size_t j = 0; j < 2 * n; ++j) {
      const int expected = j == i + n ? 1 : i == j + n ? -1 : 0;
      if (!system.poisson[i][j].is_equal(expected)) return false;
    }
  return true;
}

CurveElement<RationalFunction> variable_on(const RationalFunction&) {
  return CurveField<RationalFunction>::constant(Univariate::variable());
}
CurveElement<ParametricFunction> variable_on(const ParametricFunction&) {
  return CurveField<ParametricFunction>::constant(ParametricFunction::variable());
}
void append_parameter(std::vector<CurveElement<RationalFunction>>&) {}
void append_parameter(std::vector<CurveElement<ParametricFunction>>& values) {
  values.push_back(CurveField<ParametricFunction>::constant(ParametricFunction::parameter()));
}

/// The value of a rational function at a root of an irreducible polynomial; none at a pole.
std::optional<Univariate> at_root(const RationalFunction& f, const Univariate& direction) {
  const Univariate below = f.denominator().remainder(direction);
  if (below.is_zero()) return std::nullopt;
  return (f.numerator() * below.inverse(direction)).remainder(direction);
}

/// A V'(d) = gamma d: the point is c = s d with gamma s^(k-2) = 1, and V''(c) = V''(d)/gamma.
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

std::optional<HomogeneousPotential> homogeneous_potential(const HamiltonianSystem& system) {
  if (system.variables.size() != 4 || !system.casimirs.empty() || !system.constraints.empty() ||
      !is_canonical(system))
    return std::nullopt;
  HomogeneousPotential result;
  result.potential = system.hamiltonian;
  for (std::size_t i = 0; i < 2; ++i) {
    result.q[i] = system.variables[i];
    for (std::size_t j = 0; j < 2; ++j) {
      const GiNaC::symbol &p = system.variables[i + 2], &other = system.variables[j + 2];
      const GiNaC::ex own = system.hamiltonian.diff(p).diff(other).normal();
      for (const GiNaC::symbol& x : system.variables)
        if (own.has(x)) return std::nullopt;
      result.inverse_mass[i][j] = own;
      result.potential -= own * p * other / 2;
    }
  }
  const auto& a = result.inverse_mass;
  if ((a[0][0] * a[1][1] - a[0][1] * a[1][0]).normal().is_zero()) return std::nullopt;
  result.potential = result.potential.expand();
  if (result.potential.has(system.variables[2]) || result.potential.has(system.variables[3]) ||
      result.potential.is_zero() || has_roots(result.potential))
    return std::nullopt;
  const GiNaC::ex slope = result.q[0] * result.potential.diff(result.q[0]) +
                          result.q[1] * result.potential.diff(result.q[1]);
  const GiNaC::ex degree = (slope / result.potential).normal();
  if (!GiNaC::is_a<GiNaC::numeric>(degree) || !degree.info(GiNaC::info_flags::integer))
    return std::nullopt;
  result.degree = GiNaC::ex_to<GiNaC::numeric>(degree).to_long();
  if (result.degree == 0 || result.degree == 2 || result.degree == -2) return std::nullopt;
  return result;
}

template <class F>
DirectionChart<F>::DirectionChart(const HomogeneousPotential& system, bool second_is_one,
                                  const std::optional<GiNaC::symbol>& parameter) {
  const CurveField<F> field;
  const CurveElement<F> one = CurveField<F>::constant(F(1)), z = variable_on(F());
  GiNaC::exmap places{{system.q[0], 0}, {system.q[1], 1}};
  std::vector<CurveElement<F>> values{second_is_one ? z : one, second_is_one ? one : z};
  if (parameter) places[*parameter] = static_cast<int>(values.size());
  append_parameter(values);
  const auto value = [&](const GiNaC::ex& f) {
    return CurveField<F>::rational(field.value(f, places, values));
  };
  const auto& a = system.inverse_mass;
  const GiNaC::ex &v = system.potential, x = v.diff(system.q[0]), y = v.diff(system.q[1]);
  first = value(a[0][0] * x + a[0][1] * y);
  second = value(a[1][0] * x + a[1][1] * y);
  trace = value(a[0][0] * x.diff(system.q[0]) + 2 * a[0][1] * x.diff(system.q[1]) +
                a[1][1] * y.diff(system.q[1]));
}

template struct DirectionChart<RationalFunction>;
template struct DirectionChart<ParametricFunction>;

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
  const DirectionChart<RationalFunction> chart(system, false, std::nullopt);
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
  const DirectionChart<RationalFunction> other(system, true, std::nullopt);
  if ((other.first - z * other.second).numerator().at(0) == 0) {
    DarbouxPoint point;
    point.vertical = true;
    point.direction = Univariate::variable();
    add_point(system, other.second, other.trace, point, result);
  }
  return result;
}

std::optional<cln::cl_RA> relation_of_all_points(const HomogeneousPotential& system,
                                                 const DarbouxPoints& points) {
  if (system.degree < 3 || !system.potential.is_polynomial(GiNaC::lst{system.q[0], system.q[1]}) ||
      points.all_directions || !points.improper.empty())
    return std::nullopt;
  long count = 0;
  cln::cl_RA sum = 0;
  for (const DarbouxPoint& point : points.points) {
    const Univariate less_one = point.eigenvalue - Univariate(1);
    if (less_one.is_zero()) return std::nullopt;
    const Univariate inverse = less_one.inverse(point.direction);
    const long n = point.direction.degree();
    count += n;
    // The trace of the multiplication by it.
    for (long i = 0; i < n; ++i)
      sum = sum + (inverse * Univariate::variable().pow(static_cast<unsigned long>(i)))
                      .remainder(point.direction)
                      .coefficient(i);
  }
  return count == system.degree ? std::optional<cln::cl_RA>(sum) : std::nullopt;
}

}  // namespace casimir::obstruction
