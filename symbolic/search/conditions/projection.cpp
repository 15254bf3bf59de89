#include "symbolic/search/conditions/projection.hpp"

#include <algorithm>
#include <random>

#include "symbolic/algebra/rational_matrix.hpp"

namespace casimir::search {
namespace {

using Unknowns = std::vector<std::size_t>;

bool depends_on(const Polynomial& p, const Unknowns& places) {
  return std::ranges::any_of(places, [&](std::size_t place) { return p.uses(place); });
}

bool have_in_common(const Polynomial& a, const Polynomial& b) {
  for (std::size_t i = 0; i < a.ring().size(); ++i)
    if (a.uses(i) && b.uses(i)) return true;
  return false;
}

bool is_one_of(const Unknowns& places, std::size_t place) {
  return std::ranges::find(places, place) != places.end();
}

void cancel(Projection::Value& value) {
  const Polynomial common = Polynomial::gcd(value.top, value.bottom);
  value.top.divide(common, &value.top);
  value.bottom.divide(common, &value.bottom);
}

/// Whether the rest is a triangular set with leading coefficients that are numbers (or generic),
/// where each equation for a parameter has no other unknowns. Then the family is finite over the
/// space of the unknowns that the set does not determine: all components have the dimension of that
/// space, and each lies over a component of what the equations for parameters say, times all
/// coefficients that are not determined. Without such leading coefficients it would not hold: the
/// set a*f = 0, a^2 = a has the component a = 0, over one point, and f = 0, over two.
bool separates(const Branch& branch, const Unknowns& coefficients, const Unknowns& parameters) {
  if (branch.rest.empty()) return true;
  // One irreducible equation: its components are conjugate, of one dimension, and lie over almost
  // all values of the parameters unless it is one between parameters.
  if (branch.rest.size() == 1) return true;
  Unknowns all = coefficients;
  all.insert(all.end(), parameters.begin(), parameters.end());
  const auto set = triangular(branch.rest, all);
  return set && std::ranges::all_of(*set, [&](const SolvedRelation& own) {
           return !depends_on(own.leading, all) &&
                  (!is_one_of(parameters, own.variable) || !depends_on(own.relation, coefficients));
         });
}

/// A coefficient on which the value of a parameter depends, the equation being linear in it: it is
/// eliminated by the parameter, which is free then. No more than other coordinates on a family that
/// is irreducible, or a product of an irreducible one, with the coefficient and all on which its
/// value depends, and what is left.
bool exchange(std::vector<Projection::Value>& values, const Unknowns& coefficients,
              const std::vector<Polynomial>& rest) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Projection::Value own = values[k];
    const Polynomial equation = own.top - own.bottom * own.top.ring().variable(own.place);
    for (const std::size_t u : coefficients) {
      if (equation.degree(u) != 1) continue;
      if (std::ranges::any_of(rest,
                              [&](const Polynomial& p) { return have_in_common(p, equation); }))
        continue;
      const std::vector<Polynomial> parts = equation.coefficients(u);
      const SolvedUnknown solved{u, -parts[0], parts[1]};
      values.erase(values.begin() + static_cast<std::ptrdiff_t>(k));
      for (Projection::Value& other : values) {
        put(solved, other.top, other.bottom);
        cancel(other);
      }
      return true;
    }
  }
  return false;
}

/// Whether the values are independent functions of the coefficients and the other parameters: by
/// the rank of their derivatives at a point, which is a lower bound of the rank in general.
bool are_independent(const std::vector<Projection::Value>& values, const Unknowns& coefficients) {
  if (values.empty()) return true;
  std::mt19937_64 random(5);
  std::vector<cln::cl_RA> point;
  for (std::size_t i = 0; i < values[0].top.ring().size(); ++i)
    point.emplace_back(static_cast<int>(random() % 997) + 2);
  // The derivatives with respect to coefficients alone: the other parameters are kept.
  RationalMatrix slopes(coefficients.size(), std::vector<cln::cl_RA>(values.size(), 0));
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto& [place, top, bottom] = values[k];
    const cln::cl_RA above = top.evaluate(point), below = bottom.evaluate(point);
    if (below == 0) return false;
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
      const std::size_t u = coefficients[i];
      slopes[i][k] = (top.derivative(u).evaluate(point) * below -
                      above * bottom.derivative(u).evaluate(point)) /
                     (below * below);
    }
  }
  return independent_columns(slopes).size() == values.size();
}

std::vector<Projection::Value> parameter_values(const Branch& branch, const Unknowns& parameters) {
  std::vector<Projection::Value> result;
  for (const SolvedUnknown& s : branch.solved) {
    if (!is_one_of(parameters, s.place)) continue;
    const PolynomialRing& ring = s.numerator.ring();
    Projection::Value value{s.place, ring.variable(s.place), ring.constant(1)};
    for (const SolvedUnknown& own : branch.solved) put(own, value.top, value.bottom);
    cancel(value);
    result.push_back(std::move(value));
  }
  return result;
}

}  // namespace

Projection projected(const Branch& branch, const Unknowns& coefficients,
                     const Unknowns& parameters) {
  Projection result;
  if (!branch.decided || !separates(branch, coefficients, parameters)) return result;
  result.values = parameter_values(branch, parameters);
  while (exchange(result.values, coefficients, branch.rest)) {
  }
  const bool depends = std::ranges::any_of(result.values, [&](const Projection::Value& own) {
    return depends_on(own.top, coefficients) || depends_on(own.bottom, coefficients);
  });
  if (depends) {
    if (branch.rest.empty() && are_independent(result.values, coefficients))
      result.kind = Projection::Kind::dense;
    return result;
  }
  for (const Polynomial& p : branch.rest)
    if (!depends_on(p, coefficients)) result.relations.push_back(p);
  result.kind = !result.relations.empty() ? Projection::Kind::relations
                : result.values.empty()   ? Projection::Kind::dense
                                          : Projection::Kind::values;
  return result;
}

}  // namespace casimir::search
