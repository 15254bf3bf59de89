#include "runtime/section/section_roots.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace casimir {
namespace {

using Coefficients = std::vector<double>;

/// Parts shorter than this are one point of the step.
constexpr double kShortest = 0x1p-46;

/// In Bernstein's basis of [0, end].
Coefficients bernstein(const Coefficients& c, double end) {
  Coefficients b(c.size());
  const auto n = static_cast<double>(c.size() - 1);
  double power = 1, binomial = 1;
  for (std::size_t k = 0; k < c.size(); ++k) {
    b[k] = c[k] * power / binomial;
    power *= end;
    binomial *= (n - static_cast<double>(k)) / (static_cast<double>(k) + 1);
  }
  for (std::size_t round = 1; round < b.size(); ++round)
    for (std::size_t k = b.size() - 1; k >= round; --k) b[k] += b[k - 1];
  return b;
}

int changes_of_sign(const Coefficients& b) {
  int changes = 0;
  double last = 0;
  for (const double value : b) {
    if (value == 0) continue;
    if (last != 0 && (value > 0) != (last > 0)) ++changes;
    last = value;
  }
  return changes;
}

/// The parts on both sides of a share of the interval, by de Casteljau's scheme.
std::pair<Coefficients, Coefficients> parted(Coefficients b, double share) {
  Coefficients left;
  for (std::size_t rest = b.size(); rest > 0; --rest) {
    left.push_back(b.front());
    for (std::size_t k = 0; k + 1 < rest; ++k) b[k] += share * (b[k + 1] - b[k]);
  }
  // What remains of b holds the right part: each round left its last entry in place.
  return {std::move(left), std::move(b)};
}

class Isolation {
 public:
  Isolation(const Coefficients& c, double end) : c_(c), end_(end) {}

  /// The part of [0, 1] from `from` to `to`.
  void isolate(const Coefficients& b, double from, double to) {
    const int changes = changes_of_sign(b);
    if (changes == 0) return;
    if (changes == 1 || to - from < kShortest) {
      if (changes % 2 == 1) found_.push_back({end_ * root(from, to), last_sign(b) > 0});
      return;
    }
    for (const double share : {0.5, 0.53, 0.46, 0.59}) {
      const auto [left, right] = parted(b, share);
      if (right.front() == 0) continue;  // a zero must lie inside one of the parts
      const double middle = from + share * (to - from);
      isolate(left, from, middle);
      isolate(right, middle, to);
      return;
    }
  }

  /// Without pairs between which the polynomial is zero to rounding: it touches zero there.
  std::vector<PolynomialRoot> found() const {
    double size = 0;
    for (std::size_t k = c_.size(); k-- > 0;) size = size * std::abs(end_) + std::abs(c_[k]);
    std::vector<PolynomialRoot> result;
    for (const PolynomialRoot& passage : found_) {
      constexpr double kLostInBracket = 0x1p-49;
      if (!result.empty() &&
          std::abs(value((result.back().at + passage.at) / 2 / end_)) <= kLostInBracket * size)
        result.pop_back();
      else
        result.push_back(passage);
    }
    return result;
  }

 private:
  double value(double share) const {
    const double s = share * end_;
    double sum = 0;
    for (std::size_t k = c_.size(); k-- > 0;) sum = sum * s + c_[k];
    return sum;
  }

  static double last_sign(const Coefficients& b) {
    for (std::size_t k = b.size(); k-- > 0;)
      if (b[k] != 0) return b[k];
    return 0;
  }

  double root(double from, double to) const {
    const double at_from = value(from), at_to = value(to);
    // The signs of the basis rule; values may differ from them by rounding.
    if (at_from == 0 || at_to == 0 || (at_from > 0) == (at_to > 0))
      return std::abs(at_from) <= std::abs(at_to) ? from : to;
    std::uintmax_t most = 100;
    const auto bracket = boost::math::tools::toms748_solve(
        [&](double share) { return value(share); }, from, to, at_from, at_to,
        boost::math::tools::eps_tolerance<double>(52), most);
    return (bracket.first + bracket.second) / 2;
  }

  const Coefficients& c_;
  const double end_;
  std::vector<PolynomialRoot> found_;
};

}  // namespace

std::vector<PolynomialRoot> passages(const std::vector<double>& c, double end, bool above) {
  Coefficients b = bernstein(c, end);
  if (b.front() == 0 || (b.front() > 0) != above)
    b.front() = above ? std::numeric_limits<double>::min() : -std::numeric_limits<double>::min();
  Isolation isolation(c, end);
  isolation.isolate(b, 0, 1);
  return isolation.found();
}

}  // namespace casimir
