#include "symbolic/claims/claim.hpp"

namespace casimir {

std::vector<GiNaC::ex> values_of(const std::vector<NamedExpression>& functions) {
  std::vector<GiNaC::ex> values;
  for (const NamedExpression& f : functions) values.push_back(f.value);
  return values;
}

std::vector<GiNaC::ex> values_of(const std::vector<NamedExpression>& functions,
                                 const GiNaC::ex& more) {
  std::vector<GiNaC::ex> values = values_of(functions);
  values.push_back(more);
  return values;
}

}  // namespace casimir
