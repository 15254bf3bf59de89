#include "tools/analysis/run/exact_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <string>

#include "symbolic/expression/elliptic.hpp"
#include "tools/analysis/error.hpp"

namespace casimir {
namespace {

/// The names of the elliptic functions that occur in an expression.
void add_elliptic_names(const GiNaC::ex& expression, std::set<std::string>& names) {
  if (!has_elliptic_function(expression)) return;
  for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part)
    if (GiNaC::is_a<GiNaC::function>(*part) &&
        is_elliptic_function(GiNaC::ex_to<GiNaC::function>(*part)))
      names.insert(GiNaC::ex_to<GiNaC::function>(*part).get_name());
}

}  // namespace

void require_exact_values(const Model& model, const Scene& scene, const char* what) {
  std::vector<GiNaC::ex> all = model.field;
  if (model.hamiltonian) all.push_back(*model.hamiltonian);
  for (const auto* functions : {&model.casimirs, &model.integrals})
    for (const NamedExpression& f : *functions) all.push_back(f.value);
  for (const auto* values : {&scene.initial, &scene.parameters})
    all.insert(all.end(), values->begin(), values->end());
  std::set<std::string> names;
  for (const GiNaC::ex& one : all) add_elliptic_names(one, names);
  if (!names.empty())
    throw RequestError(fmt::format(
        "'{}' has the elliptic function{} {}, whose generated code is exact to double precision "
        "alone: {} is refused",
        model.name, names.size() > 1 ? "s" : "", fmt::join(names, ", "), what));
}

}  // namespace casimir
