#pragma once

#include "symbolic/model.hpp"

namespace casimir::codegen {

/// Looks at functions and roots of constants, as they are written: GiNaC makes Pi of acos(a) +
/// acos(-a), and a of sqrt(a)^2, whatever a is.
/// \param binding  parameters may stand for themselves; what has them is left alone
/// \throws ModelError  where the values of `binding` make one of them no real number
void require_real_constants(const Model& model, const GiNaC::ex& expression, const Scene& binding);

}  // namespace casimir::codegen
