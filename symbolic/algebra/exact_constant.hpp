#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string>

namespace casimir {

/// What is known of a number given by an expression without symbols.
struct ExactConstant {
  bool zero = false;
  std::string text;  ///< the same in every run, unlike GiNaC's
};

/// Decides whether the number is zero, by theorems and exact arithmetic alone; empty where none
/// applies. Covers quotients of sums of products of
///   rational powers of rational numbers  (Besicovitch 1940: distinct products of roots of primes
///                                         are linearly independent over the rationals),
///   the imaginary unit,
///   exp, sin, cos, tan of rational numbers (Lindemann and Weierstrass),
///   log of rational numbers and Pi, linearly (Baker).
std::optional<ExactConstant> exact_constant(const GiNaC::ex& value);

/// The sign of a real number; empty for what is not real or not decided.
/// \param bits  of the numbers on the way, as of `decimal`
std::optional<int> sign_of_constant(const GiNaC::ex& value, double bits);

}  // namespace casimir
