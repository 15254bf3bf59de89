#include "symbolic/structure/separate/commuting_integrals.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/search/search.hpp"

namespace casimir::structure {
namespace {

constexpr int kHighestOfCasimirs = 2;

/// The flows {x_i, f} of some functions, as rows.
PolynomialRows flows_of(const Leaves& leaves, const std::vector<Polynomial>& functions) {
  PolynomialRows rows;
  for (const Polynomial& f : functions) {
    rows.emplace_back();
    for (std::size_t i = 0; i < leaves.dimension(); ++i)
      rows.back().push_back(leaves.bracket(leaves.ring().variable(i), f));
  }
  return rows;
}

/// Whether the coordinates are those of a point of the level; exact numbers only.
bool is_on_level(Leaves& leaves, RealPoint& point) {
  return std::ranges::all_of(leaves.on(), [&](const NamedExpression& f) {
    const auto value = point.evaluator().exact(f.value);
    return value && cln::zerop(*value);
  });
}

/// What a search up to the degree of the request finds. Where that is too large it is said which
/// one, as its degree is not that of the bivectors that were asked for.
std::vector<search::Found> found_by(const Model& model, const search::Request& request,
                                    const search::Watch& watch) {
  const auto named = [&](const std::exception& problem) {
    return fmt::format("the search for {} up to degree {}, which this needs, is too large: {}",
                       request.casimirs ? "Casimir functions" : "integrals", request.degree,
                       problem.what());
  };
  try {
    return search::find_integrals(model, request, watch).found;
  } catch (const search::TooMuchWork& problem) {
    throw search::TooMuchWork(named(problem));
  } catch (const search::TooMuchMemory& problem) {
    throw search::TooMuchMemory(named(problem));
  }
}

}  // namespace

std::vector<GiNaC::ex> possible_integrals(const Model& model, const std::vector<Text>& on,
                                          int degree, const search::Watch& watch) {
  std::vector<GiNaC::ex> result{*model.hamiltonian};
  for (const NamedExpression& f : model.integrals) result.push_back(f.value);
  for (const LevelClaim& f : model.conditionals) result.push_back(f.expression.value);
  if (degree == 0) return result;
  search::Request request;
  request.degree = degree;
  request.on = on;
  for (const search::Found& found : found_by(model, request, watch))
    if (found.independent) result.push_back(found.value);
  return result;
}

std::vector<GiNaC::ex> possible_casimirs(const Model& model, const search::Watch& watch) {
  std::vector<GiNaC::ex> result;
  for (const NamedExpression& f : model.casimirs) result.push_back(f.value);
  search::Request request;
  request.degree = kHighestOfCasimirs;
  request.casimirs = true;
  for (const search::Found& found : found_by(model, request, watch)) result.push_back(found.value);
  return result;
}

std::vector<RealPoint> points_of(Leaves& leaves, std::size_t count) {
  Prover& prover = leaves.system().prover();
  RealPoints& real = prover.real_points();
  std::vector<RealPoint> result;
  const auto take = [&](RealPoint point) {
    try {
      if (real.admits(point, prover.domain()) && point.evaluator().smooth() &&
          is_on_level(leaves, point))
        result.push_back(std::move(point));
    } catch (const NotCertified&) {
      // Another point may do.
    }
  };
  for (const std::vector<GiNaC::ex>& scene : real.scenes()) {
    try {
      take(real.at(scene));
    } catch (const NotCertified&) {
      continue;
    }
  }
  const Level& level = prover.level(leaves.on());
  for (std::size_t k = 0; k < count; ++k) {
    std::optional<RealPoint> point =
        leaves.on().empty() ? real.random(prover.domain()) : prover.exact_point(level);
    if (!point) break;
    take(std::move(*point));
  }
  return result;
}

std::vector<std::vector<Polynomial>> commuting_choices(const Leaves& leaves,
                                                       const std::vector<Polynomial>& functions,
                                                       std::vector<RealPoint>& points,
                                                       std::size_t most) {
  const std::size_t n = leaves.degrees_of_freedom();
  std::vector<std::vector<Polynomial>> result;
  // Extends a list by later functions, as long as all of them commute and are independent.
  const std::function<void(std::vector<Polynomial>, std::size_t)> extend =
      [&](std::vector<Polynomial> list, std::size_t next) {
        if (list.size() == n) {
          if (result.size() < most) result.push_back(std::move(list));
          return;
        }
        for (std::size_t k = next; k < functions.size() && result.size() < most; ++k) {
          std::vector<Polynomial> longer = list;
          longer.push_back(functions[k]);
          const bool commute = std::ranges::all_of(list, [&](const Polynomial& f) {
            return leaves.vanishes(leaves.bracket(f, functions[k]));
          });
          const auto independent_at = [&](RealPoint& point) {
            try {
              return point.rank(flows_of(leaves, longer)) == longer.size();
            } catch (const NotCertified&) {
              return false;
            }
          };
          if (commute && std::ranges::any_of(points, independent_at)) extend(longer, k + 1);
          if (k == 0) break;  // the Hamiltonian is always one of them
        }
      };
  extend({}, 0);
  return result;
}

}  // namespace casimir::structure
