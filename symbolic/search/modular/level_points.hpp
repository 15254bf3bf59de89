#pragma once

#include <optional>
#include <random>
#include <vector>

#include "symbolic/search/system.hpp"

namespace casimir::search {

/// Draws points of the common zero level of functions modulo a prime.
class LevelPoints {
 public:
  /// \param places  the variables that may be solved for.
  LevelPoints(const System& system, std::vector<Polynomial> functions,
              const std::vector<std::size_t>& places);

  /// Whether the functions can be solved one after the other, each for a variable of its own.
  bool possible() const { return order_.size() == functions_.size(); }

  std::optional<Point> draw(const Modulus& modulus, std::mt19937_64& random,
                            const Point& constants) const;

 private:
  const System& system_;
  std::vector<Polynomial> functions_;
  struct Step {
    std::size_t function, variable;
  };
  std::vector<Step> order_;  ///< in which they are solved
};

}  // namespace casimir::search
