#include "symbolic/obstruction/curve_field.hpp"

#include <cln/integer.h>
#include <fmt/format.h>

#include <sstream>

#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

void add_to(CurveElement& sum, unsigned roots, const RationalFunction& value) {
  RationalFunction& own = sum[roots];
  own = own + value;
  if (own.is_zero()) sum.erase(roots);
}

std::string printed(const GiNaC::ex& expression) {
  std::ostringstream text;
  text << expression;
  return text.str().substr(0, 60);
}

cln::cl_RA rational_number(const GiNaC::ex& value) {
  if (!GiNaC::is_a<GiNaC::numeric>(value) || !GiNaC::ex_to<GiNaC::numeric>(value).is_rational())
    throw NotDecided(fmt::format("the number {} is not rational", printed(value)));
  return cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
}

}  // namespace

CurveElement CurveField::constant(const RationalFunction& value) {
  CurveElement result;
  if (!value.is_zero()) result.emplace(0U, value);
  return result;
}

RationalFunction CurveField::square_of(unsigned roots) const {
  RationalFunction result(1);
  for (std::size_t i = 0; i < squares_.size(); ++i)
    if ((roots >> i & 1U) != 0) result = result * squares_[i];
  return result;
}

CurveElement CurveField::root_of(const RationalFunction& square) {
  for (unsigned roots = 0; roots < 1U << squares_.size(); ++roots) {
    const RationalFunction own = square_of(roots);
    if (const auto root = (square * own).square_root()) {
      CurveElement result;
      if (!root->is_zero()) result.emplace(roots, *root / own);
      return result;
    }
  }
  if (squares_.size() >= 4) throw NotDecided("more than four square roots along a curve");
  squares_.push_back(square);
  return {{1U << (squares_.size() - 1), RationalFunction(1)}};
}

CurveElement CurveField::sum(const CurveElement& a, const CurveElement& b) const {
  CurveElement result = a;
  for (const auto& [roots, value] : b) add_to(result, roots, value);
  return result;
}

CurveElement CurveField::difference(const CurveElement& a, const CurveElement& b) const {
  CurveElement result = a;
  for (const auto& [roots, value] : b) add_to(result, roots, -value);
  return result;
}

CurveElement CurveField::product(const CurveElement& a, const CurveElement& b) const {
  CurveElement result;
  for (const auto& [left, x] : a)
    for (const auto& [right, y] : b) add_to(result, left ^ right, x * y * square_of(left & right));
  return result;
}

CurveElement CurveField::inverse(const CurveElement& a) const {
  if (a.empty()) throw NotDecided("a denominator vanishes along the curve");
  const unsigned highest = a.rbegin()->first;
  if (highest == 0) return constant(RationalFunction(1) / a.begin()->second);
  unsigned root = 1;
  while (root <= highest / 2) root *= 2;
  CurveElement conjugate = a;
  for (auto& [roots, value] : conjugate)
    if ((roots & root) != 0) value = -value;
  return product(conjugate, inverse(product(a, conjugate)));
}

CurveElement CurveField::power(const CurveElement& a, long exponent) const {
  if (exponent < 0) return power(inverse(a), -exponent);
  if (exponent > 1000) throw NotDecided("a power above 1000");
  CurveElement result = constant(1);
  for (long i = 0; i < exponent; ++i) result = product(result, a);
  return result;
}

CurveElement CurveField::derivative(const CurveElement& a) const {
  CurveElement result;
  for (const auto& [roots, value] : a) {
    RationalFunction slope = value.derivative();
    for (std::size_t i = 0; i < squares_.size(); ++i)
      if ((roots >> i & 1U) != 0)
        slope = slope + value * squares_[i].derivative() / (RationalFunction(2) * squares_[i]);
    add_to(result, roots, slope);
  }
  return result;
}

RationalFunction CurveField::rational(const CurveElement& a) {
  if (a.empty()) return 0;
  if (a.rbegin()->first != 0) throw NotDecided("a coefficient is no rational function of z");
  return a.begin()->second;
}

CurveElement CurveField::value(const GiNaC::ex& expression, const GiNaC::exmap& symbols_to_index,
                               const std::vector<CurveElement>& values) const {
  using GiNaC::is_a;
  if (is_a<GiNaC::numeric>(expression)) return constant(rational_number(expression));
  if (is_a<GiNaC::symbol>(expression)) {
    const auto place = symbols_to_index.find(expression);
    if (place == symbols_to_index.end())
      throw NotDecided(fmt::format("{} has no number", printed(expression)));
    return values[static_cast<std::size_t>(GiNaC::ex_to<GiNaC::numeric>(place->second).to_int())];
  }
  if (is_a<GiNaC::add>(expression) || is_a<GiNaC::mul>(expression)) {
    const bool is_sum = is_a<GiNaC::add>(expression);
    CurveElement result = constant(is_sum ? 0 : 1);
    for (const GiNaC::ex& part : expression) {
      const CurveElement own = value(part, symbols_to_index, values);
      result = is_sum ? sum(result, own) : product(result, own);
    }
    return result;
  }
  if (is_a<GiNaC::power>(expression)) {
    const CurveElement base = value(expression.op(0), symbols_to_index, values);
    const cln::cl_RA exponent = rational_number(expression.op(1));
    const cln::cl_I above = cln::numerator(exponent);
    if (cln::integer_length(above) > 20) throw NotDecided("a power above 1000");
    if (cln::denominator(exponent) == 1) return power(base, cln::cl_I_to_long(above));
    if (cln::denominator(exponent) == 2) {
      const auto root = rational(base).square_root();
      if (!root || root->is_zero())
        throw NotDecided(fmt::format("{} is no square along the curve", printed(expression.op(0))));
      const bool negative = cln::minusp(root->numerator().leading());
      return power(constant(negative ? -*root : *root), cln::cl_I_to_long(above));
    }
  }
  throw NotDecided(fmt::format("{} is no rational function along the curve", printed(expression)));
}

std::size_t reduce_rows(const CurveField& field, std::vector<std::vector<CurveElement>>& rows,
                        std::vector<std::size_t>* pivots) {
  std::size_t rank = 0;
  const std::size_t columns = rows.empty() ? 0 : rows.front().size();
  for (std::size_t column = 0; column < columns && rank < rows.size(); ++column) {
    std::size_t found = rank;
    while (found < rows.size() && CurveField::is_zero(rows[found][column])) ++found;
    if (found == rows.size()) continue;
    std::swap(rows[rank], rows[found]);
    const CurveElement scale = field.inverse(rows[rank][column]);
    for (CurveElement& entry : rows[rank]) entry = field.product(entry, scale);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == rank || CurveField::is_zero(rows[i][column])) continue;
      const CurveElement factor = rows[i][column];
      for (std::size_t j = 0; j < columns; ++j)
        rows[i][j] = field.difference(rows[i][j], field.product(factor, rows[rank][j]));
    }
    if (pivots) pivots->push_back(column);
    ++rank;
  }
  return rank;
}

}  // namespace casimir::obstruction
