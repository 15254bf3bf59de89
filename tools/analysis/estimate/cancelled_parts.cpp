#include "tools/analysis/estimate/cancelled_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "codegen/program_of.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/program/term_size.hpp"
#include "runtime/step/between_places.hpp"
#include "symbolic/algebra/ball_evaluator.hpp"
#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/elliptic.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/expression/principal_values.hpp"
#include "symbolic/model/given_functions.hpp"
#include "tools/analysis/estimate/shown_parts.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// The scene of the case that a run is of; for one that was made otherwise, one that leaves all
/// parameters open.
Scene scene_of(const Model& model, const std::string& name) {
  const auto found = std::ranges::find(model.scenes, name, &Scene::name);
  if (found != model.scenes.end()) return *found;
  Scene open;
  open.name = name;
  open.parameters.assign(model.parameters.begin(), model.parameters.end());
  return open;
}

bool has_any(const ex& e, const std::vector<GiNaC::symbol>& symbols) {
  return std::ranges::any_of(symbols, [&](const GiNaC::symbol& x) { return e.has(x); });
}

ex bound(const Model& model, const Scene& scene, const ex& part) {
  const auto no_value = [&] {
    return ModelError(
        fmt::format("scene \"{}\": {}, which the equations were written with, has no "
                    "value",
                    printable(scene.name), printable(expression_text(part), 80)));
  };
  try {
    ex value = model.at_parameters(part, scene);
    if (is_no_real_constant(value, model.limits.bits)) throw no_value();
    return value;
  } catch (const GiNaC::pole_error&) {
    throw no_value();
  }
}

/// Whether a part of an expression may have no value where its own parts have theirs.
bool may_lack_value(const ex& part) {
  static const std::set<std::string> kAlways{"exp", "sin", "cos", "sinh", "cosh", "tanh", "atan"};
  if (GiNaC::is_a<GiNaC::power>(part)) return !part.op(1).info(GiNaC::info_flags::posint);
  if (!GiNaC::is_exactly_a<GiNaC::function>(part)) return false;
  const auto& function = GiNaC::ex_to<GiNaC::function>(part);
  // The derivatives of elliptic functions are made of elliptic functions of the same.
  return !is_elliptic_function(function) && !kAlways.contains(function.get_name());
}

/// What an expression needs values of with the numbers and functions of the scene in it: what it
/// shows, and what it shows no longer.
void add_needs(const Model& model, const Scene& scene, const ex& written, std::vector<ex>& needs) {
  const GiNaC::exmap values = model.parameter_values(scene);
  for (const ex& part :
       lost_in_substitution(written, values, model.limits, VanishingTerms::dropped))
    needs.push_back(bound(model, scene, part));
  for (const ex& part :
       lost_of_functions_in(written, values, scene.lost_of_functions, model.limits))
    needs.push_back(bound(model, scene, part));
  const ex now = model.at_parameters(written, scene);
  for (auto part = now.preorder_begin(); part != now.preorder_end(); ++part)
    if (may_lack_value(*part)) needs.push_back(*part);
}

/// Whether a part is certain to have a value where the scene begins.
bool has_value_at_start(const Model& model, const Scene& scene, const ex& part) {
  if (scene.initial.size() != model.variables.size()) return false;
  GiNaC::exmap start;
  for (std::size_t i = 0; i < model.variables.size(); ++i)
    start[model.variables[i]] = scene.initial[i];
  if (model.time) start[*model.time] = 0;
  constexpr long kBits = 128;
  try {
    BallEvaluator evaluate(BallEvaluator::Numbers::real, kBits);
    return evaluate(substituted(part, start, model.limits)).is_finite();
  } catch (const NotCertified&) {
    return false;
  } catch (const GiNaC::pole_error&) {
    return false;
  }
}

/// The variables and the time.
std::vector<GiNaC::symbol> symbols_in(const Model& model) {
  std::vector<GiNaC::symbol> symbols = model.variables;
  if (model.time) symbols.push_back(*model.time);
  return symbols;
}

/// Whether an expression is a sum of even powers, as one sees.
bool is_sum_of_squares(const ex& e) {
  if (GiNaC::is_a<GiNaC::numeric>(e)) return !e.info(GiNaC::info_flags::negative);
  if (GiNaC::is_a<GiNaC::power>(e))
    return e.op(1).info(GiNaC::info_flags::even) && e.op(1).info(GiNaC::info_flags::positive);
  return (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) &&
         std::all_of(e.begin(), e.end(), is_sum_of_squares);
}

/// Whether a part is a root that is real everywhere.
bool is_root_of_squares(const ex& part) {
  return GiNaC::is_a<GiNaC::power>(part) && part.op(1).info(GiNaC::info_flags::positive) &&
         is_sum_of_squares(part.op(0));
}

/// The factors of a product, as 2 and (2 x - 1)^(-1) of 1/(x - 1/2); else the expression itself.
std::vector<ex> factors_of(const ex& part) {
  if (!GiNaC::is_a<GiNaC::mul>(part)) return {part};
  return {part.begin(), part.end()};
}

/// Functions that are negative where a part has no value: those of roots, logarithms and arcs.
struct Bounds {
  std::vector<ex> functions;
  bool closed = true;  ///< it has a value where one is zero
};

Bounds bounds_of(const ex& part) {
  Bounds result;
  for (const ex& factor : factors_of(part)) {
    if (GiNaC::is_a<GiNaC::power>(factor) && !factor.op(1).info(GiNaC::info_flags::integer)) {
      result.functions.push_back(factor.op(0));
      result.closed = result.closed && factor.op(1).info(GiNaC::info_flags::positive);
    }
    if (!GiNaC::is_exactly_a<GiNaC::function>(factor)) continue;
    const std::string name = GiNaC::ex_to<GiNaC::function>(factor).get_name();
    if (name == "log") {
      result.functions.push_back(factor.op(0));
      result.closed = false;
    }
    if (name == "asin" || name == "acos") {
      result.functions.push_back(1 - factor.op(0));
      result.functions.push_back(1 + factor.op(0));
    }
  }
  return result;
}

/// The polynomials whose changes of sign are poles of a part that doubles may step over; none where
/// it is no pole of a polynomial.
std::vector<ex> zeros_of_pole(const ex& part, const std::vector<GiNaC::symbol>& symbols) {
  GiNaC::lst list;
  for (const GiNaC::symbol& symbol : symbols) list.append(symbol);
  std::vector<ex> zeros;
  const auto add = [&](const ex& factor) {
    const ex root = GiNaC::is_a<GiNaC::power>(factor) ? factor.op(0) : factor;
    if (has_any(root, symbols)) zeros.push_back(root);
  };
  for (const ex& pole : factors_of(part)) {
    if (!GiNaC::is_a<GiNaC::power>(pole) || !pole.op(1).info(GiNaC::info_flags::negative) ||
        !pole.op(0).is_polynomial(list))
      continue;
    // Of even powers only the bases change their sign. GiNaC factors over the rational numbers.
    const ex base = pole.op(0).expand();
    const ex factors =
        base.info(GiNaC::info_flags::rational_polynomial) ? GiNaC::sqrfree(base) : pole.op(0);
    for (const ex& factor : factors_of(factors)) add(factor);
  }
  return zeros;
}

}  // namespace

std::vector<ex> written_parts(const Model& model, const Scene& scene) {
  std::vector<ex> needs;
  for (const std::vector<ex>* list : {&model.domain, &model.bracket_domain})
    for (const ex& part : *list) needs.push_back(bound(model, scene, part));
  if (!model.hamiltonian || !model.poisson) {
    for (const ex& rate : model.field) add_needs(model, scene, rate, needs);
    return needs;
  }
  add_needs(model, scene, *model.hamiltonian, needs);
  for (std::size_t i = 0; i < model.poisson->dimension(); ++i)
    for (std::size_t j = i + 1; j < model.poisson->dimension(); ++j)
      add_needs(model, scene, (*model.poisson)(i, j), needs);
  return needs;
}

std::vector<ex> cancelled_parts(const Model& model, const Scene& binding, States states) {
  std::vector<ex> needs;
  for (const ex& part : written_parts(model, binding)) {
    const auto is_it = [&](const ex& other) { return other.is_equal(part); };
    if (!GiNaC::is_a<GiNaC::numeric>(part) && !is_root_of_squares(part) &&
        std::ranges::none_of(needs, is_it))
      needs.push_back(part);
  }
  if (needs.empty()) return needs;
  std::vector<ex> fields;
  for (const ex& rate : model.field) fields.push_back(model.at_parameters(rate, binding));
  std::vector<GiNaC::symbol> inputs = symbols_in(model);
  inputs.insert(inputs.end(), model.parameters.begin(), model.parameters.end());
  ShownParts shown(fields, inputs);
  std::erase_if(needs, [&](const ex& part) {
    return shown.shows(part) || (states == States::connected && shown.keeps(part) &&
                                 has_value_at_start(model, binding, part));
  });
  return needs;
}

std::string unwatched_parts(const Model& model, const Scene& scene, States states) {
  std::string texts;
  for (const ex& part : cancelled_parts(model, scene, states))
    texts += (texts.empty() ? "" : ", ") + printable(expression_text(part), 80);
  if (texts.empty()) return {};
  return fmt::format(
      "the equations were written with {}, which cancels in them: whether it has a value all along "
      "the motion was not looked at",
      texts);
}

CancelledParts::CancelledParts(const Model& model, const PreparedScene& run, States states)
    : has_time_(model.time.has_value()), are_apart_(states == States::apart) {
  const Specialisation& s = run.specialisation;
  const std::vector<GiNaC::symbol> symbols = symbols_in(model);
  std::vector<ex> parts;
  for (const ex& part : cancelled_parts(model, scene_of(model, s.scene), states)) {
    const auto is_left_out = [&](const GiNaC::symbol& x) {
      return part.has(x) && std::ranges::find(s.states, x.get_name()) == s.states.end();
    };
    if (has_any(part, model.parameters) || std::ranges::any_of(model.variables, is_left_out))
      continue;
    const auto watch = [&](const ex& function, Shown how) {
      parts.push_back(function);
      shown_.push_back(how);
      texts_.push_back(printable(expression_text(part), 80));
    };
    const Bounds bounds = bounds_of(part);
    // Rounding takes a radicand that touches zero below it, where the root is no number.
    const bool may_touch = bounds.closed && !bounds.functions.empty();
    if (!may_touch) watch(part, Shown::by_value);
    for (const ex& zero : zeros_of_pole(part, symbols)) watch(zero, Shown::by_sign);
    for (const ex& bound : bounds.functions)
      watch(bound, may_touch ? Shown::far_below_zero : Shown::below_zero);
  }
  if (parts.empty()) return;
  program_ = program_of(parts, symbols);
  values_.emplace(program_);
  inputs_.resize(symbols.size());
  now_.resize(parts.size());
  within_.resize(s.states.size());
  for (const std::string& name : s.states)
    places_.push_back(static_cast<std::size_t>(
        std::ranges::find(symbols, name, [](const auto& x) { return x.get_name(); }) -
        symbols.begin()));
  state_ = run.initial;
  see(0, run.initial.data());
}

void CancelledParts::evaluate(double t, const double* x, std::vector<double>& values) {
  for (std::size_t i = 0; i < places_.size(); ++i) inputs_[places_[i]] = x[i];
  if (has_time_) inputs_.back() = t;
  (*values_)(inputs_.data(), values.data());
}

/// The size of the largest term of a function where it was evaluated last.
double CancelledParts::size_of(std::size_t which) const {
  std::vector<SizedNumber> inputs;
  for (const double input : inputs_) inputs.push_back(Arithmetic<SizedNumber>::plain(input));
  return static_cast<double>(std::abs(casimir::evaluate(program_, inputs)[which].size));
}

/// Times within a step at which to look. A function that has turned between three of them is looked
/// at where the parabola through these says that it comes nearest to zero.
std::vector<double> CancelledParts::places_within(
    double t, const std::function<void(double t, double* x)>& state_at) {
  constexpr std::size_t kPlaces = 17;
  std::vector<double> times;
  std::vector<std::vector<double>> sampled(shown_.size());
  std::vector<double> values(shown_.size());
  for (std::size_t i = 0; i <= kPlaces; ++i) {
    times.push_back(time_ + (t - time_) * static_cast<double>(i) / kPlaces);
    if (i > 0) {
      state_at(times.back(), within_.data());
      evaluate(times.back(), within_.data(), values);
    }
    for (std::size_t k = 0; k < values.size(); ++k)
      sampled[k].push_back(i == 0 ? before_[k] : values[k]);
  }
  std::vector<double> places(times.begin() + 1, times.end() - 1);
  // The places of `dip_at` are in their order.
  const double direction = t < time_ ? -1 : 1;
  std::vector<double> ordered;
  for (const double time : times) ordered.push_back(direction * time);
  for (std::size_t k = 0; k < shown_.size(); ++k)
    for (std::size_t i = 0; shown_[k] != Shown::by_value && i + 2 < ordered.size(); ++i)
      if (const auto dip = dip_at(ordered, sampled[k], i)) places.push_back(direction * dip->place);
  std::ranges::sort(places, {}, [&](double place) { return direction * place; });
  return places;
}

bool CancelledParts::see(double t, const double* x,
                         const std::function<void(double t, double* x)>& state_at) {
  if (lost_) return false;
  if (!before_.empty()) {
    for (const double place : places_within(t, state_at)) {
      state_at(place, within_.data());
      if (!see(place, within_.data())) return false;
    }
  }
  return see(t, x);
}

bool CancelledParts::see(double t, const double* x) {
  if (lost_) return false;
  evaluate(t, x, now_);
  for (std::size_t k = 0; k < now_.size() && !lost_; ++k) {
    const bool passed =
        shown_[k] == Shown::by_sign && !are_apart_ && !before_.empty() && now_[k] * before_[k] < 0;
    const bool below =
        now_[k] < 0 && (shown_[k] == Shown::below_zero ||
                        (shown_[k] == Shown::far_below_zero && -now_[k] > little_ * size_of(k)));
    if (!std::isfinite(now_[k]) || passed || below) lost_ = k;
  }
  if (lost_) {
    lost_time_ = t;
    return false;
  }
  before_ = now_;
  time_ = t;
  state_.assign(x, x + places_.size());
  return true;
}

void CancelledParts::watch(Settings& settings) {
  if (!any()) return;
  constexpr double kOfTolerance = 1000;
  if (!(settings.fixed_step > 0)) little_ = std::max(little_, kOfTolerance * settings.rtol);
  settings.watch_within = [this](double t, const double* x, const auto& state_at) {
    see(t, x, state_at);
  };
  settings.give_up = [this, limit = settings.give_up] { return lost() || (limit && limit()); };
}

void CancelledParts::end(Trajectory& trajectory) const {
  trajectory.status = Status::singularity;
  const std::string when = before_.empty()
                               ? "has no value at the start"
                               : fmt::format(
                                     "ceases to have a value between t = {:.6g} and t = "
                                     "{:.6g}",
                                     time_, lost_time_);
  trajectory.reason = fmt::format(
      "{}, which the equations were written with, {}; it cancels in them, and what goes on is no "
      "solution of the case",
      texts_[*lost_], when);
  trajectory.time = time_;
  trajectory.state = state_;
  // The last step led beyond.
  std::size_t kept = 0;
  while (kept < trajectory.sample_times.size() &&
         std::abs(trajectory.sample_times[kept]) <= std::abs(time_))
    ++kept;
  trajectory.sample_times.resize(kept);
  trajectory.samples.resize(std::min(kept, trajectory.samples.size()));
}

}  // namespace casimir
