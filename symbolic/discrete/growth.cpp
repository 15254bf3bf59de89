#include "symbolic/discrete/growth.hpp"

#include <flint/fmpz_poly.h>
#include <flint/fmpz_poly_factor.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "symbolic/discrete/prime_field.hpp"

namespace casimir::discrete {
namespace {

/// The shortest linear recurrence s(n) = c_1 s(n-1) + .. + c_L s(n-L) modulo the prime (Berlekamp
/// and Massey), with the residues of least absolute value, if the whole numbers obey it and at
/// least two of them are more than what determines it.
std::optional<std::vector<std::int64_t>> recurrence_of(const std::vector<int>& s) {
  const PrimeField field;
  std::vector<Element> current{1}, previous{1};
  std::size_t length = 0, shift = 1;
  Element last = 1;
  for (std::size_t n = 0; n < s.size(); ++n, ++shift) {
    Element defect = static_cast<Element>(s[n]);
    for (std::size_t i = 1; i < current.size() && i <= n; ++i)
      defect = field.add(defect, field.multiply(current[i], static_cast<Element>(s[n - i])));
    if (defect == 0) continue;
    const std::vector<Element> before = current;
    const Element factor = field.multiply(defect, field.inverse(last));
    current.resize(std::max(current.size(), previous.size() + shift), 0);
    for (std::size_t i = 0; i < previous.size(); ++i)
      current[i + shift] = field.subtract(current[i + shift], field.multiply(factor, previous[i]));
    if (2 * length > n) continue;
    length = n + 1 - length;
    previous = before;
    last = defect;
    shift = 0;
  }
  if (length == 0 || 2 * length + 2 > s.size()) return std::nullopt;
  current.resize(length + 1, 0);
  std::vector<std::int64_t> c;
  for (std::size_t i = 1; i <= length; ++i) {
    const auto value = static_cast<std::int64_t>(current[i]);
    c.push_back(value > static_cast<std::int64_t>(kPrime / 2)
                    ? static_cast<std::int64_t>(kPrime) - value
                    : -value);
    if (std::abs(c.back()) > 1000000)
      return std::nullopt;  // no whole numbers of a small recurrence
  }
  for (std::size_t n = length; n < s.size(); ++n) {
    std::int64_t sum = 0;
    for (std::size_t i = 1; i <= length; ++i) sum += c[i - 1] * s[n - i];
    if (sum != s[n]) return std::nullopt;
  }
  return c;
}

std::string text_of_recurrence(const std::vector<std::int64_t>& c) {
  std::string text;
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (c[i] == 0) continue;
    const std::int64_t size = std::abs(c[i]);
    text += text.empty() ? (c[i] < 0 ? "-" : "") : (c[i] < 0 ? " - " : " + ");
    text += (size == 1 ? "" : fmt::format("{}*", size)) + fmt::format("d(n-{})", i + 1);
  }
  text = "d(n) = " + (text.empty() ? "0" : text);
  // The first ones of the degrees need not obey it.
  return c.back() != 0 ? text : fmt::format("{} for n > {}", text, c.size());
}

/// The order of the root 1 of the characteristic polynomial where all roots are 0 or roots of
/// unity; then a sequence of positive numbers grows like n^(order - 1).
std::optional<int> order_of_one(const std::vector<std::int64_t>& c) {
  fmpz_poly_t characteristic;
  fmpz_poly_init(characteristic);
  const auto length = static_cast<slong>(c.size());
  fmpz_poly_set_coeff_si(characteristic, length, 1);
  for (slong i = 0; i < length; ++i)
    fmpz_poly_set_coeff_si(characteristic, length - 1 - i, -c[static_cast<std::size_t>(i)]);
  fmpz_poly_factor_t factors;
  fmpz_poly_factor_init(factors);
  fmpz_poly_factor(factors, characteristic);
  std::optional<int> order = 0;
  for (slong i = 0; i < factors->num && order; ++i) {
    const fmpz_poly_struct* factor = factors->p + i;
    const bool zero = fmpz_poly_degree(factor) == 1 && fmpz_is_zero(factor->coeffs);
    const ulong unity = fmpz_poly_is_cyclotomic(factor);
    if (!zero && unity == 0) order = std::nullopt;
    if (order && unity == 1) order = static_cast<int>(factors->exp[i]);
  }
  fmpz_poly_factor_clear(factors);
  fmpz_poly_clear(characteristic);
  return order;
}

/// How fast the sequence grows if it goes on by its recurrence.
double ratio_of(const std::vector<int>& degrees, const std::vector<std::int64_t>& c) {
  constexpr int kSteps = 400;
  std::vector<double> window(degrees.end() - static_cast<std::ptrdiff_t>(c.size()), degrees.end());
  double logarithm = 0, half = 0;
  for (int k = 0; k < kSteps; ++k) {
    double next = 0;
    for (std::size_t i = 0; i < c.size(); ++i)
      next += static_cast<double>(c[i]) * window[window.size() - 1 - i];
    window.erase(window.begin());
    window.push_back(next);
    const double scale = std::abs(next);
    if (scale == 0) return 0;
    for (double& value : window) value /= scale;
    logarithm += std::log(scale);
    if (k + 1 == kSteps / 2) half = logarithm;
  }
  return std::exp((logarithm - half) / (kSteps / 2.));
}

/// The polynomial in n that all degrees obey, by differences; at least two are more than what
/// determines it.
std::optional<std::pair<int, std::string>> polynomial_of(const std::vector<int>& degrees) {
  constexpr std::size_t kMostDegree = 6;
  constexpr std::int64_t kFactorial = 720;
  std::vector<std::int64_t> row(degrees.begin(), degrees.end());
  std::vector<std::int64_t> first;  // the differences at n = 1
  for (std::size_t k = 0; k <= kMostDegree && row.size() >= 3; ++k) {
    first.push_back(row.front());
    if (std::ranges::all_of(row, [&](std::int64_t d) { return d == row.front(); })) break;
    if (k == kMostDegree || row.size() < 4) return std::nullopt;
    for (std::size_t i = 0; i + 1 < row.size(); ++i) row[i] = row[i + 1] - row[i];
    row.pop_back();
  }
  if (first.empty() || !std::ranges::all_of(row, [&](std::int64_t d) { return d == row.front(); }))
    return std::nullopt;
  // sum_k first[k] binomial(n - 1, k), with the common denominator 6!.
  std::vector<std::int64_t> sum(first.size(), 0), binomial{kFactorial};
  for (std::size_t k = 0; k < first.size(); ++k) {
    for (std::size_t i = 0; i < binomial.size(); ++i) sum[i] += first[k] * binomial[i];
    // times (n - 1 - k)/(k + 1)
    std::vector<std::int64_t> next(binomial.size() + 1, 0);
    for (std::size_t i = 0; i < binomial.size(); ++i) {
      next[i + 1] += binomial[i];
      next[i] -= static_cast<std::int64_t>(k + 1) * binomial[i];
    }
    for (std::int64_t& c : next) c /= static_cast<std::int64_t>(k + 1);
    binomial = std::move(next);
  }
  std::string text;
  for (std::size_t i = sum.size(); i-- > 0;) {
    if (sum[i] == 0) continue;
    const std::int64_t common = std::gcd(sum[i], kFactorial);
    const std::int64_t top = std::abs(sum[i]) / common;
    const std::int64_t bottom = kFactorial / common;
    text += text.empty() ? (sum[i] < 0 ? "-" : "") : (sum[i] < 0 ? " - " : " + ");
    const std::string number =
        bottom == 1 ? std::to_string(top) : fmt::format("{}/{}", top, bottom);
    const std::string power = i == 0 ? "" : i == 1 ? "n" : fmt::format("n^{}", i);
    text += power.empty() ? number : number == "1" ? power : number + "*" + power;
  }
  return std::pair(static_cast<int>(first.size()) - 1, text.empty() ? "0" : text);
}

/// Of the last so many steps, how the degrees grew: f(d(n-1), d(n), n).
template <class Function>
std::vector<double> last_steps(const std::vector<int>& degrees, std::size_t count, Function f) {
  std::vector<double> result;
  for (std::size_t i = degrees.size() - std::min(count, degrees.size() - 1); i < degrees.size();
       ++i)
    result.push_back(f(static_cast<double>(degrees[i - 1]), static_cast<double>(degrees[i]),
                       static_cast<double>(i + 1)));
  return result;
}

double largest(const std::vector<double>& list) { return *std::ranges::max_element(list); }
double smallest(const std::vector<double>& list) { return *std::ranges::min_element(list); }

/// Where no rule was found: polynomial growth n^k has steps log(d(n)/d(n-1))/log(n/(n-1)) near k,
/// exponential growth has ratios near one number. Degrees that fall, stay for a while or jump, as
/// those of monomial maps whose eigenvalues are complex, are called neither.
Growth by_steps_of_degrees(const std::vector<int>& degrees) {
  Growth growth;
  constexpr std::size_t kRatios = 3, kFewest = 6;
  if (degrees.size() < 3 || std::ranges::any_of(degrees, [](int d) { return d <= 0; }))
    return growth;
  const auto n = static_cast<double>(degrees.size());
  // n*(d(n)/d(n-1) - 1) tends to k for n^k, and grows like n for an exponential.
  const std::vector<double> steps = last_steps(
      degrees, kRatios, [](double before, double d, double i) { return i * (d / before - 1); });
  const bool grows = steps.back() / steps.front() >
                     1 + 0.4 * (n / (n - static_cast<double>(steps.size()) + 1) - 1);
  const std::vector<double> ratios =
      last_steps(degrees, kRatios, [](double before, double d, double) { return d / before; });
  const std::vector<double> slopes =
      last_steps(degrees, (degrees.size() + 1) / 2, [](double before, double d, double i) {
        return std::log(d / before) / std::log(i / (i - 1));
      });
  constexpr double kRatioSpread = 1.25, kSlopeSpread = 1.5, kHighest = 4;
  if (ratios.back() > 1 + 5 / n && smallest(ratios) > 1 && grows &&
      largest(ratios) < kRatioSpread * smallest(ratios)) {
    growth.kind = Growth::Kind::exponential;
    growth.ratio = ratios.back();
  } else if (degrees.size() >= kFewest && smallest(slopes) >= 0 && largest(slopes) < kHighest &&
             largest(slopes) - smallest(slopes) < kSlopeSpread) {
    growth.kind = Growth::Kind::polynomial;
    growth.degree = static_cast<int>(std::lround(slopes.back()));
  }
  return growth;
}

}  // namespace

std::string to_string(Growth::Kind kind) {
  switch (kind) {
    case Growth::Kind::polynomial:
      return "polynomial";
    case Growth::Kind::exponential:
      return "exponential";
    case Growth::Kind::unclear:
      break;
  }
  return "unclear";
}

Growth growth_of(const std::vector<int>& degrees) {
  Growth growth;
  if (const auto polynomial = polynomial_of(degrees)) {
    growth.kind = Growth::Kind::polynomial;
    growth.degree = polynomial->first;
    growth.formula = polynomial->second;
    return growth;
  }
  const auto recurrence = recurrence_of(degrees);
  if (!recurrence) return by_steps_of_degrees(degrees);
  growth.recurrence = text_of_recurrence(*recurrence);
  if (const auto order = order_of_one(*recurrence)) {
    growth.kind = Growth::Kind::polynomial;
    growth.degree = std::max(*order - 1, 0);
  } else {
    growth.kind = Growth::Kind::exponential;
    growth.ratio = ratio_of(degrees, *recurrence);
  }
  return growth;
}

}  // namespace casimir::discrete
