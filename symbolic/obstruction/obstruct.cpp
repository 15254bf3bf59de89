#include "symbolic/obstruction/obstruct.hpp"

#include <fmt/format.h>

#include <functional>
#include <set>
#include <sstream>
#include <stdexcept>

#include "symbolic/obstruction/equation/kovacic.hpp"
#include "symbolic/obstruction/examine.hpp"
#include "symbolic/obstruction/family/free_parameter.hpp"
#include "symbolic/obstruction/family/several_parameters.hpp"
#include "symbolic/obstruction/hamiltonian_system.hpp"
#include "symbolic/obstruction/higher/higher_variation.hpp"
#include "symbolic/obstruction/invariant_plane.hpp"
#include "symbolic/obstruction/normal_variation.hpp"
#include "symbolic/obstruction/particular_curve.hpp"
#include "symbolic/obstruction/points/straight_lines_in_space.hpp"
#include "symbolic/obstruction/real_domain.hpp"

namespace casimir::obstruction {
namespace {

constexpr const char* kTheorem =
    "Morales-Ruiz and Ramis (2001): where a Hamiltonian system with n degrees of freedom has n "
    "independent meromorphic integrals in involution near a complex curve of motion, the Galois "
    "group of the variational equations along it has an abelian identity component";

constexpr const char* kHigherTheorem =
    "Morales-Ruiz, Ramis and Simo (2007): where a Hamiltonian system with n degrees of freedom has "
    "n independent meromorphic integrals in involution near a complex curve of motion, the Galois "
    "group of the variational equations of each order along it has an abelian identity component";

/// Curves along which the equations of higher order are examined.
constexpr std::size_t kMostCurvesOfHigherOrder = 12;

/// The integrals that an examined equation excludes.
std::string excluded_by(const Examined& examined, std::size_t freedom, bool casimirs) {
  const std::string kind = examined.regular ? "meromorphic in a neighbourhood of the complex curve"
                                            : "rational in the variables";
  const std::string where = casimirs ? " on that level of the Casimir functions" : "";
  if (freedom == 2)
    return fmt::format("every integral{} that is {} and functionally independent of H", where,
                       kind);
  return fmt::format(
      "every set of {} functionally independent integrals in involution, H among them,{} that are "
      "{}",
      freedom, where, kind);
}

GiNaC::ex expression_of(const RationalFunction& f, const GiNaC::symbol& z) {
  const auto polynomial = [&](const Univariate& p) {
    GiNaC::ex result = 0;
    for (long i = 0; i <= p.degree(); ++i)
      result += GiNaC::numeric(cln::cl_N(p.coefficient(i))) * GiNaC::pow(z, static_cast<int>(i));
    return result;
  };
  GiNaC::ex below = 1;
  for (const auto& [factor, exponent] : f.denominator().factors())
    below *= GiNaC::pow(polynomial(factor), static_cast<int>(exponent));
  return polynomial(f.numerator()) / below;
}

/// The search along surfaces.
class SurfaceSearch {
 public:
  SurfaceSearch(const HamiltonianSystem& system, const search::Watch& watch, Obstruction& result)
      : system_(system), watch_(watch), result_(result) {}

  void examine(const InvariantPlane& plane) {
    if (result_.proved) return;
    watch_.begin("along " + plane.text(system_));
    try {
      const std::string reason = for_each_curve<RationalFunction>(
          system_, plane, [&](const ParticularCurve<RationalFunction>& curve) {
            watch_.tick(0);
            along_curve(plane, curve);
            return !result_.proved;
          });
      if (!reason.empty()) leave_out(plane, reason);
    } catch (const NotDecided& problem) {
      leave_out(plane, problem.what());
    } catch (const std::invalid_argument&) {
      // GiNaC's, of a greatest common divisor.
      leave_out(plane, "the equations are no rational functions");
    } catch (const std::overflow_error&) {
      // GiNaC's, of a denominator that is zero when it is multiplied out.
      leave_out(plane, "the equations have no value on it");
    }
  }

  /// The variational equations of order 2 and more, where those of order 1 show nothing.
  void examine_orders(unsigned highest) {
    for (const Later& later : later_) {
      if (result_.proved || highest < 2) return;
      watch_.begin("higher orders along " + later.plane.text(system_));
      try {
        examine_orders_along(later, highest);
      } catch (const NotDecided& problem) {
        result_.examined[later.place].cases.emplace_back("variational equations of higher order",
                                                         problem.what());
      }
    }
  }

 private:
  /// The curve and its equation in the symbols of the system.
  CurveExpressions expressions_of(const ParticularCurve<RationalFunction>& curve,
                                  const NormalEquation<RationalFunction>& equation) const {
    GiNaC::symbol z;
    for (const GiNaC::symbol& x : system_.variables)
      if (x.get_name() == curve.names.z) z = x;
    CurveExpressions result;
    for (const auto& [i, square] : curve.roots)
      result.curve.emplace_back(GiNaC::pow(system_.variables[i], 2), expression_of(square, z));
    result.unknown = unknown_beside(curve.names.z);
    result.p = expression_of(equation.p, z);
    result.q = expression_of(equation.q, z);
    result.reduced = expression_of(equation.reduced, z);
    return result;
  }

  void leave_out(const InvariantPlane& plane, const std::string& reason) {
    const std::string line = plane.text(system_) + ": " + reason;
    if (said_.insert(line).second) result_.left_out.push_back(line);
  }

  void along_curve(const InvariantPlane& plane, const ParticularCurve<RationalFunction>& curve) {
    NormalVariation<RationalFunction> variation;
    try {
      variation = normal_variation(system_, plane, curve);
    } catch (const NotDecided& problem) {
      leave_out(plane, problem.what());
      return;
    }
    for (const std::string& part : variation.left_out) leave_out(plane, part);
    if (variation.equations.empty() && variation.left_out.empty())
      leave_out(plane, "the variational equations are solved by quadratures");
    for (const NormalEquation<RationalFunction>& equation : variation.equations) {
      if (!seen_.insert(equation.reduced.text("z")).second) continue;
      Examined examined = examine_equation(equation, curve.names.z, [&] { watch_.tick(0); });
      examined.along = plane.text(system_);
      examined.level = curve.level;
      examined.curve = curve.equations;
      examined.expressions = expressions_of(curve, equation);
      result_.examined.push_back(examined);
      if (!examined.decisive && !examined.solution.empty() &&
          later_.size() < kMostCurvesOfHigherOrder)
        later_.push_back({plane, curve, equation, result_.examined.size() - 1});
      if (!examined.decisive || (!examined.regular && result_.rational)) continue;
      result_.theorem = kTheorem;
      result_.excluded = excluded_by(examined, variation.freedom, !system_.casimirs.empty());
      if (!examined.regular) {
        result_.rational = result_.examined.size() - 1;
        continue;
      }
      result_.proved = true;
      result_.rational.reset();
      return;
    }
  }

  /// A curve along which the equation of first order has a solvable identity component.
  struct Later {
    InvariantPlane plane;
    ParticularCurve<RationalFunction> curve;
    NormalEquation<RationalFunction> equation;
    std::size_t place;  ///< among what was examined
  };

  void examine_orders_along(const Later& later, unsigned highest) {
    const HigherVariation found = examine_higher(system_, later.plane, later.curve, later.equation,
                                                 highest, [&] { watch_.tick(0); });
    const std::string what =
        found.order == 2 ? "variational equations of order 2"
                         : fmt::format("variational equations of order 2 to {}", found.order);
    result_.examined[later.place].cases.emplace_back(what, found.outcome);
    if (!found.decisive) return;
    Examined decisive = result_.examined[later.place];
    decisive.cases.emplace_back(
        "coefficient of the logarithm, by constants of the solutions of order 1", found.residue);
    decisive.order = found.order;
    decisive.outcome =
        fmt::format("of order {}: the identity component is not abelian", found.order);
    decisive.decisive = true;
    result_.examined.push_back(std::move(decisive));
    result_.proved = true;
    result_.theorem = kHigherTheorem;
    result_.excluded = excluded_by(result_.examined.back(), 2, false);
  }

  const HamiltonianSystem& system_;
  const search::Watch& watch_;
  Obstruction& result_;
  std::vector<Later> later_;
  std::set<std::string> seen_, said_;
};

/// Where a curve is looked for, with the symbols of the parameters.
struct Surfaces {
  std::vector<GiNaC::ex> asked;                   ///< functions that vanish; empty: it is sought
  std::vector<std::vector<GiNaC::ex>> relations;  ///< of the case's invariant relations
};

Surfaces surfaces_of(const Model& model, const ObstructionRequest& request) {
  Surfaces result;
  for (const Text& text : request.along) {
    if (text.value.find('=') != std::string::npos) {
      const Identity equation = model.parse_identity(text);
      result.asked.push_back(equation.left - equation.right);
    } else {
      result.asked.push_back(model.parse(text));
    }
  }
  for (const LevelClaim& claim : model.invariant_relations) {
    result.relations.push_back({claim.expression.value});
    for (const NamedExpression& other : claim.on) result.relations.back().push_back(other.value);
  }
  return result;
}

std::vector<InvariantPlane> planes_of(const HamiltonianSystem& system, const Surfaces& surfaces) {
  const auto numbered = [&](std::vector<GiNaC::ex> functions) {
    for (GiNaC::ex& f : functions) f = f.subs(system.numbers);
    return functions;
  };
  if (!surfaces.asked.empty()) return {invariant_plane(system, numbered(surfaces.asked))};
  std::vector<std::vector<GiNaC::ex>> relations;
  for (const auto& functions : surfaces.relations) relations.push_back(numbered(functions));
  return invariant_planes(system, relations);
}

/// Where the case names too few Casimir functions, no level of those is a leaf: that is said, by
/// the rank of the bracket at one point, as what may be missing.
std::string missing_casimirs(const HamiltonianSystem& system) {
  const unsigned n = static_cast<unsigned>(system.variables.size());
  GiNaC::exmap point;
  for (unsigned i = 0; i < n; ++i)
    point[system.variables[i]] = GiNaC::numeric(2 * long{i} * i + 3 * long{i} + 7, 5 + long{i});
  GiNaC::matrix bracket(n, n);
  try {
    for (unsigned i = 0; i < n; ++i)
      for (unsigned j = 0; j < n; ++j) bracket(i, j) = system.poisson[i][j].subs(point).normal();
  } catch (const GiNaC::pole_error&) {
    return "";
  }
  for (std::size_t k = 0; k < bracket.nops(); ++k)
    if (!GiNaC::is_a<GiNaC::numeric>(bracket.op(k))) return "";  // a free parameter
  const unsigned rank = bracket.rank();
  if (rank + system.casimirs.size() >= n) return "";
  return fmt::format(
      "; the bracket has rank {} in dimension {}, and of its {} Casimir functions the case names "
      "{}: levels of all of them are needed",
      rank, n, n - rank, system.casimirs.size());
}

void decide(const HamiltonianSystem& system, const Surfaces& along, unsigned order,
            const search::Watch& watch, Obstruction& result) {
  result.parameters = system.parameters;
  if (along.asked.empty()) {
    watch.begin("straight lines of a homogeneous potential");
    examine_straight_lines(system, result);
    examine_lines_in_space(
        system, [&] { watch.tick(0); }, result);
    if (result.proved) {
      result.theorem = kTheorem;
      result.excluded = excluded_by(result.examined.back(), system.variables.size() / 2, false);
      return;
    }
  }
  watch.begin("invariant surfaces");
  const std::vector<InvariantPlane> planes = planes_of(system, along);
  SurfaceSearch search(system, watch, result);
  for (const InvariantPlane& plane : planes) search.examine(plane);
  search.examine_orders(order);
  if (result.proved) return;
  if (result.rational)
    throw NotDecided(
        "no further rational integral: proved; meromorphic ones are not excluded, since the "
        "equation "
        "has an irregular singular point");
  if (result.examined.empty())
    throw NotDecided((planes.empty()
                          ? "no invariant surface was found"
                          : "no curve gave a variational equation that could be examined") +
                     missing_casimirs(system));
  throw NotDecided(
      "every equation that was examined has a solvable identity component, or was not decided");
}

/// Runs a decision, and keeps why there is none.
template <class Decision>
void with_reason(Obstruction& result, const Decision& decision) {
  try {
    decision();
  } catch (const NotDecided& problem) {
    result.reason = problem.what();
  } catch (const std::invalid_argument&) {
    result.reason = "the equations are no rational functions";
  } catch (const std::overflow_error&) {
    result.reason = "the equations have no value there";
  }
}

/// What is excluded for every value of the free parameters that does not survive.
void say_excluded(const HamiltonianSystem& system, Obstruction& result);

/// Which values of the free parameters survive.
void decide_family(const HamiltonianSystem& system, const Surfaces& along, unsigned order,
                   const search::Watch& watch, Obstruction& result) {
  result.parameters = system.parameters;
  result.free = system.free->get_name();
  watch.begin("invariant surfaces");
  for (const GiNaC::symbol& other : system.further) result.free += "," + other.get_name();
  for (const Assumption& assumption : system.of_free) result.assumed.push_back(assumption.text);
  if (!system.further.empty()) {
    exclude_regions(system,
                    general_equations(system, planes_of(system, along), watch, result.left_out),
                    result);
    say_excluded(system, result);
    return;
  }
  std::vector<FamilyEquation> equations =
      family_equations(system, planes_of(system, along), watch, result.left_out);
  const auto examine = [&](const cln::cl_RA& value) {
    Obstruction own;
    with_reason(own, [&] { decide(with_value(system, value), along, order, watch, own); });
    return own;
  };
  exclude_values(system, std::move(equations), examine, result);
  say_excluded(system, result);
}

void say_excluded(const HamiltonianSystem& system, Obstruction& result) {
  result.theorem = kTheorem;
  const bool planar = system.variables.size() == system.casimirs.size() + 4;
  const std::string where =
      system.casimirs.empty() ? "" : " on the level of the Casimir functions of one of the curves";
  result.excluded =
      planar ? fmt::format(
                   "for every other real {}: every integral{} that is meromorphic in a "
                   "neighbourhood of the complex curves and functionally independent of H",
                   result.free, where)
             : fmt::format(
                   "for every other real {}: every set of {} functionally independent "
                   "integrals in involution, H among them,{} that are meromorphic in a "
                   "neighbourhood of the complex curves",
                   result.free, (system.variables.size() - system.casimirs.size()) / 2, where);
}

}  // namespace

Obstruction find_obstruction(const Model& model, const ObstructionRequest& request,
                             const search::Watch& watch) {
  Obstruction result;
  const Surfaces along = surfaces_of(model, request);
  with_reason(result, [&] {
    const HamiltonianSystem system = hamiltonian_system(model, request.scene, request.free);
    if (system.variables.size() <= system.casimirs.size() + 2)
      throw NotDecided("a system with one degree of freedom has H, and needs no further integral");
    if (!has_inner_points(system))
      throw NotDecided(
          "no real point was found around which the Hamiltonian and all that it is written with "
          "have values inside the assumptions");
    if (system.free)
      decide_family(system, along, request.order, watch, result);
    else
      decide(system, along, request.order, watch, result);
  });
  return result;
}

}  // namespace casimir::obstruction
