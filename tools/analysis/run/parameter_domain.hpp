#pragma once

#include <vector>

#include "symbolic/model.hpp"

namespace casimir {

/// Conditions on the parameters alone without which what is integrated, as it was written, has no
/// value anywhere: a != 0 for 1/a, for a*x/a and for sign(a*x), a >= 0 for sqrt(a)^2, a > 0 for
/// log(a). Where parameters are known at run time only, nothing else sees that.
/// \param folded  values of those that are known before: a^n asks for a >= 0 unless n is whole
std::vector<Assumption> implied_by_parameters(const Model& model, const GiNaC::exmap& folded);

}  // namespace casimir
