#include "symbolic/discrete/map_claim_parts.hpp"

#include <algorithm>
#include <utility>

namespace casimir::discrete {

Residual difference(Prover& prover, std::string label, const GiNaC::ex& value) {
  return {std::move(label), prover.convert(value), [value] { return value; }};
}

std::vector<GiNaC::ex> domain_of(const MapModel& map,
                                 const std::vector<NamedExpression>& functions) {
  std::vector<GiNaC::ex> result = map.next;
  result.insert(result.end(), map.next_domain.begin(), map.next_domain.end());
  for (const GiNaC::ex& value : values_of(functions)) {
    result.push_back(value);
    result.push_back(map.composed(value));
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
