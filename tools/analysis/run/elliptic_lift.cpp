#include "tools/analysis/run/elliptic_lift.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "runtime/validated/rational_ends.hpp"
#include "symbolic/algebra/ball_evaluator.hpp"
#include "symbolic/expression/elliptic.hpp"
#include "symbolic/functions/convert/order_keys.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// Of balls at the start: enough for the digits that are asked for, and more than a double has.
long bits_for(int digits) { return 256 + 4L * digits; }

bool is_elliptic_call(const ex& e) {
  return GiNaC::is_a<GiNaC::function>(e) && is_elliptic_function(GiNaC::ex_to<GiNaC::function>(e));
}

/// The arguments in which Carlson's integrals are symmetric come first.
std::size_t symmetric_arguments(const std::string& name) {
  if (name == "R_F" || name == "R_J") return 3;
  return name == "R_D" ? 2 : 0;
}

/// Puts further variables in the place of values of elliptic functions.
class Lifter : public GiNaC::map_function {
 public:
  Lifter(Model model, std::size_t own) : model_(std::move(model)), own_(own) {}

  /// The rates of the further variables, and of those that these need.
  Model lifted() {
    for (ex& rate : model_.field) rate = without_calls(rate);
    if (model_.hamiltonian) model_.hamiltonian = without_calls(*model_.hamiltonian);
    for (auto* functions : {&model_.casimirs, &model_.integrals})
      for (NamedExpression& f : *functions) f.value = without_calls(f.value);
    while (model_.field.size() < model_.variables.size())
      model_.field.push_back(rate_of(calls_[model_.field.size() - own_]));
    return std::move(model_);
  }

  /// The call of which each further variable has the value; its arguments have further variables.
  const std::vector<ex>& calls() const { return calls_; }

  ex operator()(const ex& e) override {
    return is_elliptic_call(e) ? variable_of(GiNaC::ex_to<GiNaC::function>(e)) : e.map(*this);
  }

 private:
  /// In the same order in every process, unlike GiNaC's.
  ex without_calls(const ex& e) {
    std::set<ex, GiNaC::ex_is_less> seen;
    GiNaC::exvector calls;
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
      if (is_elliptic_call(*part) && seen.insert(*part).second) calls.push_back(*part);
    order_.sort(calls);
    for (const ex& call : calls) (*this)(call);
    return (*this)(e);
  }

  ex variable_of(const GiNaC::function& call) {
    const std::string name = call.get_name();
    GiNaC::exvector arguments;
    for (std::size_t i = 0; i < call.nops(); ++i) arguments.push_back((*this)(call.op(i)));
    GiNaC::exvector symmetric(
        arguments.begin(),
        arguments.begin() + static_cast<std::ptrdiff_t>(symmetric_arguments(name)));
    order_.sort(symmetric);
    std::ranges::copy(symmetric, arguments.begin());
    const ex value = find_elliptic_function(name)->apply(arguments);
    if (!is_elliptic_call(value)) return (*this)(value);
    const auto [known, is_new] = variables_.try_emplace(value);
    if (is_new) {
      const GiNaC::symbol further(unused_name(name));
      known->second = further;
      model_.variables.push_back(further);
      calls_.push_back(value);
    }
    return known->second;
  }

  std::string unused_name(const std::string& function) const {
    const auto taken = [this](const std::string& name) {
      const auto is_it = [&](const GiNaC::symbol& s) { return s.get_name() == name; };
      return std::ranges::any_of(model_.variables, is_it) ||
             std::ranges::any_of(model_.parameters, is_it) || (model_.time && is_it(*model_.time));
    };
    for (int number = 1;; ++number)
      if (std::string name = fmt::format("{}_{}", function, number); !taken(name)) return name;
  }

  /// By the chain rule: an argument depends on what came before it.
  ex rate_of(const ex& call) {
    ex rate = model_.time ? call.diff(*model_.time) : ex(0);
    for (std::size_t j = 0; j < model_.field.size(); ++j)
      rate += call.diff(model_.variables[j]) * model_.field[j];
    return without_calls(rate);
  }

  Model model_;
  std::size_t own_;
  std::map<ex, ex, GiNaC::ex_is_less> variables_;
  std::vector<ex> calls_;
  functions::OrderKeys order_;
};

Ball widened(Ball ball, const cln::cl_RA& radius) {
  const validated::ArbBall by(radius);
  arb_add_error(acb_realref(ball.raw()), by.raw());
  return ball;
}

RationalInterval real_ends_of(const Ball& ball) {
  if (!ball.is_real()) throw NotCertified{};
  validated::ArbBall real;
  arb_set(real.raw(), acb_realref(ball.raw()));
  return validated::ends_of(real);
}

/// The scene's numbers and the values of the further variables at them.
class Start {
 public:
  Start(const Model& model, const Scene& scene, const ValidatedOptions& options)
      : values_(BallEvaluator::Numbers::real, bits_for(options.run.digits)) {
    BallEvaluator exact(BallEvaluator::Numbers::real, values_.bits());
    for (std::size_t i = 0; i < scene.initial.size(); ++i) {
      radii_.push_back(options.radii.empty() ? options.initial_radius : options.radii.at(i));
      set(model.variables[i], scene.initial[i], radii_.back(), exact);
    }
    for (std::size_t i = 0; i < scene.parameters.size(); ++i) {
      const std::string name = model.parameters[i].get_name();
      const auto range =
          std::ranges::find(options.ranges, name, [](const auto& one) { return one.first; });
      set(model.parameters[i], scene.parameters[i],
          range == options.ranges.end() ? cln::cl_RA(0) : range->second, exact);
    }
    if (model.time) values_.set(*model.time, ex(0));
  }

  /// \return  the middle of the box of its value.
  ex add(const GiNaC::symbol& variable, const ex& call) {
    const Ball ball = values_(call);
    const auto [low, high] = real_ends_of(ball);
    values_.set(variable, ball);
    radii_.push_back((high - low) / 2);
    return GiNaC::numeric((low + high) / 2);
  }

  std::vector<cln::cl_RA> radii() && { return std::move(radii_); }

 private:
  void set(const GiNaC::symbol& symbol, const ex& value, const cln::cl_RA& radius,
           BallEvaluator& exact) {
    if (cln::zerop(radius))
      values_.set(symbol, value);
    else
      values_.set(symbol, widened(exact(value), radius));
  }

  BallEvaluator values_;
  std::vector<cln::cl_RA> radii_;
};

/// The case with the scene's numbers in it, but for the parameters that have a range.
Model at_scene(const Model& model, const Scene& scene, const ParameterRanges& ranges) {
  const Scene binding = scene_over(model, scene, ranges);
  Model own = model;
  for (ex& rate : own.field) rate = model.at_parameters(rate, binding);
  if (own.hamiltonian) own.hamiltonian = model.at_parameters(*own.hamiltonian, binding);
  for (auto* functions : {&own.casimirs, &own.integrals})
    for (NamedExpression& f : *functions) f.value = model.at_parameters(f.value, binding);
  return own;
}

}  // namespace

bool has_elliptic_functions(const Model& model) {
  const auto within = [](const NamedExpression& f) { return has_elliptic_function(f.value); };
  return std::ranges::any_of(model.field, has_elliptic_function) ||
         (model.hamiltonian && has_elliptic_function(*model.hamiltonian)) ||
         std::ranges::any_of(model.casimirs, within) ||
         std::ranges::any_of(model.integrals, within);
}

EllipticLift elliptic_lift(const Model& model, const Scene& scene,
                           const ValidatedOptions& options) {
  const std::size_t own = model.variables.size();
  Lifter lifter(at_scene(model, scene, options.ranges), own);
  EllipticLift lift{.model = lifter.lifted(), .scene = scene, .radii = {}, .own = own};
  Start start(model, scene, options);
  for (std::size_t k = 0; k < lifter.calls().size(); ++k) {
    const ex& call = lifter.calls()[k];
    try {
      lift.scene.initial.push_back(start.add(lift.model.variables[own + k], call));
    } catch (const NotCertified&) {
      throw ModelError(fmt::format(
          "scene \"{}\": {} has no certain value at the start: Carlson's integrals need positive "
          "arguments, Jacobi's functions a modulus between -1 and 1",
          printable(scene.name), GiNaC::ex_to<GiNaC::function>(call).get_name()));
    }
  }
  lift.radii = std::move(start).radii();
  return lift;
}

}  // namespace casimir
