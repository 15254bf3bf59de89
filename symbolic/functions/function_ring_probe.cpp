// A FunctionRing at points in double precision, to tell functions apart before algebra is asked
// whether they are equal. Nothing is proved by it: a relation that is overlooked makes an answer
// `undecided`.
#include <cln/float.h>
#include <cln/rational.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "symbolic/functions/function_ring.hpp"

namespace casimir {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// Between 0.3 and 1, in no simple relation with each other, and in another order at another point:
/// Weyl's sequences.
double coordinate(std::size_t i, std::size_t point) {
  constexpr std::array<double, FunctionRing::kProbes> kPrimes = {2, 3, 5, 7, 11, 13, 17, 19};
  const double multiple = static_cast<double>(i + 1) * std::sqrt(kPrimes[point]);
  return 0.3 + 0.7 * (multiple - std::floor(multiple));
}

}  // namespace

double FunctionRing::new_generator_at(Probe& probe, std::size_t index) const {
  const Generator& g = generators_[index];
  const auto argument = [&](std::size_t i) { return value_at(probe, known_.at(g.value.op(i))); };
  switch (g.kind) {
    case Kind::sine:
      return std::sin(value_at(probe, g.base));
    case Kind::cosine:
      return std::cos(value_at(probe, generators_[index - 1].base));  // of the sine's argument
    case Kind::exponential:
      return std::exp(value_at(probe, g.base));
    case Kind::root:
      return std::pow(value_at(probe, g.base), 1 / static_cast<double>(g.order));
    case Kind::absolute:
      return std::sqrt(value_at(probe, g.base));  // the base is its square
    case Kind::inverse:
      return 1 / value_at(probe, g.base);
    case Kind::imaginary:
      return kNoValue;
    case Kind::function:
      break;
  }
  switch (static_cast<FunctionTag>(g.order)) {
    case kLogarithm:
      return std::log(value_at(probe, g.base));
    case kLogOfAbsolute:
      return std::log(std::abs(value_at(probe, g.base)));
    case kArcTangent:
      return std::atan(value_at(probe, g.base));
    case kArcSine:
      return std::asin(value_at(probe, g.base));
    case kArcCosine:
      return std::acos(value_at(probe, g.base));
    case kArcTangentOfTwo:
      return std::atan2(argument(0), argument(1));
    case kPartCosine:
      return std::cos(value_at(probe, g.base));
    case kPartSine:
      return std::sin(value_at(probe, g.base));
    default:
      return kNoValue;
  }
}

/// Each is computed once.
double FunctionRing::generator_at(Probe& probe, std::size_t g) const {
  std::vector<std::optional<double>>& known = probe.generators;
  if (g < known.size() && known[g]) return *known[g];
  const double value = new_generator_at(probe, g);
  if (known.size() <= g) known.resize(g + 1);
  known[g] = value;
  return value;
}

FunctionRing::Probe FunctionRing::probe(std::size_t k) const {
  Probe result;
  for (std::size_t i = 0; i < symbols_.size(); ++i) result.coordinates.push_back(coordinate(i, k));
  return result;
}

FunctionRing::Probe& FunctionRing::own_probe(std::size_t k) {
  if (probes_[k].coordinates.empty()) probes_[k] = probe(k);
  return probes_[k];
}

double FunctionRing::value_at(Probe& probe, const Polynomial& p) const {
  double sum = 0;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    double term = cln::double_approx(coefficient);
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      const double value =
          i < symbols_.size() ? probe.coordinates[i] : generator_at(probe, i - symbols_.size());
      term *= std::pow(value, static_cast<double>(exponents[i]));
    }
    sum += term;
  }
  return sum;
}

bool FunctionRing::has_values_at(Probe& probe) const {
  for (std::size_t g = 0; g < generators_.size(); ++g)
    if (generators_[g].kind != Kind::inverse && !std::isfinite(generator_at(probe, g)))
      return false;
  return true;
}

bool FunctionRing::differ(double a, double b) {
  constexpr double kRounding = 1e-6;
  return std::abs(a - b) > kRounding * (1 + std::abs(a) + std::abs(b));
}

}  // namespace casimir
