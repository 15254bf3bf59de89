#include "tools/analysis/equilibria/numeric_balances.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <random>

#include "runtime/step/dense.hpp"

namespace casimir {
namespace {

using Number = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;
using ComplexMatrix = Eigen::MatrixXcd;

constexpr std::size_t kStartsOfBalances = 600;
// Of exponents: rounding splits a double one by the square root of its size, a triple one by the
// cube root; the mean of the parts has no more error than a simple one.
constexpr double kNearBalance = 1e-4;

Number power(Number x, unsigned long exponent) {
  Number result = 1;
  for (; exponent > 0; --exponent) result *= x;
  return result;
}

/// g_i x_i + F_i(x) and its derivative.
struct Values {
  ComplexVector residual;
  ComplexMatrix derivative;
};

Values values_at(const search::LeadingSystem& system, const ComplexVector& x) {
  const auto n = static_cast<Eigen::Index>(system.weights.size());
  Values result{ComplexVector::Zero(n), ComplexMatrix::Zero(n, n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto place = static_cast<std::size_t>(i);
    result.residual(i) = system.weights[place] * x(i);
    result.derivative(i, i) = system.weights[place];
    for (const search::LeadingSystem::Term& term : system.rates[place]) {
      Number product = term.coefficient;
      for (Eigen::Index k = 0; k < n; ++k)
        product *= power(x(k), term.exponents[static_cast<std::size_t>(k)]);
      result.residual(i) += product;
      for (Eigen::Index k = 0; k < n; ++k) {
        const unsigned long exponent = term.exponents[static_cast<std::size_t>(k)];
        if (exponent == 0) continue;
        Number part = term.coefficient * static_cast<double>(exponent);
        for (Eigen::Index m = 0; m < n; ++m) {
          const unsigned long own = term.exponents[static_cast<std::size_t>(m)];
          part *= power(x(m), m == k ? own - 1 : own);
        }
        result.derivative(i, k) += part;
      }
    }
  }
  return result;
}

/// Newton's iteration with the shortest step that the linear equations allow.
std::optional<ComplexVector> solved(const search::LeadingSystem& system, ComplexVector x) {
  constexpr int kRounds = 80;
  constexpr double kSmall = 1e-13, kZeroOfBalance = 1e-7;  // the zero solution is approached fast
  for (int round = 0; round < kRounds; ++round) {
    const Values values = values_at(system, x);
    const double scale = 1 + x.norm();
    if (!std::isfinite(values.residual.norm())) return std::nullopt;
    ComplexVector step = shortest_solution(values.derivative, values.residual, 1e-10);
    if (values.residual.norm() < kSmall * scale && step.norm() < 1e-9 * scale)
      return x.norm() < kZeroOfBalance ? std::nullopt : std::optional(x);
    if (step.norm() > scale) step *= scale / step.norm();
    x -= step;
  }
  return std::nullopt;
}

struct BalancePoint {
  ComplexVector place;
  std::vector<Number> exponents;  ///< in order
  bool has_complex_exponents = false;
  Eigen::Index family = 0;  ///< its dimension
};

/// Every number that is close to others becomes their mean.
std::vector<Number> with_means(const std::vector<ConditionedEigenvalue>& eigenvalues) {
  std::vector<Number> result;
  for (const auto& [value, condition] : eigenvalues) {
    Number sum = 0;
    double count = 0;
    for (const ConditionedEigenvalue& other : eigenvalues) {
      if (std::abs(other.value - value) > kNearBalance * std::max(1., std::abs(value))) continue;
      sum += other.value;
      ++count;
    }
    result.push_back(sum / count);
  }
  return result;
}

/// What an error of a matrix may have made of an eigenvalue: to first order by its condition, and
/// in any case by Elsner's theorem (Linear Algebra Appl. 71, 77, 1985), which holds for multiple
/// ones, too: they are split by the n-th root.
double eigenvalue_error(const ComplexMatrix& matrix, const ConditionedEigenvalue& eigenvalue) {
  constexpr double kError = 1e-10;  // of the balance, hence of the matrix, relative to its size
  const double size = std::max(1., matrix.norm()), n = static_cast<double>(matrix.cols());
  return size * std::min(eigenvalue.condition * kError, 2 * std::pow(kError, 1 / n));
}

/// Empty where the exponents cannot be computed.
std::optional<BalancePoint> described(const search::LeadingSystem& system, const ComplexVector& x) {
  const ComplexMatrix matrix = values_at(system, x).derivative;
  const auto eigenvalues = conditioned_eigenvalues_of(matrix);
  if (!eigenvalues) return std::nullopt;
  BalancePoint result{x, with_means(*eigenvalues), false, 0};
  result.has_complex_exponents = std::ranges::any_of(*eigenvalues, [&](const auto& eigenvalue) {
    return std::abs(eigenvalue.value.imag()) > eigenvalue_error(matrix, eigenvalue);
  });
  std::sort(result.exponents.begin(), result.exponents.end(), [](const Number& a, const Number& b) {
    return std::pair(std::round(a.real() / kNearBalance), a.imag()) <
           std::pair(std::round(b.real() / kNearBalance), b.imag());
  });
  result.family = matrix.cols() - rank_of(matrix, 1e-7);
  return result;
}

/// Points that differ by signs and symmetries only have the same exponents, and one stands for all.
bool same(const BalancePoint& a, const BalancePoint& b) {
  if (a.family != b.family) return false;
  std::vector<Number> others = b.exponents;  // rounding may have changed their order
  for (const Number& value : a.exponents) {
    const auto near = std::ranges::find_if(others, [&](const Number& other) {
      return std::abs(other - value) <= 10 * kNearBalance * std::max(1., std::abs(value));
    });
    if (near == others.end()) return false;
    others.erase(near);
  }
  return true;
}

constexpr double kRoundingOfBalance = 1e-7;  // of what is computed from double precision twice

double without_rounding(double x) { return std::abs(x) < kRoundingOfBalance ? 0 : x; }

std::string text_of(Number value, int digits) {
  const double real = without_rounding(value.real()), imaginary = without_rounding(value.imag());
  if (imaginary == 0) return fmt::format("{:.{}g}", real, digits);
  if (real == 0) return fmt::format("{:.{}g}*I", imaginary, digits);
  return fmt::format("{:.{}g} {} {:.{}g}*I", real, digits, imaginary < 0 ? '-' : '+',
                     std::abs(imaginary), digits);
}

search::Balance balance_of(const search::LeadingSystem& system, const BalancePoint& point) {
  constexpr int kDigits = 12, kFewDigits = 6;
  search::Balance result;
  for (Eigen::Index i = 0; i < point.place.size(); ++i)
    result.coefficients.emplace_back(system.names[static_cast<std::size_t>(i)],
                                     text_of(point.place(i), kDigits));
  for (const Number& value : point.exponents) {
    search::Exponent exponent;
    exponent.kind = search::Exponent::Kind::numeric;
    exponent.text = text_of(value, kFewDigits);
    exponent.values.emplace_back(value.real(), without_rounding(value.imag()));
    if (!result.exponents.empty() && result.exponents.back().text == exponent.text)
      ++result.exponents.back().multiplicity;
    else
      result.exponents.push_back(std::move(exponent));
  }
  result.family = static_cast<std::size_t>(point.family);
  return result;
}

}  // namespace

NumericBalances find_numeric_balances(const search::LeadingSystem& system,
                                      const std::function<void(double)>& tick) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<BalancePoint> points;
  NumericBalances result;
  for (; result.starts < kStartsOfBalances; ++result.starts) {
    tick(static_cast<double>(result.starts) / kStartsOfBalances);
    ComplexVector x(static_cast<Eigen::Index>(system.weights.size()));
    constexpr double kScales[] = {0.3, 1, 4, 16};
    const double scale = kScales[result.starts / 3 % 4];
    for (Number& entry : x) {
      // Some balances are real or imaginary, and many coefficients of some are zero.
      const double real = normal(random), imaginary = normal(random);
      entry = scale * Number(real, result.starts % 2 == 0 ? imaginary : 0);
      if (result.starts % 3 == 2 && normal(random) > 0) entry = 0;
    }
    const std::optional<ComplexVector> place = solved(system, x);
    if (!place) continue;
    std::optional<BalancePoint> point = described(system, *place);
    if (point && std::none_of(points.begin(), points.end(),
                              [&](const BalancePoint& known) { return same(known, *point); }))
      points.push_back(std::move(*point));
  }
  for (const BalancePoint& point : points) {
    result.balances.push_back(balance_of(system, point));
    result.has_complex_exponents |= point.has_complex_exponents;
  }
  return result;
}

std::size_t take_numeric_balances(search::ExponentReport& report,
                                  const std::function<void(double)>& tick) {
  NumericBalances found = find_numeric_balances(*report.leading, tick);
  report.balances = std::move(found.balances);
  if (found.has_complex_exponents)
    report.conclusions.push_back(
        "numeric exponents have imaginary parts that rounding does not explain, and what is not "
        "real is not rational: a proof of them would show that the leading system is not "
        "algebraically integrable (Yoshida 1983)");
  return found.starts;
}

}  // namespace casimir
