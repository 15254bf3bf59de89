// What is not negative, or not zero, at any point at which everything is real: by its terms.
#include <algorithm>

#include "symbolic/functions/function_factors.hpp"
#include "symbolic/functions/sign_table.hpp"

namespace casimir::functions {

/// A sum of monomials with positive coefficients, in squares and in what is not negative.
bool SignTable::is_sum_of_squares(const Polynomial& p) const {
  const auto terms = p.term_list();
  return std::all_of(terms.begin(), terms.end(), [&](const auto& term) {
    if (!cln::plusp(term.first)) return false;
    for (std::size_t i = 0; i < term.second.size(); ++i)
      if (term.second[i] % 2 == 1 && !is_never_negative(i)) return false;
    return true;
  });
}

/// Whether a variable of the ring is not negative at any point at which it is real: a root of even
/// order, or of what is not negative; an absolute value; an exponential; an angle in [0, Pi].
bool SignTable::is_never_negative(std::size_t place) const {
  if (place < table_.symbols().size()) return false;
  const Generator& g = table_.at_place(place);
  if (g.kind == Kind::root) return g.order % 2 == 0 || sign_of(g.base) > 0;
  if (g.kind == Kind::function) return !table_.is_complex() && g.order == kArcCosine;
  return g.kind == Kind::absolute || g.kind == Kind::exponential;
}

/// Whether a variable of the ring vanishes nowhere.
bool SignTable::is_never_zero(std::size_t place) const {
  const Polynomial variable = table_.ring().variable(place);
  if (is_listed_nonzero(variable)) return true;
  if (place < table_.symbols().size()) return false;
  const Generator& g = table_.at_place(place);
  if (g.kind == Kind::exponential) return true;
  return (g.kind == Kind::root || g.kind == Kind::absolute) && is_nowhere_zero(g.base);
}

/// The sign that a variable of the ring has wherever it does not vanish, or 0.
int SignTable::sign_of_variable(std::size_t place) const {
  if (is_never_negative(place)) return 1;
  const Polynomial variable = table_.ring().variable(place);
  for (const Sign& s : signs_) {
    if (s.of == variable) return s.sign;
    if (s.of == -variable) return -s.sign;
  }
  return 0;
}

/// Of a term: 1 where it is never negative, -1 where it is never positive, or 0.
int SignTable::sign_of_term(const cln::cl_RA& coefficient,
                            const std::vector<unsigned long>& exponents) const {
  int sign = cln::minusp(coefficient) ? -1 : 1;
  for (std::size_t i = 0; i < exponents.size() && sign != 0; ++i)
    if (exponents[i] % 2 == 1) sign *= sign_of_variable(i);
  return sign;
}

/// Where p has no terms that may be negative but those in sines and cosines alone, which are at
/// most 1: whether p > 0, and not only p >= 0. Else `bad` is a term that stands in the way.
std::optional<bool> SignTable::not_negative_by_terms(
    const Polynomial& p, std::pair<cln::cl_RA, std::vector<unsigned long>>* bad) const {
  cln::cl_RA room = 0;
  bool strict = false;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    bool constant = true, bounded = true, nonzero = true;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      constant = false;
      nonzero = nonzero && is_never_zero(i);
      const bool sine = i >= table_.symbols().size() && (table_.at_place(i).kind == Kind::sine ||
                                                         table_.at_place(i).kind == Kind::cosine);
      bounded = bounded && sine;
    }
    if (constant) {
      room = room + coefficient;
      if (cln::minusp(coefficient)) *bad = {coefficient, exponents};
    } else if (sign_of_term(coefficient, exponents) > 0) {
      strict = strict || nonzero;
    } else if (bounded) {
      room = room - cln::abs(coefficient);
      *bad = {coefficient, exponents};
    } else {
      *bad = {coefficient, exponents};
      return std::nullopt;
    }
  }
  if (cln::minusp(room)) return std::nullopt;
  return strict || cln::plusp(room);
}

/// Functions l_1, l_2, .. with p = d_1 l_1^2 + d_2 l_2^2 + .. and positive numbers d_i, for p of
/// degree 2: squares are completed, one variable after the other.
std::optional<std::vector<Polynomial>> SignTable::squares_of_quadratic(Polynomial p) const {
  constexpr std::size_t kMostTerms = 30;
  if (p.total_degree() != 2 || p.terms() > kMostTerms) return std::nullopt;
  std::vector<Polynomial> squares;
  for (std::size_t i = 0; i < table_.ring().size(); ++i) {
    if (!p.uses(i)) continue;
    const std::vector<Polynomial> parts = p.coefficients(i);
    if (parts.size() != 3) return std::nullopt;
    const cln::cl_RA d = parts[2].term_list()[0].first;
    if (!cln::plusp(d)) return std::nullopt;
    const Polynomial half = parts[1].scaled(1 / (2 * d));
    squares.push_back(table_.ring().variable(i) + half);
    p = parts[0] - (half * half).scaled(d);
  }
  if (p.is_zero()) return squares;
  if (cln::minusp(p.term_list()[0].first)) return std::nullopt;
  squares.push_back(table_.ring().constant(1));
  return squares;
}

/// Whether p >= 0 wherever everything is real, and whether even p > 0: by its terms, by squares, or
/// less a positive multiple of something with a known sign, as I1 - I3 = (I1 - I2) + (I2 - I3).
std::optional<bool> SignTable::is_not_negative(const Polynomial& p, int depth) const {
  if (p.is_zero()) return false;
  std::pair<cln::cl_RA, std::vector<unsigned long>> bad;
  if (const auto found = not_negative_by_terms(p, &bad)) return found;
  if (const auto squares = squares_of_quadratic(p)) {
    return std::any_of(squares->begin(), squares->end(),
                       [](const Polynomial& l) { return l.is_constant(); });
  }
  // Generators are judged by earlier ones: this ends.
  std::size_t end = table_.symbols().size();
  for (std::size_t i = end; i < table_.ring().size(); ++i)
    if (p.uses(i)) end = i + 1;
  for (const Sign& s : signs_) {
    if (depth == 0) break;
    bool later = !table_.is_real_everywhere(s.of);
    for (std::size_t i = end; i < table_.ring().size(); ++i) later = later || s.of.uses(i);
    if (later) continue;
    for (const auto& [coefficient, exponents] : s.of.term_list()) {
      const cln::cl_RA factor = bad.first / (coefficient * s.sign);
      if (exponents != bad.second || !cln::plusp(factor)) continue;
      const auto rest = is_not_negative(p - s.of.scaled(factor * s.sign), depth - 1);
      if (rest) return *rest || s.strict;
    }
  }
  return std::nullopt;
}

std::vector<Polynomial> SignTable::real_zeros(const Polynomial& p) const {
  if (table_.is_complex() && !table_.generators().empty()) return {p};
  for (const Polynomial& side : {p, -p}) {
    std::pair<cln::cl_RA, std::vector<unsigned long>> bad;
    if (const auto positive = not_negative_by_terms(side, &bad)) {
      if (*positive) return {table_.ring().constant(1)};
      return zeros_of_terms(side);
    }
    if (auto completed = squares_of_quadratic(side)) return *completed;
  }
  return {p};
}

/// Of a sum of terms that are not negative, and of products m of sines and cosines with numbers c
/// whose absolute values add up to the constant: the sum of |c| + c*m.
std::vector<Polynomial> SignTable::zeros_of_terms(const Polynomial& p) const {
  std::vector<Polynomial> zeros;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    Polynomial product = table_.ring().constant(1);
    if (sign_of_term(coefficient, exponents) <= 0) {
      for (std::size_t i = 0; i < exponents.size(); ++i)
        product *= table_.ring().variable(i).pow(exponents[i]);
      zeros.push_back(cln::minusp(coefficient) ? table_.ring().constant(1) - product
                                               : table_.ring().constant(1) + product);
      continue;
    }
    for (std::size_t i = 0; i < exponents.size(); ++i)
      if (exponents[i] > 0 && !is_never_zero(i)) product *= zeros_of_variable(i);
    if (!product.is_constant()) zeros.push_back(std::move(product));
  }
  return zeros;
}

/// What vanishes where a variable of the ring does: of a root or an absolute value, its radicand.
Polynomial SignTable::zeros_of_variable(std::size_t place) const {
  const Polynomial variable = table_.ring().variable(place);
  if (place < table_.symbols().size()) return variable;
  const Generator& g = table_.at_place(place);
  if (g.kind != Kind::root && g.kind != Kind::absolute) return variable;
  Polynomial result = table_.ring().constant(1);
  for (const auto& [f, exponent] : table_.fraction(g.base).first.factors())
    if (!f.is_constant()) result *= f;
  return result;
}

}  // namespace casimir::functions
