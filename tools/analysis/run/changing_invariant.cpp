#include "tools/analysis/run/changing_invariant.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "codegen/program_of.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/program/term_size.hpp"
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

}  // namespace

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
