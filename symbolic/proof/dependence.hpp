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
///
/// The relation says that the first function follows from the others: its highest power has a
/// number before it. Any other factor may vanish: identically, as F - 2*H, where the others are not
/// independent; on a part of the domain, as F = p + |p| in p*F - F^2/2 = 0 where p < 0.
/// \param independent  whether the others are known to be: then a factor that can only vanish
///                     identically will do as well
std::optional<std::string> polynomial_relation(Prover& prover,
                                               const std::vector<NamedExpression>& functions,
                                               bool independent);

}  // namespace casimir
