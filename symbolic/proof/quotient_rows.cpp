#include "symbolic/proof/quotient_rows.hpp"

#include <algorithm>

namespace casimir {
namespace {

bool is_open(const Prover& prover) {
  if (!prover.model().constraints.empty()) return false;
  const FunctionRing& ring = prover.ring();
  for (std::size_t g = ring.symbols().size(); g < ring.end_of_generators(); ++g)
    if (ring.origin(g).kind != FunctionRing::Origin::Kind::inverse) return false;
  return std::ranges::all_of(prover.model().assumptions, [](const Assumption& a) {
    return a.comparison == Comparison::greater || a.comparison == Comparison::less ||
           a.comparison == Comparison::unequal;
  });
}

}  // namespace

std::vector<bool> used_variables(const PolynomialRows& rows) {
  std::vector<bool> used;
  for (const auto& row : rows) {
    for (const Polynomial& p : row) {
      if (p.is_constant()) continue;
      used.resize(p.ring().size());
      for (std::size_t i = 0; i < used.size(); ++i) used[i] = used[i] || p.uses(i);
    }
  }
  return used;
}

bool has_generators(const FunctionRing& ring, const std::vector<Polynomial>& row) {
  const std::vector<bool> used = used_variables({row});
  return std::find(used.begin() +
                       static_cast<std::ptrdiff_t>(std::min(used.size(), ring.symbols().size())),
                   used.end(), true) != used.end();
}

std::optional<std::vector<Polynomial>> clear_denominators(const FunctionRing& ring,
                                                          PolynomialRows& rows) {
  std::optional<std::vector<Polynomial>> denominators;
  for (std::vector<Polynomial>& row : rows) {
    if (!has_generators(ring, row)) continue;
    if (!denominators) denominators.emplace();
    for (const Polynomial& p : row) {
      const Polynomial bottom = ring.lowest_terms(p).second;
      for (const auto& [f, exponent] : bottom.factors())
        if (!f.is_constant()) denominators->push_back(f);
    }
    row = ring.common_numerators(std::move(row));
  }
  return denominators;
}

QuotientsModulo::QuotientsModulo(const Prover& prover, const PolynomialRows& numerators,
                                 const std::vector<Polynomial>& denominators) {
  const auto others = [&](const auto& row) { return has_generators(prover.ring(), row); };
  if (!is_open(prover) || others(denominators) || std::ranges::any_of(numerators, others)) return;
  numerators_.emplace(numerators);
  for (const Polynomial& d : denominators) denominators_.emplace_back(PolynomialRows{{d}});
}

bool QuotientsModulo::have_rank(std::size_t rank, const std::vector<GiNaC::ex>& point) const {
  return numerators_ && numerators_->rank_at(point) >= rank &&
         std::ranges::all_of(denominators_,
                             [&](const MatrixModulo& d) { return d.rank_at(point) == 1; });
}

}  // namespace casimir
