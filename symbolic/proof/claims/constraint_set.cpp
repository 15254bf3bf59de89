#include "symbolic/proof/claims/constraint_set.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>

#include "symbolic/algebra/exact_constant.hpp"
#include "symbolic/algebra/ideal.hpp"
#include "symbolic/algebra/zero_sets.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/proof/parameter_minors.hpp"
#include "symbolic/proof/special_parameters.hpp"

namespace casimir {
namespace {

/// The product of those irreducible factors that are wanted, each once.
Polynomial without_powers(const Polynomial& p,
                          const std::function<bool(const Polynomial&)>& is_wanted) {
  Polynomial product = p.ring().constant(1);
  for (const auto& [factor, power] : p.factors())
    if (is_wanted(factor)) product *= factor;
  return product;
}

PolynomialRows columns_of(const PolynomialRows& rows, const std::vector<std::size_t>& columns) {
  PolynomialRows result;
  for (const auto& row : rows) {
    auto& part = result.emplace_back();
    for (const std::size_t c : columns) part.push_back(row[c]);
  }
  return result;
}

/// Rows and columns of a minor of this size that is not zero at the point; fewer where none is
/// found.
PolynomialRows pivots(RealPoint& point, const PolynomialRows& matrix, std::size_t size) {
  PolynomialRows rows;
  for (const auto& row : matrix) {
    if (rows.size() == size) break;
    rows.push_back(row);
    if (point.rank(rows) < rows.size()) rows.pop_back();
  }
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; !rows.empty() && c < rows[0].size() && columns.size() < rows.size();
       ++c) {
    columns.push_back(c);
    if (point.rank(columns_of(rows, columns)) < columns.size()) columns.pop_back();
  }
  return columns.size() == rows.size() ? columns_of(rows, columns) : PolynomialRows{};
}

}  // namespace

std::size_t rank_at(RealPoint& point, const RankedRows& one) {
  return one.rank + (one.beyond.empty() ? 0 : point.rank(one.beyond));
}

ConstraintSet::ConstraintSet(Prover& prover) : prover_(prover) {
  for (const NamedExpression& constraint : prover.model().constraints) {
    numerators_.push_back(prover.ring().numerator(prover.convert(constraint.value)));
    reduced_.push_back(
        without_powers(numerators_.back(), [&](const Polynomial& f) { return has_variables(f); }));
    slopes_.push_back(prover.gradient(reduced_.back()));
  }
}

bool ConstraintSet::has_variables(const Polynomial& p) const {
  for (std::size_t v = 0; v < prover_.dimension(); ++v)
    if (p.uses(v)) return true;
  return false;
}

/// Nothing where it is not found out.
std::optional<bool> ConstraintSet::is_zero_at(const Polynomial& p, const RealPoint& point) const {
  GiNaC::exmap at;
  const auto& symbols = prover_.ring().symbols();
  for (std::size_t i = 0; i < symbols.size() && i < point.coordinates().size(); ++i)
    at[symbols[i]] = point.coordinates()[i];
  const GiNaC::ex function = prover_.ring().expression(p);
  const auto value = exact_constant(normal_form(substituted(function, at, prover_.model().limits)));
  return value ? std::optional(value->zero) : std::nullopt;
}

bool ConstraintSet::contains(const RealPoint& point) const {
  return std::ranges::all_of(reduced_, [&](const Polynomial& constraint) {
    return is_zero_at(constraint, point).value_or(false);
  });
}

bool ConstraintSet::are_polynomials(const PolynomialRows& rows) const {
  const std::size_t own = prover_.ring().symbols().size();
  return std::ranges::all_of(rows, [&](const std::vector<Polynomial>& row) {
    return std::ranges::all_of(row, [&](const Polynomial& p) {
      for (std::size_t place = own; place < p.ring().size(); ++place)
        if (p.uses(place)) return false;
      return true;
    });
  });
}

bool ConstraintSet::is_rational(const RealPoint& point) const {
  const std::size_t own = own_symbols(prover_.model());
  for (std::size_t i = 0; i < own; ++i) {
    const GiNaC::ex& x = point.coordinates()[i];
    if (!GiNaC::is_a<GiNaC::numeric>(x) || !GiNaC::ex_to<GiNaC::numeric>(x).is_rational())
      return false;
  }
  return true;
}

bool ConstraintSet::has_rank_everywhere(RealPoint& point, const RankedRows& one) const {
  const std::size_t rank = rank_at(point, one);
  if (rank == 0) return true;
  const PolynomialRows rows = pivots(point, one.rows, rank);
  if (rows.size() < rank) return false;
  const auto minor = short_determinant(rows, prover_.ring().ring());
  if (!minor) return false;
  std::vector<Polynomial> both = reduced_;
  both.push_back(without_powers(*minor, [](const Polynomial&) { return true; }));
  return has_codimension_above(reduced_.size(), both);
}

bool ConstraintSet::have_ranks_everywhere(RealPoint& point, std::vector<RankedRows> all) const {
  if (!are_polynomials({reduced_}) || point.rank(slopes_) < reduced_.size()) return false;
  for (RankedRows& one : all) {
    // What a row is divided by vanishes at none of its points.
    for (auto& row : one.rows) row = prover_.ring().common_numerators(std::move(row));
    if (!are_polynomials(one.rows)) return false;
  }
  return has_irreducible_zeros(reduced_, is_rational(point)) ||
         std::ranges::all_of(
             all, [&](const RankedRows& one) { return has_rank_everywhere(point, one); });
}

std::vector<std::string> ConstraintSet::needed_parameters_of(RealPoint& point,
                                                             const RankedRows& one) const {
  std::vector<std::string> conditions;
  const std::size_t rank = rank_at(point, one);
  if (prover_.model().parameters.empty() || rank == 0 || !are_polynomials({reduced_}))
    return conditions;
  const std::vector<Polynomial> basis = groebner_basis(reduced_);
  PolynomialRows rows = one.rows;
  for (auto& row : rows) {
    row = prover_.ring().common_numerators(std::move(row));
    if (!are_polynomials({row})) return conditions;
    std::vector<Polynomial> quotients;
    for (Polynomial& p : row) p = p.remainder(basis, &quotients);
  }
  conditions = needed_parameters(prover_, rows, rank);
  const PolynomialRows chosen = pivots(point, rows, rank);
  const auto minor = short_determinant(chosen, prover_.ring().ring());
  if (chosen.size() < rank || !minor || minor->is_constant()) return conditions;
  std::vector<Polynomial> both = reduced_;
  both.push_back(without_powers(*minor, [](const Polynomial&) { return true; }));
  add_values_at(both, conditions);
  add_singular_values(conditions);
  return conditions;
}

/// The parameters for which the equations have a solution, where polynomials in these alone say so.
void ConstraintSet::add_values_at(const std::vector<Polynomial>& equations,
                                  std::vector<std::string>& conditions) const {
  constexpr GroebnerLimits kLimits{200, 60, 2000};
  for (const Polynomial& p : groebner_basis(equations, kLimits)) {
    if (p.is_constant() || has_variables(p)) continue;
    for (const auto& [factor, power] : p.factors()) {
      if (factor.is_constant() || prover_.ring().is_nowhere_zero(factor)) continue;
      const std::string condition = prover_.ring().text(factor) + " != 0";
      if (std::ranges::find(conditions, condition) == conditions.end())
        conditions.push_back(condition);
    }
  }
}

void ConstraintSet::add_singular_values(std::vector<std::string>& conditions) const {
  constexpr std::size_t kMostMinors = 60;
  std::vector<char> taken(prover_.dimension());
  if (reduced_.size() > taken.size()) return;
  std::fill(taken.end() - static_cast<std::ptrdiff_t>(reduced_.size()), taken.end(), 1);
  std::vector<Polynomial> singular = reduced_;
  std::size_t minors = 0;
  do {
    if (++minors > kMostMinors) return;
    std::vector<std::size_t> columns;
    for (std::size_t c = 0; c < taken.size(); ++c)
      if (taken[c] != 0) columns.push_back(c);
    const auto minor = short_determinant(columns_of(slopes_, columns), prover_.ring().ring());
    if (!minor) return;
    if (!minor->is_zero()) singular.push_back(*minor);
  } while (std::ranges::next_permutation(taken).found);
  add_values_at(singular, conditions);
}

bool ConstraintSet::is_regular(RealPoint& point) const {
  if (point.rank(slopes_) == reduced_.size()) return true;
  if (!are_polynomials({reduced_})) return false;
  // Of three orthonormal vectors and a x b = c the last equations leave none of the others out;
  // the first ones have left-handed vectors as well.
  std::vector<std::size_t> order(reduced_.size());
  std::iota(order.begin(), order.end(), 0);
  for (int attempt = 0; attempt < 2; ++attempt, std::ranges::reverse(order)) {
    PolynomialRows rows;
    std::vector<Polynomial> own, others;
    for (const std::size_t i : order) {
      rows.push_back(slopes_[i]);
      const bool adds = point.rank(rows) == rows.size();
      if (!adds) rows.pop_back();
      // Factors that are not zero there leave the set as it is around the point.
      (adds ? own : others).push_back(without_powers(reduced_[i], [&](const Polynomial& f) {
        return is_zero_at(f, point).value_or(true);
      }));
    }
    const std::vector<Polynomial> basis = groebner_basis(own);
    std::vector<Polynomial> quotients;
    if (std::ranges::all_of(others, [&](const Polynomial& other) {
          return other.remainder(basis, &quotients).is_zero();
        }))
      return true;
  }
  return false;
}

bool ConstraintSet::makes_constant(const NamedExpression& f) const {
  const auto [top, bottom] = prover_.ring().lowest_terms(prover_.convert(f.value));
  if (has_variables(bottom) || !are_polynomials({{top, bottom}, numerators_})) return false;
  std::vector<Polynomial> quotients;
  return !has_variables(top.remainder(groebner_basis(numerators_), &quotients));
}

}  // namespace casimir
