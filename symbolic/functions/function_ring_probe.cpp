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

double FunctionRing::probe_new(std::size_t index, std::size_t point) const {
  const Generator& g = generators_[index];
  const auto argument = [&](std::size_t i) { return probe(known_.at(g.value.op(i)), point); };
  switch (g.kind) {
    case Kind::sine:
      return std::sin(probe(g.base, point));
    case Kind::cosine:
      return std::cos(probe(generators_[index - 1].base, point));  // of the sine's argument
    case Kind::exponential:
      return std::exp(probe(g.base, point));
    case Kind::root:
      return std::pow(probe(g.base, point), 1 / static_cast<double>(g.order));
    case Kind::absolute:
      return std::sqrt(probe(g.base, point));  // the base is its square
    case Kind::inverse:
      return 1 / probe(g.base, point);
    case Kind::imaginary:
      return kNoValue;
    case Kind::function:
      break;
  }
  switch (static_cast<FunctionTag>(g.order)) {
    case kLogarithm:
      return std::log(probe(g.base, point));
    case kLogOfAbsolute:
      return std::log(std::abs(probe(g.base, point)));
    case kArcTangent:
      return std::atan(probe(g.base, point));
    case kArcSine:
      return std::asin(probe(g.base, point));
    case kArcCosine:
      return std::acos(probe(g.base, point));
    case kArcTangentOfTwo:
      return std::atan2(argument(0), argument(1));
    case kPartCosine:
      return std::cos(probe(g.base, point));
    case kPartSine:
      return std::sin(probe(g.base, point));
    default:
      return kNoValue;
  }
}

/// Each is computed once.
double FunctionRing::probe_generator(std::size_t g, std::size_t point) const {
  std::vector<std::optional<double>>& known = probes_[point];
  if (g < known.size() && known[g]) return *known[g];
  const double value = probe_new(g, point);
  if (known.size() <= g) known.resize(g + 1);
  known[g] = value;
  return value;
}

double FunctionRing::probe(const Polynomial& p, std::size_t point) const {
  double sum = 0;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    double term = cln::double_approx(coefficient);
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      const double value =
          i < symbols_.size() ? coordinate(i, point) : probe_generator(i - symbols_.size(), point);
      term *= std::pow(value, static_cast<double>(exponents[i]));
    }
    sum += term;
  }
  return sum;
}

bool FunctionRing::differ(double a, double b) {
  constexpr double kRounding = 1e-6;
  return std::abs(a - b) > kRounding * (1 + std::abs(a) + std::abs(b));
}

}  // namespace casimir
