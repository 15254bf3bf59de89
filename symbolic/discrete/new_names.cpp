#include "symbolic/discrete/new_names.hpp"

#include <fmt/format.h>

namespace casimir::discrete {

NewNames::NewNames(const Model& model) : taken_{"H"} {
  for (const auto* list : {&model.variables, &model.parameters}) {
    for (const GiNaC::symbol& s : *list) taken_.insert(s.get_name());
  }
  for (const auto* list : {&model.definitions, &model.casimirs, &model.integrals}) {
    for (const NamedExpression& f : *list) taken_.insert(f.name);
  }
  for (const auto& [parameter, value] : model.fixed) taken_.insert(parameter.value);
}

std::string NewNames::take(const std::vector<std::string>& wanted) {
  for (const std::string& name : wanted) {
    if (taken_.insert(name).second) return name;
  }
  for (int i = 1;; ++i) {
    const std::string name = fmt::format("{}{}", wanted.front(), i);
    if (taken_.insert(name).second) return name;
  }
}

}  // namespace casimir::discrete
