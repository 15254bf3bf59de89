#include "symbolic/obstruction/family/free_parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "symbolic/error.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"
#include "symbolic/obstruction/examine.hpp"
#include "symbolic/obstruction/family/lines_in_space.hpp"
#include "symbolic/obstruction/family/straight_lines.hpp"
#include "symbolic/obstruction/family/survivors.hpp"
#include "symbolic/obstruction/normal_variation.hpp"
#include "symbolic/obstruction/particular_curve.hpp"

namespace casimir::obstruction {
namespace {

using F = ParametricFunction;

/// Collects the equations along one surface after the other.
class FamilySearch {
 public:
  FamilySearch(const HamiltonianSystem& system, const search::Watch& watch,
               std::vector<std::string>& left_out)
      : system_(system), watch_(watch), left_out_(left_out) {}

  void along(const InvariantPlane& plane) {
    watch_.begin("along " + plane.text(system_));
    try {
      const std::string reason =
          for_each_curve<F>(system_, plane, [&](const ParticularCurve<F>& curve) {
            watch_.tick(0);
            along(plane, curve);
            return true;
          });
      if (!reason.empty()) leave_out(plane, reason);
    } catch (const NotDecided& problem) {
      leave_out(plane, problem.what());
    } catch (const TooLarge& problem) {
      leave_out(plane, problem.what());
    } catch (const std::invalid_argument&) {
      // GiNaC's, of a greatest common divisor.
      leave_out(plane, "the equations are no rational functions");
    }
  }

  std::vector<GeneralEquation> found;

 private:
  void leave_out(const InvariantPlane& plane, const std::string& reason) {
    const std::string line = plane.text(system_) + ": " + reason;
    if (said_.insert(line).second) left_out_.push_back(line);
  }

  void along(const InvariantPlane& plane, const ParticularCurve<F>& curve) {
    try {
      const NormalVariation<F> variation = normal_variation(system_, plane, curve);
      freedom = variation.freedom;
      for (const std::string& part : variation.left_out) leave_out(plane, part);
      for (const NormalEquation<F>& equation : variation.equations) add(plane, curve, equation);
    } catch (const NotDecided& problem) {
      leave_out(plane, problem.what());
    }
  }

  void add(const InvariantPlane& plane, const ParticularCurve<F>& curve,
           const NormalEquation<F>& equation) {
    const auto text = [&](const F& f) { return written(f, curve.names); };
    if (!seen_.insert(text(equation.reduced)).second) return;
    auto family = riemann_family(equation.reduced, curve.names);
    if (!family) family = lame_family(equation.p, equation.q, equation.reduced, curve.names);
    if (!family) {
      leave_out(plane, fmt::format("at {} the equation is neither Riemann's with three singular "
                                   "points nor Lame's",
                                   curve.level));
      return;
    }
    family->conditions.add(curve.field.conditions());
    for (const F* f : {&equation.p, &equation.q}) family->conditions.defined(*f);
    Examined shown;
    shown.along = plane.text(system_);
    shown.level = curve.level;
    shown.curve = curve.equations;
    const std::string unknown = unknown_beside(curve.names.z);
    shown.nve = fmt::format("{0}'' + ({1})*{0}' + ({2})*{0} = 0", unknown, text(equation.p),
                            text(equation.q));
    shown.reduced = fmt::format("{0}'' = ({1})*{0}", unknown, text(equation.reduced));
    found.push_back({std::move(shown), std::move(*family)});
  }

  const HamiltonianSystem& system_;
  const search::Watch& watch_;
  std::vector<std::string>& left_out_;
  std::set<std::string> seen_, said_;

 public:
  std::size_t freedom = 0;
};

std::string alone_text(const Examined& decisive) {
  return fmt::format("excluded along {}, {}{}", decisive.along, decisive.level,
                     decisive.order == 1
                         ? ""
                         : fmt::format(", by the variational equations of order {} (Morales-Ruiz, "
                                       "Ramis and Simo 2007)",
                                       decisive.order));
}

/// Prints the exponents, and keeps the equations that exclude something.
std::vector<RiemannFamily> shown_in(std::vector<FamilyEquation> equations, const std::string& name,
                                    Obstruction& result) {
  std::vector<RiemannFamily> families;
  for (FamilyEquation& equation : equations) {
    const bool nothing = says_nothing(equation.family);
    Examined& shown = equation.shown;
    for (std::size_t i = equation.family.lame ? 1 : 0; i < 3; ++i)
      shown.exponents.push_back(fmt::format("{}: difference of exponents sqrt({})",
                                            equation.family.points[i],
                                            equation.family.squares[i].text(name)));
    std::string conditions;
    for (const Univariate& condition : equation.family.conditions.polynomials())
      conditions += (conditions.empty() ? "" : ", ") + condition.text(name) + " != 0";
    shown.where = conditions;
    shown.outcome = nothing ? "the identity component is solvable wherever it was tried"
                            : "SL(2, C) or of another kind without a solvable identity component, "
                              "but where " +
                                  condition_text(equation.family, name);
    shown.decisive = !nothing;
    result.examined.push_back(shown);
    if (!nothing) families.push_back(std::move(equation.family));
  }
  return families;
}

/// Whether the case assumes that the free parameter does not have this value.
bool is_ruled_out(const HamiltonianSystem& system, const cln::cl_RA& value) {
  const GiNaC::exmap at{{*system.free, GiNaC::numeric(value)}};
  return std::ranges::any_of(system.of_free, [&](const Assumption& assumption) {
    try {
      return GiNaC::is_a<GiNaC::numeric>(assumption.difference.subs(at)) &&
             !assumption.holds_at(at, system.limits);
    } catch (const GiNaC::pole_error&) {
      return false;
    }
  });
}

}  // namespace

std::vector<FamilyEquation> family_equations(const HamiltonianSystem& system,
                                             const std::vector<InvariantPlane>& planes,
                                             const search::Watch& watch,
                                             std::vector<std::string>& left_out) {
  FamilySearch search(system, watch, left_out);
  std::vector<FamilyEquation> result;
  try {
    result = straight_line_families(system);
    for (FamilyEquation& own : families_of_lines_in_space(system)) result.push_back(std::move(own));
  } catch (const NotDecided& problem) {
    left_out.push_back(fmt::format("straight lines: {}", problem.what()));
  } catch (const TooLarge& problem) {
    left_out.push_back(fmt::format("straight lines: {}", problem.what()));
  }
  for (const InvariantPlane& plane : planes) search.along(plane);
  for (GeneralEquation& own : search.found)
    result.push_back({std::move(own.shown), of_one_parameter(own.family)});
  return result;
}

std::vector<GeneralEquation> general_equations(const HamiltonianSystem& system,
                                               const std::vector<InvariantPlane>& planes,
                                               const search::Watch& watch,
                                               std::vector<std::string>& left_out) {
  FamilySearch search(system, watch, left_out);
  for (const InvariantPlane& plane : planes) search.along(plane);
  return std::move(search.found);
}

void exclude_values(const HamiltonianSystem& system, std::vector<FamilyEquation> equations,
                    const std::function<Obstruction(const cln::cl_RA&)>& examine,
                    Obstruction& result) {
  const std::string name = system.free->get_name();
  const std::vector<RiemannFamily> families = shown_in(std::move(equations), name, result);
  const Survivors found = survivors(families, name);
  if (!found.informative)
    throw NotDecided(
        "no equation of Riemann with three singular points, and none of Lame, excludes a value "
        "of " +
        name);
  result.proved = true;
  for (const SurvivingValue& survivor : found.values) {
    FreeValue value;
    value.value = survivor.value.text(name);
    value.why = survivor.why;
    const auto number = survivor.value.rational();
    if (number && is_ruled_out(system, *number)) continue;
    if (number) {
      const Obstruction own = examine(*number);
      // For the other values it is of meromorphic integrals: of rational ones alone is less, since
      // px + (py^2 + x y^2)/2 has an integral with Airy's functions.
      value.excluded = own.proved;
      value.outcome = own.proved     ? alone_text(own.examined.back())
                      : own.rational ? "rational integrals alone are excluded, by an irregular "
                                       "point: " +
                                           alone_text(own.examined[*own.rational])
                                     : own.reason;
      value.only_rational = !own.proved && own.rational.has_value();
    } else {
      value.outcome = "not examined alone: no rational number";
    }
    result.values.push_back(std::move(value));
  }
  for (const SurvivingSequence& sequence : found.sequences)
    result.sequences.push_back({sequence.range, sequence.conditions});
}

}  // namespace casimir::obstruction
