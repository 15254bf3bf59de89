#include "symbolic/obstruction/obstruct.hpp"

#include <fmt/format.h>

#include <functional>
#include <set>
#include <sstream>
#include <stdexcept>

#include "symbolic/obstruction/equation/kovacic.hpp"
#include "symbolic/obstruction/examine.hpp"
#include "symbolic/obstruction/hamiltonian_system.hpp"
#include "symbolic/obstruction/invariant_plane.hpp"
#include "symbolic/obstruction/normal_variation.hpp"
#include "symbolic/obstruction/particular_curve.hpp"

namespace casimir::obstruction {
namespace {

constexpr const char* kTheorem =
    "Morales-Ruiz and Ramis (2001): where a Hamiltonian system with n degrees of freedom has n "
    "independent meromorphic integrals in involution near a curve of motion, the Galois group of "
    "the variational equations along it has an abelian identity component";

/// The integrals that an examined equation excludes.
std::string excluded_by(const Examined& examined, std::size_t freedom, bool casimirs) {
  const std::string kind = examined.regular ? "meromorphic in a neighbourhood of the curve"
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

/// The search along surfaces.
class SurfaceSearch {
 public:
  SurfaceSearch(const HamiltonianSystem& system, const search::Watch& watch, Obstruction& result)
      : system_(system), watch_(watch), result_(result) {}

  void examine(const InvariantPlane& plane) {
    if (result_.proved) return;
    watch_.begin("along " + plane.text(system_));
    try {
      const std::string reason = for_each_curve(system_, plane, [&](const ParticularCurve& curve) {
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
    }
  }

 private:
  void leave_out(const InvariantPlane& plane, const std::string& reason) {
    const std::string line = plane.text(system_) + ": " + reason;
    if (said_.insert(line).second) result_.left_out.push_back(line);
  }

  void along_curve(const InvariantPlane& plane, const ParticularCurve& curve) {
    NormalVariation variation;
    try {
      variation = normal_variation(system_, plane, curve);
    } catch (const NotDecided& problem) {
      leave_out(plane, problem.what());
      return;
    }
    for (const std::string& part : variation.left_out) leave_out(plane, part);
    if (variation.equations.empty() && variation.left_out.empty())
      leave_out(plane, "the variational equations are solved by quadratures");
    for (const NormalEquation& equation : variation.equations) {
      if (!seen_.insert(equation.reduced.text("z")).second) continue;
      Examined examined = examine_equation(equation, curve.z, [&] { watch_.tick(0); });
      examined.along = plane.text(system_);
      examined.level = curve.level;
      examined.curve = curve.equations;
      result_.examined.push_back(examined);
      if (!examined.decisive) continue;
      result_.proved = true;
      result_.theorem = kTheorem;
      result_.excluded = excluded_by(examined, variation.freedom, !system_.casimirs.empty());
      return;
    }
  }

  const HamiltonianSystem& system_;
  const search::Watch& watch_;
  Obstruction& result_;
  std::set<std::string> seen_, said_;
};

std::vector<InvariantPlane> planes_of(const Model& model, const HamiltonianSystem& system,
                                      const ObstructionRequest& request) {
  if (request.along.empty()) return invariant_planes(system);
  std::vector<GiNaC::ex> functions;
  GiNaC::exmap values;
  const Scene* scene = model.parameters.empty() ? nullptr : &model.scene(request.scene);
  for (const Text& text : request.along) {
    GiNaC::ex f;
    if (text.value.find('=') != std::string::npos) {
      const Identity equation = model.parse_identity(text);
      f = equation.left - equation.right;
    } else {
      f = model.parse(text);
    }
    functions.push_back(scene ? model.at_parameters(f, *scene) : f);
  }
  return {invariant_plane(system, functions)};
}

void decide(const Model& model, const ObstructionRequest& request, const search::Watch& watch,
            Obstruction& result) {
  const HamiltonianSystem system = hamiltonian_system(model, request.scene);
  result.parameters = system.parameters;
  if (system.variables.size() <= system.casimirs.size() + 2)
    throw NotDecided("a system with one degree of freedom has H, and needs no further integral");
  if (request.along.empty()) {
    watch.begin("straight lines of a homogeneous potential");
    examine_straight_lines(system, result);
    if (result.proved) {
      result.theorem = kTheorem;
      result.excluded = excluded_by(result.examined.back(), 2, false);
      return;
    }
  }
  watch.begin("invariant surfaces");
  const std::vector<InvariantPlane> planes = planes_of(model, system, request);
  SurfaceSearch search(system, watch, result);
  for (const InvariantPlane& plane : planes) search.examine(plane);
  if (result.proved) return;
  if (planes.empty() && result.examined.empty()) throw NotDecided("no invariant surface was found");
  if (result.examined.empty())
    throw NotDecided("no curve gave a variational equation that could be examined");
  throw NotDecided(
      "every equation that was examined has a solvable identity component, or was not decided");
}

}  // namespace

Obstruction find_obstruction(const Model& model, const ObstructionRequest& request,
                             const search::Watch& watch) {
  Obstruction result;
  try {
    decide(model, request, watch, result);
  } catch (const NotDecided& problem) {
    result.reason = problem.what();
  } catch (const std::invalid_argument&) {
    result.reason = "the equations are no rational functions";
  }
  return result;
}

}  // namespace casimir::obstruction
