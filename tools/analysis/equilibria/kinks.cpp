#include "tools/analysis/equilibria/kinks.hpp"

#include <algorithm>
#include <cmath>

namespace casimir {

Kinks::Kinks(const Program& rhs) : watch_(rhs), evaluate_(watch_.arguments()) {}

std::vector<double> Kinks::arguments(const std::vector<double>& inputs) const {
  std::vector<double> values(watch_.arguments().outputs.size());
  evaluate_(inputs.data(), values.data());
  std::vector<double> result;
  for (const StepWatch::Watched& watched : watch_.watched())
    if (watched.kind == StepWatch::Kind::side || watched.kind == StepWatch::Kind::jump ||
        watched.kind == StepWatch::Kind::turn || watched.kind == StepWatch::Kind::divisor)
      result.push_back(values[watched.place]);
  return result;
}

bool Kinks::are_at(const std::vector<double>& inputs,
                   const std::vector<std::vector<double>>& nearby) const {
  const std::vector<double> here = arguments(inputs);
  std::vector<double> changes(here.size(), 0);
  for (const std::vector<double>& other : nearby) {
    const std::vector<double> there = arguments(other);
    for (std::size_t k = 0; k < here.size(); ++k)
      changes[k] = std::max(changes[k], std::abs(there[k] - here[k]));
  }
  constexpr double kSeveral = 2;
  for (std::size_t k = 0; k < here.size(); ++k)
    if (std::abs(here[k]) <= kSeveral * changes[k]) return true;
  return false;
}

}  // namespace casimir
