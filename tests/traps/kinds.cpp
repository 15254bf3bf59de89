#include "tests/traps/kinds.hpp"

#include <fmt/format.h>

namespace casimir::traps {
namespace {

/// k / 2^bits as an exact text.
Number dyadic(long long k, int bits) {
  for (; bits > 0 && k % 2 == 0; --bits) k /= 2;
  for (; bits < 0; ++bits) k *= 2;
  const long long below = 1LL << bits;
  return {bits == 0 ? fmt::format("{}", k) : fmt::format("{}/{}", k, below),
          static_cast<Real>(k) / static_cast<Real>(below)};
}

}  // namespace

Number between(Random& random, Real least, Real most) {
  const int bits = 10 - std::ilogb(std::max(std::abs(least), std::abs(most)));
  const Real unit = std::ldexp(Real(1), bits);
  const auto low = static_cast<long long>(std::ceil(least * unit));
  const auto high = static_cast<long long>(std::floor(most * unit));
  return dyadic(low + random(static_cast<int>(high - low) + 1), bits);
}

Number scaled(Random& random, Real least, Real most) {
  const Real part = static_cast<Real>(random(1 << 20)) / (1 << 20);
  const Real value = least * std::pow(most / least, part);
  const int bits = 9 - std::ilogb(value);
  return dyadic(std::llround(std::ldexp(value, bits)), bits);
}

}  // namespace casimir::traps
