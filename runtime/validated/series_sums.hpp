#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "runtime/validated/mid_rad.hpp"

namespace casimir::validated {

/// sum_{k <= N} X_k [0, h]^k + [-R, R] for the states of a series, and what h^{N+1} is in.
template <class Ball>
struct TubeSum {
  std::vector<Ball> tube;
  Ball power;

  TubeSum(const std::vector<std::vector<Ball>>& series, const Ball& h, std::size_t order,
          const Ball& room)
      : power(h) {
    for (const std::vector<Ball>& x : series) tube.push_back(widened(x[0], room));
    for (std::size_t k = 1; k <= order; ++k) {
      const Ball up_to = from_zero_to(power);
      for (std::size_t i = 0; i < tube.size(); ++i) tube[i] = tube[i] + series[i][k] * up_to;
      power = power * h;
    }
  }
};

/// In doubles. With p_k at least h^k, which `upwards` provides, X_k [0, h]^k is in the ball of the
/// midpoint m_k p_k/2 and the radius |m_k| p_k/2 + r_k p_k. A sum of N + 1 terms passes N additions
/// and a product for each, which is covered by (N + 3) u of the sum of their sizes, as in
/// ProductSums; the halves are exact, but for what underflows, and that `upwards` covers.
template <>
inline TubeSum<MidRad>::TubeSum(const std::vector<std::vector<MidRad>>& series, const MidRad& h,
                                std::size_t order, const MidRad& room) {
  const double longest = upwards(std::abs(h.mid) + h.rad);
  std::vector<double> powers{1, longest};
  for (std::size_t k = 2; k <= order + 1; ++k) powers.push_back(upwards(powers.back() * longest));
  power = {0, powers[order + 1]};
  const double roundings = kUnit * (static_cast<double>(order) + 3);
  const double more = 1 + 4 * kUnit * static_cast<double>(order);
  for (const std::vector<MidRad>& x : series) {
    double mid = x[0].mid, sizes = 0, radii = x[0].rad;
    for (std::size_t k = 1; k <= order; ++k) {
      const double half = 0.5 * powers[k];
      mid += x[k].mid * half;
      sizes += std::abs(x[k].mid) * half;
      radii += x[k].rad * powers[k];
    }
    const double lost = roundings * (sizes + std::abs(x[0].mid));
    tube.push_back({mid, upwards((sizes + radii + lost + magnitude(room)) * more)});
  }
}

/// sum_{1 <= k <= N} x_k t^k + rest t^{N+1} by Horner's rule.
template <class Ball>
Ball horner(const std::vector<Ball>& series, Ball rest, const Ball& t, std::size_t order) {
  for (std::size_t k = order; k > 0; --k) rest = rest * t + series[k];
  return rest * t;
}

/// In doubles: the product and the sum round once each.
inline MidRad horner(const std::vector<MidRad>& series, const MidRad& rest, const MidRad& t,
                     std::size_t order) {
  const double size = std::abs(t.mid) + t.rad;
  double mid = rest.mid, rad = rest.rad;
  for (std::size_t k = order; k > 0; --k) {
    const double product = mid * t.mid, before = std::abs(mid) * t.rad;
    mid = product + series[k].mid;
    rad =
        upwards(rad * size + before + series[k].rad + kUnit * (std::abs(product) + std::abs(mid)));
  }
  return MidRad(mid, rad) * t;
}

}  // namespace casimir::validated
