#include "symbolic/proof/claims/claim.hpp"

#include <algorithm>

namespace casimir {

std::vector<GiNaC::ex> values_of(const std::vector<NamedExpression>& functions) {
  std::vector<GiNaC::ex> values;
  for (const NamedExpression& f : functions) {
    values.push_back(f.value);
    values.insert(values.end(), f.domain.begin(), f.domain.end());
  }
  return values;
}

std::vector<GiNaC::ex> values_of(const std::vector<NamedExpression>& functions,
                                 const NamedExpression& more) {
  std::vector<NamedExpression> all = functions;
  all.push_back(more);
  return values_of(all);
}

std::vector<NamedExpression> real_everywhere(const std::vector<NamedExpression>& functions) {
  std::vector<NamedExpression> result;
  for (const NamedExpression& f : functions) {
    bool polynomial = f.domain.empty();
    for (auto part = f.value.preorder_begin(); part != f.value.preorder_end(); ++part) {
      const bool whole =
          GiNaC::is_a<GiNaC::power>(*part) && part->op(1).info(GiNaC::info_flags::nonnegint);
      polynomial =
          polynomial &&
          (GiNaC::is_a<GiNaC::power>(*part) ? whole : !GiNaC::is_a<GiNaC::function>(*part));
    }
    if (polynomial) result.push_back(f);
  }
  return result;
}

std::string hamiltonian_name(const Model& model) {
  const auto is_H = [](const auto& symbol) { return symbol.get_name() == "H"; };
  const bool taken =
      std::any_of(model.variables.begin(), model.variables.end(), is_H) ||
      std::any_of(model.parameters.begin(), model.parameters.end(), is_H) ||
      (model.time && is_H(*model.time)) ||
      std::any_of(model.fixed.begin(), model.fixed.end(),
                  [](const auto& parameter) { return parameter.first.value == "H"; }) ||
      std::any_of(model.definitions.begin(), model.definitions.end(), [&](const auto& f) {
        return f.name == "H" && !f.value.is_equal(*model.hamiltonian);
      });
  return taken ? "the Hamiltonian" : "H";
}

NamedExpression hamiltonian_of(const Model& model) {
  return {hamiltonian_name(model), *model.hamiltonian, {}, model.domain};
}

}  // namespace casimir
