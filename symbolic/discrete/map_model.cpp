#include "symbolic/discrete/map_model.hpp"

#include "symbolic/expression/expression_size.hpp"

namespace casimir {

GiNaC::ex MapModel::composed(const GiNaC::ex& f) const {
  GiNaC::exmap image;
  for (std::size_t i = 0; i < next.size(); ++i) image[base.variables[i]] = next[i];
  return substituted(f, image);
}

}  // namespace casimir
