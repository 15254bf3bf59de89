#include "symbolic/discrete/map_jacobian.hpp"

#include "symbolic/discrete/minors.hpp"

namespace casimir::discrete {

std::vector<std::vector<Polynomial>> jacobian(Prover& prover, const MapModel& map) {
  std::vector<std::vector<Polynomial>> rows;
  for (const GiNaC::ex& value : map.next) rows.push_back(prover.gradient(prover.convert(value)));
  return rows;
}

Polynomial determinant(const PolynomialRing& ring,
                       const std::vector<std::vector<Polynomial>>& matrix) {
  const auto minors = maximal_minors(
      matrix, ring.constant(1), [](const Polynomial& a, const Polynomial& b) { return a * b; });
  const auto all = minors.find((1U << matrix.size()) - 1);
  return all == minors.end() ? Polynomial(ring) : all->second;
}

GiNaC::ex jacobian_determinant(const MapModel& map) {
  std::vector<std::vector<GiNaC::ex>> rows;
  for (const GiNaC::ex& value : map.next) {
    auto& row = rows.emplace_back();
    for (const GiNaC::symbol& x : map.base.variables) row.push_back(value.diff(x));
  }
  const auto minors = maximal_minors(rows, GiNaC::ex(1),
                                     [](const GiNaC::ex& a, const GiNaC::ex& b) { return a * b; });
  const auto all = minors.find((1U << rows.size()) - 1);
  return all == minors.end() ? GiNaC::ex(0) : all->second;
}

}  // namespace casimir::discrete
