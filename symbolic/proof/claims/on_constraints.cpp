#include "symbolic/proof/claims/on_constraints.hpp"

#include <algorithm>

namespace casimir {
namespace {

using Condition = std::function<bool(RealPoint&)>;

bool holds_at(RealPoint& point, const Condition& condition) {
  try {
    return condition(point);
  } catch (const NotCertified&) {
    return false;
  }
}

std::optional<RealPoint> admitted(Prover& prover, std::vector<GiNaC::ex> coordinates) {
  try {
    RealPoint point = prover.real_points().at(std::move(coordinates));
    if (prover.real_points().admits(point, prover.domain())) return point;
  } catch (const NotCertified&) {
  }
  return std::nullopt;
}

/// Leaves a proof undecided, unless the condition holds at an exact point of the constraints.
void require(Prover& prover, Proof& proof, const Condition& condition) {
  const std::vector<NamedExpression>& constraints = prover.model().constraints;
  bool any = false;
  for (std::vector<GiNaC::ex>& scene : prover.real_points().scenes()) {
    auto point = admitted(prover, std::move(scene));
    any = any || point;
    if (point && holds_at(*point, condition)) return;
  }
  const Level& level = prover.level(constraints);
  constexpr int kPoints = 3;
  for (int i = 0; i < kPoints; ++i) {
    auto point = prover.exact_point(level);
    any = any || point;
    if (!point) break;
    if (holds_at(*point, condition)) return;
  }
  proof.verdict = Verdict::undecided;
  proof.evidence.clear();
  proof.where.clear();
  proof.nonzero.clear();
  proof.reason = any ? "it is so outside of the constraints; at the points of the constraints that "
                       "were tried the rank is smaller"
                     : "it is so outside of the constraints, of which no exact point was found";
}

bool may_be_asked(const Prover& prover, const Proof& proof) {
  return proof.verdict == Verdict::proved && !prover.model().constraints.empty();
}

PolynomialRows joined(PolynomialRows rows, const PolynomialRows& more) {
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

}  // namespace

void require_on_constraints(Prover& prover, Proof& proof, const std::vector<RankedRows>& all) {
  if (!may_be_asked(prover, proof)) return;
  require(prover, proof, [&](RealPoint& point) {
    return std::ranges::all_of(
        all, [&](const RankedRows& one) { return point.rank(one.rows) >= one.rank; });
  });
}

void require_independence_on_constraints(Prover& prover, Proof& proof,
                                         const PolynomialRows& slopes) {
  if (!may_be_asked(prover, proof)) return;
  const PolynomialRows constraints = gradients(prover, prover.model().constraints);
  require(prover, proof, [&](RealPoint& point) {
    if (point.rank(slopes) < slopes.size()) return false;
    const std::size_t own = point.rank(constraints);
    PolynomialRows all = constraints;
    std::size_t varying = 0;
    for (const auto& slope : slopes) {
      if (point.rank(joined(constraints, {slope})) == own) continue;  // constant on them
      all.push_back(slope);
      ++varying;
    }
    return point.rank(all) == own + varying;
  });
}

PolynomialRows structure_rows(const Prover& prover) {
  PolynomialRows rows;
  for (std::size_t i = 0; i < prover.dimension(); ++i) {
    auto& row = rows.emplace_back();
    for (std::size_t j = 0; j < prover.dimension(); ++j) row.push_back(prover.bracket_entry(i, j));
  }
  return rows;
}

}  // namespace casimir
