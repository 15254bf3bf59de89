#include "symbolic/discrete/map_model.hpp"

#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/model/given_functions.hpp"

namespace casimir {

GiNaC::exmap MapModel::image() const {
  GiNaC::exmap result;
  for (std::size_t i = 0; i < next.size(); ++i) result[base.variables[i]] = next[i];
  return result;
}

GiNaC::ex MapModel::composed(const GiNaC::ex& f) const {
  return substituted(f, image(), base.limits);
}

std::vector<GiNaC::ex> MapModel::composed_with_parts(const GiNaC::ex& f) const {
  return substituted_with_parts(f, image(), base.limits);
}

Model MapModel::as_field() const {
  Model model = base;
  model.poisson.reset();
  model.frame.reset();
  model.linear_bracket = false;
  model.field = next;
  model.domain = next_domain;
  return model;
}

MapModel with_functions(const MapModel& map, const GivenFunctions& given) {
  MapModel result = map;
  result.base = with_functions(map.base, given);
  const auto put = [&](std::vector<GiNaC::ex>& values, std::vector<GiNaC::ex>& domain) {
    for (GiNaC::ex& part : domain) part = given.put(part);
    for (GiNaC::ex& value : values) given.put_into(value, domain);
  };
  put(result.next, result.next_domain);
  for (MapSymmetry& symmetry : result.symmetries) {
    put(symmetry.variables, symmetry.domain);
    // The function itself is none of the parameters any longer.
    std::vector<GiNaC::ex> kept;
    for (std::size_t i = 0; i < symmetry.parameters.size(); ++i)
      if (!function_name(map.base.parameters[i].get_name())) kept.push_back(symmetry.parameters[i]);
    symmetry.parameters = std::move(kept);
    put(symmetry.parameters, symmetry.domain);
  }
  for (MapConjugacy& conjugacy : result.conjugacies) {
    put(conjugacy.expressions, conjugacy.domain);
    put(conjugacy.map, conjugacy.map_domain);
  }
  for (MapModel& step : result.steps) step = with_functions(step, given);
  return result;
}

}  // namespace casimir
