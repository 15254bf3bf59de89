#include "symbolic/discrete/values_between_steps.hpp"

#include <algorithm>
#include <random>

#include "symbolic/error.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/proof/prover.hpp"
#include "symbolic/proof/thin_domain.hpp"

namespace casimir::discrete {
namespace {

using functions::Generator;
using functions::Kind;
using GiNaC::ex;

bool uses_a_variable(const FunctionRing& ring, const Polynomial& p, std::size_t variables) {
  for (std::size_t i = 0; i < variables; ++i)
    if (ring.depends_on(p, i)) return true;
  return false;
}

/// Whether each generator in what these are made of is one that `allows` wants. Parameters are not
/// moved by a step: what is made of them alone has its value everywhere or nowhere.
template <class Allows>
bool all_generators(const Model& model, const std::vector<ex>& expressions, const Allows& allows) {
  // Without assumptions, which say nothing of where the steps lead.
  const FunctionRing ring(model.symbols(), {}, expressions, model.limits);
  const std::size_t variables = model.variables.size();
  return !ring.is_complex() &&
         std::ranges::all_of(ring.table().generators(), [&](const Generator& g) {
           return allows(g) || !uses_a_variable(ring, g.base, variables);
         });
}

bool have_values_everywhere(const Model& model, const std::vector<ex>& functions) {
  return all_generators(model, functions, [](const Generator& g) {
    return g.kind == Kind::sine || g.kind == Kind::cosine || g.kind == Kind::exponential;
  });
}

bool are_rational(const MapModel& map, const std::vector<ex>& functions) {
  std::vector<ex> all = functions;
  for (const MapModel& step : map.steps)
    for (const auto* list : {&step.next, &step.next_domain})
      all.insert(all.end(), list->begin(), list->end());
  return all_generators(map.base, all, [](const Generator& g) { return g.kind == Kind::inverse; });
}

/// Whether the functions have values at the point and at those that the steps lead to from there.
bool have_values_along(const MapModel& map, const std::vector<ex>& functions, GiNaC::exmap point) {
  try {
    for (const MapModel& step : map.steps) {
      for (const auto* list : {&functions, &step.next_domain})
        for (const ex& f : *list) substituted(f, point, map.base.limits);
      std::vector<ex> next;
      for (const ex& value : step.next)
        next.push_back(substituted(value, point, map.base.limits).expand());
      for (std::size_t i = 0; i < next.size(); ++i) point[map.base.variables[i]] = next[i];
    }
    for (const ex& f : functions) substituted(f, point, map.base.limits);
  } catch (const GiNaC::pole_error&) {
    return false;
  }
  return true;
}

bool have_values_at_some_point(const MapModel& map, const std::vector<ex>& functions) {
  std::mt19937_64 random(17);
  const auto number = [&] {
    return GiNaC::numeric(1 + static_cast<long>(random() % 97),
                          1 + static_cast<long>(random() % 7));
  };
  constexpr int kTries = 10;
  for (int k = 0; k < kTries; ++k) {
    GiNaC::exmap point;
    for (const GiNaC::symbol& s : map.base.symbols()) point[s] = number();
    if (have_values_along(map, functions, std::move(point))) return true;
  }
  return false;
}

}  // namespace

bool have_values_between_steps(const MapModel& map, const std::vector<ex>& functions) {
  try {
    if (have_values_everywhere(map.base, functions)) return true;
    if (!are_rational(map, functions)) return false;
    Prover prover(map.base, functions, Subject::functions);
    return !thin_domain(prover) && have_values_at_some_point(map, functions);
  } catch (const ModelError&) {  // one of them has a value nowhere, or is too large to be looked at
    return false;
  }
}

}  // namespace casimir::discrete
