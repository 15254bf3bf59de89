#include "symbolic/obstruction/normal_variation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

using GiNaC::ex;
template <class F>
using CurveRow = std::vector<CurveElement<F>>;
template <class F>
using Matrix = std::vector<CurveRow<F>>;

/// Derivatives on the surface in the coordinates xi = x - value (normal) and x (along).
template <class F>
class Linearisation {
 public:
  Linearisation(const HamiltonianSystem& system, const InvariantPlane& plane,
                const ParticularCurve<F>& curve)
      : system_(system), plane_(plane), curve_(curve) {}

  CurveElement<F> value(const ex& f) const {
    return curve_.field.value(plane_.on(f), curve_.places, curve_.values);
  }

  CurveRow<F> by_normal(const ex& f) const {
    CurveRow<F> result;
    for (const auto& [i, own] : plane_.normal)
      result.push_back(value(f.diff(system_.variables[i])));
    return result;
  }

  CurveRow<F> by_along(const ex& f) const {
    CurveRow<F> result;
    for (const std::size_t t : plane_.along) {
      ex slope = f.diff(system_.variables[t]);
      for (const auto& [i, own] : plane_.normal)
        slope += f.diff(system_.variables[i]) * own.diff(system_.variables[t]);
      result.push_back(value(slope));
    }
    return result;
  }

  /// d(xi)/dt for a normal variable, as a function of all variables.
  ex normal_rate(std::size_t place) const {
    const auto& [i, own] = plane_.normal[place];
    ex rate = system_.rates[i];
    for (const std::size_t t : plane_.along)
      rate -= own.diff(system_.variables[t]) * system_.rates[t];
    return rate;
  }

 private:
  const HamiltonianSystem& system_;
  const InvariantPlane& plane_;
  const ParticularCurve<F>& curve_;
};

template <class F>
bool all_zero(const CurveRow<F>& row) {
  return std::all_of(row.begin(), row.end(),
                     [](const auto& e) { return CurveField<F>::is_zero(e); });
}

/// The matrix of the normal equations: the surface is invariant, so that nothing along it enters.
template <class F>
Matrix<F> normal_matrix(const Linearisation<F>& lines, std::size_t count) {
  Matrix<F> result;
  for (std::size_t i = 0; i < count; ++i) {
    const ex rate = lines.normal_rate(i);
    if (!CurveField<F>::is_zero(lines.value(rate)) || !all_zero(lines.by_along(rate)))
      throw NotDecided("the surface is not invariant");
    result.push_back(lines.by_normal(rate));
  }
  return result;
}

/// The rank of the bracket along the curve. \throws NotDecided  where a function that the case calls
/// a Casimir function has brackets there that do not vanish
template <class F>
std::size_t bracket_rank(const HamiltonianSystem& system, const Linearisation<F>& lines,
                         const CurveField<F>& field) {
  for (const auto& [name, casimir] : system.casimirs)
    for (const auto& brackets : system.poisson) {
      ex own = 0;
      for (std::size_t j = 0; j < brackets.size(); ++j)
        own += brackets[j] * casimir.diff(system.variables[j]);
      if (!CurveField<F>::is_zero(lines.value(own)))
        throw NotDecided(fmt::format("{} is no Casimir function", name));
    }
  Matrix<F> rows;
  for (const auto& brackets : system.poisson) {
    CurveRow<F> row;
    for (const ex& bracket : brackets) row.push_back(lines.value(bracket));
    rows.push_back(std::move(row));
  }
  return reduce_rows(field, rows);
}

/// Linear relations between the normal unknowns of what is tangent to the level of the Casimir
/// functions: combinations of their gradients that have no part along the surface.
template <class F>
Matrix<F> tangency(const HamiltonianSystem& system, const InvariantPlane& plane,
                   const Linearisation<F>& lines, const CurveField<F>& field) {
  Matrix<F> rows;
  for (const auto& [name, casimir] : system.casimirs) {
    CurveRow<F> row = lines.by_along(casimir);
    const CurveRow<F> normal = lines.by_normal(casimir);
    row.insert(row.end(), normal.begin(), normal.end());
    rows.push_back(std::move(row));
  }
  const std::size_t rank = reduce_rows(field, rows);
  const std::size_t leaf = bracket_rank(system, lines, field);
  if (rank != rows.size() || rank + leaf != system.variables.size())
    throw NotDecided("the Casimir functions of the case do not give the leaves along the curve");
  const auto width = static_cast<std::ptrdiff_t>(plane.along.size());
  Matrix<F> result;
  for (const CurveRow<F>& row : rows)
    if (all_zero(CurveRow<F>(row.begin(), row.begin() + width)))
      result.emplace_back(row.begin() + width, row.end());
  return result;
}

/// The unknowns that the relations leave free, and the matrix for them alone.
template <class F>
struct Reduced {
  std::vector<std::size_t> free;
  Matrix<F> matrix;
};

template <class F>
Reduced<F> reduce(const CurveField<F>& field, const Matrix<F>& matrix, Matrix<F> relations) {
  // From the last unknown on: those of a list that come first are the momenta of bodies.
  std::vector<std::size_t> pivots;
  for (CurveRow<F>& row : relations) std::reverse(row.begin(), row.end());
  reduce_rows(field, relations, &pivots);
  for (CurveRow<F>& row : relations) std::reverse(row.begin(), row.end());
  for (std::size_t& pivot : pivots) pivot = matrix.size() - 1 - pivot;
  Reduced<F> result;
  for (std::size_t i = 0; i < matrix.size(); ++i)
    if (std::find(pivots.begin(), pivots.end(), i) == pivots.end()) result.free.push_back(i);
  for (const std::size_t i : result.free) {
    CurveRow<F> row;
    for (const std::size_t j : result.free) {
      CurveElement<F> entry = matrix[i][j];
      for (std::size_t k = 0; k < pivots.size(); ++k)
        entry = field.difference(entry, field.product(matrix[i][pivots[k]], relations[k][j]));
      row.push_back(entry);
    }
    result.matrix.push_back(std::move(row));
  }
  return result;
}

/// Sets of unknowns that depend on one another: the parts of a block triangular form.
template <class F>
std::vector<std::vector<std::size_t>> parts(const Matrix<F>& matrix) {
  const std::size_t n = matrix.size();
  std::vector<std::vector<bool>> reach(n, std::vector<bool>(n, false));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      reach[i][j] = i == j || !CurveField<F>::is_zero(matrix[i][j]);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (reach[i][k] && reach[k][j]) reach[i][j] = true;
  std::vector<std::vector<std::size_t>> result;
  std::vector<bool> done(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    if (done[i]) continue;
    result.emplace_back();
    for (std::size_t j = i; j < n; ++j) {
      if (!reach[i][j] || !reach[j][i]) continue;
      result.back().push_back(j);
      done[j] = true;
    }
  }
  return result;
}

/// y' = a y + b x, x' = c y + d x, made one equation for y; a, .., d by z.
template <class F>
NormalEquation<F> second_order(const CurveField<F>& field, const CurveElement<F>& a,
                               const CurveElement<F>& b, const CurveElement<F>& c,
                               const CurveElement<F>& d) {
  const CurveElement<F> ratio = field.product(field.derivative(b), field.inverse(b));
  CurveElement<F> q = field.difference(field.product(a, d), field.product(b, c));
  q = field.sum(field.difference(q, field.derivative(a)), field.product(a, ratio));
  const CurveElement<F> p = field.difference({}, field.sum(field.sum(a, d), ratio));
  NormalEquation<F> result;
  result.p = CurveField<F>::rational(p);
  result.q = CurveField<F>::rational(q);
  const F half = result.p * F(cln::cl_RA(1) / 2);
  result.reduced = half * half + half.derivative() - result.q;
  return result;
}

/// Of the two unknowns the one whose equation is simpler. \throws NotDecided  where neither has one
/// with coefficients in Q(z)
template <class F>
NormalEquation<F> equation_of(const CurveField<F>& field, const Matrix<F>& m, std::size_t i,
                              std::size_t j, const std::function<std::string(std::size_t)>& name) {
  const auto of = [&](std::size_t own, std::size_t other) {
    NormalEquation<F> result =
        second_order(field, m[own][own], m[own][other], m[other][own], m[other][other]);
    result.unknowns = {name(own), name(other)};
    return result;
  };
  std::optional<NormalEquation<F>> first;
  try {
    first = of(i, j);
  } catch (const NotDecided&) {
    return of(j, i);
  }
  try {
    NormalEquation<F> second = of(j, i);
    const auto size = [](const NormalEquation<F>& e) { return pole_count(e.reduced); };
    return size(second) < size(*first) ? second : *first;
  } catch (const NotDecided&) {
    return *first;
  }
}

}  // namespace

template <class F>
NormalVariation<F> normal_variation(const HamiltonianSystem& system, const InvariantPlane& plane,
                                    const ParticularCurve<F>& curve) {
  const CurveField<F>& field = curve.field;
  const Linearisation<F> lines(system, plane, curve);
  Reduced<F> reduced = reduce(field, normal_matrix(lines, plane.normal.size()),
                              tangency(system, plane, lines, field));
  const CurveElement<F> slowness = field.inverse(curve.speed);
  for (CurveRow<F>& row : reduced.matrix)
    for (CurveElement<F>& entry : row) entry = field.product(entry, slowness);
  const auto name = [&, &free = reduced.free](std::size_t i) {
    return system.variables[plane.normal[free[i]].first].get_name();
  };
  NormalVariation<F> result;
  result.freedom = (system.variables.size() - system.casimirs.size()) / 2;
  for (const std::vector<std::size_t>& part : parts(reduced.matrix)) {
    if (part.size() == 1) continue;
    if (part.size() > 2) {
      result.left_out.push_back(fmt::format("{} unknowns that are not separated", part.size()));
      continue;
    }
    try {
      result.equations.push_back(equation_of<F>(field, reduced.matrix, part[0], part[1], name));
    } catch (const NotDecided& problem) {
      result.left_out.emplace_back(problem.what());
    }
  }
  return result;
}

template NormalVariation<RationalFunction> normal_variation(
    const HamiltonianSystem&, const InvariantPlane&, const ParticularCurve<RationalFunction>&);
template NormalVariation<ParametricFunction> normal_variation(
    const HamiltonianSystem&, const InvariantPlane&, const ParticularCurve<ParametricFunction>&);

}  // namespace casimir::obstruction
