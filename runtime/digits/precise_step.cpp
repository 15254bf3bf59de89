#include "runtime/digits/precise_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace casimir {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

/// The last quarter of the orders tells the radius of convergence: gaps in a series do not deceive.
std::size_t last_quarter(std::size_t order) { return order - order / 4; }

/// log2 of the step after which all of the last coefficients are 2^-bits of the first.
double by_the_tail(const std::vector<double>& sizes, double bits) {
  const std::size_t order = sizes.size() - 1;
  std::size_t first = 0;
  while (first < order && std::isinf(sizes[first])) ++first;
  double radius = kNoBound;
  for (std::size_t k = std::max(first + 1, last_quarter(order)); k <= order; ++k)
    radius = std::min(radius, (sizes[first] - sizes[k]) / static_cast<double>(k - first));
  return radius - bits / static_cast<double>(std::max<std::size_t>(order - first, 1));
}

/// log2 of the largest coefficient of each order.
std::vector<double> sizes_of(const std::vector<LongSeries>& states) {
  std::vector<double> sizes(states[0].size(), -kNoBound);
  for (const LongSeries& series : states) {
    for (std::size_t k = 0; k < sizes.size(); ++k) sizes[k] = std::max(sizes[k], series[k].log2());
  }
  return sizes;
}

}  // namespace

double log2_step(const std::vector<LongSeries>& states,
                 const std::vector<const LongSeries*>& others, const Envelope& envelope) {
  const std::vector<double> sizes = sizes_of(states);
  const std::size_t order = sizes.size() - 1;
  double step = by_the_tail(sizes, envelope.bits);
  std::vector<double> other;
  for (const LongSeries* series : others) {
    other.clear();
    for (std::size_t k = 0; k < order; ++k) other.push_back((*series)[k].log2());
    step = std::min(step, by_the_tail(other, envelope.bits));
  }
  if (std::isinf(step) || std::isnan(step)) return step;
  // The size of the solution on such a step: its value alone may happen to be near zero, and where
  // it rests at zero the first terms are zero too.
  constexpr std::size_t kFew = 4;
  std::size_t few = kFew;
  while (few < order && std::isinf(sizes[few - kFew])) ++few;
  double size = -kNoBound;
  for (std::size_t k = 0; k <= std::min(few, order); ++k)
    size = std::max(size, sizes[k] + static_cast<double>(k) * step);
  if (std::isinf(size)) return step;
  for (std::size_t k = few + 1; k <= order; ++k) {
    const double share = envelope.bits * static_cast<double>(k) / static_cast<double>(order);
    step = std::min(step, (size + envelope.slack - share - sizes[k]) / static_cast<double>(k));
  }
  return step;
}

std::optional<Singularity> nearest_singularity(const std::vector<LongSeries>& states) {
  const std::size_t order = states[0].size() - 1;
  const auto size_of_last = [&](const LongSeries& s) { return s[order].log2(); };
  const LongSeries& series = *std::max_element(
      states.begin(), states.end(),
      [&](const auto& a, const auto& b) { return size_of_last(a) < size_of_last(b); });
  // a_k / a_{k-1} = (k + p - 1) / (k h), so that k a_k / a_{k-1} is linear in k.
  const auto ratio = [&](std::size_t k) {
    return BigFloat(cln::cl_I(k)) * series[k] / series[k - 1];
  };
  const auto estimate = [&](std::size_t k) -> std::optional<BigFloat> {
    if (series[k - 1].is_zero() || series[k - 2].is_zero()) return std::nullopt;
    const BigFloat slope = ratio(k) - ratio(k - 1);
    if (slope.is_zero()) return std::nullopt;
    return BigFloat(cln::cl_I(1)) / slope;
  };
  // Later coefficients know the singularity better, but have fewer digits.
  const std::optional<BigFloat> one = estimate(2 * order / 5), other = estimate(order / 3);
  if (!one || !other) return std::nullopt;
  return Singularity{.distance = *one, .log2_spread = (*one - *other).log2()};
}

}  // namespace casimir
