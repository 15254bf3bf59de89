#include "tools/analysis/horseshoe/section_system.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "codegen/optimise/lower.hpp"
#include "codegen/specialise.hpp"
#include "runtime/program/exact_number.hpp"
#include "runtime/validated/rational_ends.hpp"
#include "symbolic/algebra/ball_evaluator.hpp"
#include "symbolic/prove.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/proof/ball_matrix.hpp"
#include "tools/analysis/section/periods.hpp"

namespace casimir::horseshoe {
namespace {

constexpr const char *kPlane = "casimir_plane", *kPlaneRate = "casimir_plane_rate";

/// The interval of all numbers within 2^-52 of the double, of its size: what was meant by it.
RationalInterval near(double value) {
  const cln::cl_RA middle = exact_number(value);
  const cln::cl_RA by = cln::abs(middle) / cln::expt(cln::cl_RA(2), 52);
  return {middle - by, middle + by};
}

class Maker {
 public:
  Maker(const Model& model, const Scene& scene, const SectionRequest& request)
      : model_(model), scene_(scene), request_(request), n_(model.variables.size()) {}

  SectionSystem make() {
    check_model();
    read_plane();
    choose_levels();
    make_programs();
    set_levels();
    set_start();
    return std::move(system_);
  }

 private:
  GiNaC::ex at_scene(const GiNaC::ex& e) const { return model_.at_parameters(e, scene_); }

  void check_model() const {
    if (model_.time)
      throw RequestError(
          fmt::format("'{}' depends on the time '{}': its return map is no map of a "
                      "surface into itself",
                      model_.name, model_.time->get_name()));
    for (const Assumption& assumption : model_.assumptions)
      for (const GiNaC::symbol& x : model_.variables)
        if (assumption.difference.has(x))
          throw RequestError(
              fmt::format("'{}' is about the states where '{}' only: that a set stays there is not "
                          "checked",
                          model_.name, printable(assumption.text)));
    if (const std::string parts = unwatched_parts(model_, scene_); !parts.empty())
      throw RequestError(
          fmt::format("'{}' has no horseshoe that can be proved: {}", model_.name, parts));
    if (n_ < 3)
      throw RequestError(
          fmt::format("'{}' has {} states: chaos of a flow needs three", model_.name, n_));
  }

  void read_plane() {
    if (!request_.plane && !model_.section)
      throw RequestError(
          fmt::format("'{}' has no plane for a section, and none is given", model_.name));
    const GiNaC::ex function = request_.plane ? request_.plane->function : model_.section->function;
    system_.plane_text =
        request_.plane ? request_.plane->text : fmt::format("{}", fmt::streamed(function));
    system_.upwards =
        request_.upwards.value_or(request_.plane || !model_.section || model_.section->upwards);
    plane_ = at_scene(function);
    if (std::ranges::none_of(model_.variables, [&](const auto& x) { return plane_.has(x); }))
      throw RequestError(fmt::format("the plane '{}' is the same everywhere in phase space",
                                     printable(system_.plane_text)));
    std::vector<GiNaC::ex> functions;
    for (const GiNaC::ex& rate : model_.field) functions.push_back(at_scene(rate));
    const std::vector<bool> is_angle = angles_among(model_.variables, functions);
    std::vector<GiNaC::symbol> angles;
    for (std::size_t i = 0; i < n_; ++i)
      if (is_angle[i]) angles.push_back(model_.variables[i]);
    if (period_of(plane_, angles) > 0)
      throw RequestError("a horseshoe needs a surface that is no angle: give it by a sine");
    if (!system_.upwards) plane_ = -plane_;
  }

  /// Whether a function is proved to be constant along solutions, without further conditions.
  bool is_constant(ClaimKind kind, const NamedExpression& function) const {
    const Proof proof = prove_claim(model_, kind, function);
    return proof.verdict == Verdict::proved && proof.where.empty();
  }

  void add_level(const std::string& name, const GiNaC::ex& value) {
    const GiNaC::ex here = at_scene(value);
    if (std::ranges::none_of(model_.variables, [&](const auto& x) { return here.has(x); })) return;
    system_.level_names.push_back(name);
    levels_.push_back(here);
  }

  /// H and the Casimir functions; of a system that is given by its equations what is proved of its
  /// integrals.
  void choose_levels() {
    const bool hamiltonian = model_.hamiltonian && model_.poisson;
    if (hamiltonian) add_level("H", *model_.hamiltonian);
    for (const NamedExpression& casimir : model_.casimirs) {
      if (!is_constant(hamiltonian ? ClaimKind::casimir : ClaimKind::integral, casimir))
        throw RequestError(fmt::format("{} is not proved to be constant", casimir.name));
      add_level(casimir.name, casimir.value);
    }
    if (!hamiltonian)
      for (const NamedExpression& integral : model_.integrals)
        if (is_constant(ClaimKind::integral, integral)) add_level(integral.name, integral.value);
    if (levels_.size() + 3 == n_) return;
    throw RequestError(fmt::format(
        "the return map of '{}' has dimension {} on the level of {}: horseshoes are sought where "
        "it has dimension 2",
        model_.name, static_cast<long>(n_) - 1 - static_cast<long>(levels_.size()),
        levels_.empty() ? "nothing" : fmt::format("{}", fmt::join(system_.level_names, ", "))));
  }

  /// Without parameters, and with the functions as its integrals.
  Model extended() const {
    Model model;
    model.limits = model_.limits;
    model.name = model_.name;
    model.phase_space = "equations";
    model.variables = model_.variables;
    for (const GiNaC::ex& rate : model_.field) model.field.push_back(at_scene(rate));
    GiNaC::ex rate = 0;
    for (std::size_t i = 0; i < n_; ++i) rate += plane_.diff(model_.variables[i]) * model.field[i];
    model.integrals = {{kPlane, plane_, {}}, {kPlaneRate, rate, {}}};
    for (std::size_t a = 0; a < levels_.size(); ++a)
      model.integrals.push_back({fmt::format("casimir_level_{}", a), levels_[a], {}});
    return model;
  }

  static Program outputs_of(const Specialisation& s, const std::vector<std::string>& names) {
    Program program = s.invariants;
    program.outputs.clear();
    program.output_names.clear();
    for (const std::string& name : names) {
      const auto place = std::ranges::find(s.invariant_names, name);
      if (place == s.invariant_names.end())
        throw RequestError("the surface or a function of the level is constant");
      const auto k = static_cast<std::size_t>(place - s.invariant_names.begin());
      program.outputs.push_back(s.invariants.outputs[k]);
      program.output_names.push_back(name);
    }
    return codegen::without_dead_code(program);
  }

  void make_programs() {
    Scene scene = scene_;
    scene.parameters.clear();
    scene.observe.clear();
    scene.duration = 1;
    SpecialiseOptions what;
    what.observe = std::vector<std::string>{};
    what.jacobian = false;
    const Specialisation s = specialise(extended(), scene, what);
    system_.names = s.states;
    if (s.states.size() != n_) throw RequestError("a state is left out of the equations");
    system_.rates = s.rhs;
    system_.jacobian = codegen::jacobian(s.rhs, n_);
    system_.plane = outputs_of(s, {kPlane, kPlaneRate});
    std::vector<std::string> names{kPlane};
    for (std::size_t a = 0; a < levels_.size(); ++a) {
      names.push_back(fmt::format("casimir_level_{}", a));
      KnownIntegral known{.name = system_.level_names[a],
                          .value = outputs_of(s, {names.back()}),
                          .gradient = {},
                          .states = {}};
      const SparseProgram gradient = codegen::gradients(known.value, n_);
      known.gradient = gradient.program;
      for (const auto& [state, output] : gradient.entries) known.states.push_back(state);
      system_.integrals.push_back(std::move(known));
    }
    system_.constraints = outputs_of(s, names);
    system_.gradients = codegen::gradients(system_.constraints, n_);
  }

  /// The values at the exact start of the scene, in balls, or what was asked for.
  void set_levels() {
    for (std::size_t a = 0; a < levels_.size(); ++a) {
      const std::string& name = system_.level_names[a];
      std::optional<double> asked;
      if (name == "H" && model_.hamiltonian) asked = request_.energy;
      for (const auto& [casimir, value] : request_.casimirs)
        if (casimir == name) asked = value;
      if (asked) {
        system_.levels.push_back(near(*asked));
        continue;
      }
      GiNaC::exmap start;
      for (std::size_t i = 0; i < n_; ++i) start[model_.variables[i]] = scene_.initial[i];
      const GiNaC::ex value = levels_[a].subs(start);
      const BallFunctions function({}, {value});
      system_.levels.push_back(ends_of(function(BallMatrix(0, 1)).at(0)));
    }
  }

  void set_start() {
    system_.start.resize(static_cast<Eigen::Index>(n_));
    BallEvaluator evaluate(BallEvaluator::Numbers::real, kBallBits);
    for (std::size_t i = 0; i < n_; ++i)
      system_.start[static_cast<Eigen::Index>(i)] =
          arf_get_d(arb_midref(acb_realref(evaluate(scene_.initial[i]).raw())), ARF_RND_NEAR);
  }

  const Model& model_;
  const Scene& scene_;
  const SectionRequest& request_;
  std::size_t n_;
  GiNaC::ex plane_;
  std::vector<GiNaC::ex> levels_;
  SectionSystem system_;
};

}  // namespace

SectionSystem section_system(const Model& model, const Scene& scene,
                             const SectionRequest& request) {
  try {
    return Maker(model, scene, request).make();
  } catch (const NotCertified&) {
    throw RequestError("the level of the scene has no certain value");
  }
}

}  // namespace casimir::horseshoe
