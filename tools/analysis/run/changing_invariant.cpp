#include "tools/analysis/run/changing_invariant.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "codegen/program_of.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/program/term_size.hpp"
#include "symbolic/algebra/ball_evaluator.hpp"
#include "symbolic/model/given_functions.hpp"

namespace casimir {
namespace {

/// The states, and near the first some more, where the case has no constraints that they would
/// leave.
std::vector<std::vector<double>> looked_at(const Model& model,
                                           std::vector<std::vector<double>> states) {
  constexpr int kNear = 4;
  constexpr double kApart = 0.01;
  if (!model.constraints.empty() || states.empty()) return states;
  std::mt19937_64 random;
  std::uniform_real_distribution<double> share(-kApart, kApart);
  for (int k = 0; k < kNear; ++k) {
    std::vector<double> near = states.front();
    for (double& x : near) x += share(random) * std::max(1.0, std::abs(x));
    states.push_back(std::move(near));
  }
  return states;
}

/// Whether a function certainly has a value at this point, and another than zero; the point is one
/// of those of which the case says something.
bool is_certainly_nonzero(const GiNaC::ex& f, const Model& model, const Scene& scene,
                          const std::vector<GiNaC::ex>& point) {
  constexpr long kBits = 512;
  BallEvaluator evaluator(BallEvaluator::Numbers::real, kBits);
  try {
    for (std::size_t i = 0; i < point.size(); ++i) evaluator.set(model.variables[i], point[i]);
    for (const Assumption& assumption : model.assumptions) {
      const auto sign = evaluator.sign(model.at_parameters(assumption.difference, scene));
      if (!sign || !holds(assumption.comparison, *sign)) return false;
    }
    return evaluator.sign(f).value_or(0) != 0;
  } catch (const NotCertified&) {
    return false;
  }
}

/// The start, and near it some points with exact numbers, where the case has no constraints that
/// they would leave.
std::vector<std::vector<GiNaC::ex>> exact_points(const Model& model, const Scene& scene) {
  std::vector<std::vector<GiNaC::ex>> points{scene.initial};
  constexpr int kNear = 4, kParts = 1000;
  std::mt19937_64 random;
  std::uniform_int_distribution<int> share(-kParts / 100, kParts / 100);
  for (int k = 0; k < kNear && model.constraints.empty(); ++k) {
    std::vector<GiNaC::ex> near = scene.initial;
    for (GiNaC::ex& x : near)
      x += GiNaC::numeric(share(random), kParts) * (x.is_zero() ? GiNaC::ex(1) : x);
    points.push_back(std::move(near));
  }
  return points;
}

}  // namespace

std::optional<std::string> changing_invariant(const MapModel& map, const Scene& scene) {
  const std::vector<std::vector<GiNaC::ex>> points = exact_points(map.base, scene);
  for (const auto* list : {&map.base.casimirs, &map.base.integrals})
    for (const NamedExpression& f : *list) {
      const GiNaC::ex change = map.base.at_parameters(map.composed(f.value) - f.value, scene);
      const auto changes_at = [&](const std::vector<GiNaC::ex>& point) {
        return is_certainly_nonzero(change, map.base, scene, point);
      };
      if (std::ranges::any_of(points, changes_at)) return f.name;
    }
  return std::nullopt;
}

std::optional<std::string> changing_invariant(const Model& given, const Scene& at,
                                              const std::vector<std::vector<double>>& states,
                                              const std::vector<double>& times) {
  const auto [model, scene] =
      has_arbitrary_functions(given) ? in_scene(given, at) : std::pair{given, at};
  std::vector<std::string> names;
  std::vector<GiNaC::ex> rates;
  for (const auto* list : {&model.casimirs, &model.integrals})
    for (const NamedExpression& f : *list) {
      names.push_back(f.name);
      rates.push_back(model.rate(f.value));
    }
  // Parameters are inputs: where a rate has no value at theirs, it is no number, and no error.
  std::vector<GiNaC::symbol> symbols = model.symbols();
  if (model.time) symbols.push_back(*model.time);
  const Program program = program_of(rates, symbols);
  const std::vector<std::vector<double>> all = looked_at(model, states);
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::vector<SizedNumber> inputs;
    for (const double x : all[k]) inputs.push_back(Arithmetic<SizedNumber>::plain(x));
    for (const GiNaC::ex& value : scene.parameters)
      inputs.push_back(
          Arithmetic<SizedNumber>::plain(GiNaC::ex_to<GiNaC::numeric>(value.evalf()).to_double()));
    if (model.time)
      inputs.push_back(Arithmetic<SizedNumber>::plain(times[k < times.size() ? k : 0]));
    const std::vector<SizedNumber> values = evaluate(program, inputs);
    constexpr long double kRounding = 1e-9L;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::isfinite(values[i].value) && std::isfinite(values[i].size) &&
          std::abs(values[i].value) > kRounding * std::abs(values[i].size))
        return names[i];
  }
  return std::nullopt;
}

}  // namespace casimir
