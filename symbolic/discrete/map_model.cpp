#include "symbolic/discrete/map_model.hpp"

#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"

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

}  // namespace casimir
