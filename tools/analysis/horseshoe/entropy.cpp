#include "tools/analysis/horseshoe/entropy.hpp"

#include <arb.h>
#include <cln/float.h>
#include <cln/real.h>

#include <algorithm>
#include <cmath>

#include "runtime/program/exact_number.hpp"
#include "runtime/validated/rational_ends.hpp"

namespace casimir::horseshoe {

bool strongly_connected(std::size_t nodes, const Arrows& arrows) {
  if (nodes == 0) return false;
  const auto reached = [&](bool forwards) {
    std::vector<bool> seen(nodes);
    seen[0] = true;
    for (bool grows = true; grows;) {
      grows = false;
      for (const auto& [from, to] : arrows) {
        const std::size_t a = forwards ? from : to, b = forwards ? to : from;
        if (!seen[a] || seen[b]) continue;
        seen[b] = true;
        grows = true;
      }
    }
    for (const bool one : seen)
      if (!one) return false;
    return true;
  };
  return reached(true) && reached(false);
}

cln::cl_RA spectral_radius_above(std::size_t nodes, const Arrows& given) {
  // One that is given twice is one covering.
  Arrows arrows = given;
  std::ranges::sort(arrows);
  arrows.erase(std::unique(arrows.begin(), arrows.end()), arrows.end());
  // A + 1 has the same eigenvector, and one dominant eigenvalue.
  std::vector<double> v(nodes, 1);
  constexpr int kRounds = 4000;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> next = v;
    for (const auto& [from, to] : arrows) next[from] += v[to];
    double largest = 0;
    for (const double x : next) largest = std::max(largest, x);
    for (std::size_t i = 0; i < nodes; ++i) v[i] = next[i] / largest;
  }
  std::vector<cln::cl_RA> exact, image(nodes, 0);
  for (const double x : v) {
    if (!(x > 1e-200)) return 0;
    exact.push_back(exact_number(x));
  }
  for (const auto& [from, to] : arrows) image[from] = image[from] + exact[to];
  cln::cl_RA least = image.empty() ? cln::cl_RA(0) : cln::cl_RA(image[0] / exact[0]);
  for (std::size_t i = 1; i < nodes; ++i) {
    const cln::cl_RA ratio = image[i] / exact[i];
    if (ratio < least) least = ratio;
  }
  return least;
}

cln::cl_RA logarithm_below(const cln::cl_RA& x) {
  const validated::BallPrecision precision(96);
  validated::ArbBall ball(x);
  arb_log(ball.raw(), ball.raw(), 96);
  return validated::ends_of(ball).low;
}

}  // namespace casimir::horseshoe
