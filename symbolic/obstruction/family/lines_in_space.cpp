#include "symbolic/obstruction/family/lines_in_space.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/obstruction/curve_field.hpp"
#include "symbolic/obstruction/family/straight_lines.hpp"
#include "symbolic/obstruction/points/potential_in_space.hpp"

namespace casimir::obstruction {
namespace {

using GiNaC::ex;
using F = ParametricFunction;

/// A function of the free parameter alone.
F function_of_parameter(const ex& f, const GiNaC::symbol& parameter) {
  const CurveField<F> field;
  const std::vector<CurveElement<F>> values{CurveField<F>::constant(F::parameter())};
  return CurveField<F>::rational(field.value(f, {{parameter, 0}}, values));
}

/// Vectors of 0, 1 and -1, one of each two opposite ones.
std::vector<std::vector<int>> line_directions(std::size_t n) {
  std::vector<std::vector<int>> result{{}};
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<std::vector<int>> longer;
    for (const std::vector<int>& d : result) {
      const bool begun = std::ranges::any_of(d, [](int entry) { return entry != 0; });
      for (int entry = begun ? -1 : 0; entry <= 1; ++entry) {
        longer.push_back(d);
        longer.back().push_back(entry);
      }
    }
    result = std::move(longer);
  }
  std::erase_if(result, [](const std::vector<int>& d) {
    return std::ranges::all_of(d, [](int entry) { return entry == 0; });
  });
  return result;
}

/// A V'(d) = gamma d with gamma not identically zero; and A V''(d)/gamma.
struct SymbolicLine {
  std::vector<int> direction;
  ex gamma;
  GiNaC::matrix curvature;
};

std::optional<SymbolicLine> line_along(const PotentialInSpace& system, const std::vector<int>& d) {
  const unsigned n = static_cast<unsigned>(d.size());
  GiNaC::exmap at;
  for (std::size_t i = 0; i < d.size(); ++i) at[system.q[i]] = d[i];
  try {
    SymbolicLine result{d, 0, GiNaC::matrix(n, n)};
    std::vector<ex> slopes;
    for (const ex& slope : system.slopes) slopes.push_back(slope.subs(at).normal());
    for (std::size_t i = 0; i < d.size(); ++i)
      if (d[i] != 0) result.gamma = slopes[i] / d[i];
    if (result.gamma.is_zero()) return std::nullopt;
    for (std::size_t i = 0; i < d.size(); ++i)
      if (!(slopes[i] - result.gamma * d[i]).normal().is_zero()) return std::nullopt;
    for (unsigned i = 0; i < n; ++i)
      for (unsigned j = 0; j < n; ++j)
        result.curvature(i, j) = (system.curvatures[i][j].subs(at) / result.gamma).normal();
    return result;
  } catch (const GiNaC::pole_error&) {
    return std::nullopt;
  }
}

/// The eigenvalues that are rational functions of the parameter, each once, but for one k - 1.
std::vector<ex> rational_eigenvalues(const SymbolicLine& line, long degree, ex& leading) {
  const GiNaC::symbol lambda("lambda");
  const ex own = line.curvature.charpoly(lambda).normal();
  leading = own.denom();
  const ex rest = GiNaC::quo(own.numer().expand(), lambda - (degree - 1), lambda).normal();
  const ex factors = GiNaC::factor(rest.numer());
  std::vector<ex> result;
  const auto add = [&](const ex& factor) {
    const ex f = GiNaC::is_a<GiNaC::power>(factor) ? factor.op(0) : factor;
    if (f.degree(lambda) != 1) return;
    const ex root = (-f.coeff(lambda, 0) / f.coeff(lambda, 1)).normal();
    leading *= f.coeff(lambda, 1);
    if (std::ranges::none_of(result, [&](const ex& other) { return other.is_equal(root); }))
      result.push_back(root);
  };
  if (GiNaC::is_a<GiNaC::mul>(factors))
    for (const ex& factor : factors) add(factor);
  else
    add(factors);
  return result;
}

std::string direction_text(const PotentialInSpace& system, const std::vector<int>& d) {
  std::string names, entries;
  for (std::size_t i = 0; i < d.size(); ++i) {
    names += (i > 0 ? ", " : "") + system.q[i].get_name();
    entries += (i > 0 ? ", " : "") + std::to_string(d[i]);
  }
  return fmt::format("the straight line ({}) = phi(t)*({})", names, entries);
}

}  // namespace

std::vector<FamilyEquation> families_of_lines_in_space(const HamiltonianSystem& system) {
  constexpr std::size_t kMostFreedom = 6;
  std::vector<FamilyEquation> result;
  const auto potential = potential_in_space(system);
  if (!potential || !system.free || potential->q.size() > kMostFreedom) return result;
  const std::string& name = system.free->get_name();
  for (const std::vector<int>& d : line_directions(potential->q.size())) {
    const auto line = line_along(*potential, d);
    if (!line) continue;
    ex leading;
    for (const ex& lambda : rational_eigenvalues(*line, potential->degree, leading)) {
      ParameterConditions conditions;
      for (const ex& f : {potential->determinant, line->gamma, leading}) {
        const F own = function_of_parameter(f, *system.free);
        conditions.nonzero(own);
        conditions.defined(own);
      }
      for (std::size_t i = 0; i < line->curvature.nops(); ++i)
        conditions.defined(function_of_parameter(line->curvature.op(i), *system.free));
      result.push_back(equation_of_line(function_of_parameter(lambda, *system.free).in_parameter(),
                                        potential->degree, std::move(conditions), name));
      result.back().shown.along = direction_text(*potential, d);
    }
  }
  return result;
}

}  // namespace casimir::obstruction
