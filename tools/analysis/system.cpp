#include "tools/analysis/system.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <set>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/elementary.hpp"
#include "symbolic/expression/elliptic.hpp"
#include "symbolic/expression/expression.hpp"

namespace casimir {
namespace {

/// The names that GiNaC has for the functions that case files may use.
const std::set<std::string>& known_functions() {
  static const std::set<std::string> names = [] {
    std::set<std::string> result;
    const GiNaC::symbol x("x"), y("y");
    for (const std::string& name : elementary_function_names()) {
      const GiNaC::ex value = find_elementary_function(name)->apply(x, y);
      for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it)
        if (GiNaC::is_a<GiNaC::function>(*it))
          result.insert(GiNaC::ex_to<GiNaC::function>(*it).get_name());
    }
    for (const std::string& name : elliptic_function_names()) result.insert(name);
    return result;
  }();
  return names;
}

/// What of an expression the prover and the generated code have no meaning for, or nothing.
std::string foreign_part(const GiNaC::ex& part, const std::vector<GiNaC::symbol>& known) {
  if (GiNaC::is_a<GiNaC::numeric>(part))
    return GiNaC::ex_to<GiNaC::numeric>(part).is_rational() ? "" : "is no rational number";
  if (GiNaC::is_a<GiNaC::symbol>(part))
    return std::ranges::any_of(
               known, [&](const auto& s) { return s.is_equal(GiNaC::ex_to<GiNaC::symbol>(part)); })
               ? ""
               : "is no variable and no parameter";
  if (GiNaC::is_a<GiNaC::add>(part) || GiNaC::is_a<GiNaC::mul>(part) ||
      GiNaC::is_a<GiNaC::power>(part) || part.is_equal(GiNaC::Pi))
    return "";
  if (GiNaC::is_a<GiNaC::function>(part) &&
      known_functions().contains(GiNaC::ex_to<GiNaC::function>(part).get_name()))
    return "";
  return "is nothing that a case can contain";
}

void check(const GiNaC::ex& expression, const std::vector<GiNaC::symbol>& known) {
  for (auto it = expression.preorder_begin(); it != expression.preorder_end(); ++it) {
    const std::string problem = foreign_part(*it, known);
    if (!problem.empty())
      throw ModelError(
          fmt::format("'{}' {}", printable(fmt::format("{}", fmt::streamed(*it))), problem));
  }
}

void check_constant(const GiNaC::ex& value, const Limits& limits) {
  check(value, {});
  if (!real_decimal(value, limits.bits))
    throw ModelError(
        fmt::format("'{}' is no real number", printable(fmt::format("{}", fmt::streamed(value)))));
}

}  // namespace

Model hamiltonian_system(const std::string& name, const std::vector<GiNaC::symbol>& q,
                         const std::vector<GiNaC::symbol>& p, const GiNaC::ex& hamiltonian,
                         const std::vector<GiNaC::symbol>& parameters) {
  if (q.empty() || q.size() != p.size())
    throw ModelError(fmt::format("{} coordinates and {} momenta", q.size(), p.size()));
  Model model;
  model.name = model.title = name;
  model.phase_space = "canonical";
  model.variables = q;
  model.variables.insert(model.variables.end(), p.begin(), p.end());
  model.parameters = parameters;
  std::vector<GiNaC::symbol> all = model.variables;
  all.insert(all.end(), parameters.begin(), parameters.end());
  std::set<std::string> names;
  for (const GiNaC::symbol& symbol : all) {
    check_name({symbol.get_name(), {name}, {}}, "a symbol");
    if (!names.insert(symbol.get_name()).second)
      throw ModelError(fmt::format("two symbols are called '{}'", symbol.get_name()));
  }
  check(hamiltonian, all);
  const std::size_t n = q.size();
  std::vector<GiNaC::ex> upper;
  for (std::size_t i = 0; i < 2 * n; ++i)
    for (std::size_t j = i + 1; j < 2 * n; ++j) upper.emplace_back(j == i + n ? 1 : 0);
  model.poisson.emplace(model.variables, upper);
  model.hamiltonian = hamiltonian;
  model.field = model.poisson->flow(hamiltonian);
  return model;
}

Scene scene_from(const Model& model, const std::vector<GiNaC::ex>& initial,
                 const GiNaC::ex& duration, const std::vector<GiNaC::ex>& parameters) {
  if (initial.size() != model.variables.size() || parameters.size() != model.parameters.size())
    throw ModelError(fmt::format(
        "{} initial values for {} variables, and {} values for {} parameters", initial.size(),
        model.variables.size(), parameters.size(), model.parameters.size()));
  for (const auto* values : {&initial, &parameters})
    for (const GiNaC::ex& value : *values) check_constant(value, model.limits);
  check_constant(duration, model.limits);
  Scene scene;
  scene.name = "default";
  scene.initial = initial;
  scene.parameters = parameters;
  scene.duration = duration;
  return scene;
}

}  // namespace casimir
