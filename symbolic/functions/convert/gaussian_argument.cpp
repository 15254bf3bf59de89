#include "symbolic/functions/convert/gaussian_argument.hpp"

#include <cln/integer.h>
#include <cln/real.h>

#include <cmath>

#include "symbolic/algebra/integer_factors.hpp"

namespace casimir {
namespace {

using cln::cl_I;

struct Gaussian {
  cl_I real, imaginary;
};

cl_I norm(const Gaussian& z) { return z.real * z.real + z.imaginary * z.imaginary; }

/// z times the conjugate of w.
Gaussian times_conjugate(const Gaussian& z, const Gaussian& w) {
  return {z.real * w.real + z.imaginary * w.imaginary, z.imaginary * w.real - z.real * w.imaginary};
}

/// Euclid's algorithm: quotients are rounded to the nearest, so that norms are halved at least.
Gaussian gcd(Gaussian a, Gaussian b) {
  while (!cln::zerop(norm(b))) {
    const Gaussian top = times_conjugate(a, b);
    const Gaussian q{cln::round1(top.real, norm(b)), cln::round1(top.imaginary, norm(b))};
    const Gaussian rest{a.real - (q.real * b.real - q.imaginary * b.imaginary),
                        a.imaginary - (q.real * b.imaginary + q.imaginary * b.real)};
    a = b;
    b = rest;
  }
  return a;
}

}  // namespace

std::optional<GaussianArgument> gaussian_argument(const cln::cl_RA& r) {
  const Gaussian z{cln::denominator(r), cln::numerator(r)};
  const auto factors = prime_factors(norm(z));
  if (!factors || cln::zerop(r)) return std::nullopt;
  cl_I count = 0;
  GaussianArgument result;
  double rest = std::atan(cln::double_approx(r));
  for (const auto& [prime, multiplicity] : *factors) {
    count = count + cl_I(multiplicity);
    if (prime == 2) continue;  // of 1 + i, a quarter
    const Gaussian factor = gcd(z, {prime, 0});
    const cl_I first = cln::abs(factor.real), second = cln::abs(factor.imaginary);
    const Gaussian canonical{cln::max(first, second), cln::min(first, second)};
    const cl_I product = times_conjugate(z, canonical).real;
    const cl_I times =
        cln::zerop(cln::mod(product, prime)) ? cl_I(multiplicity) : -cl_I(multiplicity);
    const cln::cl_RA part = canonical.imaginary / canonical.real;
    result.parts.emplace_back(part, times);
    rest -= cln::double_approx(times) * std::atan(cln::double_approx(part));
  }
  if (count < 2) return std::nullopt;
  // What is left is a multiple of a quarter; doubles are good enough to tell which.
  constexpr double kQuarter = 0.78539816339744830962, kClose = 1e-6;
  const double quarters = std::round(rest / kQuarter);
  if (!(std::fabs(rest - quarters * kQuarter) < kClose)) return std::nullopt;
  result.quarters = cl_I(static_cast<long>(quarters));
  return result;
}

}  // namespace casimir
