#include "symbolic/functions/function_probe.hpp"

#include <cln/float.h>
#include <cln/rational.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "symbolic/expression/arbitrary.hpp"

namespace casimir::functions {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// Between 0.3 and 1, in no simple relation with each other, and in another order at another point:
/// Weyl's sequences.
double coordinate(std::size_t i, std::size_t point) {
  constexpr std::array<double, kProbes> kPrimes = {2, 3, 5, 7, 11, 13, 17, 19};
  const double multiple = static_cast<double>(i + 1) * std::sqrt(kPrimes[point]);
  return 0.3 + 0.7 * (multiple - std::floor(multiple));
}

}  // namespace

double FunctionProbe::new_generator_at(Probe& probe, std::size_t index) const {
  const Generator& g = table_.generators()[index];
  switch (g.kind) {
    case Kind::sine:
      return std::sin(value_at(probe, g.base));
    case Kind::cosine:
      return std::cos(
          value_at(probe, table_.generators()[index - 1].base));  // of the sine's argument
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
      return std::atan2(value_at(probe, g.arguments[0]), value_at(probe, g.arguments[1]));
    case kPartCosine:
      return std::cos(value_at(probe, g.base));
    case kPartSine:
      return std::sin(value_at(probe, g.base));
    case kArbitrary:
    case kLastArbitrary:
      return arbitrary_at(probe, g);
    default:
      return kNoValue;
  }
}

/// At a point where nothing is proved an arbitrary function is one that is not constant anywhere:
/// exp of a sum of multiples of its arguments.
double FunctionProbe::arbitrary_at(Probe& probe, const Generator& g) const {
  const Arbitrary own = *as_arbitrary(GiNaC::ex_to<GiNaC::function>(g.value));
  const auto at = std::find_if(table_.symbols().begin(), table_.symbols().end(),
                               [&](const GiNaC::symbol& s) { return s.is_equal(own.function); });
  const double which = static_cast<double>(at - table_.symbols().begin()) + 1;
  double exponent = 0, factor = 1;
  for (std::size_t i = 0; i < own.arguments.size(); ++i) {
    const double multiple = 0.3 + std::sqrt(which + static_cast<double>(i)) / 5;
    exponent += multiple * value_at(probe, g.arguments[i]);
    factor *= std::pow(multiple, own.orders[i]);
  }
  return factor * std::exp(exponent);
}

/// Each is computed once.
double FunctionProbe::generator_at(Probe& probe, std::size_t g) const {
  std::vector<std::optional<double>>& known = probe.generators;
  if (g < known.size() && known[g]) return *known[g];
  const double value = new_generator_at(probe, g);
  if (known.size() <= g) known.resize(g + 1);
  known[g] = value;
  return value;
}

Probe FunctionProbe::probe(std::size_t k) const {
  Probe result;
  for (std::size_t i = 0; i < table_.symbols().size(); ++i)
    result.coordinates.push_back(coordinate(i, k));
  return result;
}

double FunctionProbe::value_at(Probe& probe, const Polynomial& p) const {
  double sum = 0;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    double term = cln::double_approx(coefficient);
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      const double value = i < table_.symbols().size()
                               ? probe.coordinates[i]
                               : generator_at(probe, i - table_.symbols().size());
      term *= std::pow(value, static_cast<double>(exponents[i]));
    }
    sum += term;
  }
  return sum;
}

bool FunctionProbe::has_values_at(Probe& probe) const {
  for (std::size_t g = 0; g < table_.generators().size(); ++g)
    if (table_.generators()[g].kind != Kind::inverse && !std::isfinite(generator_at(probe, g)))
      return false;
  return true;
}

bool differ(double a, double b) {
  constexpr double kRounding = 1e-6;
  return std::abs(a - b) > kRounding * (1 + std::abs(a) + std::abs(b));
}

}  // namespace casimir::functions
