#include "symbolic/obstruction/family/straight_lines.hpp"

#include <fmt/format.h>

#include "symbolic/obstruction/curve_field.hpp"
#include "symbolic/obstruction/darboux_points.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"
#include "symbolic/obstruction/family/parameter_point.hpp"

namespace casimir::obstruction {
namespace {

using F = ParametricFunction;
using Chart = DirectionChart<F>;

/// What is asked of the parameter for the point to be one: A invertible, and V with a value near
/// the line.
ParameterConditions conditions_of(const HomogeneousPotential& system,
                                  const std::optional<GiNaC::symbol>& parameter,
                                  const Chart& chart) {
  ParameterConditions result;
  const auto& a = system.inverse_mass;
  const auto number = [&](const GiNaC::ex& f) {
    const CurveField<F> field;
    const std::vector<CurveElement<F>> values{CurveField<F>::constant(F::parameter())};
    return CurveField<F>::rational(field.value(f, {{*parameter, 0}}, values));
  };
  result.nonzero(number(a[0][0] * a[1][1] - a[0][1] * a[1][0]));
  for (const auto& row : a)
    for (const GiNaC::ex& entry : row) result.defined(number(entry));
  for (const F* f : {&chart.first, &chart.second, &chart.trace}) result.defined(*f);
  return result;
}

/// A V'(d) = gamma d: the eigenvalue is the trace of A V''(d)/gamma less k - 1.
std::optional<FamilyEquation> equation_at(const HomogeneousPotential& system,
                                          const ParameterPoint& point, const Chart& chart,
                                          bool vertical, ParameterConditions conditions,
                                          const CurveNames& names) {
  const F& factor = vertical ? chart.second : chart.first;
  const auto value = [&](const F& f) -> std::optional<ParameterPoint::Residue> {
    const ParameterPoint::Residue below = point.value(f.denominator());
    if (below.a.is_zero() && below.b.is_zero()) return std::nullopt;
    const F norm = below.a * below.a - below.a * below.b * point.s + below.b * below.b * point.t;
    conditions.nonzero(norm);
    return point.product(point.value(f.numerator()), point.inverse(below));
  };
  const auto gamma = value(factor), trace = value(chart.trace);
  if (!gamma || !trace || (gamma->a.is_zero() && gamma->b.is_zero())) return std::nullopt;
  const F norm =
      gamma->a * gamma->a - gamma->a * gamma->b * point.s + gamma->b * gamma->b * point.t;
  conditions.nonzero(norm);
  const ParameterPoint::Residue sum = point.product(*trace, point.inverse(*gamma));
  if (!sum.b.is_zero()) return std::nullopt;
  const long k = system.degree;
  const RationalFunction lambda = (sum.a - F(static_cast<int>(k - 1))).in_parameter();
  conditions.nonzero(parameter_coefficients(point.polynomial).back());
  FamilyEquation result = equation_of_line(lambda, k, std::move(conditions), names.parameter);
  const std::string line = vertical ? fmt::format("{} = 0", system.q[0].get_name())
                                    : fmt::format("{} = t*{} with {}", system.q[1].get_name(),
                                                  system.q[0].get_name(), point.text(names));
  result.shown.along = "the straight line " + line;
  return result;
}

}  // namespace

FamilyEquation equation_of_line(const RationalFunction& lambda, long k,
                                ParameterConditions conditions, const std::string& parameter) {
  const cln::cl_RA degree = k;
  FamilyEquation result;
  result.family.conditions = std::move(conditions);
  result.family.conditions.nonzero(lambda.denominator());
  result.family.points = {"phi = 0", fmt::format("phi^{} = 1", k), "phi = infinity"};
  result.family.squares = {
      RationalFunction(1 / (degree * degree)), RationalFunction(cln::cl_RA(1) / 4),
      (RationalFunction((degree - 2) * (degree - 2)) + RationalFunction(8 * degree) * lambda) /
          RationalFunction(4 * degree * degree)};
  result.shown.level = fmt::format(
      "q = phi(t)*c with A V'(c) = c and phi'^2/2 + phi^{0}/{0} = 1/{0}, V homogeneous of degree "
      "{0}, p A p/2 the kinetic energy",
      k);
  result.shown.nve =
      fmt::format("y'' = -lambda*phi^({})*y with lambda = {}", k - 2, lambda.text(parameter));
  result.shown.reduced = fmt::format("in phi^{} Riemann's P equation", k);
  return result;
}

std::vector<FamilyEquation> straight_line_families(const HamiltonianSystem& system) {
  std::vector<FamilyEquation> result;
  const auto potential = homogeneous_potential(system);
  if (!potential) return result;
  const CurveNames names{"t", system.free->get_name()};
  const F z = F::variable();
  const Chart chart(*potential, false, system.free);
  const F across = chart.second - z * chart.first;
  if (across.is_zero()) return result;
  const auto add = [&](const ParameterPoint& point, const Chart& own, bool vertical) {
    auto equation = equation_at(*potential, point, own, vertical,
                                conditions_of(*potential, system.free, own), names);
    if (equation) result.push_back(std::move(*equation));
  };
  for (const auto& [factor, exponent] : across.numerator().factors()) {
    const long degree = factor.degree(F::kVariable);
    if (degree == 1 || degree == 2) add(parameter_point(factor), chart, false);
  }
  const Chart other(*potential, true, system.free);
  const F turned = other.first - z * other.second;
  const ParameterPoint zero = parameter_point(z.numerator());
  if (zero.value(turned.numerator()).a.is_zero()) add(zero, other, true);
  return result;
}

}  // namespace casimir::obstruction
