#include "tools/analysis/estimate/cancelled_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/program_of.hpp"
#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/principal_values.hpp"

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

/// What the equations as they were written show no longer with the numbers and the functions of the
/// scene in them.
std::vector<ex> lost_in_scene(const Model& model, const Scene& scene) {
  std::vector<ex> written;
  if (model.hamiltonian && model.poisson) {  // the field is derived from these
    written.push_back(*model.hamiltonian);
    for (std::size_t i = 0; i < model.poisson->dimension(); ++i)
      for (std::size_t j = i + 1; j < model.poisson->dimension(); ++j)
        written.push_back((*model.poisson)(i, j));
  } else {
    written = model.field;
  }
  GiNaC::exmap values;
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    values[model.parameters[i]] = scene.parameters[i];
  std::vector<ex> lost;
  for (const ex& e : written)
    for (const ex& part : lost_in_substitution(e, values, model.limits, VanishingTerms::dropped))
      lost.push_back(bound(model, scene, part));
  return lost;
}

/// The variables and the time.
std::vector<GiNaC::symbol> symbols_in(const Model& model) {
  std::vector<GiNaC::symbol> symbols = model.variables;
  if (model.time) symbols.push_back(*model.time);
  return symbols;
}

/// Whether b^r has values wherever b^s has them: both are roots of b, or poles of it.
bool has_values_like(const ex& root, const ex& other) {
  if (!GiNaC::is_a<GiNaC::power>(other) || !other.op(0).is_equal(root.op(0))) return false;
  const ex r = root.op(1), s = other.op(1);
  if (!r.info(GiNaC::info_flags::rational) || !s.info(GiNaC::info_flags::rational)) return false;
  const bool is_pole = r.info(GiNaC::info_flags::negative);
  if (is_pole && !s.info(GiNaC::info_flags::negative)) return false;
  return r.info(GiNaC::info_flags::integer) || !s.info(GiNaC::info_flags::integer);
}

/// Whether a factor stands in an expression: itself, or another power of the same that has values
/// where it has them only.
bool shows_factor(const ex& e, const ex& factor) {
  if (e.has(factor)) return true;
  if (!GiNaC::is_a<GiNaC::power>(factor)) return false;
  return std::any_of(e.preorder_begin(), e.preorder_end(),
                     [&](const ex& part) { return has_values_like(factor, part); });
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

/// Whether an expression has no value where a part has none, as it is written: it shows all factors
/// of the part.
bool shows(const ex& e, const ex& part) {
  if (!GiNaC::is_a<GiNaC::mul>(part)) return shows_factor(e, part);
  return std::all_of(part.begin(), part.end(), [&](const ex& factor) {
    return GiNaC::is_a<GiNaC::numeric>(factor) || shows_factor(e, factor);
  });
}

bool is_pole_of_polynomial(const ex& part, const std::vector<GiNaC::symbol>& symbols) {
  if (!GiNaC::is_a<GiNaC::power>(part) || !part.op(1).info(GiNaC::info_flags::negint)) return false;
  GiNaC::lst list;
  for (const GiNaC::symbol& symbol : symbols) list.append(symbol);
  return part.op(0).is_polynomial(list);
}

}  // namespace

std::vector<ex> cancelled_parts(const Model& model, const Scene& binding) {
  std::vector<ex> candidates;
  for (const std::vector<ex>* list : {&model.domain, &model.bracket_domain})
    for (const ex& written : *list) candidates.push_back(bound(model, binding, written));
  for (ex& part : lost_in_scene(model, binding)) candidates.push_back(std::move(part));
  if (candidates.empty()) return candidates;
  std::vector<ex> fields, parts;
  for (const ex& rate : model.field) fields.push_back(model.at_parameters(rate, binding));
  for (const ex& part : candidates) {
    const auto is_it = [&](const ex& other) { return other.is_equal(part); };
    const auto shows_it = [&](const ex& rate) { return shows(rate, part); };
    if (GiNaC::is_a<GiNaC::numeric>(part) || is_root_of_squares(part) ||
        std::ranges::any_of(parts, is_it) || std::ranges::any_of(fields, shows_it))
      continue;
    parts.push_back(part);
  }
  return parts;
}

std::string unwatched_parts(const Model& model, const Scene& scene) {
  std::string texts;
  for (const ex& part : cancelled_parts(model, scene))
    texts += (texts.empty() ? "" : ", ") + printable(expression_text(part), 80);
  if (texts.empty()) return {};
  return fmt::format(
      "the equations were written with {}, which cancels in them: whether it has a value all along "
      "the motion was not looked at",
      texts);
}

CancelledParts::CancelledParts(const Model& model, const PreparedScene& run)
    : has_time_(model.time.has_value()) {
  const Specialisation& s = run.specialisation;
  const std::vector<GiNaC::symbol> symbols = symbols_in(model);
  std::vector<ex> parts;
  for (const ex& part : cancelled_parts(model, scene_of(model, s.scene))) {
    const auto is_left_out = [&](const GiNaC::symbol& x) {
      return part.has(x) && std::ranges::find(s.states, x.get_name()) == s.states.end();
    };
    if (has_any(part, model.parameters) || std::ranges::any_of(model.variables, is_left_out))
      continue;
    parts.push_back(part);
    poles_.push_back(is_pole_of_polynomial(part, symbols));
    texts_.push_back(printable(expression_text(part), 80));
  }
  if (parts.empty()) return;
  values_.emplace(program_of(parts, symbols));
  inputs_.resize(symbols.size());
  now_.resize(parts.size());
  for (const std::string& name : s.states)
    places_.push_back(static_cast<std::size_t>(
        std::ranges::find(symbols, name, [](const auto& x) { return x.get_name(); }) -
        symbols.begin()));
  state_ = run.initial;
  see(0, run.initial.data());
}

bool CancelledParts::see(double t, const double* x) {
  if (lost_) return false;
  for (std::size_t i = 0; i < places_.size(); ++i) inputs_[places_[i]] = x[i];
  if (has_time_) inputs_.back() = t;
  (*values_)(inputs_.data(), now_.data());
  for (std::size_t k = 0; k < now_.size() && !lost_; ++k) {
    const bool passed = poles_[k] && !before_.empty() && now_[k] * before_[k] < 0;
    if (!std::isfinite(now_[k]) || passed) lost_ = k;
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
