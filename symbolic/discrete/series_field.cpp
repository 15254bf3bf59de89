#include "symbolic/discrete/series_field.hpp"

#include <algorithm>

namespace casimir::discrete {

Series SeriesField::constant(Element a) const { return line(a, 0); }

Series SeriesField::line(Element a, Element b) const {
  if (a == 0 && b == 0) return {};
  Series result{a == 0 ? 1 : 0, std::vector<Element>(most_, 0)};
  result.terms[0] = a == 0 ? b : a;
  if (a != 0 && most_ > 1) result.terms[1] = b;
  return result;
}

/// Known up to where the first of the two ends.
Series SeriesField::add(const Series& a, const Series& b) const {
  if (a.is_zero()) return b;
  if (b.is_zero()) return a;
  const auto end = [](const Series& s) { return s.valuation + static_cast<long>(s.terms.size()); };
  const long last = std::min(end(a), end(b));
  long first = std::min({a.valuation, b.valuation, last});
  const auto term = [](const Series& s, long k) {
    return k < s.valuation || s.terms.empty() ? Element{0}
                                              : s.terms[static_cast<std::size_t>(k - s.valuation)];
  };
  Series result{last, {}};
  for (; first < last; ++first) {
    const Element sum = field_.add(term(a, first), term(b, first));
    if (result.terms.empty() && sum == 0) continue;
    if (result.terms.empty()) result.valuation = first;
    result.terms.push_back(sum);
  }
  return result;
}

Series SeriesField::scaled(const Series& a, Element factor) const {
  if (factor == 0) return {};
  Series result = a;
  for (Element& term : result.terms) term = field_.multiply(term, factor);
  return result;
}

Series SeriesField::multiply(const Series& a, const Series& b) const {
  if (a.is_zero() || b.is_zero()) return {};
  Series result{a.valuation + b.valuation, {}};
  const std::size_t size = std::min(a.terms.size(), b.terms.size());
  for (std::size_t k = 0; k < size; ++k) {
    Element sum = 0;
    for (std::size_t i = 0; i <= k; ++i)
      sum = field_.add(sum, field_.multiply(a.terms[i], b.terms[k - i]));
    result.terms.push_back(sum);
  }
  return result;
}

Series SeriesField::power(Series a, std::uint64_t n) const {
  Series result = constant(1);
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) result = multiply(result, a);
    if (n > 1) a = multiply(a, a);
  }
  return result;
}

std::optional<Series> SeriesField::inverse(const Series& a) const {
  if (a.is_zero()) return std::nullopt;
  if (a.terms.empty()) throw TooFewTerms();
  const Element first = field_.inverse(a.terms[0]);
  Series result{-a.valuation, {first}};
  for (std::size_t k = 1; k < a.terms.size(); ++k) {
    Element sum = 0;
    for (std::size_t i = 1; i <= k; ++i)
      sum = field_.add(sum, field_.multiply(a.terms[i], result.terms[k - i]));
    result.terms.push_back(field_.subtract(0, field_.multiply(first, sum)));
  }
  return result;
}

/// The row of the largest entry, of those that are not done; as many as there are rows for none.
std::size_t SeriesField::pivot_of(const Rows& rows, std::size_t column) const {
  std::size_t best = rows.size();
  bool known = true;
  for (std::size_t i = column; i < rows.size(); ++i) {
    const Series& entry = rows[i][column];
    if (entry.terms.empty()) {
      known = known && entry.is_zero();
    } else if (best == rows.size() || entry.valuation < rows[best][column].valuation) {
      best = i;
    }
  }
  if (best == rows.size() && !known) throw TooFewTerms();
  return best;
}

Series SeriesField::eliminate(Rows& rows) const {
  Series determinant = constant(1);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t pivot = pivot_of(rows, k);
    if (pivot == rows.size()) return {};
    if (pivot != k) {
      std::swap(rows[pivot], rows[k]);
      determinant = scaled(determinant, kSplittingPrime - 1);
    }
    determinant = multiply(determinant, rows[k][k]);
    const Series scale = *inverse(rows[k][k]);
    for (std::size_t j = k; j < rows[k].size(); ++j) rows[k][j] = multiply(scale, rows[k][j]);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == k || rows[i][k].is_zero()) continue;
      const Series factor = rows[i][k];
      for (std::size_t j = k; j < rows[i].size(); ++j)
        rows[i][j] = subtract(rows[i][j], multiply(factor, rows[k][j]));
    }
  }
  return determinant;
}

}  // namespace casimir::discrete
