#include "symbolic/obstruction/particular_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

using GiNaC::ex;
using GiNaC::symbol;

constexpr std::size_t kMostEnergies = 7;

/// A variable as base + factor*w with w^2 = radicand, functions of z and of variables found later.
struct Step {
  symbol variable;
  ex base, factor, radicand;
};

/// A level of the integrals on the surface: each is a function with a value.
struct Relation {
  std::string name;
  ex function, value;
};

bool has_parameter(const HamiltonianSystem& system, const ex& e) {
  return (system.free && e.has(*system.free)) ||
         std::any_of(system.further.begin(), system.further.end(),
                     [&](const symbol& other) { return e.has(other); });
}

/// Variables of an expression that are among those given.
bool uses_any(const ex& expression, const std::vector<symbol>& variables) {
  return std::any_of(variables.begin(), variables.end(),
                     [&](const symbol& x) { return expression.has(x); });
}

/// One relation solved for one variable: of degree 1, else a square, else of degree 2.
std::optional<Step> solve_one(const ex& relation, const symbol& u, int kind) {
  if (!relation.is_polynomial(u)) return std::nullopt;
  const int degree = relation.degree(u);
  const ex c0 = relation.coeff(u, 0), c1 = relation.coeff(u, 1), c2 = relation.coeff(u, 2);
  if (kind == 0 && degree == 1) return Step{u, -c0 / c1, 0, 0};
  if (kind == 1 && degree == 2 && c1.is_zero()) return Step{u, 0, 1, -c0 / c2};
  if (kind == 2 && degree == 2)
    return Step{u, -c1 / (2 * c2), 1, (c1 * c1 - 4 * c0 * c2) / (4 * c2 * c2)};
  return std::nullopt;
}

/// The relation without the variable of a step; empty where an odd power of a root remains.
std::optional<ex> without(const ex& relation, const Step& step) {
  if (!relation.has(step.variable)) return relation;
  if (step.factor.is_zero()) return relation.subs(step.variable == step.base).numer().expand();
  if (!step.base.is_zero() || !relation.is_polynomial(step.variable)) return std::nullopt;
  ex result = 0;
  for (int i = 0; i <= relation.degree(step.variable); ++i) {
    const ex c = relation.coeff(step.variable, i);
    if (i % 2 != 0 && !c.is_zero()) return std::nullopt;
    if (i % 2 == 0) result += c * GiNaC::pow(step.radicand, i / 2);
  }
  return result.normal().numer().expand();
}

/// Solves the relations for all variables but z, one after the other.
std::optional<std::vector<Step>> solve(std::vector<ex> relations, std::vector<symbol> unknown) {
  std::vector<Step> steps;
  while (!unknown.empty()) {
    bool found = false;
    for (int kind = 0; kind < 3 && !found; ++kind) {
      for (std::size_t i = 0; i < relations.size() && !found; ++i) {
        for (std::size_t j = 0; j < unknown.size() && !found; ++j) {
          const auto step = solve_one(relations[i], unknown[j], kind);
          if (!step) continue;
          std::vector<ex> rest;
          for (std::size_t k = 0; k < relations.size(); ++k) {
            if (k == i) continue;
            const auto own = without(relations[k], *step);
            if (own) rest.push_back(*own);
          }
          if (rest.size() + 1 < relations.size()) continue;
          relations = std::move(rest);
          unknown.erase(unknown.begin() + static_cast<std::ptrdiff_t>(j));
          steps.push_back(*step);
          found = true;
        }
      }
    }
    if (!found) return std::nullopt;
  }
  std::reverse(steps.begin(), steps.end());
  return steps;
}

/// A polynomial in one symbol with rational coefficients; empty for anything else.
std::optional<Univariate> univariate(const ex& expression, const symbol& x) {
  const ex p = expression.expand();
  if (!p.is_polynomial(x)) return std::nullopt;
  std::vector<cln::cl_RA> coefficients;
  for (int i = 0; i <= p.degree(x); ++i) {
    const ex c = p.coeff(x, i);
    if (!GiNaC::is_a<GiNaC::numeric>(c) || !GiNaC::ex_to<GiNaC::numeric>(c).is_rational())
      return std::nullopt;
    coefficients.push_back(cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(c).to_cl_N()));
  }
  return Univariate(coefficients);
}

/// The energies that are roots of factors of degree 1.
void add_linear_roots(const ex& polynomial, const symbol& energy, std::vector<ex>& result) {
  const ex product = GiNaC::factor(polynomial.expand());
  const auto add = [&](const ex& power) {
    const ex factor = GiNaC::is_a<GiNaC::power>(power) ? power.op(0) : power;
    if (factor.is_polynomial(energy) && factor.degree(energy) == 1)
      result.push_back((-factor.coeff(energy, 0) / factor.coeff(energy, 1)).normal());
  };
  if (GiNaC::is_a<GiNaC::mul>(product))
    for (const ex& part : product) add(part);
  else
    add(product);
}

/// Rational energies at which two of the points z coincide where a radicand vanishes or is
/// infinite.
void add_special_energies(const HamiltonianSystem& system, const std::vector<Step>& steps,
                          const symbol& z, const symbol& energy, std::vector<ex>& result) {
  ex product = 1;
  for (const Step& step : steps) {
    if (step.factor.is_zero()) continue;
    const ex both = step.radicand.normal().numer_denom();
    for (const ex& part : both)
      if (part.has(z)) product *= part;
  }
  product = product.expand();
  GiNaC::lst symbols{z, energy};
  if (system.free) symbols.append(*system.free);
  for (const symbol& other : system.further) symbols.append(other);
  if (!product.is_polynomial(symbols)) return;
  product = GiNaC::sqrfree(product, GiNaC::lst{z});
  ex radical = 1;
  if (GiNaC::is_a<GiNaC::mul>(product)) {
    for (const ex& part : product) radical *= GiNaC::is_a<GiNaC::power>(part) ? part.op(0) : part;
  } else {
    radical = GiNaC::is_a<GiNaC::power>(product) ? product.op(0) : product;
  }
  radical = radical.expand();
  if (!radical.is_polynomial(z) || radical.degree(z) < 1 || radical.degree(z) > 6) return;
  const ex discriminant =
      radical.degree(z) == 1 ? radical.lcoeff(z) : GiNaC::resultant(radical, radical.diff(z), z);
  if (system.free) {
    add_linear_roots(discriminant, energy, result);
    return;
  }
  const auto p = univariate(discriminant, energy);
  if (!p) return;
  for (const auto& [factor, exponent] : p->factors())
    if (factor.degree() == 1)
      result.push_back(GiNaC::numeric(cln::cl_N(cln::cl_RA(-factor.coefficient(0)))));
}

/// What is put in for the free parameter: nothing can be where functions have none.
void add_parameter(const HamiltonianSystem& system, ParticularCurve<RationalFunction>&) {
  if (system.free) throw std::logic_error("a free parameter has no place on this curve");
}

void add_parameter(const HamiltonianSystem& system, ParticularCurve<ParametricFunction>& curve) {
  if (!system.free) return;
  curve.names.parameter = system.free->get_name();
  curve.places[*system.free] = static_cast<int>(curve.values.size());
  curve.values.push_back(CurveField<ParametricFunction>::constant(ParametricFunction::parameter()));
  for (const symbol& other : system.further) {
    curve.places[other] = static_cast<int>(curve.values.size());
    curve.names.further.push_back(other.get_name());
    curve.values.push_back(CurveField<ParametricFunction>::constant(
        ParametricFunction::parameter(curve.names.further.size())));
  }
}

RationalFunction variable_of(const RationalFunction&) { return Univariate::variable(); }
ParametricFunction variable_of(const ParametricFunction&) { return ParametricFunction::variable(); }

/// An energy in print. GiNaC's order of factors changes from run to run.
std::string energy_text(const HamiltonianSystem& system, const ex& energy) {
  if (!system.free) return expression_text(energy);
  const CurveField<ParametricFunction> field;
  std::vector<CurveElement<ParametricFunction>> values{
      CurveField<ParametricFunction>::constant(ParametricFunction::parameter())};
  GiNaC::exmap places{{*system.free, 0}};
  CurveNames names{"", system.free->get_name()};
  for (const symbol& other : system.further) {
    places[other] = static_cast<int>(values.size());
    names.further.push_back(other.get_name());
    values.push_back(CurveField<ParametricFunction>::constant(
        ParametricFunction::parameter(names.further.size())));
  }
  return written(CurveField<ParametricFunction>::rational(field.value(energy, places, values)),
                 names);
}

/// What roots are taken of, of all roots in an expression.
void add_radicands(const ex& expression, std::vector<ex>& radicands) {
  if (GiNaC::is_a<GiNaC::power>(expression) && !expression.op(1).info(GiNaC::info_flags::integer))
    radicands.push_back(expression.op(0));
  for (const ex& part : expression) add_radicands(part, radicands);
}

/// Whether a condition holds for every z that is large enough.
bool holds_for_large(const Assumption& condition, const ex& on_plane, const symbol& z) {
  const ex quotient = on_plane.numer_denom();
  int sign = 1;
  for (const ex& part : quotient) {
    const ex polynomial = part.expand();
    if (!polynomial.is_polynomial(z)) return false;
    const ex leading = polynomial.lcoeff(z);
    if (!GiNaC::is_a<GiNaC::numeric>(leading) || leading.is_zero()) return false;
    sign *= GiNaC::ex_to<GiNaC::numeric>(leading).is_negative() ? -1 : 1;
  }
  return holds(condition.comparison, sign);
}

/// Whether the radicand has a factor of even multiplicity that moves and may vanish in the domain:
/// on both sides of where it does, the root is another analytic function, as |1 - x^2| is. (Not so
/// x^2 + y^2, around whose zeros there is a way.)
bool parts_the_space(const ex& radicand, const HamiltonianSystem& system) {
  std::vector<symbol> all = system.variables;
  if (system.free) all.push_back(*system.free);
  all.insert(all.end(), system.further.begin(), system.further.end());
  GiNaC::lst symbols;
  for (const symbol& one : all) symbols.append(one);
  const auto may_vanish = [&](const ex& factor) {
    if (!uses_any(factor, system.variables)) return false;
    FunctionRing ring(all, system.domain, {factor}, system.limits);
    return !ring.is_nowhere_zero(ring.convert(factor));
  };
  for (const ex& part : radicand.numer_denom()) {
    const ex expanded = part.expand();
    if (!uses_any(expanded, system.variables)) continue;
    if (!expanded.is_polynomial(symbols)) return true;
    const ex product = GiNaC::sqrfree(expanded, symbols);
    const auto parts = [&](const ex& factor) {
      return GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::even) &&
             may_vanish(factor.op(0));
    };
    if (parts(product) ||
        (GiNaC::is_a<GiNaC::mul>(product) && std::any_of(product.begin(), product.end(), parts)))
      return true;
  }
  return false;
}

/// Whether a part that has cancelled has values for all large z on the plane: it is made of entire
/// functions and roots of what is positive there.
bool has_values_for_large(const ex& part, const InvariantPlane& plane, const symbol& z) {
  if (GiNaC::is_a<GiNaC::function>(part)) {
    const std::string name = GiNaC::ex_to<GiNaC::function>(part).get_name();
    const std::vector<std::string> entire{"sin", "cos", "exp", "sinh", "cosh", "tanh", "atan"};
    if (std::find(entire.begin(), entire.end(), name) == entire.end()) return false;
  }
  if (GiNaC::is_a<GiNaC::power>(part) && !part.op(1).info(GiNaC::info_flags::integer) &&
      !holds_for_large({part.op(0), Comparison::greater, {}}, plane.on(part.op(0)).normal(), z))
    return false;
  return std::all_of(part.begin(), part.end(),
                     [&](const ex& own) { return has_values_for_large(own, plane, z); });
}

/// Where H has roots, it is another analytic function for each choice of their signs, and the
/// choice of `CurveField::value` is that of large real z. What is excluded for it says something of
/// the case where its domain has points with such z in every neighbourhood of the surface: what is
/// under the roots and in the conditions of the domain may depend on z alone, nothing else that has
/// cancelled may limit it, and no root may make H another function on two sides of a surface, of
/// which integrals may be asked for on one.
/// \throws NotDecided  where that is not certain
void check_branches(const HamiltonianSystem& system, const InvariantPlane& plane, const symbol& z) {
  std::vector<ex> radicands;
  add_radicands(system.hamiltonian, radicands);
  for (const auto& row : system.poisson)
    for (const ex& entry : row) add_radicands(entry, radicands);
  std::erase_if(radicands, [&](const ex& e) { return !uses_any(e, system.variables); });
  if (radicands.empty()) return;
  std::vector<symbol> beside;
  for (const symbol& x : system.variables)
    if (!x.is_equal(z)) beside.push_back(x);
  const NotDecided open("which branch of a root the domain has is not decided");
  if (!std::all_of(system.lost.begin(), system.lost.end(),
                   [&](const ex& part) { return has_values_for_large(part, plane, z); }))
    throw open;
  for (const ex& radicand : radicands)
    if (uses_any(plane.on(radicand), beside) || parts_the_space(radicand, system)) throw open;
  for (const Assumption& condition : system.domain) {
    const ex on_plane = plane.on(condition.difference).normal();
    if (uses_any(on_plane, beside) || !holds_for_large(condition, on_plane, z)) throw open;
  }
}

/// The curve at an energy. \throws NotDecided  where it is none
template <class F>
ParticularCurve<F> make_curve(const HamiltonianSystem& system, const InvariantPlane& plane,
                              const std::vector<Step>& steps, const symbol& z,
                              const ex& is_energy) {
  check_branches(system, plane, z);
  ParticularCurve<F> curve;
  curve.names.z = z.get_name();
  const std::size_t n = system.variables.size();
  for (std::size_t i = 0; i < n; ++i) curve.places[system.variables[i]] = static_cast<int>(i);
  curve.values.resize(n);
  curve.values[system.index(z)] = CurveField<F>::constant(variable_of(F()));
  add_parameter(system, curve);
  const auto value = [&](const ex& expression) {
    return curve.field.value(plane.on(expression).subs(is_energy), curve.places, curve.values);
  };
  for (const Step& step : steps) {
    CurveElement<F> own = value(step.base);
    if (!step.factor.is_zero()) {
      const F square = CurveField<F>::rational(value(step.radicand));
      const CurveElement<F> root = curve.field.root_of(square);
      own = curve.field.sum(own, root);
      curve.complexity += total_degree(square);
      if (step.base.is_zero()) {
        curve.equations += fmt::format("{}{}^2 = {}", curve.equations.empty() ? "" : ", ",
                                       step.variable.get_name(), written(square, curve.names));
        curve.roots.emplace_back(system.index(step.variable), square);
      }
    }
    curve.values[system.index(step.variable)] = own;
  }
  for (const auto& [i, normal] : plane.normal) curve.values[i] = value(normal);
  // It is an integral curve: every variable has its rate.
  curve.speed = value(system.rates[system.index(z)]);
  if (CurveField<F>::is_zero(curve.speed)) throw NotDecided("the motion on that level is at rest");
  for (std::size_t i = 0; i < n; ++i) {
    const CurveElement<F> own =
        curve.field.product(curve.speed, curve.field.derivative(curve.values[i]));
    if (!CurveField<F>::is_zero(curve.field.difference(own, value(system.rates[i]))))
      throw NotDecided("the level has a part that is no motion");
  }
  for (const ex& constraint : system.constraints)
    if (!CurveField<F>::is_zero(value(constraint)))
      throw NotDecided("the motion is outside of the phase space");
  return curve;
}

/// The values of the Casimir functions and of the energy that are tried.
struct Levels {
  std::vector<Relation> relations;  ///< those of the Casimir functions that vary on the surface
  std::string text;                 ///< of all Casimir functions
};

std::vector<Levels> casimir_levels(const HamiltonianSystem& system, const InvariantPlane& plane,
                                   const std::vector<symbol>& along) {
  std::vector<Levels> result;
  for (const bool of_scene : {false, true}) {
    Levels levels;
    bool differs = !of_scene, known = true;
    for (const auto& [name, function] : system.casimirs) {
      const ex own = plane.on(function).normal();
      ex value = own;
      if (uses_any(own, along)) {
        const auto is_it = [f = function](const ex& constraint) {
          return (f - constraint).expand().is_zero();
        };
        const bool vanishes =
            std::any_of(system.constraints.begin(), system.constraints.end(), is_it);
        value = vanishes ? 0 : 1;
        if (of_scene && !vanishes) {
          const ex start = function.subs(system.start).normal();
          known = known && GiNaC::is_a<GiNaC::numeric>(start);
          differs = differs || !start.is_equal(1);
          value = start;
        }
        levels.relations.push_back({name, own, value});
      }
      levels.text += fmt::format(", {} = {}", name, expression_text(value));
    }
    if (differs && known) result.push_back(std::move(levels));
  }
  return result;
}

/// Square roots of even powers of a variable, as sqrt(y^2), are powers of it: the branch that the
/// field of the curve takes too.
struct RootsOfPowers : public GiNaC::map_function {
  ex operator()(const ex& e) override {
    const ex own = e.map(*this);
    if (!GiNaC::is_a<GiNaC::power>(own) || own.op(1).info(GiNaC::info_flags::integer)) return own;
    const ex &base = own.op(0), exponent = own.op(1);
    if (!GiNaC::is_a<GiNaC::power>(base) || !GiNaC::is_a<symbol>(base.op(0)) ||
        !base.op(1).info(GiNaC::info_flags::even) ||
        !(2 * exponent).info(GiNaC::info_flags::integer))
      return own;
    return GiNaC::pow(base.op(0), base.op(1) * exponent);
  }
};

/// The relations of a level solved for all variables but one, for each of these; and energies to
/// try.
struct Solutions {
  std::vector<std::pair<symbol, std::vector<Step>>> of;
  std::vector<ex> energies;
};

Solutions solutions_on(const HamiltonianSystem& system, const InvariantPlane& plane,
                       const std::vector<symbol>& along, const Levels& levels,
                       const symbol& energy) {
  RootsOfPowers without_roots;
  const ex hamiltonian = without_roots(plane.on(system.hamiltonian));
  std::vector<ex> relations{(hamiltonian - energy).normal().numer().expand()};
  for (const Relation& r : levels.relations)
    relations.push_back((r.function - r.value).normal().numer().expand());
  Solutions result;
  std::vector<ex> candidates;
  for (const symbol& z : along) {
    std::vector<symbol> unknown;
    for (const symbol& x : along)
      if (!x.is_equal(z)) unknown.push_back(x);
    const auto steps = solve(relations, unknown);
    if (!steps) continue;
    add_special_energies(system, *steps, z, energy, candidates);
    result.of.emplace_back(z, *steps);
  }
  if (system.free)
    std::sort(candidates.begin(), candidates.end(), [&](const ex& a, const ex& b) {
      return energy_text(system, a) < energy_text(system, b);
    });
  for (const ex& further : {ex(0), ex(1), system.hamiltonian.subs(system.start).normal()})
    candidates.push_back(further);
  for (const ex& e : candidates) {
    const bool known = std::any_of(result.energies.begin(), result.energies.end(),
                                   [&](const ex& other) { return other.is_equal(e); });
    const bool number = GiNaC::is_a<GiNaC::numeric>(e) || has_parameter(system, e);
    if (!known && number && result.energies.size() < kMostEnergies) result.energies.push_back(e);
  }
  return result;
}

/// The curves of an energy, one for each variable that may be z, the simplest first.
template <class F>
std::vector<ParticularCurve<F>> curves_at(const HamiltonianSystem& system,
                                          const InvariantPlane& plane, const Solutions& solutions,
                                          const ex& is_energy, std::string& reason) {
  std::vector<ParticularCurve<F>> result;
  for (const auto& [z, steps] : solutions.of) {
    try {
      result.push_back(make_curve<F>(system, plane, steps, z, is_energy));
    } catch (const NotDecided& problem) {
      reason = problem.what();
    } catch (const std::domain_error&) {
      reason = "the equations have no value on the level";
    }
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const auto& a, const auto& b) { return a.complexity < b.complexity; });
  return result;
}

}  // namespace

template <class F>
std::string for_each_curve(const HamiltonianSystem& system, const InvariantPlane& plane,
                           const std::function<bool(const ParticularCurve<F>&)>& visit) {
  std::vector<symbol> along;
  for (const std::size_t i : plane.along) along.push_back(system.variables[i]);
  const symbol energy("E");
  std::string reason = "the motion on the surface is not solved for one variable";
  bool visited = false;
  for (const Levels& levels : casimir_levels(system, plane, along)) {
    if (levels.relations.size() + 2 != along.size()) {
      reason = "the motion on the surface has not one degree of freedom";
      continue;
    }
    const Solutions solutions = solutions_on(system, plane, along, levels, energy);
    for (const ex& e : solutions.energies) {
      for (ParticularCurve<F>& curve :
           curves_at<F>(system, plane, solutions, energy == e, reason)) {
        curve.level = fmt::format("H = {}{}", energy_text(system, e), levels.text);
        visited = true;
        if (!visit(curve)) return {};
      }
    }
  }
  return visited ? std::string() : reason;
}

template std::string for_each_curve(
    const HamiltonianSystem&, const InvariantPlane&,
    const std::function<bool(const ParticularCurve<RationalFunction>&)>&);
template std::string for_each_curve(
    const HamiltonianSystem&, const InvariantPlane&,
    const std::function<bool(const ParticularCurve<ParametricFunction>&)>&);

}  // namespace casimir::obstruction
