#include "tools/analysis/run/validated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "codegen/optimise/differentiate.hpp"
#include "codegen/optimise/lower.hpp"
#include "symbolic/algebra/number_text.hpp"
#include "symbolic/model/given_functions.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/run/drift_check.hpp"
#include "tools/analysis/run/elliptic_lift.hpp"
#include "tools/analysis/run/exact_values.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {
namespace {

/// No further invariant is proved after so many seconds.
constexpr double kSecondsOfProof = 20;

/// The rates, and zero for each parameter that takes part as a state.
Program with_resting(Program rates, const std::vector<std::string>& resting) {
  for (const std::string& name : resting) {
    const auto zero = static_cast<int>(rates.constants.size());
    rates.constants.push_back(0);
    rates.code.push_back({Op::constant, zero});
    rates.outputs.push_back(static_cast<int>(rates.code.size()) - 1);
    rates.output_names.push_back("d" + name);
  }
  return rates;
}

/// The integrals that are proved without further conditions. That of an invariant is the identity
/// dI/dt = 0 of functions, on the assumptions of the case that are about parameters alone, which
/// every scene obeys.
std::vector<KnownIntegral> known_integrals(const Model& model, const Scene& scene,
                                           const Specialisation& s, std::size_t dimension,
                                           std::vector<std::string>& doubts) {
  std::vector<KnownIntegral> result;
  const auto late = time_limit(kSecondsOfProof);
  for (std::size_t k = 0; k < s.invariant_names.size(); ++k) {
    const std::string& name = s.invariant_names[k];
    if (late()) {
      doubts.push_back(
          fmt::format("{} does not make the box smaller: no time was left to prove it", name));
      continue;
    }
    const KnownInvariant known_of = known_invariant(model, scene, name);
    if (known_of.proof.verdict != Verdict::proved || !known_of.proof.where.empty()) {
      doubts.push_back(
          fmt::format("{} does not make the box smaller: it is {}", name, words_of(known_of)));
      continue;
    }
    KnownIntegral known{.name = name,
                        .value = codegen::single_output(s.invariants, k),
                        .gradient = {},
                        .states = {}};
    const SparseProgram gradient = codegen::gradients(known.value, dimension);
    known.gradient = gradient.program;
    for (const auto& [state, output] : gradient.entries) known.states.push_back(state);
    result.push_back(std::move(known));
  }
  return result;
}

/// By how much the parameter of that name may be off.
cln::cl_RA radius_of(const ParameterRanges& ranges, const std::string& name) {
  const auto range =
      std::ranges::find_if(ranges, [&](const auto& one) { return one.first == name; });
  return range == ranges.end() ? cln::cl_RA(0) : range->second;
}

/// \param claims  the case whose invariants are proved
ValidatedProblem problem_of(const Model& claims, const Scene& scene,
                            const ValidatedOptions& options, PreparedEnclosure& motion) {
  const Specialisation& s = motion.specialisation;
  ValidatedProblem problem;
  problem.rates = with_resting(s.rhs, s.parameters);
  const SparseProgram jacobian = codegen::jacobian(problem.rates, motion.names.size());
  problem.jacobian = jacobian.program;
  problem.entries = jacobian.entries;
  problem.start = s.start;
  const bool wide = cln::plusp(options.initial_radius) || !options.ranges.empty();
  if (!options.radii.empty()) {
    problem.radii = options.radii;
  } else if (wide) {
    problem.radii.assign(s.states.size(), options.initial_radius);
    for (const std::string& name : s.parameters)
      problem.radii.push_back(radius_of(options.ranges, name));
  }
  if (options.contract)
    problem.integrals = known_integrals(claims, scene, s, motion.names.size(), motion.doubts);
  return problem;
}

}  // namespace

/// An equation between parameters holds nowhere else: what was proved with it says nothing of a
/// range. Inequalities are open, and an identity of analytic functions that holds in an open part
/// of a connected set holds in all of it.
void check_ranges(const Model& model, const ParameterRanges& ranges) {
  for (const auto& [name, radius] : ranges) {
    const auto symbol = std::ranges::find_if(
        model.parameters, [&name = name](const auto& p) { return p.get_name() == name; });
    if (symbol == model.parameters.end())
      throw RequestError(fmt::format("'{}' is not a parameter of this case", printable(name)));
    for (const Assumption& assumption : model.assumptions) {
      const bool open = assumption.comparison == Comparison::unequal ||
                        assumption.comparison == Comparison::greater ||
                        assumption.comparison == Comparison::less;
      if (!open && assumption.difference.has(*symbol))
        throw RequestError(fmt::format("a range of {} leaves the assumption '{}'", printable(name),
                                       printable(assumption.text)));
    }
  }
}

Scene scene_over(const Model& model, const Scene& scene, const ParameterRanges& ranges) {
  Scene open = scene;
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    for (const auto& [name, radius] : ranges)
      if (model.parameters[i].get_name() == name) open.parameters[i] = model.parameters[i];
  return open;
}

std::vector<std::pair<GiNaC::symbol, RationalInterval>> intervals_of(
    const Model& model, const Scene& scene, const ParameterRanges& ranges) {
  std::vector<std::pair<GiNaC::symbol, RationalInterval>> result;
  for (const auto& [name, radius] : ranges) {
    for (std::size_t i = 0; i < model.parameters.size(); ++i) {
      if (model.parameters[i].get_name() != name) continue;
      const GiNaC::ex value = scene.parameters[i];
      if (!GiNaC::is_a<GiNaC::numeric>(value) || !GiNaC::ex_to<GiNaC::numeric>(value).is_rational())
        throw RequestError(fmt::format("the range of {} has no rational middle", printable(name)));
      const cln::cl_RA middle = cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
      result.emplace_back(model.parameters[i], RationalInterval{middle - radius, middle + radius});
    }
  }
  return result;
}

namespace {

/// The equations of a scene as they are enclosed, but for the problem.
PreparedEnclosure specialised(const Model& model, const Scene& scene,
                              const ValidatedOptions& options) {
  check_ranges(model, options.ranges);
  Scene exact = scene;
  if (options.duration) exact.duration = options.duration;
  require_duration(exact);
  SpecialiseOptions what;
  what.observe = options.observe;
  what.jacobian = false;
  for (const auto& [name, radius] : options.ranges) what.keep_parameters.push_back(name);
  PreparedEnclosure prepared;
  prepared.specialisation = specialise(model, exact, what);
  prepared.names = prepared.specialisation.states;
  for (const std::string& name : prepared.specialisation.parameters) prepared.names.push_back(name);
  return prepared;
}

ValidatedMotion enclosed(PreparedEnclosure prepared, const ValidatedOptions& options) {
  ValidatedMotion motion;
  motion.specialisation = std::move(prepared.specialisation);
  motion.names = std::move(prepared.names);
  motion.doubts = std::move(prepared.doubts);
  try {
    motion.run = validated_run(prepared.problem, options.run);
  } catch (const std::domain_error& problem_of_data) {
    throw ModelError(fmt::format("scene \"{}\": its data have no certain value: {}",
                                 printable(motion.specialisation.scene), problem_of_data.what()));
  }
  return motion;
}

/// As the other one, over the ranges of parameters. \throws ModelError  for one that has no value in
/// the middle of these
std::vector<GiNaC::ex> cancelled_parts(const Model& model, const Scene& scene,
                                       const ValidatedOptions& options) {
  if (!options.ranges.empty()) casimir::cancelled_parts(model, scene);
  return casimir::cancelled_parts(model, scene_over(model, scene, options.ranges));
}

/// A name that no variable or parameter has.
std::string unused_name(const Model& model, std::size_t number) {
  std::string name = fmt::format("casimir_part_{}", number);
  const auto taken = [&](const GiNaC::symbol& x) { return x.get_name() == name; };
  while (std::ranges::any_of(model.variables, taken) ||
         std::ranges::any_of(model.parameters, taken))
    name += '_';
  return name;
}

/// The case with a further variable for each of these parts, whose rate it is. Where a box of the
/// solutions of all this exists, the parts had values all along the way: a step evaluates every
/// rate over all of it.
std::pair<Model, Scene> with_parts_as_rates(const Model& model, const Scene& scene,
                                            const std::vector<GiNaC::ex>& parts) {
  std::pair<Model, Scene> result{model, scene};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    result.first.variables.emplace_back(unused_name(result.first, k + 1));
    result.first.field.push_back(parts[k]);
    result.second.initial.emplace_back(0);
  }
  return result;
}

/// Without the states from `first` up to `last`.
void drop_states(ValidatedMotion& motion, std::size_t first, std::size_t last) {
  const auto drop = [first, last](auto& list) {
    using Distance = std::ptrdiff_t;
    list.erase(list.begin() + static_cast<Distance>(first),
               list.begin() + static_cast<Distance>(last));
  };
  drop(motion.names);
  drop(motion.specialisation.states);
  drop(motion.specialisation.state_indices);
  drop(motion.run.end.states);
  for (StateBox& box : motion.run.samples) drop(box.states);
}

/// The message names a part that is not watched where it is not.
[[noreturn]] void refuse_parts(const GiNaC::ex& part, const char* what) {
  throw RequestError(fmt::format(
      "{} does not go with equations in which a part cancels that need not have a value: they were "
      "written with {}",
      what, printable(expression_text(part), 80)));
}

/// What has elliptic functions: see EllipticLift.
ValidatedMotion enclosed_lift(const Model& model, const Scene& scene,
                              const ValidatedOptions& options) {
  const auto parts = cancelled_parts(model, scene, options);
  if (!parts.empty()) refuse_parts(parts.front(), "an enclosure of elliptic functions");
  const EllipticLift lift = elliptic_lift(model, scene, options);
  PreparedEnclosure prepared = specialised(lift.model, lift.scene, options);
  const Specialisation& s = prepared.specialisation;
  ValidatedOptions with_radii = options;
  with_radii.radii.clear();
  for (const int state : s.state_indices)
    with_radii.radii.push_back(lift.radii.at(static_cast<std::size_t>(state)));
  for (const std::string& name : s.parameters)
    with_radii.radii.push_back(radius_of(options.ranges, name));
  prepared.problem = problem_of(model, scene, with_radii, prepared);
  const auto own = static_cast<std::size_t>(std::ranges::count_if(
      s.state_indices, [&](int state) { return static_cast<std::size_t>(state) < lift.own; }));
  const std::size_t all = s.states.size();
  ValidatedMotion motion = enclosed(std::move(prepared), with_radii);
  drop_states(motion, own, all);
  return motion;
}

/// What has parts that cancel: see `with_parts_as_rates`.
ValidatedMotion enclosed_with_parts(const Model& model, const Scene& scene,
                                    const ValidatedOptions& options,
                                    const std::vector<GiNaC::ex>& parts) {
  const auto [lifted, start] = with_parts_as_rates(model, scene, parts);
  ValidatedOptions all = options;
  if (all.observe)
    for (std::size_t k = model.variables.size(); k < lifted.variables.size(); ++k)
      all.observe->push_back(lifted.variables[k].get_name());
  PreparedEnclosure prepared = specialised(lifted, start, all);
  const Specialisation& s = prepared.specialisation;
  const auto own = static_cast<std::size_t>(std::ranges::count_if(s.state_indices, [&](int state) {
    return static_cast<std::size_t>(state) < model.variables.size();
  }));
  const std::size_t states = s.states.size();
  if (!all.radii.empty() || cln::plusp(all.initial_radius) || !all.ranges.empty()) {
    std::vector<cln::cl_RA> radii = all.radii;
    if (radii.empty()) {
      radii.assign(own, all.initial_radius);
      for (const std::string& name : s.parameters) radii.push_back(radius_of(all.ranges, name));
    }
    radii.insert(radii.begin() + static_cast<std::ptrdiff_t>(own), states - own, cln::cl_RA(0));
    all.radii = std::move(radii);
  }
  prepared.problem = problem_of(model, scene, all, prepared);
  ValidatedMotion motion = enclosed(std::move(prepared), all);
  drop_states(motion, own, states);
  return motion;
}

}  // namespace

PreparedEnclosure prepare_enclosure(const Model& model, const Scene& scene,
                                    const ValidatedOptions& options) {
  require_exact_values(model, scene, "an enclosure with a certificate or of crossings");
  const auto parts = cancelled_parts(model, scene, options);
  if (!parts.empty())
    refuse_parts(parts.front(), "an enclosure with a certificate or of crossings");
  PreparedEnclosure prepared = specialised(model, scene, options);
  prepared.problem = problem_of(model, scene, options, prepared);
  return prepared;
}

ValidatedMotion enclose(const Model& model, const Scene& scene, const ValidatedOptions& options) {
  if (has_arbitrary_functions(model)) {
    const auto [own, own_scene] = in_scene(model, scene);
    if (has_elliptic_functions(own)) return enclosed_lift(own, own_scene, options);
  }
  if (has_elliptic_functions(model)) return enclosed_lift(model, scene, options);
  const auto parts = cancelled_parts(model, scene, options);
  if (!parts.empty()) return enclosed_with_parts(model, scene, options, parts);
  return enclosed(prepare_enclosure(model, scene, options), options);
}

}  // namespace casimir
