#include "symbolic/proof/parameter_sets.hpp"

#include <algorithm>

namespace casimir {

Polynomial ParameterEquations::reduced(Polynomial p) const {
  for (const auto& [place, value] : values) {
    if (!p.uses(place)) continue;
    if (value.is_zero()) {
      p = p.coefficients(place)[0];
      continue;
    }
    Polynomial sum(p.ring()), power = p.ring().constant(1);
    for (const Polynomial& c : p.coefficients(place)) {
      sum += c * power;
      power *= value;
    }
    p = std::move(sum);
  }
  return p;
}

std::vector<ParameterForm> parameter_forms(const PolynomialRing& ring,
                                           const std::vector<std::size_t>& places) {
  std::vector<ParameterForm> result;
  for (const std::size_t p : places) {
    const Polynomial v = ring.variable(p);
    result.push_back({v, p, std::nullopt});
    for (const std::size_t q : places)
      if (q < p) result.push_back({v - ring.variable(q), p, q});
  }
  return result;
}

std::optional<ParameterEquations> solved_for_parameters(const std::vector<Polynomial>& forms,
                                                        const std::vector<std::size_t>& places) {
  ParameterEquations set{forms};
  for (const Polynomial& form : forms) {
    const Polynomial own = set.reduced(form);
    if (own.is_zero()) continue;
    if (own.total_degree() != 1) return std::nullopt;
    const auto place = std::find_if(places.begin(), places.end(),
                                    [&](std::size_t p) { return own.degree(p) == 1; });
    if (place == places.end()) return std::nullopt;
    const std::vector<Polynomial> parts = own.coefficients(*place);
    const Polynomial value = parts[0].scaled(-1 / parts[1].term_list()[0].first);
    const ParameterEquations latest{{}, {{*place, value}}};
    for (auto& [earlier, old] : set.values) old = latest.reduced(old);
    set.values.emplace_back(*place, value);
  }
  return set;
}

bool may_all_vanish(const ParameterForm& a, const ParameterForm& b,
                    const std::vector<std::size_t>& places, const PolynomialRing& ring,
                    const std::vector<MinorModulo>& minors) {
  std::vector<std::uint64_t> point(ring.size());
  for (std::size_t i = 0; i < point.size(); ++i) point[i] = 7 * i + 3;
  const auto wanted = [&](const ParameterForm& form) {
    return form.equal_to ? point[*form.equal_to] : 0;
  };
  // Twice, since the second form may change what the first one has set.
  for (const ParameterForm* form : {&a, &b, &a, &b}) {
    const std::uint64_t value = wanted(*form), known = point[form->place];
    for (const std::size_t p : places)
      if (p == form->place || (value == 0 && point[p] == known)) point[p] = value;
  }
  if (point[a.place] != wanted(a) || point[b.place] != wanted(b)) return true;
  return std::none_of(minors.begin(), minors.end(),
                      [&](const MinorModulo& minor) { return minor.is_nonzero_at(point); });
}

}  // namespace casimir
