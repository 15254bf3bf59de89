#include "tools/analysis/equilibria/equilibria.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "codegen/specialise.hpp"
#include "symbolic/model/given_functions.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/search.hpp"
#include "tools/analysis/equilibria/equilibrium_assessment.hpp"
#include "tools/analysis/equilibria/equilibrium_collection.hpp"
#include "tools/analysis/equilibria/newton_solution.hpp"
#include "tools/analysis/equilibria/relative_equations.hpp"
#include "tools/analysis/proof/proved_facts.hpp"

namespace casimir {
namespace {

constexpr std::size_t kNearStarts = 400, kMostStarts = 500;

using Functions = std::vector<NamedExpression>;

// What the level's functions are called among the invariants of the extended model.
std::string symmetry_name(std::size_t k) { return fmt::format("symmetry_{}", k + 1); }
std::string constraint_name(std::size_t k) { return fmt::format("constraint_{}", k + 1); }

/// The integrals of degree 1 that are no Casimirs.
std::vector<GiNaC::ex> linear_integrals(const Model& model, std::vector<std::string>& names) {
  std::vector<GiNaC::ex> result;
  if (!model.poisson || model.time) return result;
  search::Request request;
  request.degree = 1;
  for (const search::Found& found : search::find_integrals(model, request).found) {
    if (found.verdict != Verdict::proved) continue;
    result.push_back(found.value);
    names.push_back(found.text);
  }
  return result;
}

/// The constraints that say more than the Casimir functions: without a bracket all of them. Those
/// that are Casimir functions themselves, and not but for a number among those of the file, are
/// added to them.
Functions own_constraints(Model& model) {
  Functions result;
  for (const NamedExpression& c : model.constraints) {
    const auto is_known = [&](const NamedExpression& f) {
      return GiNaC::is_a<GiNaC::numeric>((f.value - c.value).expand());
    };
    if (std::ranges::any_of(model.casimirs, is_known)) continue;
    const bool casimir =
        model.poisson && prove_claim(model, ClaimKind::casimir, c).verdict == Verdict::proved;
    (casimir ? model.casimirs : result).push_back(c);
  }
  return result;
}

/// The model with H - sum v_k F_k in place of H; the velocities v_k are parameters, at the end. Of
/// its integrals these stay, and the constraints stand behind them.
Model with_velocities(Model model, Scene& scene, const std::vector<GiNaC::ex>& integrals,
                      const Functions& constraints, std::vector<std::string>& names) {
  for (std::size_t k = 0; k < integrals.size(); ++k) {
    const GiNaC::symbol velocity(fmt::format("velocity_{}", k + 1));
    model.hamiltonian = *model.hamiltonian - velocity * integrals[k];
    model.parameters.push_back(velocity);
    scene.parameters.push_back(0);
    names.push_back(velocity.get_name());
  }
  if (!integrals.empty()) model.field = model.poisson->flow(*model.hamiltonian);
  model.integrals.clear();
  for (std::size_t k = 0; k < integrals.size(); ++k)
    model.integrals.push_back({symmetry_name(k), integrals[k], {}});
  for (std::size_t k = 0; k < constraints.size(); ++k)
    model.integrals.push_back({constraint_name(k), constraints[k].value, {}});
  return model;
}

/// In units of the scene's state: the last starts lie farther out, in turn 4, 16 and 64 times as
/// far.
double size_of_start(std::size_t start) {
  constexpr std::size_t kSizes = 3;
  return start < kNearStarts ? 1 : std::pow(4., 1 + static_cast<double>(start % kSizes));
}

/// Whether the same equilibria may be found again and again farther out.
bool repeats_in_angles(const Program& rates) {
  return std::ranges::any_of(rates.code, [](const Instruction& one) {
    return one.op == Op::sin || one.op == Op::cos || one.op == Op::tan;
  });
}

/// Whether a state is certainly outside of the domain: beyond its edge by more than rounding.
bool is_outside(const Model& model, const Scene& scene, const Equilibrium& found, double size) {
  constexpr double kRounding = 1e-9;
  GiNaC::exmap values;
  for (std::size_t i = 0; i < model.variables.size(); ++i)
    // CLN has no numbers as small as the smallest doubles.
    values.emplace(model.variables[i], std::isnormal(found.state[i]) ? found.state[i] : 0.);
  for (std::size_t k = 0; k < model.parameters.size(); ++k)
    values.emplace(model.parameters[k], scene.parameters[k]);
  return std::ranges::any_of(model.assumptions, [&](const Assumption& a) {
    const int sign = a.comparison == Comparison::greater || a.comparison == Comparison::at_least ? 1
                     : a.comparison == Comparison::less || a.comparison == Comparison::at_most ? -1
                                                                                               : 0;
    if (sign == 0) return false;
    const GiNaC::ex value = a.difference.subs(values, GiNaC::subs_options::no_pattern).evalf();
    if (!GiNaC::is_a<GiNaC::numeric>(value)) return false;
    const auto& number = GiNaC::ex_to<GiNaC::numeric>(value);
    return number.is_real() && sign * number.to_double() < -kRounding * std::max(1., size);
  });
}

/// Functions that are proved to keep their values: of those that the model has, and these.
std::vector<GiNaC::ex> all_integrals(const Model& model, std::vector<GiNaC::ex> result) {
  if (model.hamiltonian) result.push_back(*model.hamiltonian);
  for (const NamedExpression& function : proved_invariants(model)) result.push_back(function.value);
  return result;
}

}  // namespace

double Equilibrium::growth() const {
  double real = 0;
  for (const auto& value : eigenvalues) real = std::max(real, value.real());
  return real;
}

EquilibriumReport find_equilibria(const Model& model, const Scene& scene,
                                  const std::function<void(double)>& tick) {
  if (has_arbitrary_functions(model)) {
    const auto [own, own_scene] = in_scene(model, scene);
    return find_equilibria(own, own_scene, tick);
  }
  EquilibriumReport report;
  report.symmetry_functions = linear_integrals(model, report.symmetries);
  const std::vector<GiNaC::ex>& integrals = report.symmetry_functions;
  Scene own = scene;
  SpecialiseOptions options;
  options.observe.emplace();
  options.gradients = true;
  Model with_casimirs = model;
  const Functions constraints = own_constraints(with_casimirs);
  const Model extended = with_velocities(std::move(with_casimirs), own, integrals, constraints,
                                         options.keep_parameters);
  const Specialisation spec = specialise(extended, own, options);
  if (spec.uses_time) throw ModelError("equations that depend on the time have no equilibria");
  std::map<std::string, std::string> shown;
  for (std::size_t k = 0; k < integrals.size(); ++k)
    shown.emplace(symmetry_name(k), report.symmetries[k]);
  for (std::size_t k = 0; k < constraints.size(); ++k)
    shown.emplace(constraint_name(k), constraints[k].name);
  std::size_t on_constraints = 0;
  for (const std::string& name : spec.invariant_names) {
    if (name == "H") continue;
    const auto known = shown.find(name);
    report.level.push_back(known == shown.end() ? name : known->second);
    for (std::size_t k = 0; k < constraints.size(); ++k)
      if (name == constraint_name(k)) ++on_constraints;
  }
  report.constrained = !constraints.empty();
  const equilibria::Equations equations(spec, integrals.size(), on_constraints);
  std::mt19937_64 random(1);
  const equilibria::ScaledEquations scaled(equations, integrals.size(), random);
  equilibria::Collection collection(equations, scaled, random);
  const std::size_t starts = repeats_in_angles(spec.rhs) ? kNearStarts : kMostStarts;
  for (; report.starts < starts; ++report.starts) {
    tick(static_cast<double>(report.starts) / static_cast<double>(starts));
    equilibria::Place place = scaled.random_place(random, size_of_start(report.starts));
    if (report.starts == 0) place.x = equations.start();
    if (equilibria::solve(scaled, place)) collection.add(place, report.starts < kNearStarts);
  }
  report.equilibria = collection.equilibria(equilibria::Assessment(
      extended, own, spec, all_integrals(model, integrals), equations, scaled, random));
  report.size = scaled.length();
  const std::size_t all = report.equilibria.size();
  std::erase_if(report.equilibria, [&](const Equilibrium& found) {
    return is_outside(model, scene, found, report.size);
  });
  report.outside = all - report.equilibria.size();
  std::stable_sort(report.equilibria.begin(), report.equilibria.end(),
                   [](const auto& a, const auto& b) { return a.family < b.family; });
  return report;
}

}  // namespace casimir