#include "symbolic/search/modular/level_points.hpp"

#include <algorithm>

#include "symbolic/search/modular/modular_roots.hpp"

namespace casimir::search {
LevelPoints::LevelPoints(const System& system, std::vector<Polynomial> functions,
                         const std::vector<std::size_t>& places)
    : system_(system), functions_(std::move(functions)) {
  // The last to be solved has a variable that no other one has, and so on backwards.
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < functions_.size(); ++i) left.push_back(i);
  while (!left.empty()) {
    std::optional<Step> best;
    long best_degree = 0;
    for (const std::size_t i : left) {
      for (const std::size_t v : places) {
        const long degree = functions_[i].degree(v);
        if (degree <= 0 || (best && degree >= best_degree)) continue;
        const bool own = std::none_of(left.begin(), left.end(), [&](std::size_t j) {
          return j != i && functions_[j].uses(v);
        });
        if (!own) continue;
        best = Step{i, v};
        best_degree = degree;
      }
    }
    if (!best) {
      order_.clear();
      return;
    }
    order_.insert(order_.begin(), *best);
    std::erase(left, best->function);
  }
}

std::optional<Point> LevelPoints::draw(const Modulus& modulus, std::mt19937_64& random,
                                       const Point& constants) const {
  constexpr int kTries = 200;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    std::optional<Point> point = system_.random_point(modulus, random, &constants);
    if (!point) return std::nullopt;
    bool found = true;
    for (const Step& step : order_) {
      std::vector<Residue> coefficients;
      for (const Polynomial& c : functions_[step.function].coefficients(step.variable)) {
        const std::optional<Residue> value = value_at(c, *point, modulus);
        if (!value) return std::nullopt;
        coefficients.push_back(*value);
      }
      const std::optional<Residue> root = random_root(coefficients, modulus, random);
      if (!root) {
        found = false;
        break;
      }
      (*point)[step.variable] = *root;
    }
    if (found) return point;
  }
  return std::nullopt;
}

}  // namespace casimir::search
