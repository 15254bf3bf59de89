#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "symbolic/proof/parameter_minors.hpp"

namespace casimir {

/// A parameter that is zero, or equal to another one.
struct ParameterForm {
  Polynomial form;                      ///< vanishes there: a, or a - b
  std::size_t place;                    ///< of a among the variables of the ring
  std::optional<std::size_t> equal_to;  ///< the place of b
};

/// Equations for parameters, each solved for one of them by the others.
struct ParameterEquations {
  std::vector<Polynomial> forms;  ///< that vanish
  /// Place and value of a parameter; no value uses a place that has one.
  std::vector<std::pair<std::size_t, Polynomial>> values{};

  /// `p` with these values.
  Polynomial reduced(Polynomial p) const;
};

/// All such forms of the parameters with these places.
std::vector<ParameterForm> parameter_forms(const PolynomialRing& ring,
                                           const std::vector<std::size_t>& places);

/// Linear equations, one after the other; empty where one contradicts the others, or is not linear.
/// \param places  of the parameters that they may be solved for
std::optional<ParameterEquations> solved_for_parameters(const std::vector<Polynomial>& forms,
                                                        const std::vector<std::size_t>& places);

/// False where some minor is certainly not zero at a point at which both forms are: one with small
/// numbers, at which the minors are evaluated modulo a prime.
bool may_all_vanish(const ParameterForm& a, const ParameterForm& b,
                    const std::vector<std::size_t>& places, const PolynomialRing& ring,
                    const std::vector<MinorModulo>& minors);

}  // namespace casimir
