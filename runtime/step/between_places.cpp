#include "runtime/step/between_places.hpp"

#include <algorithm>
#include <cmath>

namespace casimir {

double reach(std::span<const double> places, std::span<const double> values, std::size_t i) {
  const auto change = [&](std::size_t k) { return values[k + 1] - values[k]; };
  const auto slope = [&](std::size_t k) { return change(k) / (places[k + 1] - places[k]); };
  double most = std::abs(change(i)), bend = 0;
  if (i > 0) {
    most = std::max(most, std::abs(change(i - 1)));
    bend = std::max(bend, std::abs(slope(i) - slope(i - 1)));
  }
  if (i + 2 < places.size()) {
    most = std::max(most, std::abs(change(i + 1)));
    bend = std::max(bend, std::abs(slope(i + 1) - slope(i)));
  }
  return most + bend * (places[i + 1] - places[i]);
}

std::optional<Dip> dip_at(std::span<const double> places, std::span<const double> values,
                          std::size_t i) {
  const double a = places[i], b = places[i + 1], c = places[i + 2];
  const double left = (values[i + 1] - values[i]) / (b - a);
  const double right = (values[i + 2] - values[i + 1]) / (c - b);
  const double bend = (right - left) / (c - a);
  if (!(bend * values[i + 1] > 0)) return std::nullopt;
  const double vertex = (a + b) / 2 - left / (2 * bend);
  if (!(vertex > a && vertex < c)) return std::nullopt;
  return Dip{vertex, values[i] + left * (vertex - a) + bend * (vertex - a) * (vertex - b)};
}

}  // namespace casimir
