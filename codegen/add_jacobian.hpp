#pragma once

#include "codegen/specialise.hpp"

namespace casimir {

/// Adds the Jacobian to what was specialised without one: the search for a short form of it can
/// take longer than all else, and few methods need it.
void add_jacobian(Specialisation& specialisation);

}  // namespace casimir
