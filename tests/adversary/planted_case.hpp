#pragma once

#include <vector>

#include "tests/adversary/case.hpp"
#include "tests/adversary/random.hpp"

namespace casimir::adversary {

/// A system of which a structure is known by construction: Kovalevskaya exponents, Darboux
/// polynomials, or what a certificate has to state.
struct PlantedCase {
  Case base;  ///< its kind says which
  /// Kovalevskaya exponents of every sort of balance, each as often as it occurs; none where only
  /// what is reported is checked.
  std::vector<std::vector<Expr>> exponents{};
  /// Irreducible Darboux polynomials up to the degree that are no integrals.
  std::vector<Expr> darboux{};
  int degree = 1;

  /// The case file, with the command that asks in its first line.
  std::string text() const;
};

using PlantedTemplate = PlantedCase (*)(Random&);
/// Quasi-homogeneous systems whose balances are known, in linear coordinates that mix them.
const std::vector<PlantedTemplate>& exponent_templates();
/// Systems with invariant curves and surfaces in bent coordinates, and such without any.
const std::vector<PlantedTemplate>& darboux_templates();
/// Poisson systems with polynomial integrals and Casimir functions.
const std::vector<PlantedTemplate>& certificate_templates();

}  // namespace casimir::adversary
