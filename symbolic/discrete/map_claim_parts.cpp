#include "symbolic/discrete/map_claim_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace casimir::discrete {

Residual difference(Prover& prover, std::string label, const GiNaC::ex& value) {
  return {std::move(label), prover.convert(value), [value] { return value; }};
}

std::vector<Residual> level_images(Prover& prover, const MapModel& map,
                                   const std::vector<NamedExpression>& level) {
  std::vector<Residual> residuals;
  for (const NamedExpression& f : level)
    residuals.push_back(
        difference(prover, fmt::format("{} at the next point", f.name), map.composed(f.value)));
  return residuals;
}

void append(std::vector<GiNaC::ex>& list, const std::vector<GiNaC::ex>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

std::vector<GiNaC::ex> domain_of(const MapModel& map,
                                 const std::vector<NamedExpression>& functions) {
  std::vector<GiNaC::ex> result = map.next;
  append(result, map.next_domain);
  for (const GiNaC::ex& value : values_of(functions)) {
    result.push_back(value);
    append(result, map.composed_with_parts(value));
  }
  return result;
}

Claim or_without_value(ClaimKind kind, const std::string& name,
                       const std::function<Claim()>& claim) {
  try {
    return claim();
  } catch (const GiNaC::pole_error&) {
    Claim result{kind, name, false, [](Prover& /*prover*/, Proof& proof) {
                   proof.reason = "it has no value wherever the map leads: a denominator is zero";
                 }};
    result.subject = Subject::functions;
    return result;
  }
}

void add_conditions(Proof& proof, const std::vector<std::string>& conditions) {
  for (const std::string& condition : conditions)
    if (std::ranges::find(proof.where, condition) == proof.where.end())
      proof.where.push_back(condition);
}

}  // namespace casimir::discrete
