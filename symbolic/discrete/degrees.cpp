#include "symbolic/discrete/degrees.hpp"

#include <algorithm>

#include "symbolic/discrete/kahan.hpp"
#include "symbolic/discrete/modular_map.hpp"
#include "symbolic/discrete/univariate.hpp"

namespace casimir::discrete {
namespace {

/// The degree of the rational function with these values; empty where there are too few points.
std::optional<int> degree_from_values(const std::vector<Element>& t,
                                      const std::vector<Element>& y) {
  const std::optional<Quotient> found = quotient_from_values(t, y);
  if (!found) return std::nullopt;
  return static_cast<int>(std::max({found->top.degree(), found->bottom.degree(), 0L}));
}

/// Orbits of points on a line, one step of all at a time.
class Line {
 public:
  explicit Line(const ModularMap& map)
      : map_(map),
        origin_(map.random_state()),
        direction_(map.random_state()),
        weights_(map.random_state()) {}

  /// So many points in all; those that are new are taken to the iterate of the others.
  void resize(std::size_t points, const search::Watch& watch) {
    const PrimeField field;
    while (states_.size() < points) {
      if (states_.size() % 16 == 0)
        watch.tick(static_cast<double>(states_.size()) / static_cast<double>(points));
      const Element t = next_place_++;
      ModularMap::State state;
      for (std::size_t i = 0; i < origin_.size(); ++i)
        state.push_back(field.add(origin_[i], field.multiply(t, direction_[i])));
      bool defined = true;
      for (int k = 0; k < iterate_ && defined; ++k) defined = advance(state);
      if (!defined) continue;
      places_.push_back(t);
      states_.push_back(std::move(state));
    }
  }

  /// One more iterate; points at which it has no value are left out.
  void step() {
    ++iterate_;
    std::vector<Element> places;
    std::vector<ModularMap::State> states;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (!advance(states_[i])) continue;
      places.push_back(places_[i]);
      states.push_back(std::move(states_[i]));
    }
    places_ = std::move(places);
    states_ = std::move(states);
  }

  std::optional<int> degree() const {
    const PrimeField field;
    std::vector<Element> values;
    for (const ModularMap::State& state : states_) {
      Element sum = 0;
      for (std::size_t i = 0; i < state.size(); ++i)
        sum = field.add(sum, field.multiply(weights_[i], state[i]));
      values.push_back(sum);
    }
    return degree_from_values(places_, values);
  }

  std::size_t size() const { return states_.size(); }

 private:
  bool advance(ModularMap::State& state) const {
    auto next = map_(state);
    if (next) state = std::move(*next);
    return next.has_value();
  }

  const ModularMap& map_;
  ModularMap::State origin_, direction_, weights_;
  Element next_place_ = 1;
  int iterate_ = 0;
  std::vector<Element> places_;
  std::vector<ModularMap::State> states_;
};

std::vector<int> degrees_of(const ModularMap& map, const DegreeRequest& request,
                            const search::Watch& watch) {
  // Where no number is asked for, up to the degree at which an iterate costs a second.
  constexpr int kMostIterates = 14;
  constexpr int kLargeDegree = 300;
  constexpr std::size_t kMostPoints = 40000, kFirstPoints = 64;
  Line line(map);
  line.resize(kFirstPoints, watch);
  std::vector<int> degrees;
  // A shift of n variables needs as many steps before what it does to one of them shows.
  const int iterates =
      request.iterates.value_or(std::max(kMostIterates, 2 * static_cast<int>(map.dimension()) + 4));
  while (static_cast<int>(degrees.size()) < iterates) {
    watch.begin("iterate " + std::to_string(degrees.size() + 1));
    line.step();
    std::optional<int> degree = line.degree();
    while (!degree) {
      if (2 * line.size() > kMostPoints)
        throw search::NoAnswer("the degree of iterate " + std::to_string(degrees.size() + 1) +
                               " exceeds " + std::to_string(kMostPoints / 2));
      line.resize(2 * line.size(), watch);
      degree = line.degree();
    }
    degrees.push_back(*degree);
    if (!request.iterates && *degree > kLargeDegree) break;
  }
  return degrees;
}

}  // namespace

std::vector<int> degrees_of_iterates(const MapModel& map, const DegreeRequest& request,
                                     const search::Watch& watch) {
  return degrees_of(ModularMap(map), request, watch);
}

std::vector<int> degrees_of_kahan_iterates(const Model& flow, const DegreeRequest& request,
                                           const search::Watch& watch) {
  check_quadratic(flow);
  return degrees_of(ModularMap::kahan(flow), request, watch);
}

}  // namespace casimir::discrete
