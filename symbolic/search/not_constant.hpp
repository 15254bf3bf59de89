#pragma once

#include <ginac/ginac.h>

#include "symbolic/model.hpp"

namespace casimir::search {

/// Whether the function was shown to depend on the coordinates or the time: some derivative along
/// one of them has a ball of values without zero at a real point, at which all assumptions hold.
bool is_certainly_not_constant(const Model& model, const GiNaC::ex& function);

}  // namespace casimir::search
