#include "runtime/digits/root_zeros.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/evaluate.hpp"

namespace casimir {
namespace {

/// Of the largest value that a radicand has had. Places in a step are known to 10^(-16) of it, and
/// a radicand that touches zero is about the square of that at the nearest.
constexpr double kZero = 1e-27;

}  // namespace

RootZeros::RootZeros(const Program& rhs, std::vector<double> parameters)
    : states_(rhs.outputs.size()) {
  Program radicands = rhs;
  radicands.outputs.clear();
  radicands.output_names.clear();
  for (const Instruction& line : rhs.code) {
    if (line.op != Op::pow) continue;
    const double exponent =
        literal_value(rhs, rhs.code[static_cast<std::size_t>(line.b)], Arithmetic<double>{});
    if (!(exponent > 0 && exponent < 0.5) || std::ranges::count(radicands.outputs, line.a) > 0)
      continue;
    radicands.outputs.push_back(line.a);
    radicands.output_names.emplace_back("radicand");
  }
  if (radicands.outputs.empty()) return;
  highest_.assign(radicands.outputs.size(), 0);
  values_.resize(highest_.size());
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

std::optional<double> RootZeros::zero_in(const StateAt& state_at) {
  constexpr std::size_t kPlaces = 17;
  std::vector<std::vector<double>> sampled(kPlaces);
  for (std::size_t i = 0; i < kPlaces; ++i) {
    sampled[i] = radicands(static_cast<double>(i) / (kPlaces - 1), state_at);
    for (std::size_t k = 0; k < highest_.size(); ++k)
      highest_[k] = std::max(highest_[k], sampled[i][k]);
  }
  for (std::size_t k = 0; k < highest_.size(); ++k) {
    for (std::size_t i = 0; i + 2 < kPlaces; ++i) {
      if (!(sampled[i + 1][k] <= sampled[i][k] && sampled[i + 1][k] <= sampled[i + 2][k])) continue;
      // The least value between the neighbours, by the golden section.
      constexpr double kGolden = 0.6180339887498949;
      double low = static_cast<double>(i) / (kPlaces - 1);
      double high = static_cast<double>(i + 2) / (kPlaces - 1);
      for (int round = 0; round < 90; ++round) {
        const double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
        const double at_left = radicands(left, state_at)[k];
        if (at_left < radicands(right, state_at)[k])
          high = right;
        else
          low = left;
      }
      const double place = (low + high) / 2;
      if (radicands(place, state_at)[k] <= kZero * highest_[k]) return place;
    }
  }
  return std::nullopt;
}

}  // namespace casimir
