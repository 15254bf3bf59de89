// What facts about independence and ranks have in common.
#include "symbolic/proof/claims/ranks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <random>

#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/model/given_functions.hpp"

namespace casimir {

std::vector<NamedExpression> with_hamiltonian(const Model& model,
                                              std::vector<NamedExpression> functions) {
  if (model.hamiltonian && !model.time) functions.push_back(hamiltonian_of(model));
  functions.insert(functions.end(), model.integrals.begin(), model.integrals.end());
  return functions;
}

std::string listed(const std::vector<NamedExpression>& functions) {
  return fmt::format("{}", fmt::join(names_of(functions), ", "));
}

PolynomialRows gradients(Prover& prover, const std::vector<NamedExpression>& functions) {
  PolynomialRows rows;
  for (const NamedExpression& f : functions)
    rows.push_back(prover.gradient(prover.convert(f.value)));
  return rows;
}

void say_where(Proof& proof, const std::string& where, const std::vector<std::string>& nonzero) {
  if (!where.empty()) proof.where.push_back(where);
  for (const std::string& condition : nonzero) {
    if (std::find(proof.where.begin(), proof.where.end(), condition) == proof.where.end())
      proof.where.push_back(condition);
  }
}

std::optional<std::vector<NamedExpression>> dependent(const std::vector<NamedExpression>& functions,
                                                      const PolynomialRows& rows,
                                                      std::vector<RealPoint>& points) {
  std::vector<NamedExpression> result;
  PolynomialRows chosen;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    PolynomialRows more = chosen;
    more.push_back(rows[i]);
    const auto adds = [&](RealPoint& point) { return point.rank(more) > chosen.size(); };
    const auto count = std::ranges::count_if(points, adds);
    if (count != 0 && static_cast<std::size_t>(count) != points.size()) return std::nullopt;
    if (count != 0)
      chosen = std::move(more);
    else
      result.push_back(functions[i]);
  }
  return result;
}

/// Theorem: a minor of polynomials in the variables alone is not zero almost everywhere where it is
/// not zero at one point. Columns with anything else are left out: that makes ranks smaller only.
bool are_always_independent(const Prover& prover, const PolynomialRows& rows) {
  if (!has_arbitrary_functions(prover.model()) || rows.empty()) return false;
  const std::size_t dimension = prover.dimension(), places = prover.ring().ring().size();
  std::mt19937_64 random(11);
  std::vector<cln::cl_RA> point(places, 0);
  for (std::size_t i = 0; i < dimension; ++i) point[i] = static_cast<long>(random() % 1000) + 1;
  RationalMatrix values(rows.size());
  for (std::size_t j = 0; j < rows[0].size(); ++j) {
    const bool plain = std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
      for (std::size_t place = dimension; place < places; ++place)
        if (row[j].uses(place)) return false;
      return true;
    });
    for (std::size_t i = 0; i < rows.size() && plain; ++i)
      values[i].push_back(rows[i][j].evaluate(point));
  }
  return !values[0].empty() && rank(values) == rows.size();
}

namespace {

PolynomialRows structure_matrix(Prover& prover) {
  PolynomialRows rows;
  for (std::size_t i = 0; i < prover.dimension(); ++i) {
    rows.emplace_back();
    for (std::size_t j = 0; j < prover.dimension(); ++j)
      rows.back().push_back(prover.bracket_entry(i, j));
  }
  return rows;
}

}  // namespace

/// The gradients of Casimir functions span its kernel.
std::optional<GenericRank> bracket_rank(Prover& prover) {
  return rank_with_conditions(prover, structure_matrix(prover), [&] {
    std::vector<KernelCandidate> candidates;
    for (auto& slope : gradients(prover, real_everywhere(prover.model().casimirs)))
      candidates.push_back({std::move(slope)});
    return candidates;
  });
}

}  // namespace casimir
