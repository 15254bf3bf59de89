#include "runtime/digits/root_zeros.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/evaluate.hpp"

namespace casimir {

RootZeros::RootZeros(const Program& rhs, std::vector<double> parameters)
    : states_(rhs.outputs.size()) {
  Program radicands = rhs;
  radicands.outputs.clear();
  radicands.output_names.clear();
  for (const Instruction& line : rhs.code) {
    if (line.op != Op::pow && line.op != Op::sqrt) continue;
    const auto code = [&](int of) { return rhs.code[static_cast<std::size_t>(of)]; };
    const double exponent =
        line.op == Op::sqrt ? 0.5 : literal_value(rhs, code(line.b), Arithmetic<double>{});
    const double least = code(line.a).op == Op::abs ? 1 : 0.5;
    if (!(exponent > 0 && exponent < least) || std::ranges::count(radicands.outputs, line.a) > 0)
      continue;
    radicands.outputs.push_back(line.a);
    radicands.output_names.emplace_back("radicand");
  }
  if (radicands.outputs.empty()) return;
  values_.resize(radicands.outputs.size());
  inputs_.resize(states_);
  inputs_.insert(inputs_.end(), parameters.begin(), parameters.end());
  inputs_.push_back(0);
  evaluate_.emplace(radicands);
}

const std::vector<double>& RootZeros::radicands(double part, const StateAt& state_at) {
  inputs_.back() = state_at(part, inputs_.data());
  (*evaluate_)(inputs_.data(), values_.data());
  return values_;
}

std::optional<double> RootZeros::zero_in(const StateAt& state_at, double zero) {
  constexpr std::size_t kPlaces = 17;
  std::vector<std::vector<double>> sampled(kPlaces);
  std::vector<double> highest(values_.size(), 0);
  for (std::size_t i = 0; i < kPlaces; ++i) {
    sampled[i] = radicands(static_cast<double>(i) / (kPlaces - 1), state_at);
    for (std::size_t k = 0; k < highest.size(); ++k)
      highest[k] = std::max(highest[k], sampled[i][k]);
  }
  const auto place_of = [](std::size_t i) { return static_cast<double>(i) / (kPlaces - 1); };
  for (std::size_t k = 0; k < highest.size(); ++k) {
    for (std::size_t i = 0; i < kPlaces; ++i) {
      const std::size_t before = i > 0 ? i - 1 : i, behind = i + 1 < kPlaces ? i + 1 : i;
      if (sampled[before][k] < sampled[i][k] || sampled[behind][k] < sampled[i][k]) continue;
      if (sampled[i][k] <= zero * highest[k]) return place_of(i);
      const double place = least_between(place_of(before), place_of(behind), k, state_at);
      if (radicands(place, state_at)[k] <= zero * highest[k]) return place;
    }
  }
  return std::nullopt;
}

/// Where a radicand is least that is so within a part of a step: by the golden section.
double RootZeros::least_between(double low, double high, std::size_t which,
                                const StateAt& state_at) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kRounds = 90;
  for (int round = 0; round < kRounds; ++round) {
    const double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    const double at_left = radicands(left, state_at)[which];
    if (at_left < radicands(right, state_at)[which])
      high = right;
    else
      low = left;
  }
  return (low + high) / 2;
}

}  // namespace casimir
