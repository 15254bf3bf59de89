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

PolynomialRows taken(const PolynomialRows& rows, const std::vector<std::size_t>& columns) {
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
    if (point.rank(taken(rows, columns)) < columns.size()) columns.pop_back();
  }
  return columns.size() == rows.size() ? taken(rows, columns) : PolynomialRows{};
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
