#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// A polynomial relation of low degree between functions, with coefficients that are polynomials in
/// the parameters, as text such as "F = 2*H^2 - C1" or "F^2 - C1*C2 = 0"; proved in the prover's
/// ring. The first function is the one that is asked about: it is solved for where that is
/// possible. Empty if none was found within the limits; that is no proof that there is none.
std::optional<std::string> polynomial_relation(Prover& prover,
                                               const std::vector<NamedExpression>& functions);

}  // namespace casimir
