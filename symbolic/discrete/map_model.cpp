#include "symbolic/discrete/map_model.hpp"

#include "symbolic/expression/expression_size.hpp"

namespace casimir {

GiNaC::ex MapModel::composed(const GiNaC::ex& f) const {
  GiNaC::exmap image;
  for (std::size_t i = 0; i < next.size(); ++i) image[base.variables[i]] = next[i];
  return substituted(f, image, base.limits);
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
