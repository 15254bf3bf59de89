#pragma once

#include "symbolic/model.hpp"

namespace casimir {

/// Refuses what is to be enclosed, or computed with more digits than doubles have, where it has
/// elliptic functions: generated code has these by a number of steps that is enough for doubles.
/// \param what  is asked for, as "an enclosure": for the message
/// \throws RequestError
void require_exact_values(const Model& model, const Scene& scene, const char* what);

}  // namespace casimir
