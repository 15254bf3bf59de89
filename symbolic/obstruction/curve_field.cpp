#include "symbolic/obstruction/curve_field.hpp"

#include <cln/integer.h>
#include <fmt/format.h>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

template <class F>
void add_to(CurveElement<F>& sum, unsigned roots, const F& value) {
  F& own = sum[roots];
  own = own + value;
  if (own.is_zero()) sum.erase(roots);
}

std::string first_letters(const GiNaC::ex& expression) {
  return expression_text(expression).substr(0, 60);
}

cln::cl_RA rational_number(const GiNaC::ex& value) {
  if (!GiNaC::is_a<GiNaC::numeric>(value) || !GiNaC::ex_to<GiNaC::numeric>(value).is_rational())
    throw NotDecided(fmt::format("the number {} is not rational", first_letters(value)));
  return cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
}

}  // namespace

template <class F>
CurveElement<F> CurveField<F>::constant(const F& value) {
  CurveElement<F> result;
  if (!value.is_zero()) result.emplace(0U, value);
  return result;
}

template <class F>
F CurveField<F>::square_of(unsigned roots) const {
  F result(1);
  for (std::size_t i = 0; i < squares_.size(); ++i)
    if ((roots >> i & 1U) != 0) result = result * squares_[i];
  return result;
}

template <class F>
CurveElement<F> CurveField<F>::root_of(const F& square) {
  for (unsigned roots = 0; roots < 1U << squares_.size(); ++roots) {
    const F own = square_of(roots);
    if (const auto root = (square * own).square_root()) {
      CurveElement<F> result;
      if (!root->is_zero()) result.emplace(roots, *root / own);
      return result;
    }
  }
  if (squares_.size() >= 4) throw NotDecided("more than four square roots along a curve");
  conditions_->nonzero(square);
  squares_.push_back(square);
  return {{1U << (squares_.size() - 1), F(1)}};
}

template <class F>
CurveElement<F> CurveField<F>::sum(const CurveElement<F>& a, const CurveElement<F>& b) const {
  CurveElement<F> result = a;
  for (const auto& [roots, value] : b) add_to<F>(result, roots, value);
  return result;
}

template <class F>
CurveElement<F> CurveField<F>::difference(const CurveElement<F>& a,
                                          const CurveElement<F>& b) const {
  CurveElement<F> result = a;
  for (const auto& [roots, value] : b) add_to<F>(result, roots, -value);
  return result;
}

template <class F>
CurveElement<F> CurveField<F>::product(const CurveElement<F>& a, const CurveElement<F>& b) const {
  CurveElement<F> result;
  for (const auto& [left, x] : a)
    for (const auto& [right, y] : b)
      add_to<F>(result, left ^ right, x * y * square_of(left & right));
  return result;
}

template <class F>
CurveElement<F> CurveField<F>::inverse(const CurveElement<F>& a) const {
  if (a.empty()) throw NotDecided("a denominator vanishes along the curve");
  const unsigned highest = a.rbegin()->first;
  if (highest == 0) {
    conditions_->nonzero(a.begin()->second);
    return constant(F(1) / a.begin()->second);
  }
  unsigned root = 1;
  while (root <= highest / 2) root *= 2;
  CurveElement<F> conjugate = a;
  for (auto& [roots, value] : conjugate)
    if ((roots & root) != 0) value = -value;
  return product(conjugate, inverse(product(a, conjugate)));
}

template <class F>
CurveElement<F> CurveField<F>::power(const CurveElement<F>& a, long exponent) const {
  if (exponent < 0) return power(inverse(a), -exponent);
  if (exponent > 1000) throw NotDecided("a power above 1000");
  CurveElement<F> result = constant(1);
  for (long i = 0; i < exponent; ++i) result = product(result, a);
  return result;
}

template <class F>
CurveElement<F> CurveField<F>::derivative(const CurveElement<F>& a) const {
  CurveElement<F> result;
  for (const auto& [roots, value] : a) {
    F slope = value.derivative();
    for (std::size_t i = 0; i < squares_.size(); ++i)
      if ((roots >> i & 1U) != 0)
        slope = slope + value * squares_[i].derivative() / (F(2) * squares_[i]);
    add_to<F>(result, roots, slope);
  }
  return result;
}

template <class F>
F CurveField<F>::rational(const CurveElement<F>& a) {
  if (a.empty()) return 0;
  if (a.rbegin()->first != 0) throw NotDecided("a coefficient is no rational function of z");
  return a.begin()->second;
}

template <class F>
CurveElement<F> CurveField<F>::value(const GiNaC::ex& expression,
                                     const GiNaC::exmap& symbols_to_index,
                                     const std::vector<CurveElement<F>>& values) const {
  using GiNaC::is_a;
  if (is_a<GiNaC::numeric>(expression)) return constant(rational_number(expression));
  if (is_a<GiNaC::symbol>(expression)) {
    const auto place = symbols_to_index.find(expression);
    if (place == symbols_to_index.end())
      throw NotDecided(fmt::format("{} has no number", first_letters(expression)));
    return values[static_cast<std::size_t>(GiNaC::ex_to<GiNaC::numeric>(place->second).to_int())];
  }
  if (is_a<GiNaC::add>(expression) || is_a<GiNaC::mul>(expression)) {
    const bool is_sum = is_a<GiNaC::add>(expression);
    CurveElement<F> result = constant(is_sum ? 0 : 1);
    for (const GiNaC::ex& part : expression) {
      const CurveElement<F> own = value(part, symbols_to_index, values);
      result = is_sum ? sum(result, own) : product(result, own);
    }
    return result;
  }
  if (is_a<GiNaC::power>(expression)) {
    const CurveElement<F> base = value(expression.op(0), symbols_to_index, values);
    const cln::cl_RA exponent = rational_number(expression.op(1));
    const cln::cl_I above = cln::numerator(exponent);
    if (cln::integer_length(above) > 20) throw NotDecided("a power above 1000");
    if (cln::denominator(exponent) == 1) return power(base, cln::cl_I_to_long(above));
    if (cln::denominator(exponent) == 2) {
      const auto root = rational(base).square_root();
      if (!root || root->is_zero())
        throw NotDecided(
            fmt::format("{} is no square along the curve", first_letters(expression.op(0))));
      const bool negative = leads_with_minus(*root);
      return power(constant(negative ? -*root : *root), cln::cl_I_to_long(above));
    }
  }
  throw NotDecided(
      fmt::format("{} is no rational function along the curve", first_letters(expression)));
}

template <class F>
std::size_t reduce_rows(const CurveField<F>& field, std::vector<std::vector<CurveElement<F>>>& rows,
                        std::vector<std::size_t>* pivots) {
  std::size_t rank = 0;
  const std::size_t columns = rows.empty() ? 0 : rows.front().size();
  for (std::size_t column = 0; column < columns && rank < rows.size(); ++column) {
    std::size_t found = rank;
    while (found < rows.size() && CurveField<F>::is_zero(rows[found][column])) ++found;
    if (found == rows.size()) continue;
    std::swap(rows[rank], rows[found]);
    const CurveElement<F> scale = field.inverse(rows[rank][column]);
    for (CurveElement<F>& entry : rows[rank]) entry = field.product(entry, scale);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == rank || CurveField<F>::is_zero(rows[i][column])) continue;
      const CurveElement<F> factor = rows[i][column];
      for (std::size_t j = 0; j < columns; ++j)
        rows[i][j] = field.difference(rows[i][j], field.product(factor, rows[rank][j]));
    }
    if (pivots) pivots->push_back(column);
    ++rank;
  }
  return rank;
}

template class CurveField<RationalFunction>;
template class CurveField<ParametricFunction>;
template std::size_t reduce_rows(const CurveField<RationalFunction>&,
                                 std::vector<std::vector<CurveElement<RationalFunction>>>&,
                                 std::vector<std::size_t>*);
template std::size_t reduce_rows(const CurveField<ParametricFunction>&,
                                 std::vector<std::vector<CurveElement<ParametricFunction>>>&,
                                 std::vector<std::size_t>*);

}  // namespace casimir::obstruction
