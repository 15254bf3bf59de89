#include "runtime/step/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "runtime/step/dense.hpp"

namespace casimir {
namespace {

/// How much faster than the solution a perturbation must decay.
constexpr double kSeparation = 100;

/// Above it the eigenvalues would take seconds.
constexpr int kMostStates = 500;

Eigen::MatrixXd jacobian_at(const Module& module, double t, const std::vector<double>& x,
                            const double* p) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd jacobian(n, n);
  if (module.has_jacobian()) {
    module.functions().jacobian(t, x.data(), p, jacobian.data());
    return jacobian;
  }
  double all = 0;
  for (const double number : x) all = std::max(all, std::abs(number));
  std::vector<double> moved = x;
  Eigen::VectorXd ahead(n), behind(n);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double reach = std::max(std::abs(x[i]), all > 0 ? 1e-3 * all : 1.0) * 0x1p-17;
    moved[i] = x[i] + reach;
    const double upper = moved[i];
    module.functions().rhs(t, moved.data(), p, ahead.data());
    moved[i] = x[i] - reach;
    module.functions().rhs(t, moved.data(), p, behind.data());
    jacobian.col(static_cast<Eigen::Index>(i)) = (ahead - behind) / (upper - moved[i]);
    moved[i] = x[i];
  }
  return jacobian;
}

std::string short_number(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", number);
  return text;
}

}  // namespace

std::optional<Rates> rates_at(const Module& module, double t, const std::vector<double>& x,
                              const double* p) {
  const auto n = static_cast<Eigen::Index>(x.size());
  if (n > kMostStates) return std::nullopt;
  Eigen::VectorXd slope(n);
  module.functions().rhs(t, x.data(), p, slope.data());
  const Eigen::MatrixXd jacobian = jacobian_at(module, t, x, p);
  const double size = Eigen::Map<const Eigen::VectorXd>(x.data(), n).lpNorm<Eigen::Infinity>();
  if (!slope.allFinite() || !jacobian.allFinite() || !std::isfinite(size)) return std::nullopt;
  const auto eigenvalues = eigenvalues_of(jacobian);
  if (!eigenvalues) return std::nullopt;
  Rates rates;
  rates.decay = std::max(0.0, -eigenvalues->real().minCoeff());
  const double speed = slope.lpNorm<Eigen::Infinity>();
  rates.solution = speed > 0 ? speed / size : 0;
  return rates;
}

bool is_stiff(const Module& module, double t, const std::vector<double>& x, const double* p,
              double span) {
  const auto rates = rates_at(module, t, x, p);
  return rates && rates->decay * std::abs(span) > 1000 &&
         rates->decay > kSeparation * rates->solution;
}

std::optional<std::string> stiffness_at(const Module& module, double t,
                                        const std::vector<double>& x, const double* p,
                                        double step) {
  const auto rates = rates_at(module, t, x, p);
  // Explicit methods are stable up to about 5 decay times, and series of order 24 up to 10. Steps
  // vary: their mean may be a part of the last ones.
  const double reach = rates ? rates->decay * std::abs(step) : 0;
  if (!(reach > 0.1) || !(rates->decay > kSeparation * rates->solution)) return std::nullopt;
  return "the equations are stiff here: perturbations decay at the rate " +
         short_number(rates->decay) + " while the solution changes at the rate " +
         short_number(rates->solution) +
         ", and the steps of an explicit method follow the faster; use radau9";
}

}  // namespace casimir
