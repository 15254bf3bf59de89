#include "symbolic/proof/claims/on_constraints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <span>

#include "symbolic/error.hpp"

namespace casimir {
namespace {

std::optional<RealPoint> admitted(Prover& prover, std::vector<GiNaC::ex> coordinates) {
  try {
    RealPoint point = prover.real_points().at(std::move(coordinates));
    if (prover.real_points().admits(point, prover.domain())) return point;
  } catch (const NotCertified&) {
  }
  return std::nullopt;
}

/// Looks at exact points of the constraints until one is enough: initial states of scenes, which
/// may be rounded ones, then others of a level.
/// \return  whether there was any
bool look_at_points(Prover& prover, const ConstraintSet& constraints,
                    const std::function<bool(RealPoint&)>& is_enough) {
  bool any = false;
  const auto ends = [&](RealPoint& point) {
    any = true;
    try {
      return is_enough(point);
    } catch (const NotCertified&) {
      return false;
    }
  };
  for (std::vector<GiNaC::ex>& scene : prover.real_points().scenes()) {
    auto point = admitted(prover, std::move(scene));
    if (point && constraints.contains(*point) && ends(*point)) return true;
  }
  const Level& level = prover.level(prover.model().constraints);
  constexpr int kPoints = 3;
  for (int i = 0; i < kPoints; ++i) {
    auto point = prover.exact_point(level);
    if (!point || (constraints.contains(*point) && ends(*point))) break;
  }
  return any;
}

/// The scene that begins at the point, or else its coordinates.
std::string name_of(const Model& model, const RealPoint& point) {
  const auto& coordinates = point.coordinates();
  for (const Scene& scene : model.scenes) {
    if (scene.initial.size() != model.variables.size()) continue;
    if (std::ranges::equal(scene.initial, std::span(coordinates).first(scene.initial.size()),
                           [](const auto& a, const auto& b) { return a.is_equal(b); }))
      return fmt::format("the scene '{}'", printable(scene.name));
  }
  return point.text();
}

/// Leaves a proof undecided, unless these matrices have their ranks at an exact point of the
/// constraints; where that does not speak for all of them, says of which part it does.
void require(Prover& prover, Proof& proof, const ConstraintSet& constraints,
             const std::vector<RankedRows>& all) {
  std::string part;
  bool of_all = false;
  std::vector<std::string> needed;
  const bool any = look_at_points(prover, constraints, [&](RealPoint& point) {
    for (const RankedRows& one : all) {
      if (point.rank(one.rows) < rank_at(point, one)) return false;
      // At the cusp of v^2 = u^3 no gradient is that of the constraint, and u and v are dependent.
      if (!one.beyond.empty() && !constraints.is_regular(point)) return false;
    }
    if (part.empty()) {
      part = name_of(prover.model(), point);
      for (const RankedRows& one : all)
        for (std::string& condition : constraints.needed_parameters_of(point, one))
          needed.push_back(std::move(condition));
    }
    of_all = constraints.have_ranks_everywhere(point, all);
    return of_all;
  });
  if (!part.empty()) say_where(proof, "", needed);
  if (of_all) return;
  if (!part.empty()) {
    // The parts are those of the space of both.
    const char* who =
        prover.model().parameters.empty() ? "the state is" : "state and parameters are";
    say_where(proof, fmt::format("{} on the part of the constraints with {}", who, part));
    return;
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

}  // namespace

void require_on_constraints(Prover& prover, Proof& proof, const std::vector<RankedRows>& all) {
  if (may_be_asked(prover, proof)) require(prover, proof, ConstraintSet(prover), all);
}

void require_independence_on_constraints(Prover& prover, Proof& proof,
                                         const std::vector<NamedExpression>& functions) {
  if (!may_be_asked(prover, proof)) return;
  const ConstraintSet constraints(prover);
  std::vector<NamedExpression> varying = functions;
  std::erase_if(varying, [&](const NamedExpression& f) { return constraints.makes_constant(f); });
  PolynomialRows together = constraints.slopes();
  for (auto& slope : gradients(prover, varying)) together.push_back(std::move(slope));
  require(prover, proof, constraints,
          {{gradients(prover, functions), functions.size()},
           {std::move(together), varying.size(), constraints.slopes()}});
}

void require_local_inverse_on_constraints(
    Prover& prover, Proof& proof, const std::vector<PolynomialRows>& derivatives,
    const std::function<PolynomialRows(const PolynomialRows&)>& slopes_at) {
  if (!may_be_asked(prover, proof)) return;
  const ConstraintSet constraints(prover);
  std::vector<RankedRows> all{{slopes_at(constraints.slopes()), 0, constraints.slopes()}};
  for (const PolynomialRows& rows : derivatives) {
    PolynomialRows together = constraints.slopes();
    together.insert(together.end(), rows.begin(), rows.end());
    all.push_back({std::move(together), prover.dimension()});
  }
  require(prover, proof, constraints, all);
}

void decide_within_constraints(Prover& prover, Proof& proof, const std::vector<NamedExpression>& on,
                               const DecideOnLevel& decide,
                               const std::function<bool(const Proof&)>& is_open) {
  const Proof blank = proof;
  decide(proof, on);
  if (!is_open(proof)) return;
  const std::vector<NamedExpression> within = prover.within_constraints(on);
  if (within.size() == on.size()) return;
  Proof there = blank;
  decide(there, within);
  if (there.verdict == Verdict::proved) there.on = names_of(within);
  proof = std::move(there);
}

bool is_open_on_constraints(const Prover& prover, const Proof& proof) {
  return proof.verdict == Verdict::undecided && prover.holds_on_constraints();
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
