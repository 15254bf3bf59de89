#include "symbolic/search/generic_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/error.hpp"

namespace casimir::search {

void check_parameters_are_free(const Model& model) {
  for (const Assumption& a : model.assumptions) {
    const bool of_parameters =
        std::none_of(model.variables.begin(), model.variables.end(),
                     [&](const GiNaC::symbol& x) { return GiNaC::has(a.difference, x); });
    if (a.comparison == Comparison::equal && of_parameters) {
      throw ModelError(fmt::format(
          "this is about generic parameters, but '{}' is assumed: give numbers to them", a.text));
    }
  }
}

}  // namespace casimir::search
